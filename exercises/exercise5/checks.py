"""Exercise 5: four tests on four buttons, held, explained and guarded. Read, and RobotPy run."""

from pathlib import Path

from grader.check import NotReachedError, Status, WrongAnswer, check, run_checks
from grader.robotcode import bench
from grader.robotcode.bench import RunFacts, findings
from grader.robotcode.bench.findings import RunFault, find_stop
from grader.robotcode.binding_facts import BindingFacts
from grader.robotcode.bindings import read_bindings
from grader.submission import read_text
from grader.sysid_routine_checks import READ as READ_ONLY
from grader.sysid_routine_checks import check_compiles, check_spelling
from sim.core.errors import UnreadableFile

from .explained import check_comment
from .four import TESTS, all_of, missing, named, times
from .guarded import HOLDS, check_guard
from .holding import check_hold, held_share
from .pressed import agreed, press

FILES = ("RobotContainer.java", "robotcontainer.py")
WRITE_IT = "Write Direction.kForward or Direction.kReverse there."
READ = "checked after you bind a test"


def read(path: Path, *, student: str, run: bool = True) -> BindingFacts:  # noqa: ARG001 - one task for everyone
    """What the file says about its buttons; in RobotPy, once that is right, what they do.

    Args:
        path: the file.
        student: whose it is.
        run: whether to run it, where it can be.

    Raises:
        UnreadableFile: it cannot be read, or does not parse.
    """
    read_text(path)
    facts = read_bindings(path)
    if facts.problems:
        first = facts.problems[0]
        raise UnreadableFile(
            first.message,
            where=f"{path}, line {first.line}",
            advice="Fix that line first: code with a mistake like this does not compile.",
        )
    if facts.language == "python":
        bench.refuse_tampering(path)
    if not run or facts.language != "python" or not bench.is_robotpy_installed():
        return facts
    right = run_checks((factories, held, each_once, guard), facts)
    return press(path, facts) if all(one.status is Status.PASSED for one in right) else facts


@check(points=2)
def factories(facts: BindingFacts) -> None:
    """Public methods of the subsystem make the commands of all four tests."""
    made = all_of(one.test for one in facts.factories)
    public = all_of(one.test for one in facts.factories if one.public)
    if public >= TESTS:
        return
    earned = 2 * len(public) / len(TESTS)
    check_spelling(facts.compile_errors, language=facts.language, earned=earned)
    hidden = [one for one in facts.factories if not one.public and all_of([one.test]) - public]
    if hidden:
        raise WrongAnswer(
            f"other classes may not call {hidden[0].method}",
            hint="Make it public: in Java by that word, in Python by a name without a _ in front.",
            earned=earned,
        )
    if not made and any(not test.read for one in facts.bindings for test in one.tests):
        raise WrongAnswer(
            f"the grader cannot see the methods that {facts.bindings[0].text} calls",
            hint=(
                "Put the subsystem's file into the same folder, or its class into this file, "
                "and grade again."
            ),
        )
    if any(not one.test.direction for one in facts.factories):
        one = next(one for one in facts.factories if not one.test.direction)
        raise WrongAnswer(
            f"the grader cannot see the direction of {one.method} by reading",
            hint=(
                "Pass Direction.kForward or kReverse, or make the direction a parameter of the"
                " method."
            ),
            earned=earned,
        )
    lacking = named(TESTS - public)
    raise WrongAnswer(
        f"no method makes {lacking}" if made else "no method makes the command of a test",
        hint="The routine makes the commands: quasistatic(direction) and dynamic(direction). "
        "Return them from public methods of the subsystem.",
        earned=earned,
    )


@check(points=3)
def held(facts: BindingFacts) -> str | None:
    """Each of the four tests runs only while its own button is held."""
    bound(facts)
    earned = round(3 * held_share(facts), 2)
    for one in facts.bindings:
        check_hold(one, facts, earned=earned)
    if len(facts.bindings) >= len(TESTS):
        check_compiles(facts.compile_errors, language=facts.language, earned=1)
        if facts.language == "java" or not bench.is_robotpy_installed():
            return READ_ONLY[facts.language]
        return agreed(facts, _stops, points=3)
    check_spelling(facts.compile_errors, language=facts.language, earned=earned)
    _readable(facts, earned=earned)
    hint = "Four tests, four buttons: two kinds, each forward and reverse."
    raise WrongAnswer(f"no button runs {named(missing(facts))}", hint=hint, earned=earned)


def _stops(ran: RunFacts) -> RunFault | None:
    """Where the run stopped, or a test that did not."""
    return find_stop(ran, where="") or findings.check_release(ran)


@check(points=1)
def each_once(facts: BindingFacts) -> None:
    """Every test is there once: two kinds, two directions."""
    reached(facts)
    for one in facts.bindings:
        if len(one.tests) > 1:
            hint = "Such a command runs the tests one after the other. Give each its own button."
            raise WrongAnswer(f"line {one.line} runs {named(all_of(one.tests))}", hint=hint)
        if not all_of(one.tests) or one.tests[0].direction == "any":
            raise WrongAnswer(
                f"the grader cannot see the direction in line {one.line} by reading {one.text}",
                hint=WRITE_IT,
            )
    twice = [test for test in TESTS if len(times(facts, test)) > 1]
    if twice:
        first = min(twice, key=lambda test: times(facts, test)[0])
        lines = " and ".join(f"line {line}" for line in times(facts, first))
        hint = (
            "Did you copy a line and forget to change it? Check the kind and the direction "
            "in both lines."
        )
        raise WrongAnswer(f"{' '.join(first)} twice: {lines}", hint=hint)
    lacking = missing(facts)
    if lacking:
        only = {way for _, way in lacking} == {"reverse"}
        raise WrongAnswer(
            f"{named(lacking)} missing",
            hint=(
                "You need the reverse runs: only both directions together show friction and "
                "gravity."
            )
            if only
            else "Two kinds, each forward and reverse.",
            misconception="M-REVERSE-WASTE" if only else "",
        )


@check(points=2)
def comments(facts: BindingFacts) -> None:
    """A comment next to each binding says which test it is and what that measures."""
    reached(facts)
    wrong: list[WrongAnswer] = []
    for one in facts.bindings:
        try:
            check_comment(one)
        except WrongAnswer as why:
            wrong.append(why)
    if wrong:
        right = len(facts.bindings) - len(wrong)
        wrong[0].earned = round(2 * right / max(len(facts.bindings), len(TESTS)), 2)
        raise wrong[0]


@check(points=2)
def guard(facts: BindingFacts) -> str | None:
    """No test can be started by accident in a match."""
    reached(facts)
    note = check_guard(facts, points=2)
    if all(HOLDS.intersection(one.guards) for one in facts.bindings):
        agreed(facts, findings.check_guard, points=2)
    return note


def bound(facts: BindingFacts) -> None:
    """Ask for bindings, where there are none.

    Raises:
        WrongAnswer: tests are started in another way, or cannot be read.
        NotReachedError: there is nothing yet.
    """
    if facts.bindings:
        return
    check_spelling(facts.compile_errors, language=facts.language)
    if facts.elsewhere:
        text, line = facts.elsewhere[0]
        raise WrongAnswer(
            f"{text} in line {line}",
            hint="No button is held there, so nobody can release it. Bind the test to a button.",
        )
    _readable(facts, earned=0.0)
    if all_of(one.test for one in facts.factories) >= TESTS:
        raise WrongAnswer(
            "no button runs a test",
            hint="Bind each of the four to a button. If you did: does the program reach that "
            "line, or is there a return or a condition before it?",
        )
    reached(facts)


def reached(facts: BindingFacts) -> None:
    """Look no further where there are no bindings.

    Raises:
        NotReachedError: there are none.
    """
    if not facts.bindings:
        raise NotReachedError(READ)


def _readable(facts: BindingFacts, *, earned: float) -> None:
    """Ask, where a test that is missing may be one that cannot be read."""
    for first in facts.unread[:1]:
        hint = "Write the test into the line that binds it, so that the grader can read it."
        raise WrongAnswer(f"line {first.line}: {first.message}", hint=hint, earned=earned)
    for one in facts.bindings:
        if not all_of(one.tests):
            raise WrongAnswer(
                f"the grader cannot see the direction in line {one.line} by reading {one.text}",
                hint=WRITE_IT,
                earned=earned,
            )
