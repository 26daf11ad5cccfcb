"""Wrong answers in RobotPy made from the right one, and what it takes to run them."""

from places import ROOT

from grader.robotcode import python
from grader.robotcode.bench.simulation import Mount

RIGHT = (ROOT / "solutions" / "exercise4" / "example_subsystem.py").read_text("utf-8")
MOUNTS = {0: Mount(), 1: Mount(backward=True)}  # of exercise 4's own drivetrain


def changed(*changes):
    """The right answer with parts replaced, each of which must be there."""
    text = RIGHT
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return text


def ran(tmp_path, text, **options):
    """The facts of one run of a text."""
    path = tmp_path / "mine.py"
    path.write_text(text, "utf-8")
    return python.run_python(path, "routine", MOUNTS, **options)[0]
