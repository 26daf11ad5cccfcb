"""The course on this machine: progress that is kept, and students who are told apart."""

import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_course import HALF, RIGHT, answer, lay_out

from grader.cli import run
from grader.course import PLACE, Progress, Standing, find_course, load, save
from grader.variant import folder_name, generator, seed, student_name
from sim.errors import BadRequest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A small course, in whose folder the command runs."""
    lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_best_score_is_kept(course, capsys):
    for text in (HALF, "size = 0"):
        answer(course, text)
        run(["exercise1"])
    capsys.readouterr()
    run([])

    assert "2.5 of 3" in capsys.readouterr().out
    kept = tomllib.loads((course / PLACE).read_text("utf-8"))
    assert kept["progress"]["me"]["exercise1"]["score"] == 2.5
    assert [file.name for file in (course / ".course").iterdir()] == ["progress.toml"]


@pytest.mark.parametrize(
    "text",
    [
        "not toml",
        "student = 3\n[progress.me]\nexercise1 = 5",
        "progress = 1",
        "\0",
        'student = "/"',
    ],
)
def test_damaged_progress_is_said_set_aside_and_begun_anew(course, capsys, text):
    (course / ".course").mkdir()
    (course / PLACE).write_text(text, "utf-8")

    assert run([]) == 0
    out, err = capsys.readouterr()
    assert "could not be read; it starts anew" in err
    assert "0 of 1 exercises done" in out
    assert (course / ".course" / "progress.toml.bak").read_text("utf-8") == text

    run([])
    assert capsys.readouterr().err == ""


def test_progress_that_cannot_be_kept_does_not_stop_grading(course, capsys):
    (course / ".course").write_text("a file where a folder should be", "utf-8")
    answer(course, RIGHT)

    assert run(["exercise1"]) == 0
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

    assert save(progress, folder) == ""
    assert load(folder) == (progress, "")


def test_outside_a_course_it_uses_the_one_it_belongs_to(tmp_path):
    assert find_course(tmp_path) == ROOT


def test_where_only_a_students_numbers_are_unpacked_no_other_course_is_taken(tmp_path):
    (tmp_path / "exercises" / "exercise1").mkdir(parents=True)
    (tmp_path / ".course").mkdir()
    (tmp_path / ".course" / "class.toml").write_text("", encoding="utf-8")

    with pytest.raises(BadRequest, match=r"the course is not. Unpack your class's course.zip"):
        find_course(tmp_path / "exercises" / "exercise1")


def test_a_student_who_is_someone_else_is_somewhere_else():
    names = ["ann", "a.nn", "ann ", "con", "a:b", "a*b", "ä", "😀", "x" * 64, "..", "a.", "Straße"]
    folders = {folder_name(name) for name in names}

    assert len(folders) == len(names) - 1  # "ann " is ann
    assert all(not set(folder) & set('<>:"/\\|?*') for folder in folders)
    assert all(len(folder.encode()) < 200 for folder in folders)
    assert folder_name("Ann") == folder_name("ann")


@given(st.text(max_size=70))
def test_any_name_has_a_folder_or_is_refused(name):
    try:
        student_name(name)
    except BadRequest:
        return
    assert folder_name(name).strip(". ") == folder_name(name) != ""


def test_numbers_are_drawn_from_who_one_is():
    assert seed("ann", "exercise9") == seed("Ann ", "exercise9")
    drawn = {
        generator(*who, draw=draw).integers(2**62)
        for who in (("ann", "exercise9"), ("ben", "exercise9"), ("ann", "exercise1"))
        for draw in (0, 1)
    }
    assert len(drawn) == 6
    assert seed("ann", "exercise9") != seed("ann", "exercise9", secret=b"a class's own")
