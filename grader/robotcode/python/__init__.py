"""RobotPy text to the common syntax, with Python's own parser."""

import ast
import re
import warnings
from pathlib import Path

from grader.robotcode import ir
from grader.robotcode.facts import ParseProblem
from grader.robotcode.python.expressions import EXPRESSIONS
from grader.robotcode.python.statements import STATEMENTS
from grader.robotcode.python.to_ir import IrBuilder

_JAVA = re.compile(r"^[ \t]*(package [\w.]+;|import [\w.]+;|public class )", re.MULTILINE)


def parse(text: str, path: Path) -> ir.Module:
    r"""Bring a Python file to the common syntax.

    Args:
        text: the source, with ``\n`` line ends.
        path: where it is.

    Returns:
        The module. A text that is not Python gives one without a body, and one problem.
    """
    source = text.encode("utf-8", errors="replace")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a doubtful escape is the learner's own affair
            tree = ast.parse(text)
    except SyntaxError as error:
        said = f"this is not Python: {error.msg.partition(';')[0]}"
        if _JAVA.search(text):
            said = "this is Java, and a .py file must contain Python"
        problem = ParseProblem(said, max(error.lineno or 1, 1))
    except (RecursionError, MemoryError, ValueError):
        problem = ParseProblem("the code is nested deeper than Python itself can read", 1)
    else:
        lowering = IrBuilder(source, EXPRESSIONS | STATEMENTS)
        body = lowering.lower(tree)
        return ir.Module(path, "python", source, body, tuple(reversed(lowering.imports)))
    return ir.Module(path, "python", source, (), problems=(problem,))
