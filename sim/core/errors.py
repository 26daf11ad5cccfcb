"""All exceptions raised on purpose: one line with what is wrong, where, and what to do next.

    Refusal
    ├── UnreadableFile    missing, empty, damaged, truncated, or of a format nobody here reads
    ├── MissingSignal     the file is sound, but an entry that a fit needs is not in it
    ├── BadSample         a number that cannot be a measurement: nan, infinite, out of order
    ├── NotIdentifiable   the log is sound, but does not determine the gains
    └── BadRequest        what was asked for cannot be done: unknown name, value out of range,
                          a folder that cannot be written

A command turns any of them into one line on standard error and exit code 2.
"""


class Refusal(Exception):  # noqa: N818 - a refusal is an answer, not a fault of the program
    """Base class of all errors raised on purpose: what is wrong, where, and what to do.

    Args:
        what: the problem, with its size: ``velocity is nan``.
        where: the file, and the place in it: ``log.csv, line 17``; may be empty.
        advice: what the reader does next, an imperative sentence.
    """

    def __init__(self, what: str, *, where: str = "", advice: str) -> None:
        self.what = what
        self.where = where
        self.advice = advice
        super().__init__(what, where, advice)

    def __reduce__(self) -> tuple[object, ...]:
        """How it travels from one process to another."""
        return _again, (type(self), self.what, self.where, self.advice)

    def __str__(self) -> str:
        said = f"{self.where}: {self.what}" if self.where else self.what
        return f"{said}{'' if said.endswith(('.', '?', '!')) else '.'} {self.advice}"


class UnreadableFile(Refusal):
    """A file that is missing, empty, damaged, truncated, or of an unknown format."""


class MissingSignal(Refusal):
    """A sound file that lacks an entry which the work at hand needs."""


class BadSample(Refusal):
    """A sample that cannot be a measurement."""


class NotIdentifiable(Refusal):
    """A sound log that does not determine the gains."""


class BadRequest(Refusal):
    """A request that cannot be met as it was made."""


def _again(kind: type[Refusal], what: str, where: str, advice: str) -> Refusal:
    return kind(what, where=where, advice=advice)
