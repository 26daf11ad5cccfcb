"""`grade start FOLDER`: lessons and exercises are unpacked once, and over nothing else."""

import pytest

from grader import course_folder
from grader.cli import run_command
from grader.course_folder import find_course_source, unpack_course
from sim.core.errors import BadRequest


def test_the_course_is_unpacked_as_it_was_written(root, tmp_path):
    target = tmp_path / "my course"

    assert unpack_course(target)
    tops = {path.name for path in target.iterdir()}
    assert tops == {"LICENSE", "README.md", "pyproject.toml", "exercises", "lessons"}
    task = "exercises/exercise4/README.md"
    assert (target / task).read_bytes() == (root / task).read_bytes()
    assert not list(target.rglob("data"))
    assert not unpack_course(target)  # what a learner wrote there stays


def test_what_is_there_already_is_left_alone(tmp_path):
    (tmp_path / "diary.txt").write_text("mine", encoding="utf-8")
    for taken in (tmp_path, tmp_path / "diary.txt"):
        with pytest.raises(BadRequest, match="Name a folder that is empty or new"):
            unpack_course(taken)


def test_a_folder_that_cannot_be_written_is_refused(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(course_folder, "write_atomically", full)

    with pytest.raises(BadRequest, match="No space left on device"):
        unpack_course(tmp_path / "course")


def test_an_installation_without_the_course_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(course_folder, "INSTALLATION", tmp_path)

    with pytest.raises(BadRequest, match="contains no lessons or exercises"):
        find_course_source()


def test_the_course_of_a_wheel_is_found_beside_the_packages(tmp_path, monkeypatch):
    for name in ("exercises", "lessons"):
        (tmp_path / "sysid_course" / name).mkdir(parents=True)
    monkeypatch.setattr(course_folder, "INSTALLATION", tmp_path)

    assert find_course_source() == tmp_path / "sysid_course"


def test_the_command_refuses_in_one_line(tmp_path, monkeypatch, capsys):
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "diary.txt").write_text("mine", encoding="utf-8")
    monkeypatch.chdir(tmp_path)

    assert run_command(["start", "taken", "--no-lab"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("grade: taken: something else is there already.")
    assert said.count("\n") == 1


def test_outside_of_a_course_it_says_how_to_make_one(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("grader.course.__file__", str(tmp_path / "grader" / "course.py"))

    assert run_command(["exercise4"]) == 2
    assert "grade start my-course" in capsys.readouterr().err
