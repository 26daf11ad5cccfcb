"""Make the file that a learner starts from: the solution with its answers taken out.

In a solution an answer stands between two comments, in Python or in Java::

    # --- answer: give the routine its three numbers
    config = SysIdRoutine.Config(0.5, 3.5, 10.0)
    # --- end

becomes ``# TODO: give the routine its three numbers``.
"""

import re

ANSWER = re.compile(
    r"^(?P<margin>[ \t]*)(?P<mark>#|//) --- answer: (?P<task>[^\n]+)\n"
    r"(?P<more>(?:[ \t]*(?:#|//) ---   [^\n]+\n)*)"
    r".*?"
    r"^[ \t]*(?:#|//) --- end[^\n]*\n",
    re.MULTILINE | re.DOTALL,
)


def remove_answers(solution: str) -> str:
    """Remove the answers from a solution, and leave the tasks in their place.

    A task may go on over several lines, each under ``# ---   ``.
    """
    return ANSWER.sub(_write_to_do, solution)


def _write_to_do(answer: re.Match[str]) -> str:
    margin, mark = answer["margin"], answer["mark"]
    more = re.sub(
        r"^[ \t]*(?:#|//) ---   ", f"{margin}{mark}       ", answer["more"], flags=re.MULTILINE
    )
    return f"{margin}{mark} TODO: {answer['task']}\n{more}"
