"""Runs a Java program without WPILib: its main method, and what that prints."""

import sys
from pathlib import Path

from grader.robotcode.java.lang import Exited
from grader.robotcode.java.program import Program
from grader.robotcode.java.runtime import STATE, EndlessError, find_attribute
from grader.robotcode.java.syntax import Source
from grader.robotcode.java.values import Array, Throwable, to_string
from grader.robotcode.library.world import WORLD

PYTHON_CALLS = 15_000  # Python calls within calls that DEEPEST calls of Java may need


def allow_deep_calls() -> None:
    """Let Java's own limit of calls within calls come before Python's."""
    sys.setrecursionlimit(max(sys.getrecursionlimit(), PYTHON_CALLS))


def run_main(source: str, *, steps: int = 1_000_000) -> str:
    """What a program's ``Main.main`` prints.

    Args:
        source: the text of one file.
        steps: calls and turns of loops after which it is given up.

    Returns:
        The output; its last line is ``!! java.lang...`` if an exception ended the program, or
        begins with ``!! line`` where javac would refuse it.
    """
    allow_deep_calls()
    WORLD.reset("java")
    program = Program(Path("Main.java"), source=Source(Path("Main.java"), source))
    STATE.refill(steps)
    if not program.problems:
        program.compile_all()
    for one in (*program.problems, *program.errors.values()):
        return f"!! line {one.line}: {one.message}\n"
    main, end = program.unit.classes["Main"], ""
    try:
        main.initialize()
        find_attribute(main.cls, "main").overloads.call(None, [Array([], "String")], ())
    except Exited:
        pass
    except EndlessError as endless:
        end = f"!! {endless}\n"
    except RecursionError:
        end = "!! java.lang.StackOverflowError\n"
    except Throwable as problem:
        end = f"!! {to_string(problem)}\n"
    return "".join(WORLD.singletons.get("output", [])) + end
