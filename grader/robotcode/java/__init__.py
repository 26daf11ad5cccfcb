"""Java text to the common syntax, with tree-sitter: it reads what is sound around a mistake."""

import re
from pathlib import Path

import tree_sitter_java
from tree_sitter import Language, Parser
from tree_sitter import Node as Tree

from grader.robotcode import syntax
from grader.robotcode.facts import Problem
from grader.robotcode.java.brackets import refuse_deep_nesting, unmatched
from grader.robotcode.java.declarations import DECLARATIONS
from grader.robotcode.java.expressions import EXPRESSIONS
from grader.robotcode.java.lowering import Lowering, said

MOST_PROBLEMS = 5  # one mistake makes many; the first ones tell

_LANGUAGE = Language(tree_sitter_java.language())


def parse(text: str, path: Path) -> syntax.Module:
    r"""Bring a Java file to the common syntax.

    Args:
        text: the source, with ``\n`` line ends.
        path: where it is.

    Returns:
        The module; its ``problems`` say where the text is not Java.

    Raises:
        UnreadableFile: nested deeper than any robot code.
    """
    refuse_deep_nesting(text, where=path.name)
    source = text.encode("utf-8", errors="replace")
    root = Parser(_LANGUAGE).parse(source).root_node
    body = Lowering(source, EXPRESSIONS | DECLARATIONS).lower(root)
    headers = [
        child
        for child in root.children
        if child.type in {"import_declaration", "package_declaration"}
    ]
    package = next((said(h) for h in headers if h.type == "package_declaration"), "")
    return syntax.Module(
        path,
        "java",
        source,
        body,
        imports=tuple(_import(said(h)) for h in headers if h.type == "import_declaration"),
        package=re.sub(r"package|[\s;]", "", package),
        problems=_problems(root, text) if root.has_error else (),
    )


def _import(line: str) -> syntax.Import:
    path = re.sub(r"\bimport\b|\bstatic\b|[\s;]", "", line)
    if path.endswith(".*"):
        return syntax.Import("*", path[:-2])
    return syntax.Import(path.rpartition(".")[2], path)


def _problems(root: Tree, text: str) -> tuple[Problem, ...]:
    """What is not Java, the cause before its echoes."""
    bracket = unmatched(text)
    found = [] if bracket is None else [bracket]
    waiting = [root]
    while waiting and len(found) < MOST_PROBLEMS:
        tree = waiting.pop()
        if tree.is_missing and bracket is not None and tree.type in "()[]{}":
            continue  # the parser's repair of the same mistake, farther from its cause
        if tree.is_missing:
            found.append(Problem(f"a '{tree.type}' is missing", tree.start_point[0] + 1))
        elif tree.is_error:
            found.append(Problem(_misread(tree), tree.start_point[0] + 1))
        elif tree.has_error:
            waiting.extend(reversed(tree.children))
    return tuple(dict.fromkeys(found))


def _misread(tree: Tree) -> str:
    shown = " ".join(said(tree)[:200].split())[:40]
    return f"this is not Java: {shown}" if shown else "something is missing here"
