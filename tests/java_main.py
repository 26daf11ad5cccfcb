"""Runs a Java program without WPILib: its main method, and what that prints."""

from pathlib import Path

from grader.robotcode.java import text
from grader.robotcode.java.lang import Exited, PrintStream
from grader.robotcode.java.program import Program
from grader.robotcode.java.runtime import STATE, EndlessError, find_attribute
from grader.robotcode.java.steps import allow_deep_calls
from grader.robotcode.java.syntax import Source
from grader.robotcode.java.values import Array, Throwable, to_string
from grader.robotcode.library.base import JAVA
from grader.robotcode.library.world import WORLD

PRINTED: list[str] = []  # by the program that runs


def print_value(stream, value=""):
    """System.out.print: the interpreter itself lets a program's output go."""
    if stream is JAVA["java.lang.System"].out:
        PRINTED.append(str(to_string(value)))


def print_line(stream, value=""):
    """System.out.println."""
    print_value(stream, value)
    print_value(stream, "\n")


PrintStream.print, PrintStream.println = print_value, print_line
PrintStream.printf = PrintStream.format = lambda self, pattern, *args: print_value(
    self, text.format(pattern, args)
)


def run_main(source, *, steps=1_000_000):
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
    program.compile_all()
    for one in program.errors.values():
        return f"!! line {one.line}: {one.message}\n"
    PRINTED.clear()
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
    return "".join(PRINTED) + end
