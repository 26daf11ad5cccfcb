"""Wrong answers to the practice, and what a learner must be told about each."""

from grader.mistake import Mistake, change_number, put_value, replace_text, scale_numbers

ANSWERS = "answers.toml"

MISTAKES = (
    Mistake("kV for rpm", ANSWERS, scale_numbers(1 / 60, "kV"), "gains-kv", "rpm", "M-UNITS"),
    Mistake("no kP noted", ANSWERS, put_value("kP", '""'), "gains-kp", "nothing yet"),
    Mistake(
        "R² in percent",
        ANSWERS,
        scale_numbers(100.0, "simulated_velocity_r2"),
        "r2",
        "There are two R². Write the simulated",
        "M-R2",
    ),
    Mistake(
        "an output for the theory's volts",
        ANSWERS,
        scale_numbers(1 / 12, "kV_theory"),
        "theory-kv-theory",
        "volts",
        "M-DUTY",
    ),
    Mistake(
        "a wrong verdict",
        ANSWERS,
        put_value("verdict", '"inspect"'),
        "theory-verdict",
        "with its sign",
    ),
    Mistake(
        "a difference from nowhere",
        ANSWERS,
        change_number("difference", lambda right: right["difference"] + 30.0),
        "theory-difference",
        "outside",
    ),
    Mistake(
        "a step of 7 V",
        "ExampleSubsystem.java",
        replace_text(("Volts.of(3.5)", "Volts.of(7)")),
        "routine-step",
        "too much",
        "M-BIG-STEP",
    ),
    Mistake(
        "a test that nobody has to hold",
        "RobotContainer.java",
        replace_text(("whileTrue", "onTrue")),
        "buttons-held",
        "Once started, the test runs to its",
    ),
    Mistake(
        "kV and kA in each other's place",
        "ExampleMechanism.java",
        replace_text(
            (
                "CharacterizationConstants.kV, CharacterizationConstants.kA",
                "CharacterizationConstants.kA, CharacterizationConstants.kV",
            )
        ),
        "constants-order",
        "kA is where SimpleMotorFeedforward expects kV",
        "M-ARGORDER",
    ),
)
