"""Exercise 5: four tests on four buttons, held, explained and guarded. Every button is pressed."""

from collections.abc import Iterator
from pathlib import Path

from grader.checks.check import NotReachedError, WrongAnswer, check
from grader.robotcode.bench.button_run import ButtonFacts, Press
from grader.robotcode.bench.facts import TESTS
from grader.robotcode.checks.causes import ask_for_files, check_compiles, check_stop, list_tests
from grader.robotcode.running import Runs, judge_runs, run_buttons
from sim.support.printable import join_names

from .explained import check_comment

FILES = ("RobotContainer.java", "robotcontainer.py")
READ = "checked after a held button runs a test"
TIMEOUT = 10.0  # [s] of the routine in the file to fill in
LATE = 1.5  # [s] a test may wait for its steering, or for a button to settle
EARLY = 0.9  # [share] of the timeout that a held test has to run
PRESSED = 1 / 3  # [share] of the points for a test that starts, but does not stop on release
WAYS = (
    "Use something that never happens in a match: test mode, a second button that you hold at"
    " the same time, a switch on the dashboard, or a controller that is not plugged in."
)


def read(path: Path, *, student: str, run: bool = True) -> Runs:  # noqa: ARG001 - one task for everyone
    """The facts about the program's buttons.

    Args:
        path: the file.
        student: whose it is.
        run: whether a learner's Python may be run; Java is interpreted by ourselves in any case.

    Raises:
        UnreadableFile: it cannot be read, or does not parse.
        NotRunError: it is Python, which may not be run.
    """
    return run_buttons(path, run=run)


def _list_missing_tests(facts: ButtonFacts) -> list[str]:
    """The tests that no button runs."""
    return [one for one in TESTS if one not in {press.test for press in facts.presses}]


def _check_reached(facts: ButtonFacts) -> None:
    """Look no further where no button runs a test.

    Raises:
        NotReachedError: none does.
    """
    if not facts.presses:
        raise NotReachedError(READ)


@check(points=2)
def factories(runs: Runs) -> str | None:
    """Public methods of the subsystem make the commands of all four tests."""
    return judge_runs(runs, _check_factories)


def _check_factories(facts: ButtonFacts) -> None:
    made = {test for one in facts.factories for test in one.tests}
    public = {test for one in facts.factories if one.public for test in one.tests}
    if public >= set(TESTS):
        return
    earned = 2 * len(public) / len(TESTS)
    check_compiles(facts, earned=earned)
    hidden = [one for one in facts.factories if not one.public and set(one.tests) - public]
    if hidden:
        raise WrongAnswer(
            f"other classes may not call {hidden[0].method} (line {hidden[0].line})",
            hint="Make it public: in Java by that word, in Python by a name without a _ in front.",
            earned=earned,
        )
    check_stop(facts, "start", earned=earned)
    ask_for_files(facts.unknown, earned)
    lacking = list_tests(set(TESTS) - public)
    raise WrongAnswer(
        f"no method makes {lacking}" if made else "no method makes the command of a test",
        hint="The routine makes the commands: quasistatic(direction) and dynamic(direction). "
        "Return them from public methods of the subsystem.",
        earned=earned,
    )


@check(points=3)
def held(runs: Runs) -> str | None:
    """Each of the four tests runs only while its own button is held."""
    return judge_runs(runs, _check_held)


def _check_held(facts: ButtonFacts) -> None:
    faults = {one.test: next(_list_faults(one, facts), None) for one in facts.presses}
    share = 0.0
    for one in facts.presses:
        fault = faults[one.test]
        share += 1.0 if fault is None else PRESSED if fault[0] else 0.0
    earned = round(3 * share / len(TESTS), 2)
    check_stop(facts, earned=earned)
    for mode, tests in facts.alone.items():
        if tests:
            raise WrongAnswer(
                f"nobody presses anything, and in {mode} mode {list_tests(tests)} runs",
                hint="Its trigger is true without a button, or something else starts it. It must "
                "run only while you hold the button: whileTrue().",
            )
    for _, seen, hint in (fault for fault in faults.values() if fault is not None):
        check_compiles(facts, earned=earned)
        raise WrongAnswer(seen, hint=hint, earned=earned)
    lacking = _list_missing_tests(facts)
    if not lacking:
        check_compiles(facts, earned=1)
        return
    check_compiles(facts, earned=earned)
    _explain_missing(facts, lacking, earned)


def _list_faults(one: Press, facts: ButtonFacts) -> Iterator[tuple[bool, str, str]]:
    """Faults in how a test is held, the worst first.

    Yields:
        Whether it starts at all, what is seen, and the advice.
    """
    test, at = list_tests([one.test]), f" ({one.text} in line {one.line})" if one.line else ""
    if sequence := _describe_sequence(one, facts):
        yield False, *sequence
    elif one.together:
        lines = sorted({p.line for p in facts.presses if p.inputs == one.inputs})
        yield (
            False,
            (
                f"lines {' and '.join(map(str, lines))} share the trigger: "
                f"{' and '.join(one.inputs)} runs {list_tests([one.test, *one.together])}"
            ),
            (
                "Both need the motors, so one interrupts the other, and only one ever runs. Give "
                "each its own button."
            ),
        )
    if one.stayed:
        yield _describe_stay(one, f"{test} continues when the button is released{at}")
    if one.delay > LATE:
        yield (
            False,
            f"{test} starts {one.delay:.1f} s after the button is pressed{at}",
            "The test must start and stop with its button. Debounce for at most 0.5 s.",
        )
    if one.restarted:
        yield (
            True,
            f"{test} begins again after its end while the button is held{at}",
            (
                "Then the routine's timeout protects nobody. Pass the test itself to whileTrue(), "
                "without repeating it."
            ),
        )
    if one.lasted < EARLY * TIMEOUT and _is_shorter(one, facts):
        yield (
            True,
            f"{test} ends after {one.lasted:.2g} s although the button is held{at}",
            (
                "The test must run while you hold its button, up to the routine's own timeout. "
                "Does another command of the same button, or a decorator, end it early?"
            ),
        )
    if one.moves:
        yield (
            True,
            f"after {test} the motor is still driven, with nobody touching anything{at}",
            "When a test ends or its button is released, the mechanism has to stop.",
        )


def _describe_sequence(one: Press, facts: ButtonFacts) -> tuple[str, str] | None:
    """What happens at a binding that runs several tests, and the advice."""
    bound_apart = {p.test for p in facts.presses if p.line != one.line}
    if not one.together or bound_apart & set(one.together):
        return None
    hint = "A command that holds several tests runs one after the other. Give each its own button."
    return f"line {one.line} runs {list_tests([one.test, *one.together])}", hint


def _describe_stay(one: Press, seen: str) -> tuple[bool, str, str]:
    """Words for a test that goes on when its button is released."""
    said = "Once started, the test runs to its timeout even after you release the button. "
    if one.stopped or one.how.startswith("toggle"):
        said = "You need a second press to stop it, and in a hurry nobody finds the button. "
    elif one.how in {"whileTrue", ""}:  # no trigger holds the test itself
        hint = (
            "Does the button only start another command, which then runs to its timeout? Pass the "
        )
        return True, seen, f"{hint}test itself to whileTrue()."
    return True, seen, f"{said}It must stop when you let go: whileTrue()."


def _is_shorter(one: Press, facts: ButtonFacts) -> bool:
    """Whether a test ends before the others, and too early for a timeout."""
    longest = max((press.lasted for press in facts.presses), default=0.0)
    return one.lasted < 3.0 or one.lasted < EARLY * min(longest, TIMEOUT)  # [s] no ramp is so short


def _explain_missing(facts: ButtonFacts, lacking: list[str], earned: float) -> None:
    for name, line in facts.uncalled:
        raise WrongAnswer(
            f"nothing calls {name} in line {line}",
            hint="Call it where the RobotContainer is made. Until then no button does anything.",
            earned=earned,
        )
    for test, line in facts.released:
        raise WrongAnswer(
            f"{list_tests([test])} starts when the button is let go (line {line})",
            hint="Then it runs while nobody holds the button, and with onFalse a press does not "
            "stop it. It must run while you hold the button: whileTrue().",
            earned=earned,
        )
    for said, line in facts.elsewhere:
        raise WrongAnswer(
            f"{said}{f' (line {line})' if line else ''}",
            hint="No button is held there, so nobody can release it. Bind the test to a button.",
            earned=earned,
        )
    ask_for_files(facts.unknown, earned)
    if not any(one.tests for one in facts.factories):
        raise NotReachedError(READ)
    if not facts.presses and not facts.bindings:
        raise WrongAnswer(
            "no button runs a test",
            hint="Bind each of the four to a button. If you did: does the program reach that "
            "line, or is there a return or a condition before it? Of several classes, the one "
            "that is named like the file is run.",
        )
    bound = [str(line) for line in sorted({line for line, _ in facts.bindings})]
    raise WrongAnswer(
        f"no button was found that runs {list_tests(lacking) if facts.presses else 'a test'}",
        hint="Four tests, four buttons: two kinds, each forward and reverse. Every button was "
        "held for 0.6 s, alone and together with a second one, in test mode and in teleop. Is the "
        f"guard true there{f' (lines {join_names(bound)})' if bound else ''}? A button that is the "
        "guard must start no test itself.",
        earned=earned,
    )


@check(points=1)
def each_once(runs: Runs) -> str | None:
    """Every test is there once: two kinds, two directions."""
    return judge_runs(runs, _check_each_once)


def _check_each_once(facts: ButtonFacts) -> None:
    _check_reached(facts)
    for one in facts.presses:
        if sequence := _describe_sequence(one, facts):
            raise WrongAnswer(sequence[0], hint=sequence[1])
    bound = {line for _, line in facts.made}
    for test in TESTS:
        lines = sorted({line for made, line in facts.made if made == test and line in bound})
        if len(lines) > 1 and _list_missing_tests(facts):
            raise WrongAnswer(
                f"{list_tests([test])} twice: {' and '.join(f'line {line}' for line in lines)}",
                hint="Did you copy a line and forget to change it? Check the kind and the "
                "direction in both lines.",
            )
    there = {test for test, _ in facts.made}
    lacking = [test for test in _list_missing_tests(facts) if test not in there]
    if not lacking and (idle := _list_missing_tests(facts)):
        raise NotReachedError(f"checked after a held button runs {list_tests(idle)}, too")
    if lacking:
        only = {one.rpartition("-")[2] for one in lacking} == {"reverse"}
        raise WrongAnswer(
            f"{list_tests(lacking)} missing",
            hint="You need the reverse runs: only both directions together show friction and "
            "gravity."
            if only
            else "Two kinds, each forward and reverse.",
            misconception="M-REVERSE-WASTE" if only else "",
        )


@check(points=2)
def comments(runs: Runs) -> str | None:
    """A comment next to each binding says which test it is and what that measures."""
    return judge_runs(runs, _check_comments)


def _check_comments(facts: ButtonFacts) -> None:
    _check_reached(facts)
    wrong: list[WrongAnswer] = []
    for one in facts.presses:
        try:
            check_comment(one)
        except WrongAnswer as why:
            wrong.append(why)
    if wrong:
        right = len(facts.presses) - len(wrong)
        wrong[0].earned = round(2 * right / len(TESTS), 2)
        raise wrong[0]


@check(points=2)
def guard(runs: Runs) -> str | None:
    """No test can be started by accident in a match."""
    return judge_runs(runs, _check_guards)


def _check_guards(facts: ButtonFacts) -> str | None:
    if not facts.presses:
        _check_asked_once(facts)
    _check_reached(facts)
    for said, line in facts.elsewhere:
        if said.startswith(("autonomous", "the program")):
            raise WrongAnswer(
                f"{said} (line {line})", hint=f"It would start in every match. {WAYS}"
            )
    for mode in ("autonomous", "teleop"):
        alone = facts.alone.get(mode)
        if alone and not any(map(_has_or, facts.presses)):
            raise WrongAnswer(
                f"in {mode} mode {list_tests(alone)} runs although nobody presses anything",
                hint=f"In a match it would run at once. {WAYS}",
            )
    joined = [one for one in facts.presses if _is_open(one) and _has_or(one)]
    if joined:
        raise WrongAnswer(
            f"the trigger in line {joined[0].line} joins two conditions with or",
            hint="Then one of them alone can start the test. If both must be true, join them with "
            "and() (Python: and_()).",
        )
    inverted = [one for one in facts.presses if one.mode != "test"]
    if inverted:
        one = inverted[0]
        raise WrongAnswer(
            f"line {one.line} starts its test in {one.mode} mode, not in test mode: {one.text}",
            hint="Then it can start in a match. Does its guard check for test mode itself?",
        )
    open_ = [one for one in facts.presses if _is_open(one)]
    bound = len(facts.presses)
    if not open_ and bound < len(TESTS):
        hint = "The guard is right. It earns all its points when a held button runs each test."
        raise WrongAnswer(
            f"held buttons run {bound} of {len(TESTS)} tests",
            hint=hint,
            earned=2 * bound / len(TESTS),
        )
    if not open_:
        apart = [one for one in facts.presses if one.opened and one.apart and len(one.inputs) == 1]
        return (
            "Unplug that controller before a match, so that nobody touches it." if apart else None
        )
    _explain_open(open_, facts, bound)
    return None


def _has_or(one: Press) -> bool:
    """Whether the line of a binding joins conditions with or."""
    return ".or(" in one.text or ".or_(" in one.text


def _is_open(one: Press) -> bool:
    """Whether a match can bring what starts a test: one input, on a controller that drives."""
    return bool(one.opened) and len(one.inputs) == 1 and not one.switch and not one.apart


def _explain_open(open_: list[Press], facts: ButtonFacts, bound: int) -> None:
    """Say why tests can start in a match.

    Raises:
        WrongAnswer: always.
    """
    first = open_[0]
    seen = (
        f"in {' and '.join(first.opened)}, {' and '.join(first.inputs)} alone starts "
        f"{list_tests([first.test])} (line {first.line})"
    )
    for port, line in facts.shared:
        if port in first.ports:
            raise WrongAnswer(
                f"two controllers are made with port {port} (line {line})",
                hint=f"They are one and the same controller. {WAYS}",
            )
    guarded = bound - len(open_)
    if guarded:
        lines = ", ".join(str(one.line) for one in open_)
        raise WrongAnswer(
            f"{guarded} of {bound} tests are guarded; without a guard: line {lines}",
            hint="One test without a guard is enough for an accident. Guard all four in the same "
            "way, and with another button than the test's own.",
            earned=2 * guarded / len(TESTS),
        )
    _check_asked_once(facts)
    raise WrongAnswer(seen, hint=WAYS)


def _check_asked_once(facts: ButtonFacts) -> None:
    """Raise ``WrongAnswer`` if test mode is asked for only while the program starts."""
    if facts.asked_once and facts.stop is None:
        raise WrongAnswer(
            f"line {facts.asked_once} checks test mode only once, while the program starts",
            hint="The robot is not in test mode then, and the answer never changes. Let the "
            "trigger check it every time.",
        )
