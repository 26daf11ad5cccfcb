"""The comments of a file, which its syntax tree leaves out, and those that belong to a line."""

import functools
import io
import re
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass

JAVA_TOKEN = re.compile(
    r"(?P<comment>//[^\n]*|/\*(?:.*?\*/|.*))"
    r'|"""(?:\\.|[^\\])*?(?:"""|\Z)'
    r'|(?P<quoted>"(?:\\.|[^"\\\n])*(?P<end>")?)'
    r"|'(?:\\.|[^'\\\n])*'?"
    r"|->|\w+|[^\s\w]",
    re.DOTALL,
)


@dataclass(frozen=True)
class Comment:
    """One comment.

    Args:
        first, last: its lines, from 1.
        alone: whether nothing but the comment stands on them.
        text: what it says, without its signs.
    """

    first: int
    last: int
    alone: bool
    text: str


@functools.lru_cache(maxsize=8)
def list_comments(text: str, language: str) -> tuple[Comment, ...]:
    """All comments of a file, in order."""
    return tuple(_in_java(text) if language == "java" else _in_python(text))


def _in_java(text: str) -> Iterator[Comment]:
    for match in JAVA_TOKEN.finditer(text):
        if match["comment"] is None:
            continue
        first = text.count("\n", 0, match.start()) + 1
        before = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
        said = re.sub(r"^\s*(//+|/\*+|\*+(?!/))|\*/\s*$", "", match.group(), flags=re.MULTILINE)
        last = first + match.group().count("\n")
        yield Comment(first, last, not before.strip(), " ".join(said.split()))


def _in_python(text: str) -> Iterator[Comment]:
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                line, column = token.start
                alone = not token.line[:column].strip()
                yield Comment(line, line, alone, token.string.lstrip("# ").strip())
    except (tokenize.TokenError, SyntaxError):
        return  # what does not parse has been said before


def find_comments_near(found: tuple[Comment, ...], first: int, last: int) -> str:
    """The comments on some lines, and the block of comments directly above them."""
    said = [one.text for one in found if first <= one.first <= last]
    top = first
    for one in reversed(found):
        if one.alone and one.last == top - 1:
            said.insert(0, one.text)
            top = one.first
    return " ".join(said)
