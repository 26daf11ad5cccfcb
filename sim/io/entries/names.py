"""Names of entries: split as SysId's loggers write them, or chosen by the user.

Loggers put a path before a name (``NT:/``, ``/Robot/``). Some files hold the same entry with a path
and without.
"""

import re
from collections.abc import Collection, Sequence
from difflib import get_close_matches
from typing import NamedTuple

from sim.core.advice import Action
from sim.core.errors import MissingSignal
from sim.core.vocabulary import DIRECTIONS, KINDS, TESTS
from sim.io.entries.entry import Entry
from sim.support.printable import list_first

_SAME = {
    "slow": "quasistatic",
    "fast": "dynamic",
    "backward": "reverse",
    "backwards": "reverse",
    "forwards": "forward",
}


class EntryName(NamedTuple):
    """The name of an entry, split: ``NT:/`` + ``voltage`` + ``-`` + ``left-Drive``."""

    path: str
    rest: str


def split_name(name: str, word: str) -> EntryName | None:
    """The parts of a name before and after ``word-``; None if the name does not contain it so."""
    found = re.fullmatch(rf"((?:.*?[/:])??){re.escape(word)}-(.*)", name, re.DOTALL)
    return EntryName(*found.groups()) if found else None


def split_words(name: str) -> list[str]:
    """The words of a name, lower case: ``DriveVelocityRadPerSec`` is drive velocity rad per sec."""
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+", name)]


def find_test_name(text: str, *, fillers: Collection[str] | None = None) -> str:
    """The test that a text names in any spelling: ``State.kQuasistaticForward``, ``slow backward``.

    Args:
        text: the text, with its words in any order.
        fillers: other words that are allowed; None allows any.

    Returns:
        One of ``TESTS``; empty if the text names none, or several.
    """
    words = [_SAME.get(word, word) for word in split_words(text)]
    kinds, ways = set(KINDS).intersection(words), set(DIRECTIONS).intersection(words)
    if len(kinds) != 1 or len(ways) != 1:
        return ""
    if fillers is not None and not set(words) <= {*kinds, *ways, *fillers}:
        return ""
    test = f"{kinds.pop()}-{ways.pop()}"
    return test if test in TESTS else ""


def split_unit(name: str) -> tuple[str, str]:
    """A name without the unit in brackets at its end, and that unit: ``velocity (m/s)``."""
    found = re.fullmatch(r"(.*?\S)\s*[(\[]([^()\[\]]+)[)\]]\s*", name, re.DOTALL)
    return (found[1], found[2].strip()) if found else (name, "")


def find_type_in_name(mechanism: str) -> str:
    """``elevator`` or ``arm`` if one of them is a word of a mechanism's name; else empty.

    ``left-Elevator``, ``ElevatorSubsystem`` and ``ARM_1`` contain one, ``alarm`` does not.
    """
    types = {"elevator", "arm"}.intersection(split_words(mechanism))
    return types.pop() if len(types) == 1 else ""


def find_requested_entry(
    name: str, *, role: str, kinds: Collection[str], entries: Sequence[Entry], where: str
) -> Entry:
    """The entry that the user chose for a signal.

    Raises:
        MissingSignal: there is no entry of this name, or it is empty or of an unsuitable type.
    """
    same = [entry for entry in entries if entry.name == name]
    usable = [entry for entry in same if entry.type in kinds and len(entry)]
    if usable:
        return max(usable, key=len)
    if same:
        raise MissingSignal(
            f"the {role} entry {name!r} {explain_unfit_entry(same[0], kinds=kinds)}",
            where=where,
            advice=Action("entry-type", (" or ".join(kinds), f"--{role}")),
        )
    near = get_close_matches(name, [entry.name for entry in entries], cutoff=0.5)
    raise MissingSignal(
        f"there is no entry {name!r} to take {role} from",
        where=where,
        advice=f"Did you mean {quote_names(near)}?"
        if near
        else f"Give --{role} a name as AdvantageScope shows it, with its whole path.",
    )


def explain_unfit_entry(entry: Entry, *, kinds: Collection[str]) -> str:
    """Why an entry cannot be used for a signal."""
    if entry.type in kinds:
        return "holds no values"
    return f"is of type {entry.type}, which cannot be used here"


def quote_names(names: Sequence[str]) -> str:
    """The first few names, in quotes, for a message."""
    return list_first([repr(name) for name in names])


def number_names(names: Sequence[str]) -> str:
    """Numbered names to choose from, for a message: ``1 'Arm', 2 'Elevator'``."""
    return ", ".join(f"{number} {name!r}" for number, name in enumerate(names, start=1))
