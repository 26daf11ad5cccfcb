"""Two ways to look at one file: reading it, and running it in WPILib's simulation.

What reading decides stands, unless the run shows otherwise; what it has to ask about, the run
settles. Where nothing can be run (Java, no RobotPy, vendors' devices), reading is all there is.
"""

from collections.abc import Callable
from dataclasses import dataclass

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.bench import RunFacts, RunOutcome
from grader.robotcode.bench.findings import IN, RunFault
from grader.robotcode.facts import RoutineFacts
from grader.sysid_routine_checks import explain_doubt

QUESTION = explain_doubt("", "").split(" by ")[0].strip()  # how everything begins that is asked
STOPPED = {RunOutcome.CRASHED, RunOutcome.ENDLESS}


@dataclass(frozen=True)
class Code:
    """What the checks look at.

    Args:
        facts: what the file says.
        ran: what it did; None if it was not run.
    """

    facts: RoutineFacts
    ran: RunFacts | None = None


def asks(seen: str) -> bool:
    """Whether what a check saw is a question, not a mistake."""
    return seen.startswith(QUESTION)


def settle(
    code: Code,
    reading: Callable[[], str | None],
    running: Callable[[RunFacts], RunFault | None],
    *,
    points: float,
    answered: Callable[[RunFacts], bool] = lambda _: True,
) -> str | None:
    """Look both ways.

    Args:
        code: the file, read and perhaps run.
        reading: the check by reading; returns a note, or raises WrongAnswer or NotReachedError.
        running: what a run that came to its end shows to be wrong, or one that did not.
        points: the check's.
        answered: whether a run that shows no fault shows that all is right.

    Returns:
        The reading's note, or how its question was settled.

    Raises:
        WrongAnswer: it is wrong, or cannot be told either way.
        NotReachedError: there is nothing to look at yet.
    """
    ran = code.ran
    try:
        note = reading()
    except (WrongAnswer, NotReachedError) as open_still:
        if isinstance(open_still, WrongAnswer) and not asks(open_still.seen):
            raise
        if ran is not None and ran.outcome in STOPPED and isinstance(open_still, WrongAnswer):
            _unsettled(open_still, ran.said)
        if ran is None or ran.outcome is not RunOutcome.RAN:
            raise
        _fail(running(ran), points)
        if isinstance(open_still, WrongAnswer) and ran.aware:
            said = (
                f"{ran.aware}, checks whether this is a simulation, and may behave "
                "differently on a robot"
            )
            _unsettled(open_still, said)
        if not answered(ran):
            raise
        return (
            f"The grader could not decide this by reading, so it ran the code {IN}: there it "
            "is right."
        )
    if ran is not None:
        _fail(running(ran), points)
    return note


def _unsettled(question: WrongAnswer, said: str) -> None:
    """Say that running did not answer the question, either."""
    raise WrongAnswer(
        question.seen,
        hint=f"{question.hint} Running it {IN} did not help: {said}",
        misconception=question.misconception,
        earned=question.earned,
    ) from None


def _fail(fault: RunFault | None, points: float) -> None:
    if fault is not None:
        raise WrongAnswer(
            fault.seen,
            hint=fault.hint,
            misconception=fault.misconception,
            earned=round(points * (1.0 - fault.share), 1),
        )


def noted(ran: RunFacts | None, figures: Callable[[RunFacts], str]) -> str | None:
    """Which way the file was looked at, where that is not reading alone."""
    if ran is None or ran.outcome in STOPPED:
        return None
    if ran.outcome is RunOutcome.CANNOT:
        return f"Only read, not run {IN}: {ran.said}."
    return f"Also run {IN}: {figures(ran)}."
