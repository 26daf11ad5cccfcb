"""One mutant: an authored answer with one mistake put into it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    """A right answer file with one change by one mutation operator.

    Attributes:
        exercise: The exercise the file answers, as in ``exercises/``, for example ``exercise4``.
        file: The name of the changed file in ``solutions/``, with ``/`` between folders.
        operator: The name of the mutation operator, for example ``negate-guard``.
        line: The first changed line, counted from 1.
        text: The whole file after the change.
    """

    exercise: str
    file: str
    operator: str
    line: int
    text: str
