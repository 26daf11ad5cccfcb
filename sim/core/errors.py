"""All exceptions raised on purpose: one line with what is wrong, where, and what to do next.

    Refusal
    ├── UnreadableFile    missing, empty, damaged, truncated, or of an unknown format
    ├── MissingSignal     the file is intact, but an entry that a fit needs is missing
    ├── BadSample         a number that cannot be a measurement: nan, infinite, out of order
    ├── NotIdentifiable   the log is intact, but does not determine the gains
    └── BadRequest        a request that cannot be carried out: unknown name, value out of range,
                          a folder that cannot be written

A command turns any of them into one line on standard error and exit code 2.
"""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Self

from sim.core.advice import Action


class Refusal(Exception):  # noqa: N818 - not an error of the program
    """Base class of all errors raised on purpose: what is wrong, where, and what to do.

    Args:
        what: the problem, with its size: ``velocity is nan``.
        where: the file, and the place in it: ``log.csv, line 17``; may be empty.
        advice: what to do next, an imperative sentence, or an action that each surface words.
    """

    def __init__(self, what: str, *, where: str = "", advice: str | Action) -> None:
        self.what = what
        self.where = where
        self.action = advice if isinstance(advice, Action) else None
        self.advice = str(advice)
        super().__init__(what, where, self.advice)

    def __reduce__(self) -> tuple[object, ...]:
        """Support for pickling, to send a refusal from one process to another."""
        return _rebuild, (type(self), self.what, self.where, self.action or self.advice)

    def move(self, where: str) -> Self:
        """The refusal with another place."""
        return self.__class__(self.what, where=where, advice=self.action or self.advice)

    def __str__(self) -> str:
        said = f"{self.where}: {self.what}" if self.where else self.what
        return f"{said}{'' if said.endswith(('.', '?', '!')) else '.'} {self.advice}"


class UnreadableFile(Refusal):
    """A file that is missing, empty, damaged, truncated, or of an unknown format."""


class MissingSignal(Refusal):
    """An intact file without an entry that is needed."""


class BadSample(Refusal):
    """A sample that cannot be a measurement."""


class NotIdentifiable(Refusal):
    """An intact log that does not determine the gains."""


class BadRequest(Refusal):
    """A request that cannot be carried out."""


def refuse_unknown(what: str, name: object, known: Iterable[object]) -> None:
    """Refuse a name that is not among those known.

    Args:
        what: what it should name: ``motor``.
        name: the name.
        known: the names there are, which the message lists.

    Raises:
        BadRequest: the name is not among them.
    """
    known = tuple(known)
    if name not in known:
        advice = f"Choose one of: {', '.join(map(str, known))}."
        raise BadRequest(f"unknown {what} {name!r}", advice=advice)


def _rebuild(kind: type[Refusal], what: str, where: str, advice: str | Action) -> Refusal:
    """An unpickled refusal."""
    return kind(what, where=where, advice=advice)


@contextmanager
def refusals_at(where: str) -> Iterator[None]:
    """A context in which every refusal names the given place before its own."""
    try:
        yield
    except Refusal as refusal:
        place = f"{where}, {refusal.where}" if refusal.where else where
        raise BadRequest(refusal.what, where=place, advice=refusal.advice) from None
