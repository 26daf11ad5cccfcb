"""Read a TOML table key by key; an unknown or wrong key is refused by name and place."""

import json
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING, NoReturn

from sim.core.errors import BadRequest

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np

SHOWN = 40  # [characters] of a wrong value in a message, at most


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


class TomlTable:
    """A TOML table whose keys are checked.

    Its methods raise BadRequest if a value is missing or wrong.

    Args:
        content: the parsed table.
        where: file and place of the table, for messages.
        known: all keys that it may have.

    Raises:
        BadRequest: it has another key; the message names the most similar known one.
    """

    def __init__(self, content: object, *, where: str, known: Sequence[str]) -> None:
        self.where = where
        if not isinstance(content, dict):
            self.refuse(
                f"there are no keys here, only {_shown(content)}",
                advice="Write each line as key = value.",
            )
        self.content: Mapping[str, object] = content
        for key in content:
            if key not in known:
                self.refuse(f"unknown key {_shown(key)}", advice=suggest_word(key, known))

    def __contains__(self, key: str) -> bool:
        return key in self.content

    def refuse(self, what: str, *, advice: str) -> NoReturn:
        """Raise BadRequest with the place of this table."""
        raise BadRequest(what, where=self.where, advice=advice)

    def refuse_value(self, key: str, *, advice: str) -> NoReturn:
        """Raise BadRequest about the value of a key."""
        self.refuse(f"{key} is {_shown(self.content[key])}", advice=advice)

    def read_text(self, key: str, *, example: str) -> str:
        """Read a text that is not empty.

        Args:
            key: the key.
            example: a valid value for the message of a refusal.
        """
        if key not in self:
            self.refuse(f"{key} is missing", advice=f"Add, for example: {key} = {_shown(example)}")
        value = self.content[key]
        if not (isinstance(value, str) and value.strip()):
            self.refuse_value(key, advice=f"Give a text: {key} = {_shown(example)}")
        return value.strip()

    def read_texts(self, key: str, *, example: str) -> tuple[str, ...]:
        """Read one text, or several in a list, always as a tuple."""
        value = self.content.get(key)
        if not isinstance(value, list):
            return (self.read_text(key, example=example),)
        if not value or not all(isinstance(one, str) and one.strip() for one in value):
            self.refuse_value(key, advice=f"Give texts: {key} = [{_shown(example)}]")
        return tuple(one.strip() for one in value)

    def read_choices(self, key: str, options: Iterable[str]) -> tuple[str, ...]:
        """Read one or several of the allowed names, always as a tuple."""
        options = tuple(options)
        chosen = self.read_texts(key, example=options[0] if options else "")
        for one in chosen:
            if one not in options:
                self.refuse(f"{key} {_shown(one)} is unknown", advice=suggest_word(one, options))
        for one in chosen:
            if chosen.count(one) > 1:
                self.refuse(f"{key} names {_shown(one)} twice", advice="Name each once.")
        return chosen

    def read_flag(self, key: str, *, default: bool) -> bool:
        """Read true or false."""
        value = self.content.get(key, default)
        if not isinstance(value, bool):
            self.refuse_value(key, advice="Give true or false, without quotes.")
        return value

    def read_integer(self, key: str, *, least: int, most: int, default: int | None = None) -> int:
        """Read an integer within limits."""
        advice = f"Give a whole number from {least} to {most}."
        if key not in self and default is None:
            self.refuse(f"{key} is missing", advice=advice)
        value = self.content.get(key, default)
        if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
            self.refuse_value(key, advice=advice)
        return value

    def read_number(
        self, key: str, *, default: float, above: float = -math.inf, most: float = math.inf
    ) -> float:
        """Read a number above one limit and up to another."""
        value = _number(self.content.get(key, default))
        if value is None or not above < value <= most:
            self.refuse_value(key, advice=f"Give a number{_limits(above, most)}.")
        return value

    def read_range(
        self, key: str, *, default: float, least: float = -math.inf, most: float = math.inf
    ) -> NumberRange:
        """Read a number, or a list of the limits of a range."""
        value = self.content.get(key, default)
        ends = [_number(end) for end in (value if isinstance(value, list) else [value, value])]
        advice = (
            f"Give a number from {least:g} to {most:g}, or a range for random numbers: "
            f"[{least:.1f}, {most:.1f}]."
            if math.isfinite(least)
            else "Give a number, or a range for random numbers: [1.0, 2.0]."
        )
        numbers = [end for end in ends if end is not None and least <= end <= most]
        if len(ends) != 2 or numbers != sorted(numbers) or len(numbers) != len(ends):  # noqa: PLR2004 - the least and the most
            self.refuse_value(key, advice=advice)
        return NumberRange(*numbers)

    def read_tables(self, key: str, *, name: str, known: Sequence[str]) -> tuple["TomlTable", ...]:
        """Read a list of tables.

        Args:
            key: the key.
            name: name between the double brackets in the file.
            known: all keys that each table may have.
        """
        value = self.content.get(key, [])
        if not isinstance(value, list):
            self.refuse_value(key, advice=f"Begin each with a line [[{name}]].")
        return tuple(
            TomlTable(one, where=f"{self.where}, [[{name}]] number {number}", known=known)
            for number, one in enumerate(value, start=1)
        )


def suggest_word(word: str, options: Sequence[str]) -> str:
    """Advice for an unknown word: the option it probably means, or all options."""
    close = get_close_matches(word, options, n=1, cutoff=0.5)
    if close:
        return f"Did you mean {_shown(close[0])}?"
    return f"Choose one of: {', '.join(options)}." if options else "There is none so far."


def _number(value: object) -> float | None:
    """A value as a finite number; None if it is not one, or true or false."""
    if not isinstance(value, int | float) or isinstance(value, bool):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def _limits(above: float, most: float) -> str:
    """The limits of a number, in words."""
    low = f" above {above:g}" if math.isfinite(above) else ""
    high = f"{',' if low else ''} at most {most:g}" if math.isfinite(most) else ""
    return low + high


def _shown(value: object) -> str:
    """A value as JSON, shortened if it is long."""
    text = json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= SHOWN else text[: SHOWN - 1] + "…"
