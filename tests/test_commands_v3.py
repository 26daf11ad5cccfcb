"""Commands v3 of WPILib 2027: its SysIdRoutine is run and graded like that of Commands v2.

Signatures as on allwpilib's development branch, commandsv3, org.wpilib.command3.sysid.SysIdRoutine:
Config(rampRate, stepVoltage, timeout, recordState), where null is refused for the first three;
Config.useDataLog(rampRate, stepVoltage, timeout); Config.defaults(); SysIdMechanism(drive, log,
mechanism[, name]), where null is allowed for log and name.
"""

import pytest
from places import ROOT

from grader.exercise.exercise import Exercise

EXERCISE4 = Exercise("exercise4", ROOT / "exercises" / "exercise4")
EXERCISE5 = Exercise("exercise5", ROOT / "exercises" / "exercise5")

RAMP, STEP, TIMEOUT = "Volts.of(0.5).per(Second)", "Volts.of(3.5)", "Seconds.of(10)"
THREE = f"{RAMP}, {STEP}, {TIMEOUT}"
CONFIG = f"SysIdRoutine.Config.useDataLog({THREE})"
MECHANISM = "new SysIdRoutine.SysIdMechanism(this::drive, this::record, this)"

HEAD = """package first.robot;

import static org.wpilib.units.Units.Meters;
import static org.wpilib.units.Units.MetersPerSecond;
import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Seconds;
import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Command;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.sysid.SysIdRoutineLog;
import org.wpilib.units.VoltageUnit;
import org.wpilib.units.measure.Time;
import org.wpilib.units.measure.Velocity;
import org.wpilib.units.measure.Voltage;
"""
FIELDS = """
  private static final double METERS_PER_ROTATION = 0.0472;

  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2);
"""
CALLBACKS = """
  private void drive(Voltage voltage) {
    m_left.setVoltage(voltage.in(Volts));
    m_right.setVoltage(voltage.in(Volts));
  }

  private void record(SysIdRoutineLog log) {
    log.motor("left")
        .voltage(Volts.of(m_left.getMotorVoltage().getValueAsDouble()))
        .linearPosition(Meters.of(getMeters(m_left)))
        .linearVelocity(MetersPerSecond.of(getMetersPerSecond(m_left)));
    log.motor("right")
        .voltage(Volts.of(m_right.getMotorVoltage().getValueAsDouble()))
        .linearPosition(Meters.of(getMeters(m_right)))
        .linearVelocity(MetersPerSecond.of(getMetersPerSecond(m_right)));
  }

  private double getMeters(TalonFX motor) {
    return motor.getPosition().getValueAsDouble() * METERS_PER_ROTATION;
  }

  private double getMetersPerSecond(TalonFX motor) {
    return motor.getVelocity().getValueAsDouble() * METERS_PER_ROTATION;
  }
"""


def program(*, config=CONFIG, mechanism=MECHANISM, base="extends Mechanism", fields="", routine=""):
    made = routine or (
        f"  private final SysIdRoutine m_routine =\n      new SysIdRoutine(\n          {config},\n"
        f"          {mechanism});\n"
    )
    return (
        f"{HEAD}\n/** A drivetrain. */\npublic class ExampleSubsystem {base} {{\n"
        f"{FIELDS}{fields}\n{made}{CALLBACKS}}}\n"
    )


DUTY = "m_left.set(voltage.in(Volts) / 12)"
WRONG = {  # what is wrong -> the program, the check that fails, and what it says
    "its defaults": (
        program(config="SysIdRoutine.Config.defaults()"), "step", "WPILib's default, 7 V"
    ),
    "null, which it refuses": (
        program(config=f"new SysIdRoutine.Config({RAMP}, {STEP}, null, null)"),
        "timeout",
        "null for the timeout",
    ),
    "the lesson's step": (program(config=CONFIG.replace("3.5", "3")), "step", "3 V (line 29)"),
    "no log": (
        program(mechanism=MECHANISM.replace("this::record", "null")), "log", "null instead of"
    ),
    "a duty cycle": (
        program().replace("m_left.setVoltage(voltage.in(Volts))", DUTY),
        "open-loop",
        "set() (line",
    ),
    "a name of Commands v2": (
        program(mechanism=MECHANISM.replace("SysIdMechanism", "Mechanism")),
        "assembled",
        "SysIdRoutine has no Mechanism. Did you mean SysIdMechanism?",
    ),
    "a name of Commands v3 in v2": (
        program(base="extends SubsystemBase")
        .replace("command3.Mechanism", "command2.SubsystemBase")
        .replace("command3", "command2"),
        "assembled",
        "SysIdRoutine has no SysIdMechanism",
    ),
    "another mechanism": (
        program(
            fields='  private final Mechanism m_other = new Mechanism("other");\n',
            mechanism=MECHANISM.replace(", this)", ", m_other)"),
        ),
        "assembled",
        "the tests require another subsystem",
    ),
}  # fmt: skip


def grade_answer(exercise, text, tmp_path, *, name="ExampleSubsystem.java"):
    path = tmp_path / name
    path.write_text(text, "utf-8")
    return {one.id: one for one in exercise.grade(path, student="ann").checks}


@pytest.mark.parametrize("mistake", WRONG)
def test_feedback_on_a_wrong_answer_says_what_is_wrong(mistake, tmp_path):
    text, check, said = WRONG[mistake]

    found = grade_answer(EXERCISE4, text, tmp_path)[check]

    assert found.status == "failed"
    assert said in found.seen


BINDINGS = """package first.robot;

import org.wpilib.command3.Command;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.Trigger;
import org.wpilib.command3.button.CommandXboxController;
import org.wpilib.command3.button.RobotModeTriggers;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.command3.sysid.SysIdRoutine.Direction;

public class RobotContainer {
  private final Arm m_arm = new Arm();
  private final CommandXboxController m_driver = new CommandXboxController(0);

  public RobotContainer() {
    Trigger testing = RobotModeTriggers.utility();
    // Quasistatic, forward: a slow ramp, which measures kS and kV.
    m_driver.a().and(testing).whileTrue(m_arm.quasistatic(Direction.FORWARD));
    // Quasistatic, reverse: kS and kV once more, from the other side.
    m_driver.b().and(testing).whileTrue(m_arm.quasistatic(Direction.REVERSE));
    // Dynamic, forward: a step, which measures kA.
    m_driver.x().and(testing).whileTrue(m_arm.dynamic(Direction.FORWARD));
    // Dynamic, reverse: kA once more, from the other side.
    m_driver.y().and(testing).whileTrue(m_arm.dynamic(Direction.REVERSE));
  }
}

class Arm extends Mechanism {
  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.defaults(),
          new SysIdRoutine.SysIdMechanism(volts -> {}, null, this));

  public Command quasistatic(Direction direction) {
    return m_routine.quasistatic(direction);
  }

  public Command dynamic(Direction direction) {
    return m_routine.dynamic(direction);
  }
}
"""


def test_commands_of_v3_are_bound_and_guarded_like_those_of_v2(tmp_path):
    found = grade_answer(EXERCISE5, BINDINGS, tmp_path, name="RobotContainer.java")

    assert {name: one.seen for name, one in found.items() if one.status != "passed"} == {}
