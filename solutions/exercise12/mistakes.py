"""Wrong answers to exercise 12, and what a learner must be told about each."""

import re
from collections.abc import Callable

from grader.exercise.mistake import Mistake, make_wrong_answer

ANSWERS = "answers.toml"
LINE = re.compile(r"^(?P<name>[a-z-]+\.\w+) = (?P<value>[-+.\de]+)$", re.MULTILINE)


def change_names(change: Callable[[str], str], lines: str = "") -> Callable[[str], str]:
    """Change the list of names, and add lines with parameters."""

    def edit_text(text: str) -> str:
        found = re.search(r"^effects = \[(.*?)\]", text, re.MULTILINE)
        if found is None:
            raise ValueError("the solution names no effects")
        return text.replace(found[0], f"effects = [{change(found[1])}]") + lines

    return edit_text


def change_first_line(change: Callable[[str, float], str]) -> Callable[[str], str]:
    """Change the first parameter."""

    def edit_text(text: str) -> str:
        if not LINE.search(text):
            raise ValueError("the solution has no parameters")
        return LINE.sub(lambda one: change(one["name"], float(one["value"])), text, count=1)

    return edit_text


def shift_parameters(text: str) -> str:
    """Every parameter three times as large."""
    return LINE.sub(lambda one: f"{one['name']} = {3.0 * float(one['value']):.6g}", text)


def swap_gaps(text: str) -> str:
    """Each gap in the place of the other."""
    before, after = (
        re.search(rf"^{name} = ([\d.]+)", text, re.MULTILINE)
        for name in ("gap_before", "gap_after")
    )
    if before is None or after is None:
        raise ValueError("the solution has no gaps")
    return make_wrong_answer("gap_before", after[1])(
        make_wrong_answer("gap_after", before[1])(text)
    )


MISTAKES = (
    Mistake("no effect named", ANSWERS, make_wrong_answer("effects", "[]"), "first-effect",
        "nothing yet"),
    Mistake("kA fixes it", ANSWERS, make_wrong_answer("effects", '["kA"]'), "first-effect",
        "hides the missing effect"),
    Mistake("inertia for whatever is missing", ANSWERS,
        change_names(
            lambda _: '"inertia-change"',
            '"inertia-change".extra = 0.05\n"inertia-change".moment = 20.0\n',
        ), "first-effect", "another effect alone makes the gap of"),
    Mistake("a word of one's own", ANSWERS, make_wrong_answer("effects", '["air resistance"]'),
        "first-effect", "sysid effects lists the names"),
    Mistake("one effect too many", ANSWERS,
        change_names(lambda names: f'{names}, "constant-load"', "constant-load.load = 0.001\n"),
        "justified", "predict other runs worse"),
    Mistake("one name too many", ANSWERS,
        change_names(lambda names: f'{names}, "constant-load"', "constant-load.load = 0.001\n"),
        "all-effects", "all hidden effects are in your list"),
    Mistake("everything that might be, added", ANSWERS,
        change_names(
            lambda names: f'{names}, "constant-load", "delay", "heating"',
            "constant-load.load = 0.15\ndelay.lag = 0.2\nheating.rate = 0.01\n",
        ), "held-out", "on runs that it was not fitted"),
    Mistake("a look-alike", ANSWERS, change_names(lambda _: '"delay"', "delay.lag = 0.04\n"),
        "all-effects", "not all of these are right. Two effects"),
    Mistake("an effect of nothing", ANSWERS,
        change_names(lambda names: f'{names}, "delay"', "delay.lag = 0.0\n"), "justified",
        "is at its limit"),
    Mistake("a look-alike that explains little", ANSWERS,
        change_names(lambda _: '"constant-load"', "constant-load.load = 0.02\n"), "held-out",
        "a large gap remains. Are the parameters"),
    Mistake("a parameter left out", ANSWERS, change_first_line(lambda _name, _value: ""),
        "held-out", "Write"),
    Mistake("a parameter in another unit", ANSWERS,
        change_first_line(lambda name, value: f'{name} = "{value} m^7"'), "held-out",
        "is not a unit of", "M-UNITS"),
    Mistake("no gaps written down", ANSWERS, make_wrong_answer("gap_after", '""'), "held-out",
        "gap_after: nothing"),
    Mistake("the two gaps swapped", ANSWERS, swap_gaps, "held-out", "is this the other gap"),
    Mistake("a gap below what noise allows", ANSWERS, make_wrong_answer("gap_after", "0.2"),
        "held-out", "not the gap of your model"),
    Mistake("parameters that were made up", ANSWERS, shift_parameters, "first-effect",
        "names count only if their effects make the gap"),
)  # fmt: skip
