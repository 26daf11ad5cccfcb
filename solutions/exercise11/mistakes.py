"""Wrong answers to exercise 11, and what a learner must be told about each."""

from grader.exercise.mistake import Mistake, change_number, make_wrong_answer

ANSWERS = "answers.toml"


def make_wrong_choice(name: str, words: str, says: str, code: str = "") -> Mistake:
    """A wrong option, chosen by its first words: letters are everybody's own."""
    check = name.lower().replace("_", "-")
    return Mistake(
        f"{name}: {words}", ANSWERS, make_wrong_answer(name, f'"{words}"'), check, says, code
    )


MISTAKES = (
    Mistake("nothing chosen", ANSWERS, make_wrong_answer("KC1_answer", '""'), "kc1-answer",
        "nothing yet"),
    Mistake("a number", ANSWERS, make_wrong_answer("KC1_answer", "1"), "kc1-answer",
        "not a letter"),
    Mistake("a letter too far", ANSWERS, make_wrong_answer("KC1_answer", '"z"'), "kc1-answer",
        "of your questions.md: a"),
    make_wrong_choice(
        "Q0_guess", "Which model of the physics", "You can only answer this question with recorded"
    ),
    make_wrong_choice("Q0_sysid", "With which gain does", "This question is about behavior."),
    make_wrong_choice("Q0_brace", "kV", "kV depends on the motor, the gears and the wheel",
        "M-KV-MASS"),
    make_wrong_choice("Q0_brace", "none, as long", "The motors stay the same, but they"),
    make_wrong_choice("kA_use", "The robot's top speed", "so the term kA·a is zero"),
    make_wrong_choice("kS_flag", "Nothing: kS is", "That rule gives a warning only if friction"),
    make_wrong_choice("step_shape", "Nothing: with a", "larger kV·v becomes", "M-CONST-ACCEL"),
    make_wrong_choice("step_shape", "Whether the battery", "largest at the start"),
    make_wrong_choice("step_length", "The log has five times", "still gets faster", "M-LONG-DYN"),
    make_wrong_choice("step_length", "SysId can no longer", "90 %", "M-LONG-DYN"),
    make_wrong_choice("null_consumer", "To the Driver", "Many teams copied a comment"),
    make_wrong_choice("status_frames", "Use SysId's kA", "several rows contain the same value",
        "M-MORE-ROWS"),
    make_wrong_choice("status_frames", "Write the log every 1 ms", "would be even smaller",
        "M-MORE-ROWS"),
    make_wrong_choice("status_frames", "Set a larger window", "equal rows stay equal",
        "M-FILTER-FREE"),
    make_wrong_choice("status_frames", "Find out where samples", "too many rows are equal"),
    make_wrong_choice("three_logs", "The difference is only noise", "already contain the noise",
        "M-ERROR-BAR"),
    make_wrong_choice("three_logs", "The error bars are wrong", "how well one recording",
        "M-ERROR-BAR"),
    make_wrong_choice("three_logs", "The one with the best R²", "may have a high R²", "M-R2"),
    make_wrong_choice("match_heat", "None: gains belong", "it is warmer now", "M-FF-EXACT"),
    make_wrong_choice("match_heat", "All of them, by the same", "this code sends volts", "M-DUTY"),
    make_wrong_choice(
        "match_heat",
        "kV: with a weak battery",
        "the same effect with every battery",
        "M-SAG-ALWAYS-BAD",
    ),
    make_wrong_choice("schedule", "In the practice match", "eight minutes between"),
    make_wrong_choice("schedule", "As soon as the frame", "heavier", "M-KV-MASS"),
    make_wrong_choice("KC1_answer", "The battery browned", "the battery's voltage would drop"),
    make_wrong_choice("KC1_answer", "The log has a gap", "time stamps"),
    make_wrong_choice("KC1_answer", "The mechanism hit", "stays there"),
    make_wrong_choice("KC1_reason", "Almost nothing", "squares the errors"),
    make_wrong_choice("KC1_reason", "The simulated velocity R² falls", "stays above 0.9", "M-R2"),
    make_wrong_choice(
        "KC1_reason", "Nothing, once", "SysId cannot use a log without that run", "M-REVERSE-WASTE"
    ),
    make_wrong_choice("KC2_answer", "Raise kV", "Then this kV is right only for one speed",
        "M-FF-EXACT"),
    make_wrong_choice("KC2_answer", "Raise kA", "acceleration is zero"),
    make_wrong_choice("KC2_answer", "Only add a kP", "Feedback is part of the answer. But",
        "M-KP-EXACT"),
    make_wrong_choice("KC2_reason", "With good gains", "from minute to minute", "M-FF-EXACT"),
    make_wrong_choice("KC2_reason", "Proportional", "kP/kV", "M-KP-EXACT"),
    make_wrong_choice("KC3_answer", "Raise kP", "divided by kP", "M-KP-EXACT"),
    make_wrong_choice("KC3_answer", "Add kI", "swing up"),
    make_wrong_choice("KC3_answer", "Use the mean", "Then the gains are wrong in both"),
    make_wrong_choice("KC3_answer", "Raise kV", "has no speed", "M-KV-MASS"),
    make_wrong_choice("KC3_reason", "A heavier arm has more friction", "helps an arm",
        "M-HEAVIER-MORE-KS"),
    make_wrong_choice("KC3_reason", "SysId does not know", "finds kG", "M-NO-KG-IN-SYSID"),
    Mistake("rpm as rotations per second", ANSWERS,
        change_number("KC2_volts", lambda right: 60.0 * right["KC2_volts"]), "kc2-volts",
        "They are rotations in a minute", "M-UNITS"),
    Mistake("an output for the voltage", ANSWERS,
        change_number("KC2_volts", lambda right: right["KC2_volts"] / 12.0), "kc2-volts", "volts",
        "M-DUTY"),
    Mistake("no test for the drivetrain", ANSWERS, make_wrong_answer("drivetrain", '"usually not"'),
        "decision-drivetrain", "autonomous path"),
    Mistake("a shooter that may be guessed", ANSWERS, make_wrong_answer("shooter", '"optional"'),
        "decision-shooter", "3 % too slow"),
    Mistake("always, without a reason that carries it", ANSWERS,
        make_wrong_answer("conveyor", '"always"'), "decision-conveyor", "do better"),
    Mistake("always for a mechanism that feedback can help", ANSWERS,
        make_wrong_answer("arm", '"always"'), "decision-arm", "But do gains that are 5 % off ruin"),
    Mistake("a word that is none", ANSWERS, make_wrong_answer("arm", '"maybe"'), "decision-arm",
        "Choose one of: always, recommended, optional, usually not"),
    Mistake("no reason", ANSWERS, make_wrong_answer("climber_reason", '""'), "reason-climber",
        "letter of a reason"),
)  # fmt: skip
