"""Wrong answers to the practice, and what a learner must be told about each."""

from grader.mistake import Mistake, number, put, replacing, scaled

ANSWERS = "answers.toml"

MISTAKES = (
    Mistake("kV for rpm", ANSWERS, scaled(1 / 60, "kV"), "gains-kv", "rpm", "M-UNITS"),
    Mistake("no kP noted", ANSWERS, put("kP", '""'), "gains-kp", "nothing yet"),
    Mistake(
        "R² in percent",
        ANSWERS,
        scaled(100.0, "simulated_velocity_r2"),
        "r2",
        "a share of 1",
        "M-R2",
    ),
    Mistake(
        "an output for the theory's volts",
        ANSWERS,
        scaled(1 / 12, "kV_theory"),
        "theory-kv-theory",
        "volts",
        "M-DUTY",
    ),
    Mistake("a wrong verdict", ANSWERS, put("verdict", '"inspect"'), "theory-verdict", "sign and"),
    Mistake(
        "a difference from nowhere",
        ANSWERS,
        number("difference", lambda right: right["difference"] + 30.0),
        "theory-difference",
        "outside",
    ),
    Mistake(
        "a step of 7 V",
        "ExampleSubsystem.java",
        replacing(("Volts.of(3.5)", "Volts.of(7)")),
        "routine-step",
        "too much",
        "M-BIG-STEP",
    ),
    Mistake(
        "a test that nobody has to hold",
        "RobotContainer.java",
        replacing(("whileTrue", "onTrue")),
        "buttons-held",
        "even after release",
    ),
    Mistake(
        "kV and kA in each other's place",
        "ExampleMechanism.java",
        replacing(
            (
                "CharacterizationConstants.kV, CharacterizationConstants.kA",
                "CharacterizationConstants.kA, CharacterizationConstants.kV",
            )
        ),
        "constants-order",
        "kA stands where SimpleMotorFeedforward expects kV",
        "M-ARGORDER",
    ),
)
