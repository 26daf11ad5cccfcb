"""Wrong answers to the practice, and what a learner must be told about each."""

from grader.exercise.mistake import (
    Mistake,
    change_number,
    make_wrong_answer,
    replace_text,
    scale_numbers,
)

ANSWERS = "answers.toml"

SECOND = """
/** One motor, and a routine to characterize it with. */
class ExampleSubsystem extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);
  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.Mechanism(this::drive, this::record, this));

  private void drive(Voltage voltage) {
    m_motor.setVoltage(voltage.in(Volts));
  }
}
"""

MISTAKES = (
    Mistake("kV for rpm", ANSWERS, scale_numbers(1 / 60, "kV"), "gains-kv", "rpm", "M-UNITS"),
    Mistake("no kP noted", ANSWERS, make_wrong_answer("kP", '""'), "gains-kp", "nothing yet"),
    Mistake("R² in percent", ANSWERS, scale_numbers(100.0, "simulated_velocity_r2"), "r2",
        "write a fraction, not percent", "M-R2"),
    Mistake("a theoretical kV as a duty cycle", ANSWERS, scale_numbers(1 / 12, "kV_theory"),
        "theory-kv-theory", "volts", "M-DUTY"),
    Mistake("a wrong verdict", ANSWERS, make_wrong_answer("verdict", '"inspect"'), "theory-verdict",
        "with its sign"),
    Mistake("a difference from nowhere", ANSWERS,
        change_number("difference", lambda right: right["difference"] + 30.0), "theory-difference",
        "outside"),
    Mistake("a step of 7 V", "ExampleSubsystem.java",
        replace_text(("Volts.of(3.5)", "Volts.of(7)")), "routine-step", "too much", "M-BIG-STEP"),
    Mistake("a test that nobody has to hold", "RobotContainer.java",
        replace_text(("whileTrue", "onTrue")), "buttons-held",
        "Once started, the test runs to its"),
    Mistake("kV and kA in each other's place", "ExampleSubsystem.java",
        replace_text(
            (
                "CharacterizationConstants.kV, CharacterizationConstants.kA",
                "CharacterizationConstants.kA, CharacterizationConstants.kV",
            )
        ), "constants-order", "kA is where SimpleMotorFeedforward expects kV", "M-ARGORDER"),
    Mistake("a unit per rotation beside a kV per meter", "ExampleSubsystem.java",
        replace_text(("// V·s/m\n", "// V·s/rot\n")), "constants-units",
        "This unit does not belong to this kV", "M-UNITS"),
    Mistake("turns for the log's meters", "ExampleSubsystem.java",
        replace_text(
            (
                "Meters.of(getMeters(m_left))",
                "Rotations.of(m_left.getPosition().getValueAsDouble())",
            ),
            (
                "Meters.of(getMeters(m_right))",
                "Rotations.of(m_right.getPosition().getValueAsDouble())",
            ),
            ("MetersPerSecond.of(getMetersPerSecond(m_left))", "RotationsPerSecond.of(1)"),
            ("MetersPerSecond.of(getMetersPerSecond(m_right))", "RotationsPerSecond.of(1)"),
            ("linearPosition", "angularPosition"),
            ("linearVelocity", "angularVelocity"),
        ), "one-mechanism", "They are two different mechanisms", "M-UNITS"),
    Mistake("a second routine beside the buttons", "RobotContainer.java",
        lambda text: text + SECOND, "one-mechanism",
        "nobody runs the one in ExampleSubsystem.java"),
    Mistake("buttons of another subsystem", "RobotContainer.java",
        replace_text(("ExampleSubsystem", "Shooter")), "one-mechanism",
        "does not use the class ExampleSubsystem"),
)  # fmt: skip
