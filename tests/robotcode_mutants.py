"""Java robot code, damaged: lines, tokens and bytes lost, repeated, swapped and mixed.

The same number gives the same mutant as long as the corpus stays as it is.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from places import ROOT
from robot_corpus import whole_corpus

FOLDERS = (*sorted((ROOT / "solutions").glob("exercise*")), whole_corpus())
MOST_CHANGES = 4
LONGEST = 60  # pieces that one change takes, repeats or moves
BRACKETS = [b"(", b")", b"{", b"}", b"[", b"]", b"<", b">", b'"', b"'", b'"""', b"/*", b"*/", b"\\"]
WORDS = [  # what turns up where nobody expects it
    *(b"null", b"None", b"this", b"self", b"super", b"new ", b"->", b"::", b"lambda: ", b":="),
    *(b"\0", b"\xff", b"\xef\xbb\xbf", b"\r", b"\x0c", b"\t", "\u2028".encode(), "电压".encode()),
    *(b"0x", b"1e999", b"9" * 400, b".", b"...", b"@", b"#", b"//", b"\\u007b", b"\n    "),
    *(b"((" * 60, b"{" * 60, b"x." * 300, b"-" * 3000, b"f(" * 90, b"a<" * 40, b"!;" * 500),
]
NUMBERS = [  # in place of another: zero to divide by, too large, and none at all
    *(b"0", b"0.0", b"-1", b"1e999", b"1e-999", b"0x", b"0xFp3", b"09", b"0b2", b"1_000", b"5."),
    *(b".5f", b"2147483648", b"9" * 400, b"3L", b"1j", b"'5'", b"Double.NaN", b"(1 / 0)"),
]
_NUMBER = re.compile(rb"(?<![\w.])\d[\w.]*")
_PAIR = re.compile(rb"\([^()]*\)|\{[^{}]*\}|\[[^\[\]]*\]")
_WORD = re.compile(rb"\b\w+\b")
_WHOLE = re.compile(rb".*[;)\w]")  # a line that may be a statement
_PAIRS = ((b"(", b")"), (b"[", b"]"), (b"{", b"}"))
_TOKEN = re.compile(rb"\w+|\s+|[^\w\s]")

Pieces = list[bytes]


@dataclass(frozen=True)
class Mutant:
    """A damaged file.

    Args:
        source: the file it was made of.
        content: what is in it now.
        how: the changes, in words.
    """

    source: Path
    content: bytes
    how: str


def sources() -> list[Path]:
    """The sound and broken Java files that mutants are made of."""
    found = (path for folder in FOLDERS for path in sorted(folder.rglob("*")))
    return [path for path in found if path.suffix == ".java"]


def mutant(number: int, files: Sequence[Path]) -> Mutant:
    """The mutant of a number."""
    rng = np.random.default_rng(number)
    source = files[number % len(files)]
    content, how = source.read_bytes(), []
    for _ in range(min(int(rng.geometric(0.5)), MOST_CHANGES)):
        kinds = [*CHANGES, *KEEPING * 3]  # what keeps the syntax leads deepest into the reader
        name = kinds[rng.integers(len(kinds))]
        other = files[rng.integers(len(files))].read_bytes()
        content = CHANGES[name](content, other, rng)
        how.append(name)
    return Mutant(source, content, ", ".join(how))


def _stretch(pieces: Pieces, rng: np.random.Generator) -> slice:
    at = int(rng.integers(len(pieces) + 1))
    return slice(at, at + int(rng.integers(1, min(LONGEST, len(pieces) + 1) + 1)))


def _delete(pieces: Pieces, rng: np.random.Generator) -> Pieces:
    gone = _stretch(pieces, rng)
    return pieces[: gone.start] + pieces[gone.stop :]


def _duplicate(pieces: Pieces, rng: np.random.Generator) -> Pieces:
    twice = _stretch(pieces, rng)
    return pieces[: twice.stop] + pieces[twice.start :]


def _swap(pieces: Pieces, rng: np.random.Generator) -> Pieces:
    if len(pieces) > 1:
        one, other = rng.integers(len(pieces), size=2)
        pieces[one], pieces[other] = pieces[other], pieces[one]
    return pieces


def _move(pieces: Pieces, rng: np.random.Generator) -> Pieces:
    taken = _stretch(pieces, rng)
    rest = pieces[: taken.start] + pieces[taken.stop :]
    to = int(rng.integers(len(rest) + 1))
    return rest[:to] + pieces[taken] + rest[to:]


def _inserted(content: bytes, what: bytes, rng: np.random.Generator) -> bytes:
    at = int(rng.integers(len(content) + 1))
    return content[:at] + what + content[at:]


def _bracket(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
    """One more bracket or quote, or one less."""
    sign = BRACKETS[rng.integers(len(BRACKETS))]
    places = [match.start() for match in re.finditer(re.escape(sign), content)]
    if places and rng.random() < 0.5:
        at = places[rng.integers(len(places))]
        return content[:at] + content[at + len(sign) :]
    return _inserted(content, sign, rng)


def _word(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
    return _inserted(content, WORDS[rng.integers(len(WORDS))], rng)


def _noise(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
    changed = bytearray(content)
    for at in rng.integers(len(content), size=min(len(content), 3)) if content else ():
        changed[at] = rng.integers(256)
    return bytes(changed)


def _cut(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
    """Half a file."""
    return content[: rng.integers(len(content) + 1)]


def _splice(content: bytes, other: bytes, rng: np.random.Generator) -> bytes:
    """The beginning of one file, the end of another."""
    at, to = rng.integers(len(content) + 1), rng.integers(len(other) + 1)
    return content[:at] + other[to:]


def _graft(content: bytes, other: bytes, rng: np.random.Generator) -> bytes:
    """Some lines of another file in the middle of this one."""
    lines = other.splitlines(keepends=True)
    return _inserted(content, b"".join(lines[_stretch(lines, rng)]), rng)


def _exchange(content: bytes, other: bytes, rng: np.random.Generator) -> bytes:
    """One word in the place of another: what still parses, and means something else."""
    words = _WORD.findall(content if rng.random() < 0.7 else other) or [b"it"]
    return _replaced(content, _WORD, words, rng)


def _rename(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
    """All that has one name gets the name of something else."""
    words = sorted(set(_WORD.findall(content)))
    if not words:
        return content
    old, new = (words[at] for at in rng.integers(len(words), size=2))
    return re.sub(rb"\b" + re.escape(old) + rb"\b", lambda _: new, content)


def _number(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
    """An odd number in the place of another."""
    return _replaced(content, _NUMBER, NUMBERS, rng)


def _hollow(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
    """A pair of brackets emptied, or gone with all that is in it."""
    return _replaced(content, _PAIR, [b"()", b"{}", b"[]", b"", b";", b"(,)"], rng)


def _replaced(
    content: bytes, form: re.Pattern[bytes], words: Sequence[bytes], rng: np.random.Generator
) -> bytes:
    places = list(form.finditer(content))
    if not places:
        return content
    place = places[rng.integers(len(places))]
    return content[: place.start()] + words[rng.integers(len(words))] + content[place.end() :]


def _statement(content: bytes, other: bytes, rng: np.random.Generator) -> bytes:
    """A whole line, of this file or of another, at a line that is indented as much."""
    lines = content.splitlines(keepends=True)
    given = [
        line
        for line in (other if rng.random() < 0.3 else content).splitlines(keepends=True)
        if _WHOLE.fullmatch(line.rstrip())
        and all(line.count(o) == line.count(c) for o, c in _PAIRS)
    ]
    if not given:
        return content
    line = given[rng.integers(len(given))]
    fits = [at for at, here in enumerate(lines) if _indented(here) == _indented(line)]
    if not fits:
        return content
    at = fits[rng.integers(len(fits))]
    return b"".join([*lines[:at], line, *lines[at + int(rng.integers(2)) :]])


def _indented(line: bytes) -> int:
    return len(line) - len(line.lstrip())


def _by(split: Callable[[bytes], Pieces], change: Callable[..., Pieces]) -> Callable[..., bytes]:
    def changed(content: bytes, _other: bytes, rng: np.random.Generator) -> bytes:
        return b"".join(change(split(content), rng))

    return changed


def _lines(content: bytes) -> Pieces:
    return content.splitlines(keepends=True)


def _bytes(content: bytes) -> Pieces:
    return [content[at : at + 1] for at in range(len(content))]


CHANGES: dict[str, Callable[..., bytes]] = {
    f"{change.__name__.strip('_')} {split.__name__.strip('_')}": _by(split, change)
    for change in (_delete, _duplicate, _swap, _move)
    for split in (_lines, _TOKEN.findall, _bytes)
} | {
    one.__name__.strip("_"): one
    for one in (
        *(_bracket, _word, _noise, _cut, _splice, _graft),
        *(_exchange, _rename, _statement, _number, _hollow),
    )
}
KEEPING = ["exchange", "rename", "statement", "number", "hollow"]
