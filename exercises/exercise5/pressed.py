"""What a run adds to reading: every button pressed, in test mode and out of it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from grader.check import WrongAnswer
from grader.robotcode import bench
from grader.robotcode.bench import RunFacts, RunOutcome
from grader.robotcode.bench.findings import IN, RunFault
from grader.robotcode.binding_facts import BindingFacts

CONTAINER = "RobotContainer"  # what a robot's program makes first, by WPILib's own template
FOUR = 4


@dataclass(frozen=True)
class Pressed(BindingFacts):
    """What the file says, and what it did.

    Args:
        ran: what its buttons did; None if nobody pressed them.
    """

    ran: RunFacts | None = None


def press(path: Path, facts: BindingFacts) -> Pressed:
    """Press every button of the program."""
    return Pressed(**vars(facts), ran=bench.press_buttons(path, CONTAINER))


def agreed(
    facts: BindingFacts, look: Callable[[RunFacts], RunFault | None], *, points: float
) -> str:
    """Hold a check that passed by reading against the run.

    Args:
        facts: what the file says, and perhaps did.
        look: what the run shows to be wrong.
        points: the check's.

    Returns:
        A note on the run, or nothing.

    Raises:
        WrongAnswer: the run shows otherwise.
    """
    ran = facts.ran if isinstance(facts, Pressed) else None
    if ran is None:
        return ""
    if ran.outcome is RunOutcome.CANNOT:
        return f"Only read, not run {IN}: {ran.said}."
    fault = look(ran)
    if fault:
        raise WrongAnswer(
            fault.seen,
            hint=fault.hint,
            misconception=fault.misconception,
            earned=round(points * (1.0 - fault.share), 1),
        )
    seen = {test for one in ran.presses for test in one.tests}
    return f"Also run {IN}: each ran while its button was held." if len(seen) == FOUR else ""
