"""Mutation operators on an answers.toml: wrong numbers, units, choices, lists and keys."""

import math
import re
from collections.abc import Iterator
from itertools import pairwise

FACTORS = {  # what a number may be off by -> why
    "minutes": 60.0,
    "turns": 2.0 * math.pi,
    "duty-cycle": 1.0 / 12.0,
    "degrees": 180.0 / math.pi,
    "milli": 1000.0,
    "gear-ratio": 6.75,
    "quarter-more": 1.25,
}
ENTRY = re.compile(r"^(?P<name>\w+) = (?P<value>[^#\n]*?)(?P<end>\s*(?:#.*)?)$")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
WORD = re.compile(r'"([^"]*)"')
TABLE = re.compile(r"^\[\[?(\w+)")

Change = tuple[str, int, str]  # the operator, the changed line from 1, the whole changed text


def changes_of(text: str) -> Iterator[Change]:
    """Return every mutant of an answer file: operator, line and text, each text once."""
    seen = {text}
    lines = text.splitlines(keepends=True)
    words = sorted({word for line in lines for word in _words(line)})
    for at, line in enumerate(lines):
        for operator, new in _line_changes(line, words):
            changed = "".join((*lines[:at], new, *lines[at + 1 :]))
            if changed not in seen:
                seen.add(changed)
                yield operator, at + 1, changed
    for operator, at, changed in _swaps(lines):
        if changed not in seen:
            seen.add(changed)
            yield operator, at, changed


def _words(line: str) -> list[str]:
    found = ENTRY.match(line.rstrip("\n"))
    return WORD.findall(found["value"]) if found else []


def _line_changes(line: str, words: list[str]) -> Iterator[tuple[str, str]]:
    found = ENTRY.match(line.rstrip("\n"))
    if found is None or found["value"].strip() in {"", '""', "[", "[]", "{"}:
        return
    name, value, end = found["name"], found["value"], found["end"]

    def put(new: str) -> str:
        return f"{name} = {new}{end}\n"

    yield "drop-key", f"# {line}"
    yield "misspell-key", line.replace(name, f"{name}_", 1)
    yield "empty", put('""')
    if NUMBER.fullmatch(value):
        yield from ((operator, put(new)) for operator, new in _numbers(value))
    elif value.startswith("["):
        yield from ((operator, put(new)) for operator, new in _lists(value))
    elif WORD.fullmatch(value):
        yield from ((operator, put(new)) for operator, new in _choices(value, words))
    elif value in {"true", "false"}:
        yield "other-choice", put("false" if value == "true" else "true")


def _numbers(value: str) -> Iterator[tuple[str, str]]:
    number = float(value)
    yield "negate", f"{-number:.8g}"
    yield "word-for-number", '"about right"'
    yield "list-for-number", f"[{value}]"
    yield "other-dimension", f'"{value} kg"'
    yield "not-a-number", "nan"
    for name, factor in FACTORS.items():
        yield f"times-{name}", f"{number * factor:.8g}"
        yield f"over-{name}", f"{number / factor:.8g}"


def _choices(value: str, words: list[str]) -> Iterator[tuple[str, str]]:
    own = WORD.findall(value)[0]
    yield "misspell-choice", f'"{own}x"'
    yield "number-for-choice", "3"
    for other in words:
        if other != own:
            yield "other-choice", f'"{other}"'


def _lists(value: str) -> Iterator[tuple[str, str]]:
    parts = [part.strip() for part in value.strip()[1:-1].split(",") if part.strip()]
    if "[" in value[1:] or "{" in value or len(parts) == 0:
        return
    yield "empty-list", "[]"
    for at in range(len(parts)):
        yield "drop-from-list", f"[{', '.join(parts[:at] + parts[at + 1 :])}]"
    yield "reverse-list", f"[{', '.join(reversed(parts))}]"
    if all(NUMBER.fullmatch(part) for part in parts):
        for shift in (-3.0, 3.0):
            moved = (f"{float(part) + shift:.6g}" for part in parts)
            yield "shift-interval", f"[{', '.join(moved)}]"
    else:
        more = ", ".join((*parts, '"gremlins"'))
        yield "add-unknown-to-list", f"[{more}]"


def _swaps(lines: list[str]) -> Iterator[Change]:
    """Exchange the values of two entries that stand next to each other, of one kind each."""
    entries = [
        (at, found) for at, line in enumerate(lines) if (found := ENTRY.match(line.rstrip("\n")))
    ]
    for (one, first), (other, second) in pairwise(entries):
        if any(TABLE.match(line) for line in lines[one:other]):
            continue
        values = first["value"], second["value"]
        if values[0] == values[1] or not all(NUMBER.fullmatch(value) for value in values):
            continue
        changed = list(lines)
        changed[one] = f"{first['name']} = {values[1]}{first['end']}\n"
        changed[other] = f"{second['name']} = {values[0]}{second['end']}\n"
        yield "swap-numbers", one + 1, "".join(changed)
