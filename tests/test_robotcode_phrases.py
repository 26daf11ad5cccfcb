"""Single phrases of robot code, and what is read from them: constants, commands, motors."""

from pathlib import Path

import pytest

from grader.robotcode import read
from grader.robotcode.facts import Known, Output, RoutineFacts, Source
from grader.robotcode.vocabulary import DIRECTIONS, constant, is_motor, plain

JAVA = """
import static edu.wpi.first.units.Units.*;

public class Arm extends SubsystemBase {{
  {fields}
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(null, {step}, null),
      new SysIdRoutine.Mechanism({drive}, {log}, this));
}}
"""
PYTHON = """
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpimath.units import millisecondsToSeconds, volts
{top}

class Arm(Subsystem):
    {fields}

    def __init__(self):
        {body}
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(1.0, {step}),
            SysIdRoutine.Mechanism({drive}, {log}, self),
        )

    {methods}
"""


def java(
    folder: Path, *, step: str = "null", fields: str = "", drive: str = "null", log: str = "null"
) -> RoutineFacts:
    path = folder / "Arm.java"
    text = JAVA.format(step=step, fields=fields, drive=drive, log=log)
    path.write_text(text, encoding="utf-8")
    return read(path)


def python(
    folder: Path,
    *,
    step: str = "7.0",
    top: str = "",
    fields: str = "pass",
    body: str = "pass",
    drive: str = "None",
    log: str = "None",
    methods: str = "pass",
) -> RoutineFacts:
    path = folder / "arm.py"
    text = PYTHON.format(
        step=step, top=top, fields=fields, body=body, drive=drive, log=log, methods=methods
    )
    path.write_text(text, encoding="utf-8")
    return read(path)


JAVA_CONSTANTS = {  # an argument, the fields it needs, what it is
    "volts": ("Volts.of(3.5)", "", (3.5, "volts")),
    "a bare fraction": ("Volts.of(.5)", "", (0.5, "volts")),
    "a bare point": ("Volts.of(2.)", "", (2.0, "volts")),
    "an exponent": ("Volts.of(35e-1)", "", (3.5, "volts")),
    "float": ("Volts.of(.5f)", "", (0.5, "volts")),
    "long": ("Volts.of(3L)", "", (3.0, "volts")),
    "hexadecimal": ("Volts.of(0x0B)", "", (11.0, "volts")),
    "octal": ("Volts.of(010)", "", (8.0, "volts")),
    "underscores": ("Millivolts.of(3_500)", "", (3.5, "volts")),
    "Units in front": ("Units.Volts.of(3)", "", (3.0, "volts")),
    "package in front": ("edu.wpi.first.units.Units.Volts.of(3)", "", (3.0, "volts")),
    "per second": ("Volts.of(.5).per(Second)", "", (0.5, "volts-per-second")),
    "per seconds": ("Volts.of(.5).per(Seconds)", "", (0.5, "volts-per-second")),
    "per minute": ("Volts.of(30).per(Minute)", "", (0.5, "volts-per-second")),
    "unit first": ("Volts.per(Second).of(.5)", "", (0.5, "volts-per-second")),
    "divided by a time": ("Volts.of(1).div(Seconds.of(2))", "", (0.5, "volts-per-second")),
    "milliseconds": ("Units.Milliseconds.of(2_500)", "", (2.5, "seconds")),
    "minutes": ("Minutes.of(.5)", "", (30.0, "seconds")),
    "another kind": ("Meters.of(2)", "", (2.0, "other")),
    "a plain number": ("3.5", "", (3.5, "number")),
    "taken out of its unit": ("Volts.of(3).in(Millivolts)", "", (3000.0, "number")),
    "integers divide": ("Volts.of(7 / 2)", "", (3.0, "volts")),
    "a quarter": ("Volts.of(1 / 4)", "", (0.0, "volts")),
    "towards zero": ("Volts.of(-7 / 2)", "", (-3.0, "volts")),
    "one real is enough": ("Volts.of(7.0 / 2)", "", (3.5, "volts")),
    "cast before division": ("Volts.of((double) 7 / 2)", "", (3.5, "volts")),
    "cast after division": ("Volts.of((double) (7 / 2))", "", (3.0, "volts")),
    "cast to int": ("Volts.of((int) 3.9)", "", (3.0, "volts")),
    "remainder": ("Volts.of(-7 % 4)", "", (-3.0, "volts")),
    "signs": ("Volts.of(-(-3) + +1)", "", (4.0, "volts")),
    "times": ("Volts.of(7).times(.5)", "", (3.5, "volts")),
    "plus and minus": ("Volts.of(4).plus(Volts.of(1)).minus(Volts.of(2))", "", (3.0, "volts")),
    "negated": ("Volts.of(3).unaryMinus()", "", (-3.0, "volts")),
    "one of it": ("Volts.one().times(4)", "", (4.0, "volts")),
    "boxed": ("Volts.of(Double.valueOf(3.5))", "", (3.5, "volts")),
    "cast": ("(Voltage) Volts.of(3)", "", (3.0, "volts")),
    "a constant": ("Volts.of(kStep)", "static final double kStep = 3.5;", (3.5, "volts")),
    "this": ("Volts.of(this.step)", "private final double step = 3.5;", (3.5, "volts")),
    "a measure": ("kStep", "static final Voltage kStep = Volts.of(3.5);", (3.5, "volts")),
    "an int": ("Volts.of(k / 2)", "static final int k = 7;", (3.0, "volts")),
    "an int kept as double": ("Volts.of(k / 2)", "static final double k = 7;", (3.5, "volts")),
    "a double from ints": ("Volts.of(k)", "static final double k = 7 / 2;", (3.0, "volts")),
    "nested": (
        "Volts.of(K.a.b)",
        "static class K {static class a {static int b = 3;}}",
        (3, "volts"),
    ),
    "a method": ("step()", "static Voltage step() { return Volts.of(3.5); }", (3.5, "volts")),
    "a real method": ("Volts.of(k() / 2)", "double k() { return 7; }", (3.5, "volts")),
    "null by name": ("kNone", "static final Voltage kNone = null;", "default"),
    "null": ("null", "", "default"),
    "set twice": ("Volts.of(k)", "double k = 3; void f() { k = 4; }", "unknown"),
    "in a circle": ("Volts.of(a)", "double a = b; double b = a;", "unknown"),
    "a choice": ("fast ? Volts.of(7) : Volts.of(3)", "", "unknown"),
    "a foreign call": ("Volts.of(Preferences.getDouble(key, 3))", "", "unknown"),
    "not here": ("Volts.of(Constants.kStep)", "", "unknown"),
    "by zero": ("Volts.of(1 / 0)", "", "unknown"),
    "overflow": ("Volts.of(2_147_483_647 + 1)", "", "unknown"),
    "no amount": ("Volts", "", "unknown"),
    "apples and pears": ("Volts.of(3).plus(Seconds.of(1))", "", "unknown"),
    "text": ('Volts.of("3")', "", "unknown"),
}


@pytest.mark.parametrize("case", JAVA_CONSTANTS)
def test_a_java_constant_is_worked_out_as_java_does_it(case: str, tmp_path: Path) -> None:
    step, fields, expected = JAVA_CONSTANTS[case]

    found = java(tmp_path, step=step, fields=fields).step

    if isinstance(expected, str):
        assert found.known.value == expected
    else:
        assert (found.known, found.dimension) == (Known.STATED, expected[1])
        assert found.value == pytest.approx(expected[0], rel=1e-12)
    assert found.text == step


PYTHON_CONSTANTS = {  # an argument, where it is defined, what it is
    "a number": ("3.5", {}, 3.5),
    "an integer": ("3", {}, 3.0),
    "division": ("7 / 2", {}, 3.5),
    "floor": ("7 // 2", {}, 3.0),
    "at the top": ("STEP", {"top": "STEP = 7 * 0.5"}, 3.5),
    "in the class": ("self.STEP", {"fields": "STEP = 3.5"}, 3.5),
    "by the class": ("Arm.STEP", {"fields": "STEP = 3.5"}, 3.5),
    "set in init": ("self.step", {"body": "self.step = 3.5"}, 3.5),
    "a local": ("step", {"body": "step = 3.5"}, 3.5),
    "a local hides the top": ("step", {"top": "step = 9", "body": "step = 3.5"}, 3.5),
    "volts": ("volts(3.5)", {}, 3.5),
    "converted": ("millisecondsToSeconds(3500)", {}, 3.5),
    "the class does not see it": ("STEP", {"fields": "STEP = 3.5"}, None),
    "set twice": ("step", {"body": "step = 3; step = 4"}, None),
    "None": ("None", {}, None),
    "a power": ("10 ** 10 ** 10", {}, None),
    "too large": ("1e999", {}, None),
    "not here": ("constants.STEP", {"top": "import constants"}, None),
}


@pytest.mark.parametrize("case", PYTHON_CONSTANTS)
def test_a_python_constant_is_worked_out_as_python_does_it(case: str, tmp_path: Path) -> None:
    step, places, value = PYTHON_CONSTANTS[case]

    found = python(tmp_path, step=step, **places).step

    assert found.value == value
    assert found.dimension == ("" if value is None else "number")
    assert found.text == step


def test_two_files_of_one_name_are_told_apart_by_their_package_or_not_at_all(
    tmp_path: Path,
) -> None:
    for package in ("left", "right"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "Constants.java").write_text(
            f"package {package}; class Constants {{ static double k = {len(package)}; }}",
            encoding="utf-8",
        )

    assert java(tmp_path, step="Volts.of(right.Constants.k)").step.value == 5.0
    assert java(tmp_path, step="Volts.of(Constants.k)").step.known is Known.UNKNOWN


def test_a_damaged_neighbor_has_no_constants(tmp_path: Path) -> None:
    text = "class Constants { static double k = 3.5; int x = (; }"
    (tmp_path / "Constants.java").write_text(text, encoding="utf-8")

    assert java(tmp_path, step="Volts.of(Constants.k)").step.known is Known.UNKNOWN


FIELDS = """
  private final TalonFX m_motor = new TalonFX(1);
  private final SparkMax m_spark = new SparkMax(2, MotorType.kBrushless);
  private final VoltageOut m_voltage = new VoltageOut(0);
  private final PIDController m_pid = new PIDController(1, 0, 0);
  private final SimpleMotorFeedforward m_ff = new SimpleMotorFeedforward(0, 1);
  private final DifferentialDrive m_drive = new DifferentialDrive(m_motor, m_spark);
  private void send(double volts) { m_motor.setVoltage(volts); }
"""
VOLTAGE, DUTY, CLOSED = Output.VOLTAGE, Output.DUTY, Output.CLOSED_LOOP
YES, NO = True, False
JAVA_COMMANDS = {  # what is done with voltage -> kind of command, carries the parameter, scaled
    "setVoltage": ("m_motor.setVoltage(v.in(Volts))", (VOLTAGE, YES, NO)),
    "the measure itself": ("m_motor.setVoltage(v)", (VOLTAGE, YES, NO)),
    "magnitude": ("m_motor.setVoltage(v.magnitude())", (VOLTAGE, YES, NO)),
    "reversed": ("m_motor.setVoltage(v.unaryMinus())", (VOLTAGE, YES, NO)),
    "a new request": ("m_motor.setControl(new VoltageOut(v.in(Volts)))", (VOLTAGE, YES, NO)),
    "a kept request": ("m_motor.setControl(m_voltage.withOutput(v.in(Volts)))", (VOLTAGE, YES, NO)),
    "settings": (
        "m_motor.setControl(m_voltage.withOutput(v).withEnableFOC(true))",
        (VOLTAGE, YES, NO),
    ),
    "a request filled first": (
        "{ m_voltage.Output = v.in(Volts); m_motor.setControl(m_voltage); }",
        (VOLTAGE, YES, NO),
    ),
    "clamped": ("m_motor.setVoltage(MathUtil.clamp(v.in(Volts), -6, 6))", (VOLTAGE, YES, NO)),
    "through a method": ("send(v.in(Volts))", (VOLTAGE, YES, NO)),
    "through a local": ("{ var x = v.in(Volts); m_motor.setVoltage(-x); }", (VOLTAGE, YES, NO)),
    "there and back": ("m_motor.setVoltage(v.in(Volts) / 12 * 12)", (VOLTAGE, YES, NO)),
    "halved": ("m_motor.setVoltage(v.in(Volts) / 2)", (VOLTAGE, YES, YES)),
    "times": ("m_motor.setVoltage(v.times(2))", (VOLTAGE, YES, YES)),
    "millivolts": ("m_motor.setVoltage(v.in(Millivolts))", (VOLTAGE, YES, YES)),
    "by an unknown": ("m_motor.setVoltage(v.in(Volts) * sign())", (VOLTAGE, YES, None)),
    "offset": ("m_motor.setVoltage(v.in(Volts) + 0.2)", (VOLTAGE, YES, YES)),
    "feedforward": ("m_motor.setVoltage(m_ff.calculate(v.in(Volts)))", (VOLTAGE, YES, YES)),
    "a constant": ("m_motor.setVoltage(3.5)", (VOLTAGE, NO, NO)),
    "a limit": (
        "{ double x = v.in(Volts); if (x > 6) x = 6; m_motor.setVoltage(x); }",
        (VOLTAGE, YES, NO),
    ),
    "one of two": ("m_motor.setVoltage(v.in(Volts) > 0 ? 3 : -3)", (VOLTAGE, NO, NO)),
    "duty": ("m_motor.set(v.in(Volts) / 12)", (DUTY, YES, YES)),
    "battery": ("m_spark.set(v.in(Volts) / RobotController.getBatteryVoltage())", (DUTY, YES, YES)),
    "DutyCycleOut": ("m_motor.setControl(new DutyCycleOut(v.in(Volts) / 12))", (DUTY, YES, YES)),
    "percent": ("m_motor.set(ControlMode.PercentOutput, v.in(Volts) / 12)", (DUTY, YES, YES)),
    "tank": ("m_drive.tankDrive(v.in(Volts), v.in(Volts))", (DUTY, YES, NO)),
    "velocity": ("m_motor.setControl(new VelocityVoltage(v.in(Volts)))", (CLOSED, YES, NO)),
    "motion magic": ("m_motor.setControl(new MotionMagicVoltage(2))", (CLOSED, NO, NO)),
    "pid": ("m_motor.setVoltage(m_pid.calculate(0, v.in(Volts)))", (CLOSED, YES, YES)),
    "reference": (
        "m_spark.getClosedLoopController().setReference(v.in(Volts), ControlType.kVelocity)",
        (CLOSED, YES, NO),
    ),
    "voltage reference": (
        "m_spark.getClosedLoopController().setReference(v.in(Volts), ControlType.kVoltage)",
        (VOLTAGE, YES, NO),
    ),
    "2027 reference": (
        "m_spark.getClosedLoopController().setSetpoint(v.in(Volts), ControlType.VOLTAGE)",
        (VOLTAGE, YES, NO),
    ),
    "not in these files": ("runVolts(v)", (Output.UNKNOWN, YES, NO)),
}


@pytest.mark.parametrize("case", JAVA_COMMANDS)
def test_a_command_is_known_by_its_kind_and_by_what_reaches_it(case: str, tmp_path: Path) -> None:
    code, expected = JAVA_COMMANDS[case]

    calls = java(tmp_path, fields=FIELDS, drive=f"v -> {code}").drive

    assert {(call.output, call.uses_parameter, call.scaled) for call in calls} == {expected}


SILENT = {
    "dashboard": 'SmartDashboard.putNumber("v", v.in(Volts))',
    "print": "System.out.println(v)",
    "record": 'Logger.recordOutput("v", v)',
    "neutral": "m_motor.setControl(new NeutralOut())",
    "a light": "m_light.set(true)",
    "nothing": "{}",
}


@pytest.mark.parametrize("case", SILENT)
def test_what_moves_no_motor_is_no_command(case: str, tmp_path: Path) -> None:
    fields = FIELDS + "private final DigitalOutput m_light = new DigitalOutput(0);"

    facts = java(tmp_path, fields=fields, drive=f"v -> {SILENT[case]}")

    assert facts.drive_found
    assert facts.drive == ()


def test_a_drive_moves_all_its_motors(tmp_path: Path) -> None:
    facts = java(tmp_path, fields=FIELDS, drive="v -> m_drive.tankDrive(v.in(Volts), 0)")

    assert [call.motor for call in facts.drive] == ["m_motor", "m_spark"]


JAVA_VOLTAGES = {  # what is logged as voltage -> where it comes from
    "reported": ("m_motor.getMotorVoltage().getValue()", Source.APPLIED),
    "a kept signal": ("m_signal.refresh().getValue()", Source.APPLIED),
    "duty times battery": (
        "Volts.of(m_spark.get() * RobotController.getBatteryVoltage())",
        Source.APPLIED,
    ),
    "output times bus": (
        "Volts.of(m_spark.getAppliedOutput() * m_spark.getBusVoltage())",
        Source.APPLIED,
    ),
    "by a getter": ("applied()", Source.APPLIED),
    "mutable": ("m_applied.mut_replace(m_motor.getMotorVoltage().getValue())", Source.APPLIED),
    "duty alone": ("Volts.of(m_spark.getAppliedOutput() * 12)", Source.UNKNOWN),
    "the battery": ("Volts.of(RobotController.getBatteryVoltage())", Source.UNKNOWN),
    "supply": ("m_motor.getSupplyVoltage().getValue()", Source.UNKNOWN),
    "a constant": ("Volts.of(3)", Source.UNKNOWN),
    "the command": ("Volts.of(m_asked)", Source.COMMANDED),
    "the request": ("Volts.of(m_request.Output)", Source.COMMANDED),
    "the command, kept": ("m_kept", Source.COMMANDED),
}


@pytest.mark.parametrize("case", JAVA_VOLTAGES)
def test_a_logged_voltage_is_applied_or_only_asked_for(case: str, tmp_path: Path) -> None:
    code, source = JAVA_VOLTAGES[case]
    fields = """
      private final TalonFX m_motor = new TalonFX(1);
      private final SparkMax m_spark = new SparkMax(2, MotorType.kBrushless);
      private final StatusSignal<Voltage> m_signal = m_motor.getMotorVoltage();
      private final VoltageOut m_request = new VoltageOut(0);
      private final MutVoltage m_applied = Volts.mutable(0), m_kept = Volts.mutable(0);
      private double m_asked;
      private Voltage applied() { return m_motor.getMotorVoltage().getValue(); }
    """
    drive = """v -> {
      m_asked = v.in(Volts);
      m_kept.mut_replace(v.in(Volts), Volts);
      m_motor.setControl(m_request.withOutput(m_asked));
    }"""

    facts = java(tmp_path, fields=fields, drive=drive, log=f'l -> l.motor("a").voltage({code})')

    assert [(one.signal, one.source) for one in facts.logged] == [("voltage", source)]


PYTHON_FOLLOWERS = {
    "follow": "self.b.follow(self.a)",
    "addFollower": "self.a.addFollower(self.b)",
    "Follower": "self.b.set_control(Follower(1, False))",
    "settings": "c = SparkMaxConfig(); c.follow(1); self.b.configure(c, 0, 0)",
    "settings in one": "self.b.configure(SparkMaxConfig().follow(1), 0, 0)",
    "settings used before": (
        "c = SparkMaxConfig(); self.a.configure(c, 0, 0); c.follow(1); self.b.configure(c, 0, 0)"
    ),
    "a loop": "[motor.follow(self.a) for motor in [self.b]]",
}


@pytest.mark.parametrize("case", PYTHON_FOLLOWERS)
def test_a_motor_that_follows_need_not_be_driven(case: str, tmp_path: Path) -> None:
    body = f"self.a, self.b = SparkMax(1), SparkMax(2); {PYTHON_FOLLOWERS[case]}"

    assert python(tmp_path, body=body).motors == ("a",)


def test_a_method_may_make_followers(tmp_path: Path) -> None:
    fields = """
      private final TalonFX m_a = new TalonFX(1), m_b = new TalonFX(2), m_c = new TalonFX(3);
      public Arm() { join(m_b); join(m_c); }
      private void join(TalonFX motor) { motor.setControl(new Follower(1, false)); }
    """

    assert java(tmp_path, fields=fields).motors == ("m_a",)


MOTORS = "TalonFX TalonFXS[] List<SparkMax> CANSparkFlex WPI_TalonSRX PWMVenom VictorSP ThriftyNova"
OTHERS = "CANcoder SparkMaxConfig TalonFXConfiguration TalonFXSimState PWM PWMSim Servo Solenoid"


def test_motor_controllers_are_known_by_their_types() -> None:
    assert [word for word in MOTORS.split() if not is_motor(word)] == []
    assert [word for word in OTHERS.split() if is_motor(word)] == []


def test_the_names_of_2026_and_2027_are_one() -> None:
    assert {plain(name) for name in ("setVoltage", "set_voltage")} == {"setVoltage"}
    assert {constant(name) for name in ("kForward", "FORWARD", "Forward")} <= DIRECTIONS
    assert constant("kDutyCycle") == constant("DUTY_CYCLE")
