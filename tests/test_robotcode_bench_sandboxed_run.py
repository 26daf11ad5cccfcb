"""RobotPy code is run shut in: tricks from inside a submission reach nothing and stop nothing.

The sandbox itself is tested in ``test_isolation.py``.
"""

import socket
import sys
import time

import pytest
from robot_mistakes import MOUNTS, changed

from grader.isolation import find_isolation_level
from grader.isolation import sandbox_parent as isolation
from grader.robotcode import python
from grader.robotcode.bench.facts import Outcome
from grader.robotcode.python.sandbox_files import MOST, copy_program

pytestmark = pytest.mark.slow

LEVEL = find_isolation_level()
NO_ISOLATION = "" if LEVEL.startswith("isolated") else f"this system is {LEVEL}"
isolated = pytest.mark.skipif(bool(NO_ISOLATION), reason=NO_ISOLATION or "isolated")
posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such call")
KEY = "the key is 42"
SEND = "self.left.setVoltage(voltage)"


@pytest.fixture
def tried(tmp_path, monkeypatch):
    """Runs the right answer with a trick before it sends its first voltage."""
    monkeypatch.setattr(python, "refuse_tampering", lambda _: None)

    def run(trick, *, seconds=python.SECONDS):
        folder = tmp_path / "theirs"
        folder.mkdir(exist_ok=True)
        path = folder / "mine.py"
        path.write_text(changed((SEND, f"import trick; {SEND}")), "utf-8")
        (folder / "trick.py").write_text(trick, "utf-8")
        return python.run_python(path, "routine", MOUNTS, seconds=seconds)[0]

    return run


def goes_on(run):
    """Whether a run came to its end, and shows what the program did."""
    return run.stop is None and (run.ramp.value, run.step.value) == (0.5, 3.5)


def quietly(statement):
    """A trick that goes on as if nothing had been, if it is refused."""
    return (
        f"try:\n    {statement}\nexcept OSError:\n    pass\nelse:\n    raise KeyError('REACHED')\n"
    )


@isolated
@pytest.mark.parametrize(
    "statement",
    [
        pytest.param("open({key!r}).read()", id="reading a key"),
        pytest.param("open({folder!r} + '/planted', 'w')", id="writing outside"),
        pytest.param("import os; os.fork()", id="a fork"),
        pytest.param("import socket; socket.create_connection(('127.0.0.1', {port}))", id="TCP"),
    ],
)
def test_forbidden_call_is_refused_and_the_run_stays_the_same(tried, tmp_path, statement):
    (tmp_path / "key.txt").write_text(KEY, "utf-8")
    with socket.create_server(("127.0.0.1", 0)) as server:
        names = {
            "key": str(tmp_path / "key.txt"),
            "folder": str(tmp_path),
            "port": server.getsockname()[1],
        }
        run = tried(quietly(statement.format(**names)))

    assert goes_on(run), run.stop
    assert not (tmp_path / "planted").exists()


def test_forbidden_calls_succeed_without_the_sandbox(tried, tmp_path, monkeypatch):
    (tmp_path / "key.txt").write_text(KEY, "utf-8")
    monkeypatch.setattr(isolation, "CONFINED", False)
    run = tried(quietly(f"open({str(tmp_path / 'key.txt')!r}).read()"))

    assert "REACHED" in run.stop.said


@posix
@pytest.mark.parametrize(
    ("trick", "outcome"),
    [
        pytest.param("import os; os._exit(0)", Outcome.CRASHED, id="a sudden end"),
        pytest.param(
            "import faulthandler\nfaulthandler.cancel_dump_traceback_later()\nwhile True: pass",
            Outcome.ENDLESS,
            id="an endless loop that hides",
        ),
        pytest.param("print('flood ' * 5_000_000)", None, id="an output flood"),
    ],
)
def test_program_beyond_its_limits_is_ended(tried, trick, outcome):
    begin = time.monotonic()
    run = tried(trick)

    assert (run.stop and run.stop.outcome) is outcome, run.stop
    assert time.monotonic() - begin < python.SECONDS + 5.0


@isolated
def test_environment_and_arguments_hold_no_secret(tried, monkeypatch):
    monkeypatch.setenv("SYSID_SECRET", "of the class")
    run = tried("import os, sys; raise KeyError(str(dict(os.environ)) + str(sys.argv)[:60])")

    assert "HOME" in run.stop.said
    assert "SYSID_SECRET" not in run.stop.said
    assert "of the class" not in run.stop.said


def test_only_the_files_of_a_program_are_copied_to_the_sandbox(tmp_path):
    robot, given = tmp_path / "home" / "robot", tmp_path / "given"
    for name in (
        "robot.py", "constants.py", "secret.txt", "subsystems/drive.py", "subsystems/arm/joint.py",
        "lib/limits.json", "../elsewhere.py",
    ):  # fmt: skip
        (robot / name).parent.mkdir(parents=True, exist_ok=True)
        (robot / name).write_text(name, "utf-8")
    copy = copy_program(robot / "subsystems" / "drive.py", given)

    assert copy == given / "robot" / "subsystems" / "drive.py"
    assert {one.relative_to(given / "robot").as_posix() for one in given.rglob("*.*")} == {
        "robot.py", "constants.py", "subsystems/drive.py", "subsystems/arm/joint.py",
        "lib/limits.json",
    }  # fmt: skip


def test_folder_without_a_robot_project_is_not_searched(tmp_path):
    for name in ("mine/drive.py", "others/key.py", "note.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(name, "utf-8")
    copy_program(tmp_path / "mine" / "drive.py", tmp_path / "given")

    assert {one.name for one in (tmp_path / "given").rglob("*.py")} == {"drive.py", "note.py"}


@posix
def test_a_link_is_not_followed_when_a_program_is_handed_over(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "key").write_text(KEY, "utf-8")
    (tmp_path / "mine" / "a.py").symlink_to(tmp_path / "key")
    (tmp_path / "mine" / "drive.py").write_text("", "utf-8")
    copy_program(tmp_path / "mine" / "drive.py", tmp_path / "given")

    assert [one.name for one in (tmp_path / "given").rglob("*.py")] == ["drive.py"]


def test_overfull_folder_is_copied_in_part_with_the_graded_file(tmp_path):
    (tmp_path / "mine").mkdir()
    for number in range(MOST + 20):
        (tmp_path / "mine" / f"a{number}.py").write_text("", "utf-8")
    (tmp_path / "mine" / "z.py").write_text("z = 1", "utf-8")
    copy = copy_program(tmp_path / "mine" / "z.py", tmp_path / "given")

    assert copy.read_text("utf-8") == "z = 1"
    assert len([*copy.parent.iterdir()]) == MOST + 1
