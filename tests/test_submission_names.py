"""Names of what schools hand in: each platform has its form; the roster has the student."""

import shutil
import zipfile

import pytest
from places import ROOT
from small_course import HALF, RIGHT, lay_out, put

from grader.classroom.roster import read_class_roster
from grader.classroom.submission_names import Identities, SubmissionName, parse_name
from grader.classroom.submissions import find_stray_files, find_submissions
from grader.cli import run_command
from grader.exercise.exercise import list_exercises
from sim.core.errors import BadRequest

CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Section
    Points Possible,,,,
"Doe, Jane",101,s101,jdoe,A
"Müller-Lüdenscheid, Zoë",102,s102,zoe,A
"de la Cruz, Ana María",103,s103,ana,A
"""


@pytest.fixture
def course(tmp_path):
    lay_out(tmp_path / "course")
    return list_exercises(tmp_path / "course")


def people(tmp_path, text):
    path = tmp_path / "roster.csv"
    path.write_text(text, encoding="utf-8")
    return read_class_roster(path).identities


@pytest.mark.parametrize(
    ("name", "folder", "found"),
    [
        ("doejane_101_5555_exercises.zip", False, ("doejane", "101", "exercises.zip")),
        ("doejane_LATE_101_5555_answers-2.toml", False, ("doejane", "101", "answers-2.toml", True)),
        ("Jane Doe_4711_assignsubmission_file_exercises.zip", False,
         ("Jane Doe", "", "exercises.zip")),
        ("Jane Doe_4711_assignsubmission_file_", True, ("Jane Doe", "", "")),
        ("Jane Doe_4711_assignsubmission_file", True, ("Jane Doe", "", "")),
        ("Jane Doe - exercises.zip", False, ("Jane Doe", "", "exercises.zip")),
        ("week-3-janedoe", True, ("week-3-janedoe", "", "")),
        ("jane.zip", False, ("jane", "", "")),
        ("Jane Doe", True, ("Jane Doe", "", "")),
    ],
)  # fmt: skip
def test_each_platforms_names_are_read(name, folder, found):
    assert parse_name(name, folder=folder) == SubmissionName(*found)


@pytest.mark.parametrize("name", ["roster.csv", "notes.txt", "answers.toml"])
def test_file_with_an_ordinary_name_belongs_to_the_student_on_the_roster(tmp_path, name):
    found = parse_name(name, folder=False)

    assert (found.guessed, found.file) == (True, name)
    assert people(tmp_path, CANVAS).find(found) is None


@pytest.mark.parametrize(
    ("name", "student"),
    [
        (SubmissionName("doejane", "101", "x.zip"), "jdoe"),
        (SubmissionName("doejane", "999", "x.zip"), "jdoe"),  # another Canvas's number
        (SubmissionName("someone", "102", "x.zip"), "zoe"),
        (SubmissionName("mullerludenscheidzoe", "", "x.zip"), "zoe"),
        (SubmissionName("mllerldenscheidzo", "", "x.zip"), "zoe"),
        (SubmissionName("Jane Doe"), "jdoe"),
        (SubmissionName("Doe Jane"), "jdoe"),
        (SubmissionName("Doe, Jane"), "jdoe"),
        (SubmissionName("Ana María de la Cruz"), "ana"),
        (SubmissionName("de la Cruz Ana Maria"), "ana"),
        (SubmissionName("JDOE"), "jdoe"),
        (SubmissionName("s103"), "ana"),
        (SubmissionName("Jane Do"), None),
        (SubmissionName("somebody"), None),
    ],
)
def test_the_student_on_the_roster_is_found(tmp_path, name, student):
    assert people(tmp_path, CANVAS).find(name) == student


def test_a_name_that_two_students_have_is_given_to_neither(tmp_path):
    both = people(tmp_path, "student,name\na1,Kim Lee\na2,Lee Kim\n")

    assert both.find(SubmissionName("Kim Lee")) is None
    assert set(both.propose(SubmissionName("Kim Lee"))) == {"a1", "a2"}


def test_a_repository_is_found_by_the_login_at_its_end():
    roster = Identities({"Jane Doe": {"identifier": "Jane Doe", "github_username": "JD-2010"}})

    assert roster.find(SubmissionName("week-3-jd-2010")) == "Jane Doe"
    assert roster.find(SubmissionName("week-3-somebody")) is None


def zipped(path, **files):
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in files.items():
            archive.writestr(name.replace("__", "/") + ".toml", text)


def test_a_canvas_download_is_graded_as_it_is(tmp_path, course):
    place = tmp_path / "in"
    place.mkdir()
    zipped(place / "doejane_101_5555_exercises.zip", course__exercises__exercise1__answers=RIGHT)
    zipped(place / "mllerldenscheidzo_LATE_102_5556_exercise1-1.zip", answers=HALF)
    (place / "delacruzanamara_103_5557_answers.toml").write_text(RIGHT, encoding="utf-8")
    (place / "roster.csv").write_text(CANVAS, encoding="utf-8")
    roster = people(tmp_path, CANVAS)
    found = {one.student: one for one in find_submissions(place, course, roster=roster)}

    assert set(found) == {"jdoe", "zoe", "ana"}
    assert all(list(one.files) == ["exercise1"] for one in found.values())
    assert all(not one.problem for one in found.values())
    assert found["zoe"].files["exercise1"] == {"answers.toml": HALF.encode()}
    assert [one.student for one in found.values() if one.late] == ["zoe"]
    assert find_stray_files(place, roster) == ("roster.csv",)


@pytest.fixture
def four(tmp_path, course):
    """A course of four exercises: three of numbers, and exercise 4 of code."""
    first = course[0].folder
    for number, file in ((2, "answers.toml"), (3, "answers.toml"), (4, "Code.java")):
        folder = first.with_name(f"exercise{number}")
        folder.mkdir()
        for name in ("checks.py", "README.md", "hints.toml"):
            text = (first / name).read_text(encoding="utf-8").replace("answers.toml", file)
            (folder / name).write_text(text, encoding="utf-8")
    return list_exercises(tmp_path / "course")


COULD_BELONG = (
    "answers.toml could belong to exercise1, exercise2, exercise3; it was not graded. "
    "Put it into a folder with the name of its exercise"
)


@pytest.mark.parametrize(
    ("path", "exercise", "name"),
    [
        ("Code.java", "exercise4", "Code.java"),
        ("code.JAVA", "exercise4", "Code.java"),
        ("exercise4/Code.java.txt", "exercise4", "Code.java"),
        ("Exercise 4/Code.java", "exercise4", "Code.java"),
        ("Exercise4.java", "exercise4", "Exercise4.java"),
        ("exercise_2/ANSWERS.TOML", "exercise2", "answers.toml"),
        ("EX03/my answers.toml", "exercise3", "my answers.toml"),
        ("ex-2.toml", "exercise2", "ex-2.toml"),
    ],
)
def test_an_answer_is_recognized_by_its_folders_or_its_own_name(
    tmp_path, four, path, exercise, name
):
    put(tmp_path / "in" / "ann", {path: RIGHT})
    (one,) = find_submissions(tmp_path / "in", four)

    assert one.files == {exercise: {name: RIGHT.encode()}}
    assert (one.unused, one.problems) == ((), {})


def test_code_outside_the_folders_counts_where_its_exercise_has_no_other(tmp_path, four):
    put(tmp_path / "in" / "ann", {"exercise1/answers.toml": RIGHT, "Code.java": HALF})
    put(tmp_path / "in" / "ben", {"exercise4/Code.java": RIGHT, "Code.java": HALF})
    ann, ben = find_submissions(tmp_path / "in", four)

    assert ann.files["exercise4"] == {"Code.java": HALF.encode()}
    assert ben.files == {"exercise4": {"Code.java": RIGHT.encode()}}


@pytest.mark.parametrize(
    ("files", "unused", "problems"),
    [
        (["answers.toml"],
         (COULD_BELONG,), {}),
        (["report.pdf", "exercise9/answers.docx"],
         ("report.pdf is not a file of any exercise; it was not graded",
          "answers.docx is not a file of any exercise; it was not graded"), {}),
        (["exercise2/answers.txt", "exercise2/answers.docx", "ex4/notebook.ipynb"], (),
         {"exercise2": "answers.docx, answers.txt cannot be graded: exercise2 needs answers.toml",
          "exercise4": "notebook.ipynb cannot be graded: exercise4 needs Code.java"}),
        (["exercise1/answers.toml", "exercise2/answers.toml", "answers.toml"], (),
         {"exercise3": "answers.toml may belong to exercise3. Put it into a folder exercise3"}),
        (["exercise1/answers.toml", "exercise1/notes.txt"], (), {}),
    ],
)  # fmt: skip
def test_a_file_that_may_be_the_only_answer_to_an_exercise_is_named(
    tmp_path, four, files, unused, problems
):
    put(tmp_path / "in" / "ann", dict.fromkeys(files, RIGHT))
    (one,) = find_submissions(tmp_path / "in", four)

    assert (one.unused, one.problems) == (unused, problems)


@pytest.mark.parametrize(
    "path",
    [
        "README.md", "exercise1/README.md", "exercise1/checks.py", "readme.txt", ".DS_Store",
        "__MACOSX/x.toml", "Thumbs.db", ".git/config", "__pycache__/a.pyc", "class.toml",
        ".course/class.toml", "lessons/01_model.ipynb", "sim/core/log.py", "LICENSE",
        "exercise1/data/ann/numbers.txt", "exercise1/log.wpilog", "exercise1/~$answers.docx",
    ],
)  # fmt: skip
def test_files_of_the_course_and_of_the_system_are_not_reported_as_unused(tmp_path, four, path):
    put(tmp_path / "in" / "ann", {path: "x"})
    (one,) = find_submissions(tmp_path / "in", four)

    assert (one.files, one.unused, one.problems) == ({}, (), {})


def test_the_authored_files_of_an_exercise_are_not_graded_as_an_answer(tmp_path):
    course = list_exercises(ROOT)
    for one in course:
        shutil.copytree(one.folder, tmp_path / "in" / "ann" / one.name)
        for name in (*one.files, *one.companion_files):
            (tmp_path / "in" / "ann" / one.name / name).unlink()
    (one,) = find_submissions(tmp_path / "in", course)

    assert (one.files, one.unused, one.problems) == ({}, (), {})


def test_class_command_reports_unused_files_and_returns_1(tmp_path, four, monkeypatch, capsys):
    put(tmp_path / "in" / "Jane Doe", {"answers.toml": RIGHT})
    put(tmp_path / "in" / "ana", {"exercise1/answers.txt": RIGHT})
    put(tmp_path / "in" / "zoe", {"exercise1/answers.toml": RIGHT})
    (tmp_path / "roster.csv").write_text(CANVAS, encoding="utf-8")
    monkeypatch.chdir(four[0].folder)

    assert run_command(["class", str(tmp_path / "in"), "--roster", f"{tmp_path}/roster.csv"]) == 1
    out = tmp_path / "in-graded"
    page = (out / "index.html").read_text(encoding="utf-8")
    rows = (out / "gradebook.csv").read_text("utf-8-sig").splitlines()
    assert "<b>jdoe</b>: answers.toml could belong to exercise1, exercise2, exercise3;" in page
    assert "<b>ana, exercise1</b>: answers.txt cannot be graded: exercise1 needs" in page
    assert [row.rpartition(",")[2] for row in rows[1:]] == ["exercise1", "unused files", ""]
    said = capsys.readouterr().err
    assert "jdoe: answers.toml could belong to" in said
    assert "some work of 2 students could not be graded" in said


def test_several_files_of_one_student_are_one_submission(tmp_path, course):
    second = tmp_path / "course" / "exercises" / "exercise2"
    second.mkdir()
    first = course[0].folder
    for name in ("checks.py", "README.md", "hints.toml"):
        text = (first / name).read_text(encoding="utf-8").replace("answers.toml", "code.toml")
        (second / name).write_text(text, encoding="utf-8")
    place = tmp_path / "in"
    place.mkdir()
    (place / "Jane Doe - answers.toml").write_text(RIGHT, encoding="utf-8")
    (place / "Jane Doe - code.toml").write_text(HALF, encoding="utf-8")
    (one,) = find_submissions(place, list_exercises(tmp_path / "course"))

    assert one.student == "Jane Doe"
    assert {name: list(files) for name, files in one.files.items()} == {
        "exercise1": ["answers.toml"], "exercise2": ["code.toml"],
    }  # fmt: skip


def test_one_exercise_alone_is_found_in_a_whole_course_and_in_a_flat_folder(tmp_path, course):
    place = tmp_path / "in"
    for name in ("exercise1", "exercise9"):
        (place / "ann" / "exercises" / name).mkdir(parents=True)
        (place / "ann" / "exercises" / name / "answers.toml").write_text(RIGHT, encoding="utf-8")
    (place / "ann" / "answers.toml").write_text(HALF, encoding="utf-8")
    (place / "ben").mkdir()
    (place / "ben" / "my answers.toml").write_text(HALF, encoding="utf-8")
    ann, ben = find_submissions(place, course, asked=course)

    assert ann.files == {"exercise1": {"answers.toml": RIGHT.encode()}}
    assert ben.files == {"exercise1": {"my answers.toml": HALF.encode()}}


def test_a_stranger_is_reported_with_the_likely_student_and_not_graded(tmp_path, course, reads):
    place = tmp_path / "in" / "Jane Dow" / "exercise1"
    place.mkdir(parents=True)
    (place / "answers.toml").write_text(RIGHT, encoding="utf-8")
    (one,) = find_submissions(tmp_path / "in", course, roster=people(tmp_path, CANVAS))

    assert one.files == {}
    reads(one.problem)


def test_two_folders_of_one_student_are_refused(tmp_path, course, reads):
    for name in ("Jane Doe", "Doe Jane"):
        (tmp_path / "in" / name).mkdir(parents=True)

    with pytest.raises(BadRequest) as refused:
        find_submissions(tmp_path / "in", course, roster=people(tmp_path, CANVAS))
    reads(refused.value)
