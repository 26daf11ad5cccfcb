"""Robot code in, facts out: Java and RobotPy are parsed, never executed.

    file ──source──▶ text ──java | python──▶ ir ──symbol_table──▶ routine ──▶ RoutineFacts

``source`` refuses what is no text, ``java`` and ``python`` bring both languages to the small syntax
of ``ir``, and everything after that is written once: ``symbol_table`` and ``name_resolution`` find
what a name stands for, ``constant_folding`` works out a constant, ``callback_interpreter`` follows
a callback (``statement_interpreter`` and ``transfer_functions`` step by step; ``drive_callback``
and ``log_callback`` note what they are after), ``motors`` knows who follows whom, and ``routine``
collects the facts. Words that change with the season are in
``vocabulary``. What cannot be read, ``bench`` can run: RobotPy only, and only when asked to.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from grader.robotcode.facts import RoutineFacts


def read(path: "Path") -> "RoutineFacts":
    """Read what a robot program says about its SysIdRoutine, without running any of it.

    Constants are looked up in other files of the same language beside it, where it names them.

    Args:
        path: a ``.java`` or ``.py`` file.

    Returns:
        The facts. Code that does not parse gives facts with ``problems``.

    Raises:
        UnreadableFile: it is missing, empty, too large, not text, or neither Java nor Python.
    """
    from grader.robotcode.routine import read_routine_facts  # noqa: PLC0415 - a command's start stays quick

    return read_routine_facts(path)
