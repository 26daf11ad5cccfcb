"""Read a TOML table into a dataclass; an unknown or wrong key is refused by name and place.

A field of the dataclass is a key with a reader: a function of the key and its value in the file,
which returns the value as the program needs it.
"""

import json
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import MISSING, dataclass, field, fields
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, TypeVar

from sim.core.errors import BadRequest, refusals_at

if TYPE_CHECKING:
    import numpy as np

SHOWN = 40  # [characters] of a wrong value in a message, at most
LARGEST = 1e300  # numbers are below it; what is larger counts as infinite
ENDS = 2  # [numbers] of a range

Reader = Callable[[str, Any], Any]
Table = TypeVar("Table")


@dataclass(frozen=True)
class NumberRange:
    """A number that is fixed, or drawn uniformly from a range.

    Args:
        least: lower limit.
        most: upper limit; equal to the lower one if the number is fixed.
    """

    least: float
    most: float

    def draw(self, rng: "np.random.Generator") -> float:
        """Draw a number from the range."""
        return float(rng.uniform(self.least, self.most))


def key(read: Reader, default: object = MISSING) -> Any:  # noqa: ANN401 - as ``dataclasses.field``
    """A field that is a key of a table; without a default, the table must have it."""
    return field(default=default, metadata={"read": read})


def read_table(kind: type[Table], content: object) -> Table:
    """A table as a dataclass.

    Args:
        kind: the dataclass, whose fields are made by ``key``.
        content: the parsed table.

    Raises:
        BadRequest: a key is unknown or missing, or its value is wrong.
    """
    keys = {one.name: one for one in fields(kind) if one.metadata}  # type: ignore[arg-type]
    if not isinstance(content, dict):
        advice = "Write each line as key = value."
        raise BadRequest(
            f"a table of keys belongs here, and this is {show(content)}", advice=advice
        )
    for name in content:
        if name not in keys:
            raise BadRequest(f"unknown key {show(name)}", advice=suggest_word(name, tuple(keys)))
    required = {name: MISSING for name, one in keys.items() if one.default is MISSING}
    values = (required | content).items()
    return kind(**{name: keys[name].metadata["read"](name, value) for name, value in values})


def table(kind: type[Table]) -> Reader:
    """A reader of a table."""

    def read(name: str, value: object) -> Table:
        with refusals_at(name):
            return read_table(kind, value)

    return read


def tables(kind: type[Table], name: str) -> Reader:
    """A reader of several tables, as a tuple; messages count them.

    Args:
        kind: the dataclass of each.
        name: name between the double brackets in the file: ``logs.faults``.
    """

    def read(key: str, value: object) -> tuple[Table, ...]:
        if not isinstance(value, list):
            raise refuse_value(key, value, f"Begin each with a line [[{name}]].")
        found = []
        for number, one in enumerate(value, start=1):
            with refusals_at(f"[[{name}]] number {number}"):
                found.append(read_table(kind, one))
        return tuple(found)

    return read


def refuse_value(key: str, value: object, advice: str) -> BadRequest:
    """The error for a wrong value of a key."""
    return BadRequest(f"{key} is {show(value)}", advice=advice)


def text(example: str) -> Reader:
    """A reader of a text that is not empty."""

    def read(key: str, value: object) -> str:
        if value is MISSING:
            advice = f"Add, for example: {key} = {show(example)}"
            raise BadRequest(f"{key} is missing", advice=advice)
        if not (isinstance(value, str) and value.strip()):
            raise refuse_value(key, value, f"Give a text: {key} = {show(example)}")
        return value.strip()

    return read


def texts(example: str) -> Reader:
    """A reader of one text, or several in a list, always as a tuple."""

    def read(key: str, value: object) -> tuple[str, ...]:
        if not isinstance(value, list):
            return (text(example)(key, value),)
        if not value or not all(isinstance(one, str) and one.strip() for one in value):
            raise refuse_value(key, value, f"Give texts: {key} = [{show(example)}]")
        return tuple(one.strip() for one in value)

    return read


def choices(options: Iterable[str]) -> Reader:
    """A reader of one or several of the allowed names, always as a tuple."""
    options = tuple(options)

    def read(key: str, value: object) -> tuple[str, ...]:
        chosen: tuple[str, ...] = texts(options[0])(key, value)
        for one in chosen:
            if one not in options:
                raise BadRequest(f"{key} {show(one)} is unknown", advice=suggest_word(one, options))
            if chosen.count(one) > 1:
                raise BadRequest(f"{key} names {show(one)} twice", advice="Name each once.")
        return chosen

    return read


def flag(key: str, value: object) -> bool:
    """Read true or false."""
    if not isinstance(value, bool):
        raise refuse_value(key, value, "Give true or false, without quotes.")
    return value


def integer(least: int, most: int) -> Reader:
    """A reader of an integer within limits."""

    def read(key: str, value: object) -> int:
        if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
            raise refuse_value(key, value, f"Give a whole number from {least} to {most}.")
        return value

    return read


def number(least: float, most: float) -> Reader:
    """A reader of a number within limits."""
    limits = f" from {least:g} to {most:g}" if math.isfinite(most) else f" of at least {least:g}"

    def read(key: str, value: object) -> float:
        numeric = isinstance(value, int | float) and not isinstance(value, bool)
        if not (numeric and least <= value <= most and value < LARGEST):  # type: ignore[operator]
            raise refuse_value(key, value, f"Give a number{limits}.")
        return float(value)  # type: ignore[arg-type]  # it is a number

    return read


def number_range(least: float, most: float) -> Reader:
    """A reader of a number, or a list of the limits of a range."""

    def read(key: str, value: object) -> NumberRange:
        if not isinstance(value, list):
            value = [value, value]
        ends = [number(least, most)(key, end) for end in value]
        if ends != sorted(ends) or len(ends) != ENDS:
            raise refuse_value(key, value, "Give a range for random numbers: [1.0, 2.0].")
        return NumberRange(*ends)

    return read


def suggest_word(word: str, options: Sequence[str]) -> str:
    """Advice for an unknown word: the option it probably means, or all options."""
    close = get_close_matches(word, options, n=1, cutoff=0.5)
    return f"Did you mean {show(close[0])}?" if close else f"Choose one of: {', '.join(options)}."


def show(value: object) -> str:
    """A value as JSON, shortened if it is long."""
    shown = json.dumps(value, ensure_ascii=False, default=str)
    return shown if len(shown) <= SHOWN else shown[: SHOWN - 1] + "…"
