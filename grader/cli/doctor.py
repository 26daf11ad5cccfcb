"""``grade doctor``."""

from pathlib import Path

import click

from grader.course.progress import find_course
from grader.feedback.terminal import StyledText, print_lines, wrap_text
from grader.setup.doctor import examine_machine
from sim.support.command_line import DONE, NOT_RIGHT


@click.command()
def doctor() -> int:
    """Check what is installed on this computer, and what is missing.

    It also says which parts of the course need the missing programs.

    Exit codes: 0 everything needed is there, 1 something needed is missing.
    """
    bad = False
    for one in examine_machine(find_course(Path.cwd())):
        mark, style = ("✓", "green") if one.right else ("✗", "red") if one.needed else ("–", "dim")
        rows = wrap_text(one.found, lead=f"  {one.what:<16}")
        rows[0] = (StyledText(f"{mark} ", style), StyledText(f"{one.what:<16}"), *rows[0][1:])
        print_lines(rows)
        if not one.right:
            print_lines(wrap_text(one.advice, lead="    ", style="cyan"))
        bad = bad or (one.needed and not one.right)
    return NOT_RIGHT if bad else DONE
