"""Phrases of the two callbacks: commands, sources of a logged value, motors that follow."""

from pathlib import Path

import pytest
from robot_phrase import java, python

from grader.robotcode.facts import Output, Source
from grader.robotcode.vocabulary import DIRECTIONS, is_motor, normalize_enum_constant, spell_as_java

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
    "battery as a measure": (
        "m_spark.set(v.div(RobotController.getMeasureBatteryVoltage()).magnitude())",
        (DUTY, YES, YES),
    ),
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
    assert {spell_as_java(name) for name in ("setVoltage", "set_voltage")} == {"setVoltage"}
    assert {
        normalize_enum_constant(name) for name in ("kForward", "FORWARD", "Forward")
    } <= DIRECTIONS
    assert normalize_enum_constant("kDutyCycle") == normalize_enum_constant("DUTY_CYCLE")
