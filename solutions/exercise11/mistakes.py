"""Wrong answers to exercise 11, and what a learner must be told about each."""

from grader.mistake import Mistake, change_number, make_wrong_answer

ANSWERS = "answers.toml"


def chose(name: str, words: str, says: str, code: str = "") -> Mistake:
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
    chose(
        "Q0_guess", "Which model of the physics", "You can only answer this question with recorded"
    ),
    chose("Q0_sysid", "With which gain does", "This question is about behavior."),
    chose("Q0_brace", "kV", "kV depends on the motor, the gears and the wheel", "M-KV-MASS"),
    chose("Q0_brace", "none, as long", "The motors stay the same, but they"),
    chose("kA_use", "The robot's top speed", "so the term kA·a is zero"),
    chose("kS_flag", "Nothing: kS is", "That rule gives a warning only if friction"),
    chose("step_shape", "Nothing: with a", "larger kV·v becomes", "M-CONST-ACCEL"),
    chose("step_shape", "Whether the battery", "largest at the start"),
    chose("step_length", "The log has five times", "still gets faster", "M-LONG-DYN"),
    chose("step_length", "SysId can no longer", "90 %", "M-LONG-DYN"),
    chose("null_consumer", "To the Driver", "Many teams copied a comment"),
    chose("status_frames", "Use SysId's kA", "partly from repeated values", "M-MORE-ROWS"),
    chose("status_frames", "Write the log every 1 ms", "would be even smaller", "M-MORE-ROWS"),
    chose("status_frames", "Set a larger window", "equal rows stay equal", "M-FILTER-FREE"),
    chose("status_frames", "Find out where samples", "too many rows are equal"),
    chose("three_logs", "The difference is only noise", "already contain the noise", "M-ERROR-BAR"),
    chose("three_logs", "The error bars are wrong", "how well one recording", "M-ERROR-BAR"),
    chose("three_logs", "The one with the best R²", "may have a high R²", "M-R2"),
    chose("match_heat", "None: gains belong", "it is warmer now", "M-FF-EXACT"),
    chose("match_heat", "All of them, by the same", "this code sends volts", "M-DUTY"),
    chose(
        "match_heat",
        "kV: with a weak battery",
        "the same effect with every battery",
        "M-SAG-ALWAYS-BAD",
    ),
    chose("schedule", "In the practice match", "eight minutes between"),
    chose("schedule", "As soon as the frame", "heavier", "M-KV-MASS"),
    chose("KC1_answer", "The battery browned", "In a brownout the voltage would drop"),
    chose("KC1_answer", "The log has a gap", "time stamps"),
    chose("KC1_answer", "The mechanism hit", "stays there"),
    chose("KC1_reason", "Almost nothing", "squares the errors", "M-NOISE-AVERAGES"),
    chose("KC1_reason", "The simulated velocity R² falls", "stays above 0.9", "M-R2"),
    chose(
        "KC1_reason", "Nothing, once", "SysId cannot use a log without that run", "M-REVERSE-WASTE"
    ),
    chose("KC2_answer", "Raise kV", "Then this kV is right only for one speed", "M-FF-EXACT"),
    chose("KC2_answer", "Raise kA", "acceleration is zero"),
    chose("KC2_answer", "Only add a kP", "Feedback is part of the answer. But", "M-KP-EXACT"),
    chose("KC2_reason", "With good gains", "from minute to minute", "M-FF-EXACT"),
    chose("KC2_reason", "Proportional", "kP/kV", "M-KP-EXACT"),
    chose("KC3_answer", "Raise kP", "divided by kP", "M-KP-EXACT"),
    chose("KC3_answer", "Add kI", "swing up"),
    chose("KC3_answer", "Use the mean", "Then the gains are wrong in both"),
    chose("KC3_answer", "Raise kV", "has no speed", "M-KV-MASS"),
    chose("KC3_reason", "A heavier arm has more friction", "helps an arm", "M-HEAVIER-MORE-KS"),
    chose("KC3_reason", "SysId does not know", "finds kG", "M-NO-KG-IN-SYSID"),
    Mistake("rpm as rotations per second", ANSWERS,
        change_number("KC2_volts", lambda right: 60.0 * right["KC2_volts"]), "kc2-volts",
        "rpm are rotations in a minute", "M-UNITS"),
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
