"""A warning that is attached to a result."""

from collections.abc import Iterable
from dataclasses import dataclass

from sim.core.advice import Action

SHOWN_FIRST = frozenset({"contradicting-units", "unit-error"})  # others depend on these
GAINS = ("kS", "kV", "kA", "kG", "offset_rad")
OF_POSITION = GAINS[1:]  # gains that depend on the unit of the position


@dataclass(frozen=True)
class Doubt:
    """A warning about a result; in JSON output its key is ``warnings``.

    Args:
        code: a short fixed name for programs, like ``negative-gain``.
        message: the cause, in one or two sentences for the user.
        grave: whether the result cannot be right; if not, it only has to be checked.
        action: what to do, where each surface says it in its own words.
        gains: gains that may be wrong by more than their errors because of it.
    """

    code: str
    message: str
    grave: bool = False
    action: Action | None = None
    gains: tuple[str, ...] = ()

    @property
    def is_shown_first(self) -> bool:
        """Whether it is shown before the result."""
        return self.grave or self.code in SHOWN_FIRST

    @property
    def text(self) -> str:
        """Cause and advice, as the command line says it."""
        return self.message if self.action is None else f"{self.message} {self.action}"


def sort_doubts(doubts: Iterable[Doubt]) -> list[Doubt]:
    """What is wrong comes first, then what other doubts depend on, then doubts about gains."""
    return sorted(doubts, key=lambda one: (not one.grave, not one.is_shown_first, not one.gains))
