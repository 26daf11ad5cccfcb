"""The place of a running program, and the rest of its time."""

import sys
from typing import Any

from grader.robotcode.java.syntax import At

STEPS = 100_000  # calls and turns of a loop between two visits of the bench
MOST_STEPS = 8_000_000  # of a whole run
ELEMENTS = 20  # of a collection, that cost as much time to move as a step
DEEPEST = 500  # calls within calls


PYTHON_CALLS = 15_000  # Python calls within calls that DEEPEST calls of Java may need


def allow_deep_calls() -> None:
    """Let Java's own limit of calls within calls come before Python's."""
    sys.setrecursionlimit(max(sys.getrecursionlimit(), PYTHON_CALLS))


class EndlessError(BaseException):
    """The program does not come back; no code of a learner can catch this."""


class CannotRunError(BaseException):
    """The program uses something of Java that is not run here, so its effect is unknown."""


def refuse(what: str) -> Any:
    """Stop a program that needs something of Java's that is not run here.

    Raises:
        CannotRunError: always.
    """
    raise CannotRunError(what)


class State:
    """The current place in the program, and the rest of its budget."""

    at: At = At(0)
    steps = STEPS
    left = MOST_STEPS  # from the last refill on
    depth = 0

    def start(self) -> None:
        """Begin a new run."""
        self.left, self.depth = MOST_STEPS, 0

    def refill(self, steps: int = STEPS) -> None:
        """Let the program run on, as when the next loop of the robot begins."""
        self.left -= max(STEPS - self.steps, 0)
        self.steps, self.depth = min(steps, self.left), 0

    def tick(self, count: int = 1) -> None:
        """Count steps; work on many elements is several.

        Raises:
            EndlessError: there have been too many.
        """
        self.steps -= count
        if self.steps < 0:
            raise EndlessError(f"line {self.at} runs without end")


STATE = State()
