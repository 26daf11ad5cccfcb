"""Whether a comment says which test a button runs, and which property that test measures."""

import re
from collections.abc import Iterator

from grader.checks.check import WrongAnswer
from grader.robotcode.bench.button_run import Press

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
WAY = {
    "forward": re.compile(r"\bforwards?\b", re.IGNORECASE),
    "reverse": re.compile(r"\breversed?\b|\bbackwards?\b", re.IGNORECASE),
}
ALL_GAINS = re.compile(r"\bkS\b.*\bkV\b.*\bkA\b", re.IGNORECASE)


def check_comment(one: Press) -> None:
    """Whether a comment beside a binding, or where its command is made, names test and property.

    Raises:
        WrongAnswer: none does; about the first of them.
    """
    if not one.comments:
        raise WrongAnswer(
            f"no comment next to line {one.line}: {one.text}",
            hint="Write one directly above it or after it: which test, and what does it measure?",
        )
    wrong = [next(_list_faults(said, one), "") for said in one.comments]
    if all(wrong):
        raise WrongAnswer(f'"{one.comments[0][:60]}" next to line {one.line}', hint=wrong[0])


def _list_faults(said: str, one: Press) -> Iterator[str]:
    """What is wrong with a comment, the worst first."""
    kind, way = one.test.split("-")
    other = "dynamic" if kind == "quasistatic" else "quasistatic"
    opposite = "reverse" if way == "forward" else "forward"
    if re.match(rf"\W*{NAMES[other]}", said, re.IGNORECASE) and not re.search(
        NAMES[kind], said, re.IGNORECASE
    ):
        yield f"This button runs the {kind} test. What does the method that it calls return?"
    if WAY[opposite].search(said) and not WAY[way].search(said):
        yield f"This button runs the {kind} test in {way}."
    test, property_ = bool(TEST[kind].search(said)), bool(PROPERTY[kind].search(said))
    if ALL_GAINS.search(said):
        hint = "It names all three gains. What does this one test measure?"
        yield f"{hint} The ramp shows kS and kV, the step kA."
    if test and property_:
        return
    if not test and TEST[other].search(said):
        yield f"This button runs the {kind} test."
    if not property_ and PROPERTY[other].search(said):
        yield f"That is what the {other} test measures. What does the {kind} test measure?"
    if test:
        yield "It names the test. Which property of the mechanism does the test measure?"
    if property_:
        yield "It names the property. Which of the tests is this, quasistatic or dynamic?"
    yield "Name the test, quasistatic or dynamic, and the property of the mechanism it shows."
