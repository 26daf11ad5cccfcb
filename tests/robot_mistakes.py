"""Wrong answers in RobotPy made from the right one, and what it takes to run them."""

from pathlib import Path

import pytest

from grader.robotcode import bench

ROOT = Path(__file__).resolve().parents[1]
RIGHT = (ROOT / "solutions" / "exercise4" / "example_subsystem.py").read_text("utf-8")


def needs_robot(test):
    """Skip a test, with the reason, where RobotPy is not installed."""
    reason = "RobotPy (extra `robot`) is not installed"
    return pytest.mark.robot(
        pytest.mark.skipif(not bench.is_robotpy_installed(), reason=reason)(test)
    )


def changed(*changes):
    """The right answer with parts replaced, each of which must be there."""
    text = RIGHT
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return text


def ran(tmp_path, text, *, seconds=bench.SECONDS, name="ExampleSubsystem"):
    path = tmp_path / "mine.py"
    path.write_text(text, "utf-8")
    return bench.run_sysid_routine(path, name, seconds=seconds)
