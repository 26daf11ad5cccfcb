"""Whether a comment says which test a button runs, and which property that test measures."""

import re

from grader.check import WrongAnswer
from grader.robotcode.binding_facts import Binding

NAMES = {"quasistatic": r"quasi.?static", "dynamic": r"dynamic"}
TEST = {
    "quasistatic": re.compile(r"quasi.?static|\bramp|\bslow", re.IGNORECASE),
    "dynamic": re.compile(r"\bdynamic|\bstep\b|\bsteps\b", re.IGNORECASE),
}
PROPERTY = {
    "quasistatic": re.compile(
        r"\bk_?[SV]\b|friction|\bstatic\b|velocity (gain|constant|feed)|back.?emf"
        r"|volt\w* (per|for each) (speed|velocity|m/s|rot|rad)"
        r"|(speed|velocity) (per|for each) volt|need\w* .*to (start|keep) moving",
        re.IGNORECASE,
    ),
    "dynamic": re.compile(r"\bk_?A\b|accelerat|inertia|\bmass\b|\bheav", re.IGNORECASE),
}


def check_comment(one: Binding) -> None:
    """Whether the comment beside a binding names its test and its property.

    Raises:
        WrongAnswer: it does not.
    """
    kind = one.tests[0].kind
    other = "dynamic" if kind == "quasistatic" else "quasistatic"
    said = one.comment
    if not said:
        raise WrongAnswer(
            f"no comment next to {one.text} in line {one.line}",
            hint="Write one above it or after it: which test, and what does it measure?",
        )
    seen = f'"{said[:60]}" next to line {one.line}'
    opposite = re.match(rf"\W*{NAMES[other]}", said, re.IGNORECASE)
    if opposite and not re.search(NAMES[kind], said, re.IGNORECASE):
        raise WrongAnswer(seen, hint=f"This button runs the {kind} test.")
    test, property_ = bool(TEST[kind].search(said)), bool(PROPERTY[kind].search(said))
    if test and property_:
        return
    if not test and TEST[other].search(said):
        raise WrongAnswer(seen, hint=f"This button runs the {kind} test.")
    if not property_ and PROPERTY[other].search(said):
        hint = f"That is what the {other} test measures. What does the {kind} test measure?"
        raise WrongAnswer(seen, hint=hint)
    if test:
        hint = "It names the test. Which property of the mechanism does the test measure?"
    elif property_:
        hint = "It names the property. Which of the tests is this, quasistatic or dynamic?"
    else:
        hint = "Name the test, quasistatic or dynamic, and the property of the mechanism it shows."
    raise WrongAnswer(seen, hint=hint)
