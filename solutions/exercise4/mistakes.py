"""Wrong answers to exercise 4, and what a learner must be told about each."""

from grader.exercise.mistake import Mistake, replace_text

JAVA, PYTHON = "ExampleSubsystem.java", "example_subsystem.py"

CONFIG = "new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10))"
MECHANISM = "new SysIdRoutine.Mechanism(this::drive, this::record, this)"
LEFT, RIGHT = "m_left.setVoltage(voltage.in(Volts))", "m_right.setVoltage(voltage.in(Volts))"
APPLIED_LEFT = "Volts.of(m_left.getMotorVoltage().getValueAsDouble())"
LOGGED_RIGHT = (
    '        log.motor("right").voltage(self.right.getVoltage()).position(\n',
    "            self.right_encoder.getDistance()\n",
    "        ).velocity(self.right_encoder.getRate())\n",
)

SHALLOW, DEEP = "    ", "        "  # in front of a method, and of its statements
INIT = "    def __init__(self)"
ROUTINE_PYTHON = (
    f"{DEEP}self.routine = SysIdRoutine(\n"
    f"{DEEP}    SysIdRoutine.Config(rampRate=0.5, stepVoltage=3.5, timeout=10.0),\n"
    f"{DEEP}    SysIdRoutine.Mechanism(self.drive, self.record, self),\n"
    f"{DEEP})\n"
)

COMMANDS_V3 = (  # the same routine as Java of WPILib 2027 has it
    ("edu.wpi.first.units", "org.wpilib.units"),
    ("edu.wpi.first.wpilibj.sysid", "org.wpilib.sysid"),
    ("edu.wpi.first.wpilibj2.command.sysid", "org.wpilib.command3.sysid"),
    ("edu.wpi.first.wpilibj2.command.SubsystemBase", "org.wpilib.command3.Mechanism"),
    ("extends SubsystemBase", "extends Mechanism"),
    ("new SysIdRoutine.Mechanism", "new SysIdRoutine.SysIdMechanism"),
    (CONFIG, CONFIG.replace("new SysIdRoutine.Config", "SysIdRoutine.Config.useDataLog")),
)

MISTAKES = (
    Mistake("the routine is never made", JAVA,
        replace_text(
            ("private final SysIdRoutine m_routine =\n      new SysIdRoutine(\n", ""),
            (f"          {CONFIG},\n", ""),
            (f"          {MECHANISM});\n", ""),
        ), "routine", "no SysIdRoutine is made"),
    Mistake("a ramp in volts", JAVA, replace_text(("Volts.of(0.5).per(Second)", "Volts.of(0.5)")),
        "ramp", "The ramp is in V/s", "M-UNITS"),
    Mistake("a unit that is not imported", JAVA,
        replace_text(("import static edu.wpi.first.units.Units.Second;\n", "")), "ramp",
        "Second is not imported"),
    Mistake("a timeout in a unit that is not imported", JAVA,
        replace_text(("Seconds.of(10)", "Milliseconds.of(10)")), "log",
        "Milliseconds is not imported"),
    Mistake("half a volt by dividing whole numbers", JAVA,
        replace_text(("Volts.of(0.5)", "Volts.of(1 / 2)")), "ramp", "1 / 2 is 0"),
    Mistake("a slower ramp, to be on the safe side", PYTHON,
        replace_text(("rampRate=0.5", "rampRate=0.25")), "ramp", "Slower is not safer",
        "M-SLOW-SAFE"),
    Mistake("a ramp left to WPILib", JAVA, replace_text(("Volts.of(0.5).per(Second)", "null")),
        "ramp", "WPILib's default, 1 V/s"),
    Mistake("None where Java would take null", PYTHON,
        replace_text(("rampRate=0.5", "rampRate=None")), "ramp", "RobotPy stops with a TypeError"),
    Mistake("the step of the lesson's example", JAVA,
        replace_text(("Volts.of(3.5)", "Volts.of(3.0)")), "step", "3 V is an example in many"),
    Mistake("a step left to WPILib", JAVA, replace_text(("Volts.of(3.5)", "null")), "step",
        "7 V, WPILib's default, is almost always too much", "M-BIG-STEP"),
    Mistake("a step from a function that is not there", PYTHON,
        replace_text(("stepVoltage=3.5", "stepVoltage=load_step()")), "routine",
        "name 'load_step' is not defined"),
    Mistake("a timeout of one minute", JAVA,
        replace_text(("Seconds.of(10)", "edu.wpi.first.units.Units.Minutes.of(1)")), "timeout",
        "60 s"),
    Mistake("Commands v3: all numbers left to WPILib", JAVA,
        replace_text(
            *COMMANDS_V3,
            (
                CONFIG.replace("new SysIdRoutine.Config", "SysIdRoutine.Config.useDataLog"),
                "SysIdRoutine.Config.defaults()",
            ),
        ), "step", "7 V, WPILib's default, is almost always too much", "M-BIG-STEP"),
    Mistake("Commands v3: a slower ramp", JAVA,
        replace_text(*COMMANDS_V3, ("Volts.of(0.5).per(Second)", "Volts.of(0.25).per(Second)")),
        "ramp", "Slower is not safer", "M-SLOW-SAFE"),
    Mistake("Commands v3: null for the timeout", JAVA,
        replace_text(*COMMANDS_V3, ("Seconds.of(10)", "null")), "timeout",
        "Commands v3 takes no null there"),
    Mistake("Commands v3: a name of Commands v2", JAVA,
        replace_text(*COMMANDS_V3, ("SysIdRoutine.SysIdMechanism", "SysIdRoutine.Mechanism")),
        "assembled", "SysIdRoutine has no Mechanism. Did you mean SysIdMechanism?"),
    Mistake("a share of the battery, Java", JAVA,
        replace_text(
            (LEFT, "m_left.set(voltage.in(Volts) / 12.0)"),
            (RIGHT, "m_right.set(voltage.in(Volts) / 12.0)"),
        ), "open-loop", "setVoltage(voltage), unchanged", "M-DUTY"),
    Mistake("a share of the battery, Python", PYTHON,
        replace_text(
            ("self.left.setVoltage(voltage)", "self.left.set(voltage / 12)"),
            ("self.right.setVoltage(voltage)", "self.right.set(voltage / 12)"),
        ), "drive", "to setVoltage() unchanged", "M-DUTY"),
    Mistake("volts divided by twelve and sent as volts", JAVA,
        replace_text((LEFT, "m_left.setVoltage(voltage.in(Volts) / 12)")), "drive",
        "to setVoltage() unchanged", "M-DUTY"),
    Mistake("a closed loop in the drive callback", JAVA,
        replace_text(
            (LEFT, "m_left.setControl(new VelocityVoltage(voltage.in(Volts)))"),
            (RIGHT, "m_right.setControl(new VelocityVoltage(voltage.in(Volts)))"),
        ), "open-loop", "use no controller in the test", "M-CLOSEDLOOP"),
    Mistake("only one of two motors driven", JAVA, replace_text((f"    {RIGHT};\n", "")), "drive",
        "m_right gets no voltage"),
    Mistake("one motor driven backward, though nothing inverts it", JAVA,
        replace_text((RIGHT, RIGHT.replace("voltage", "-voltage"))), "drive",
        "the sign of the voltage is changed"),
    Mistake("a limit of one's own in the drive callback", PYTHON,
        replace_text(
            ("        self.left.set", (
                "        if self.left_encoder.getDistance() > 3:\n            voltage = 0\n"
                "        self.left.set"
            )),
        ), "drive", "does a condition skip the call"),
    Mistake("always the same voltage", PYTHON,
        replace_text(("setVoltage(voltage)", "setVoltage(3.5)")), "drive",
        "does not depend on the test"),
    Mistake("no log callback", JAVA, replace_text(("this::record", "null")), "log",
        "null instead of the log callback: then"),
    Mistake("the routine in the body of the class", PYTHON,
        replace_text(
            (ROUTINE_PYTHON, ""),
            (INIT, f"{ROUTINE_PYTHON.replace(DEEP, SHALLOW)}\n{INIT}"),
            ("    self.routine =", "    routine ="),
        ), "routine", "the body of a class has no self"),
    Mistake("None for the log callback", PYTHON,
        replace_text(("self.drive, self.record, self", "self.drive, None, self")), "log",
        "stops with a TypeError in the first loop"),
    Mistake("the voltage that was asked for in the log", JAVA,
        replace_text(
            (
                "  /** Called in every loop",
                "  private double m_asked;\n\n  /** Called in every loop",
            ),
            (f"    {LEFT};", f"    m_asked = voltage.in(Volts);\n    {LEFT};"),
            (APPLIED_LEFT, "Volts.of(m_asked)"),
        ), "log", "the commanded voltage", "M-CMDVOLT"),
    Mistake("no velocity in the log", PYTHON,
        replace_text((".velocity(self.left_encoder.getRate())", "")), "log", "no velocity of left"),
    Mistake("ticks for meters", JAVA,
        replace_text(("METERS_PER_ROTATION = 0.0472", "METERS_PER_ROTATION = 2048")), "units",
        "One rotation would be 2048 m", "M-UNITS"),
    Mistake("one side's numbers under both names", JAVA,
        replace_text(
            *((f"{part}m_right)", f"{part}m_left)") for part in ("Meters(", "Second(")),
            ("m_right.getMotorVoltage", "m_left.getMotorVoltage"),
        ), "log", "right gets the voltage of m_left"),
    Mistake("the velocity in place of the position", JAVA,
        replace_text(("Meters.of(getMeters(m_left))", "Meters.of(getMetersPerSecond(m_left))")),
        "log", "the position of left is the velocity of m_left"),
    Mistake("one side is not in the log", PYTHON,
        replace_text(*((line, "") for line in LOGGED_RIGHT)), "log", "no right motor in the log"),
    Mistake("rotations under the name of meters", JAVA,
        replace_text(
            ("getMeters(m_left)", "m_left.getPosition().getValueAsDouble()"),
            ("getMetersPerSecond(m_left)", "m_left.getVelocity().getValueAsDouble()"),
        ), "units", "m_left reports rotations, and the log says", "M-UNITS"),
    Mistake("the position in meters, the velocity in rotations", JAVA,
        replace_text(
            (
                ".linearVelocity(MetersPerSecond.of(getMetersPerSecond(m_left)))",
                ".angularVelocity(RotationsPerSecond.of(m_left.getVelocity().getValueAsDouble()))",
            )
        ), "units", "Choose one kind for all", "M-UNITS"),
    Mistake("an arm in meters", PYTHON, replace_text(("ExampleSubsystem", "ArmSubsystem")), "units",
        "moves in Rotations or Radians", "M-UNITS"),
    Mistake("the two arguments swapped", JAVA,
        replace_text((CONFIG, "CONFIG"), (MECHANISM, CONFIG), ("CONFIG,", f"{MECHANISM},")),
        "assembled", "First the Config, then the Mechanism", "M-ARGORDER"),
    Mistake("the two callbacks swapped", JAVA,
        replace_text(("this::drive, this::record", "this::record, this::drive")), "drive",
        "Are the two callbacks swapped?", "M-ARGORDER"),
    Mistake("the two callbacks swapped, Python", PYTHON,
        replace_text(("self.drive, self.record", "self.record, self.drive")), "log",
        "Are the two callbacks swapped?", "M-ARGORDER"),
    Mistake("ramp and step swapped", JAVA,
        replace_text(
            (
                "Volts.of(0.5).per(Second), Volts.of(3.5)",
                "Volts.of(3.5), Volts.of(0.5).per(Second)",
            )
        ), "ramp", "Config takes the ramp first", "M-ARGORDER"),
    Mistake("ramp and step swapped, Python", PYTHON,
        replace_text(("rampRate=0.5, stepVoltage=3.5", "rampRate=3.5, stepVoltage=0.5")), "ramp",
        "The numbers of ramp and step are swapped", "M-ARGORDER"),
    Mistake("a decimal comma", JAVA, replace_text(("Volts.of(0.5)", "Volts.of(0,5)")), "ramp",
        "has a point, not a comma"),
    Mistake("the voltage of the battery in the log", JAVA,
        replace_text(("m_left.getMotorVoltage()", "m_left.getSupplyVoltage()")), "log",
        "the voltage of the battery"),
    Mistake("the subsystem forgotten", JAVA, replace_text((", this))", ", null))")), "assembled",
        "no this among the Mechanism's arguments"),
    Mistake("a class that is no subsystem", PYTHON,
        replace_text(("class ExampleSubsystem(Subsystem)", "class ExampleSubsystem")), "assembled",
        "not a subsystem"),
    Mistake("an encoder that counts backward", PYTHON,
        replace_text(("Encoder(2, 3, reverseDirection=True)", "Encoder(2, 3)")), "units",
        "the position of right goes against its voltage"),
    Mistake("a motor that is sent forward voltages only", PYTHON,
        replace_text(
            ("        self.left.set", "        if voltage > 0:\n            self.left.set"),
        ), "drive", "does a condition skip the call"),
    Mistake("a misspelled method in Java", JAVA,
        replace_text(("m_left.setVoltage", "m_left.setVolatge")), "drive",
        "Did you mean setVoltage?"),
    Mistake("a misspelled method in Python", PYTHON,
        replace_text(("self.left.setVoltage", "self.left.setVolatge")), "drive",
        "Did you mean setVoltage?"),
    Mistake("a closed loop on one of both sides", JAVA,
        replace_text((RIGHT, RIGHT.replace("setVoltage(voltage.in(Volts))",
            "setControl(new com.ctre.phoenix6.controls.VelocityVoltage(voltage.in(Volts)))"))),
        "drive", "m_right gets setControl(VelocityVoltage)", "M-CLOSEDLOOP"),
    Mistake("a follower of the other side, set in every loop", JAVA,
        replace_text((RIGHT, RIGHT.replace("setVoltage(voltage.in(Volts))",
            "setControl(new com.ctre.phoenix6.controls.Follower(1, false))"))),
        "drive", "m_right follows m_left"),
    Mistake("a negated voltage in the log", JAVA,
        replace_text((APPLIED_LEFT, APPLIED_LEFT.replace("m_left", "-m_left"))), "log",
        "left's logged voltage is -1 times the voltage of m_left"),
    Mistake("a voltage without its sign", JAVA,
        replace_text((APPLIED_LEFT, f"{APPLIED_LEFT[:9]}Math.abs({APPLIED_LEFT[9:]})")), "log",
        "the voltage of left loses its sign"),
    Mistake("a misspelled signal", JAVA, replace_text(("linearVelocity(", "linearVelocty(")), "log",
        "has no linearVelocty. Did you mean linearVelocity?"),
)  # fmt: skip
