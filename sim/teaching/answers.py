"""Answers that a lesson's code must not show: those of its questions, and the hidden effects.

They stand in ``lesson_answers.toml`` by names like ``lesson9.ka``, and a cell holds only the name.
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from sim.bench.mechanism import Mechanism
from sim.core.errors import BadRequest

FILE = Path(__file__).with_name("lesson_answers.toml")


def read_answer(name: str) -> Any:  # noqa: ANN401 - as TOML has it
    """What stands under a name, such as the arguments of a question.

    Raises:
        BadRequest: there is no such name.
    """
    found: Any = _read_file()
    for key in name.split("."):
        if not (isinstance(found, Mapping) and key in found):
            raise BadRequest(
                f"no answer is called {name!r}", advice=f"Write it into {FILE.name}, or correct it."
            )
        found = found[key]
    return found


def hide_effects(mechanism: Mechanism, name: str) -> Mechanism:
    """A mechanism with the hidden effects that stand under a name: effect -> size."""
    for effect, size in read_answer(name).items():
        mechanism = mechanism.hide(effect, size)
    return mechanism


@cache
def _read_file() -> dict[str, Any]:
    return tomllib.loads(FILE.read_text(encoding="utf-8"))
