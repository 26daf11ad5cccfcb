"""Java text to tree-sitter's tree, and its syntax errors."""

import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from time import thread_time
from typing import Self

import tree_sitter_java
from tree_sitter import Language, Node, Parser

from grader.robotcode.java.brackets import find_unmatched, refuse_garbage
from grader.robotcode.problems import ParseProblem

# On garbage the parser's repairs take time and memory by the square of the length.
FIRST = 1_024  # [bytes] parsed first, then twice as much, and so on
LONGEST = 0.2  # [s of this thread alone: a busy machine must not count] what garbage may take,
SECONDS_PER_BYTE = 3e-6  # and this for its length; Java takes a twentieth

_CLASS = re.compile(r"\b(class|interface|enum|record)\s+\w+[^;:]*\{")
_DECIMAL_COMMA = re.compile(r"(?<=[=(*/+-])\s*\d+,\d+\b")
_PYTHON = re.compile(r"^[ \t]*(def \w+\(.*:|class \w+.*:|from [\w.]+ import .*)$", re.MULTILINE)
# The end of a statement that lacks its semicolon; no header, annotation, comment or condition.
_STATEMENT = re.compile(
    r"\s*(?!@|/|\*|(if|for|while|else|do|try|switch|public|private|protected|class)\b).*[\w)\]\"]"
)
_TEXT = re.compile(r'"[^"]*"')
_COMMENT = {"//", "/*", "*/", "* ", "*"}
_POINT = "a decimal number has a point in Java, not a comma:{}"
_LANGUAGE = Language(tree_sitter_java.language())


class At(int):
    """A line number that knows its file."""

    file: str = ""

    def __new__(cls, line: int, file: str = "") -> Self:
        one = super().__new__(cls, line)
        one.file = file
        return one


@dataclass(frozen=True, eq=False)
class Source:
    """A parsed file.

    Args:
        path: where it is.
        text: the source as it was written, its lines ending as on Unix.
    """

    path: Path
    text: str

    @cached_property
    def root(self) -> Node | None:
        """The tree; None where error recovery would take the parser too long.

        Beginnings of doubling length are parsed first, so that the cost of all is bounded.
        """
        source, length = self.text.replace("\0", " ").encode("utf-8", errors="replace"), FIRST
        while length < len(source):
            if _parse(source[:length]) is None:
                return None
            length *= 2
        return _parse(source)

    def at(self, node: Node) -> At:
        """The file and the line of a node."""
        return At(node.start_point[0] + 1, self.path.name)

    @cached_property
    def problem(self) -> ParseProblem | None:
        """The first thing that is not Java; None if all is."""
        refuse_garbage(self.text, where=self.path.name)
        if self.root is None:
            return find_unmatched(self.text) or ParseProblem("most of this is not Java", 1)
        return _find_problem(self.root, self.text) if self.root.has_error else None


def _parse(source: bytes) -> Node | None:
    start = thread_time()
    root = Parser(_LANGUAGE).parse(source).root_node
    late = thread_time() - start > LONGEST + len(source) * SECONDS_PER_BYTE
    return None if late else root


def _find_problem(root: Node, text: str) -> ParseProblem:
    found = find_unmatched(text) or _find_no_class(text)
    if found is not None:
        return found
    tree = root
    while not (tree.is_missing or tree.is_error):
        tree = next(one for one in tree.children if one.has_error or one.is_missing)
    row = tree.start_point[0]
    if tree.is_missing:
        return ParseProblem(f"a '{tree.type}' is missing", _find_code_line(text, row))
    comma = _DECIMAL_COMMA.search(text.split("\n")[row])
    said = _POINT.format(comma[0]) if comma else _describe_misreading((tree.text or b"").decode())
    return _find_no_semicolon(text, *tree.start_point) or ParseProblem(said, row + 1)


def _find_code_line(text: str, row: int) -> int:
    """The line (from 1) of the last code at or before a row (from 0), without comments."""
    lines = [line.strip() for line in text.split("\n")[: row + 1]]
    code = (at for at in range(row, -1, -1) if lines[at] and lines[at][:2] not in _COMMENT)
    return next(code, row) + 1


def _find_no_semicolon(text: str, row: int, column: int) -> ParseProblem | None:
    """The statement before an error, if the error begins a line and that statement has no end."""
    lines = text.split("\n")
    if lines[row][:column].strip() or not lines[row][column : column + 1].isidentifier():
        return None
    above = [_TEXT.sub('""', line).partition("//")[0].rstrip() for line in lines[:row]]
    code = "".join(above)
    number = next((at for at in range(row, 0, -1) if above[at - 1]), 0)
    within = code.count("(") > code.count(")")  # there, a comma or an operator is missing
    if within or not number or not _STATEMENT.fullmatch(above[number - 1]):
        return None
    return ParseProblem("a ';' is missing at the end of this line", number)


def _find_no_class(text: str) -> ParseProblem | None:
    """What to say of a text that never was Java: a letter, a page, another language."""
    if _CLASS.search(text):
        return None
    first = next((at for at, line in enumerate(text.split("\n"), 1) if line.strip()), 1)
    said = "this is Python, and a .java file must contain Java"
    if not _PYTHON.search(text):
        said = _describe_misreading(text.split("\n")[first - 1])
    return ParseProblem(said, first)


def _describe_misreading(text: str) -> str:
    shown = " ".join(text[:200].split())[:40]
    return f"this is not Java: {shown}" if shown else "something is missing here"
