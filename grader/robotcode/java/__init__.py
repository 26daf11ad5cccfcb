"""Runs Java robot code: a small interpreter over tree-sitter's tree, with values of its own.

A learner's classes become Python classes, so that they can derive from the fakes of
``grader.robotcode.library``; methods become Python functions of their variables.
"""

from typing import Any


def __getattr__(name: str) -> Any:
    if name != "run_main":  # which costs the import of the parser
        raise AttributeError(name)
    from grader.robotcode.java.run import run_main  # noqa: PLC0415 - only when it is asked for

    return run_main
