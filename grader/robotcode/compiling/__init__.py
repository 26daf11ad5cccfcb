"""Mistakes for which a compiler would stop: names that nothing declares, types that do not fit.

No compiler is at hand: Java is read with tree-sitter, and Python with ``ast``. So only what cannot
be right is reported, and code that leans on classes out of sight is left alone.
"""

from grader.robotcode.facts import ParseProblem
from grader.robotcode.symbol_table import SymbolTable


def find_compile_errors(names: SymbolTable) -> tuple[ParseProblem, ...]:
    """What keeps a program from being compiled, or in Python from being run, in the order of lines.

    Args:
        names: the names of the program; its main file is looked at.

    Returns:
        One problem a line; none where nothing was found, which is no proof that it compiles.
    """
    if names.main.problems:
        return ()
    if names.main.language == "python":
        from grader.robotcode.compiling.python import find_python_errors  # noqa: PLC0415 - no ast for Java

        found = find_python_errors(names)
    else:
        from grader.robotcode.compiling.java import find_java_errors as find_java_errors  # noqa: PLC0415 - the same

        found = find_java_errors(names)
    by_line = {one.line: one for one in sorted(found, key=lambda one: -one.line)}
    return tuple(by_line[line] for line in sorted(by_line))
