"""A warning that is attached to a result."""

from dataclasses import dataclass

SHOWN_FIRST = frozenset({"contradicting-units", "not-volts"})  # all that follows depends on these


@dataclass(frozen=True)
class Doubt:
    """A warning about a result. In JSON output doubts stand under ``warnings``.

    Args:
        code: a short fixed name for programs, e.g. ``negative-gain``.
        message: cause and cure, one or two sentences for people.
        grave: the result it stands beside cannot be right, rather than only be looked at twice.
    """

    code: str
    message: str
    grave: bool = False
