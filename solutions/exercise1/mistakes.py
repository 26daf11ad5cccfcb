"""Wrong answers to exercise 1, and what a learner must be told about each."""

import re
from collections.abc import Callable

from grader.exercise.mistake import Mistake, replace_text

ANSWERS = "answers.toml"
ROW = re.compile(
    r"^(?P<name>\w+) = (?P<volts>\S+)  # kS (\S+) V, kV (\S+) V, kA (\S+) V, 1:(\S+)", re.MULTILINE
)

Terms = Callable[[float, float, float, float], float]


def write_term(name: str, wrong: Terms) -> Callable[[str], str]:
    """Make a wrong voltage of its three terms and of the size of the dashboard's unit."""

    def edit_text(text: str) -> str:
        (row,) = (row for row in ROW.finditer(text) if row["name"] == name)
        value = wrong(*(float(term) for term in row.groups()[2:]))
        return text.replace(f"{name} = {row['volts']} ", f"{name} = {value:.3f} ")

    return edit_text


def compute_push(text: str) -> float:
    """The acceleration's volts while it speeds up [V]."""
    (row,) = (row for row in ROW.finditer(text) if row["name"] == "accelerating")
    return float(row[5])


def swap_values(one: str, other: str) -> Callable[[str], str]:
    """Exchange two names."""

    def edit_text(text: str) -> str:
        spare = text.replace(f"\n{one} = ", "\n@ = ").replace(f"\n{other} = ", f"\n{one} = ")
        return spare.replace("\n@ = ", f"\n{other} = ")

    return edit_text


def swap_largest_term(text: str) -> str:
    """Exchange kV and kA as the answer to which term is largest."""
    right, wrong = ("kV", "kA") if 'largest = "kV"' in text else ("kA", "kV")
    return text.replace(f'largest = "{right}"', f'largest = "{wrong}"')


def replace_kv_unit(text: str) -> Callable[[str], str]:
    """Edit that gives kV another unit."""
    return lambda right: re.sub(r'kV_unit = "[^"]*"', f'kV_unit = "{text}"', right)


MISTAKES = (
    Mistake("sgn of the acceleration", ANSWERS, write_term("braking", lambda s, v, a, _: v + a - s),
        "braking", "did you use sgn(a)? It must be"),
    Mistake("no friction while it speeds up", ANSWERS,
        write_term("accelerating", lambda _s, v, a, _: v + a), "accelerating", "is kS missing"),
    Mistake("no friction at a steady speed", ANSWERS, write_term("forward", lambda _s, v, _a, _: v),
        "forward", "is kS missing"),
    Mistake("the dashboard's unit", ANSWERS, write_term("forward", lambda s, v, _,
        size: s + v / size), "forward", "did you convert the speed", "M-UNITS"),
    Mistake("converted the wrong way", ANSWERS,
        write_term("forward", lambda s, v, _, size: s + v / size**2), "forward",
        "mix up multiplying and dividing", "M-UNITS"),
    Mistake("a speed converted that was right", ANSWERS,
        write_term("accelerating", lambda s, v, a, size: s + v / size + a), "accelerating",
        "the unit of your kV. Did you", "M-UNITS"),
    Mistake("speed and acceleration converted that were right", ANSWERS,
        write_term("braking", lambda s, v, a, size: s + (v + a) / size), "braking",
        "the unit of your kV. Did you", "M-UNITS"),
    Mistake("backward without a sign", ANSWERS, write_term("backward", lambda s, v, _a, _: -s - v),
        "backward", "Moving backward, v is negative"),
    Mistake("friction that helps, backward", ANSWERS, write_term("backward", lambda s, v, _a,
        _: v - s), "backward", "did kS get the wrong sign"),
    Mistake("no acceleration while it brakes", ANSWERS, write_term("braking", lambda s, v, _a,
        _: s + v), "braking", "is kA·a missing"),
    Mistake("braking as if it sped up", ANSWERS, write_term("braking", lambda s, v, a,
        _: s + v - a), "braking", "slower, so a is negative"),
    Mistake("neither friction nor acceleration while it brakes", ANSWERS,
        write_term("braking", lambda _s, v, _a, _: v), "braking", "maybe there are two mistakes"),
    Mistake("an acceleration at a steady speed", ANSWERS,
        lambda text: write_term("backward", lambda s, v, _a, _: s + v + compute_push(text))(text),
        "backward", "did you add a term kA·a"),
    Mistake("an output between -1 and 1", ANSWERS,
        write_term("backward", lambda s, v, a, _: (s + v + a) / 12), "backward",
        "Is this an output between", "M-DUTY"),
    Mistake("two rows exchanged", ANSWERS, swap_values("braking", "accelerating"), "accelerating",
        "Did you swap two answers?"),
    Mistake("a number from nowhere", ANSWERS, write_term("forward", lambda s, v, _a,
        _: 1.08 * (s + v)), "forward", "outside the accepted ±2 %"),
    Mistake("nothing", ANSWERS, replace_text(("forward = ", 'forward = "" # ')), "forward",
        "nothing"),
    Mistake("kA's unit", ANSWERS, replace_text(("V·s/", "V·s²/")), "kv-unit", "to kA", "M-UNITS"),
    Mistake("kS's unit", ANSWERS, replace_kv_unit("V"), "kv-unit", "to kS", "M-UNITS"),
    Mistake("no parentheses", ANSWERS, replace_text(("V·s/", "V/s/")), "kv-unit", "parentheses",
        "M-UNITS"),
    Mistake("another length", ANSWERS, replace_kv_unit("V·s/in"), "kv-unit",
        "the right kind of unit", "M-UNITS"),
    Mistake("not a unit", ANSWERS, replace_kv_unit("volt per banana"), "kv-unit",
        "'banana' is not known"),
    Mistake("the other term", ANSWERS, swap_largest_term, "largest",
        "in volts, and compare their sizes"),
    Mistake("a word that is no term",
        ANSWERS, replace_text(("largest = ", 'largest = "torque" # ')), "largest",
        "Choose one of: kS, kV, kA."),
)  # fmt: skip
