"""The course on this machine: progress that is kept, and students who are told apart."""

import os
import subprocess
import sys
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from places import ROOT
from small_course import HALF, RIGHT, answer

from grader.cli import run_command
from grader.course.progress import (
    PLACE,
    Progress,
    Standing,
    find_course,
    load_progress,
    update_progress,
)
from grader.student_data.variant import derive_student_seed, make_student_rng
from sim.core.errors import BadRequest
from sim.support.atomic_file import make_private_folder, write_atomically
from sim.support.student_names import check_student_name, make_folder_name


def test_the_best_score_is_kept(course, capsys):
    for text in (HALF, "size = 0"):
        answer(course, text)
        run_command(["exercise1"])
    capsys.readouterr()
    run_command([])

    assert "2.5 of 3" in capsys.readouterr().out
    kept = tomllib.loads((course / PLACE).read_text("utf-8"))
    assert kept["progress"]["me"]["exercise1"]["score"] == 2.5
    names = {file.name for file in (course / ".course").iterdir()}
    assert names == {"progress.lock", "progress.toml"}


def test_a_name_is_read_out_of_damaged_progress(course, capsys):
    (course / ".course").mkdir()
    (course / PLACE).write_text('student = "zoë"\n[progress.zoë]\nexercise1 = {', "utf-8")

    run_command([])
    capsys.readouterr()
    assert load_progress(course)[0].student == "zoë"


def test_a_lost_name_is_asked_for_before_anything_is_graded(course, capsys, reads):
    (course / ".course").mkdir()
    (course / PLACE).write_text("\0", "utf-8")
    (course / "exercises" / "exercise1" / "data" / "zoe").mkdir(parents=True)

    assert run_command(["exercise1"]) == 2
    reads(capsys.readouterr().err)
    assert run_command(["exercise1"]) == 2  # until somebody says it
    assert run_command(["start", "--no-lab", "--student", "zoe"]) == 0
    assert load_progress(course)[0].student == "zoe"


def test_grading_goes_on_when_progress_cannot_be_saved(course, capsys):
    (course / ".course").write_text("a file where a folder should be", "utf-8")
    answer(course, RIGHT)

    assert run_command(["exercise1"]) == 0
    assert "could not be saved" in capsys.readouterr().err


@given(
    st.dictionaries(
        st.text(st.characters(exclude_categories=["C"]), min_size=1, max_size=9),
        st.dictionaries(
            st.sampled_from(["exercise4", "exercise 9", "ü.x"]),
            st.builds(
                lambda share, most, hints: Standing(share * most, most, hints),
                st.sampled_from([0.0, 0.5, 1.0]),
                st.integers(1, 20).map(float),
                st.integers(0, 3),
            ),
        ),
    )
)
def test_progress_is_read_back_as_it_was_written(tmp_path_factory, standings):
    folder = tmp_path_factory.mktemp("course")
    progress = Progress("ann", standings)

    assert update_progress(folder, lambda _: progress) == ""
    assert load_progress(folder) == (progress, "")


NOTES = """
import sys
from pathlib import Path
from grader.course.progress import update_progress
number = int(sys.argv[1])
name = f"exercise{number}"
for _ in range(5):
    update_progress(Path(), lambda now: now.add_score("ann", name, score=1, max_score=1))
"""


def test_eight_processes_that_grade_at_once_lose_no_score(course):
    running = [
        subprocess.Popen(
            [sys.executable, "-c", NOTES, str(number)],
            cwd=course,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        )
        for number in range(8)
    ]
    assert [one.wait(120) for one in running] == [0] * 8
    standings = load_progress(course)[0].standings["ann"]

    assert {name for name, one in standings.items() if one.is_done} == {
        f"exercise{number}" for number in range(8)
    }
    assert list((course / ".course").glob("*.part")) == []


@pytest.mark.parametrize(
    "content",
    ["", "\n", "student = [", "not toml", "student = 3\n[progress.me]\nexercise1 = 5",
     "progress = 1", "\0", 'student = "/"'],
)  # fmt: skip
def test_damaged_progress_is_reported_and_each_file_set_aside(course, content, capsys):
    answer(course, RIGHT)
    path = course / PLACE
    path.parent.mkdir()
    for name in ("progress.toml.bak", "progress.toml.2.bak"):
        path.write_text(content, encoding="utf-8")

        assert run_command(["exercise1"]) == 0
        assert (
            f"could not be read; it starts again from zero, and the damaged file is now {name}"
            in (capsys.readouterr().err)
        )
        assert (path.parent / name).read_text(encoding="utf-8") == content
        assert load_progress(course)[0].find_standing("me", "exercise1").is_done


def test_full_disk_leaves_the_old_file_and_no_partial_file(tmp_path, monkeypatch):
    path = tmp_path / "gradebook.csv"
    write_atomically(path, "old")
    monkeypatch.setattr("sim.support.atomic_file.os.fsync", no_room)

    with pytest.raises(OSError, match="No space left"):
        write_atomically(path, "new")
    assert [one.read_text(encoding="utf-8") for one in tmp_path.iterdir()] == ["old"]


def no_room(_):
    raise OSError(28, "No space left on device")


@pytest.mark.skipif(os.name == "nt", reason="Windows knows no such rights")
def test_private_files_are_created_readable_by_their_owner_only(tmp_path):
    make_private_folder(tmp_path / "class" / "results")
    write_atomically(tmp_path / "class" / "results" / "ann.json", "{}", private=True)
    write_atomically(tmp_path / "class" / "page.html", "")

    assert (tmp_path / "class").stat().st_mode & 0o777 == 0o700
    assert (tmp_path / "class" / "results" / "ann.json").stat().st_mode & 0o777 == 0o600
    assert (tmp_path / "class" / "page.html").stat().st_mode & 0o600 == 0o600


def test_outside_a_course_the_installed_one_is_used(tmp_path):
    assert find_course(tmp_path) == ROOT


def test_where_only_a_students_numbers_are_unpacked_no_other_course_is_taken(tmp_path):
    (tmp_path / "exercises" / "exercise1").mkdir(parents=True)
    (tmp_path / ".course").mkdir()
    (tmp_path / ".course" / "class.toml").write_text("", encoding="utf-8")

    with pytest.raises(BadRequest, match=r"the course is not. Unpack your class's course.zip"):
        find_course(tmp_path / "exercises" / "exercise1")


def test_different_students_get_different_folders():
    names = ["ann", "a.nn", "ann ", "con", "a:b", "a*b", "ä", "😀", "x" * 64, "..", "a.", "Straße"]
    folders = {make_folder_name(name) for name in names}

    assert len(folders) == len(names) - 1  # "ann " is ann
    assert all(not set(folder) & set('<>:"/\\|?*') for folder in folders)
    assert all(len(folder.encode()) < 200 for folder in folders)
    assert make_folder_name("Ann") == make_folder_name("ann")


@given(st.text(max_size=70))
def test_any_name_has_a_folder_or_is_refused(name):
    try:
        check_student_name(name)
    except BadRequest:
        return
    assert make_folder_name(name).strip(". ") == make_folder_name(name) != ""


def test_numbers_depend_on_student_exercise_draw_and_secret():
    assert derive_student_seed("ann", "exercise9") == derive_student_seed("Ann ", "exercise9")
    drawn = {
        make_student_rng(*who, draw=draw).integers(2**62)
        for who in (("ann", "exercise9"), ("ben", "exercise9"), ("ann", "exercise1"))
        for draw in (0, 1)
    }
    assert len(drawn) == 6
    assert derive_student_seed("ann", "exercise9") != derive_student_seed(
        "ann", "exercise9", secret=b"a class's own"
    )
