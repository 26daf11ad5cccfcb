"""Wrong answers to exercise 8, and what a learner must be told about each."""

from collections.abc import Callable

from grader.exercise.mistake import Mistake, make_wrong_answer, scale_numbers

ANSWERS = "answers.toml"
RAMPS = ("quasistatic_forward", "quasistatic_reverse")
STEPS = ("dynamic_forward", "dynamic_reverse")


def set_windows(span: str, *names: str) -> Callable[[str], str]:
    """Keep the same of some tests."""

    def edit_text(text: str) -> str:
        for name in names:
            text = make_wrong_answer(name, f'"{span}"')(text)
        return text

    return edit_text


def apply_both(*changes: Callable[[str], str]) -> Callable[[str], str]:
    """Make several changes."""

    def edit_text(text: str) -> str:
        for change in changes:
            text = change(text)
        return text

    return edit_text


MISTAKES = (
    Mistake("nothing is done", ANSWERS,
        apply_both(
            set_windows("all", *RAMPS, *STEPS),
            make_wrong_answer("threshold", "0"),
            make_wrong_answer("median", "1"),
        ), "ka", "comes out"),
    Mistake("the stops are kept", ANSWERS, set_windows("all", *RAMPS, *STEPS), "ka",
        "do you keep samples in which a hard"),
    Mistake("a median filter that suits only a plot", ANSWERS,
        make_wrong_answer("median", "15"), "ka", "A median of as many samples flattens",
        "M-FILTER-FREE"),
    Mistake("no filter", ANSWERS, make_wrong_answer("median", "1"), "ka",
        "Single readings are far off"),
    Mistake("no threshold", ANSWERS, make_wrong_answer("threshold", "0"), "ks",
        "Do you keep samples in which the mechanism stands"),
    Mistake("the rise of the steps is cut away", ANSWERS, set_windows("0.3 to 0.6", *STEPS),
        "reach", "A step contains kA only in its", "M-TRIM-PRETTY"),
    Mistake("the fast half of the ramps is cut away", ANSWERS, set_windows("0 to 2.5", *RAMPS),
        "reach", "The fast samples of a ramp determine", "M-TRIM-PRETTY"),
    Mistake("a threshold that drops the slow half", ANSWERS, scale_numbers(4, "threshold"), "kept",
        "too little is left", "M-TRIM-PRETTY"),
    Mistake("hardly anything is left", ANSWERS, set_windows("2 to 2.1", *RAMPS), "kv",
        "Too little is left of more than one test", "M-TRIM-PRETTY"),
    Mistake("nothing yet", ANSWERS, make_wrong_answer("threshold", '""'), "kept",
        "threshold: nothing yet"),
    Mistake("a threshold in volts", ANSWERS, make_wrong_answer("threshold", '"0.2 V"'), "kept",
        "is not a unit of", "M-UNITS"),
    Mistake("half a sample", ANSWERS, make_wrong_answer("median", "2.5"), "kept",
        "whole number of samples"),
    Mistake("it ends before it begins", ANSWERS, set_windows("3 to 1", *RAMPS), "kept",
        "ends before"),
    Mistake("no times", ANSWERS, set_windows("most of it", *STEPS), "kept", "two times are needed"),
)  # fmt: skip
