"""A class: what is handed in is found, graded once, the same by any number of workers, and kept."""

import hashlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import zipfile

import pytest
from places import ROOT, read_all
from small_course import HALF, RIGHT, lay_out

from grader.classroom.class_grading import GradedClass, grade_class, plan_grading
from grader.classroom.roster import read_class_roster
from grader.classroom.store import ResultStore
from grader.classroom.submissions import find_submissions, read_submission
from grader.cli import run_command
from grader.exercise.exercise import list_exercises
from sim.core.errors import BadRequest

BOOM = 'size = "boom"\n'  # the small course's check breaks on it
WAITS = '''
"""An exercise whose check takes its time."""
import time
from grader.checks.check import check
from grader.answers.submission import read_answers
FILES = ("answers.toml",)

def read(path, *, student):
    answers = read_answers(path)
    time.sleep(answers.get("wait", 0))
    return answers

@check(points=1)
def there(answers):
    """Something is there."""
'''


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A small course, in whose folder the command runs."""
    lay_out(tmp_path / "course")
    monkeypatch.chdir(tmp_path / "course")
    return tmp_path / "course"


def hand_in(folder, **answers):
    """A folder for each student, with an answer to exercise 1."""
    for student, text in answers.items():
        place = folder / student / "exercise1"
        place.mkdir(parents=True)
        (place / "answers.toml").write_text(text, encoding="utf-8")
    return folder


def graded(folder, name):
    return json.loads((folder / "results" / f"{name}.json").read_text(encoding="utf-8"))


def test_broken_submission_does_not_stop_the_grading_of_others(course, tmp_path, capsys, reads):
    there = hand_in(tmp_path / "in", ann=RIGHT, ben=HALF, cat=BOOM, dan="size = [", eve=RIGHT)

    assert run_command(["class", str(there)]) == 1  # two could not be graded
    said = capsys.readouterr()
    rows = (tmp_path / "in-graded" / "gradebook.csv").read_text("utf-8-sig").splitlines()

    assert rows == [
        "student,exercise1,total,of,late,not graded",
        "ann,3,3,3,,",
        "ben,2.5,2.5,3,,",
        "cat,,,3,,exercise1",
        "dan,,,3,,exercise1",
        "eve,3,3,3,,",
    ]
    reads(said.err)
    assert "KeyError" in graded(tmp_path / "in-graded", "cat")["grades"][0]["reason"]
    assert course.is_dir()


@pytest.mark.usefixtures("course")
def test_the_same_class_is_graded_the_same_by_one_and_by_four_workers(tmp_path):
    many = {f"student{number:02d}": (RIGHT, HALF, "size = 1\n")[number % 3] for number in range(20)}
    there = hand_in(tmp_path / "in", **many)
    roster = tmp_path / "roster.csv"
    roster.write_text("Student,ID\n" + "".join(f"{name},7\n" for name in many), "utf-8")
    exports = [word for name in ("canvas", "github", "gradescope", "junit") for word in
               ("--export", name)]  # fmt: skip
    exports += ["--roster", str(roster)]
    found = []
    for name, processes in (("one", "1"), ("four", "4"), ("again", "1")):
        out = tmp_path / name
        command = ["class", str(there), "-o", str(out), "--processes", processes, *exports]
        assert run_command(command) == 0
        found.append(read_all(out))

    assert len(found[0]) == 20 * 4 + 5  # results, pages, two exports; index, gradebook, …
    assert found[0] == found[1] == found[2]


def test_unchanged_submission_is_not_graded_again(course, tmp_path):
    there = hand_in(tmp_path / "in", ann=RIGHT, ben=HALF)
    store = ResultStore(tmp_path / "out")

    def left(*, secret=None, again=False):
        work = GradedClass(
            find_submissions(there, list_exercises(course)), list_exercises(course), course, secret
        )
        kept, todo = plan_grading(work, store, travel=False, again=again)
        grade_class(work, kept, todo, store, processes=1, cluster=None, say=lambda: None)
        return [job.submission.student for job in todo]

    assert left() == ["ann", "ben"]
    assert left() == []
    (there / "ben" / "exercise1" / "answers.toml").write_text(RIGHT, encoding="utf-8")
    assert left() == ["ben"]
    for damaged in (
        "{",
        '{"student": "ann", "digest": "", "grades": [{"exercise": "exercise1"}]}',
    ):
        (tmp_path / "out" / "results" / "ann.json").write_text(damaged, encoding="utf-8")
        assert left() == ["ann"]
    assert left(secret=b"another class's") == ["ann", "ben"]
    assert left(secret=b"another class's", again=True) == ["ann", "ben"]
    checks = course / "exercises" / "exercise1" / "checks.py"
    checks.write_text(checks.read_text("utf-8") + "\n# another course\n", encoding="utf-8")
    assert left(secret=b"another class's") == ["ann", "ben"]


def test_a_roster_may_have_empty_cells_at_the_ends_of_its_lines(tmp_path):
    path = tmp_path / "roster.csv"
    path.write_text("student,mail\nann,a@x, ,\nben\n,,,\n", encoding="utf-8")

    assert [*read_class_roster(path).rows] == ["ann", "ben"]


@pytest.mark.usefixtures("course")
def test_only_results_of_the_previous_run_are_removed(tmp_path):
    there = hand_in(tmp_path / "in", ann=RIGHT, bne=HALF)
    command = ["class", str(there), "--export", "gradescope", "--export", "github"]
    assert run_command([*command, "--export", "junit"]) == 0
    out = tmp_path / "in-graded"
    others = ("students/notes.html", "gradescope/bne/mine.txt", "bne.html")
    for name in others:
        (out / name).write_text("mine", encoding="utf-8")
    (tmp_path / "victim.txt").write_text("mine", encoding="utf-8")
    with (out / "results" / "written.txt").open("a", encoding="utf-8") as stream:
        stream.write("../victim.txt\n")
    (there / "bne").rename(there / "ben")

    assert run_command(command) == 0
    assert {*read_all(out)} == {
        "index.html", "gradebook.csv", "results/written.txt", *others,
        *(f"{place}{name}{end}" for name in ("ann", "ben") for place, end in (
            ("students/", ".html"), ("results/", ".json"), ("github/", ".txt"),
            ("gradescope/", "/results.json"))),
    }  # fmt: skip
    assert (tmp_path / "victim.txt").is_file()


@pytest.mark.skipif(os.name == "nt", reason="a process cannot be sent SIGKILL on Windows")
def test_killed_run_continues_where_it_stopped(course, tmp_path):
    (course / "exercises" / "exercise1" / "checks.py").write_text(WAITS, encoding="utf-8")
    many = {f"student{number}": "wait = 0.3\n" for number in range(6)}
    there = hand_in(tmp_path / "in", **many)
    command = [sys.executable, "-c", "from grader.cli import main; main()", "class", str(there)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    running = subprocess.Popen([*command, "--processes", "1"], cwd=course, env=environment)
    results = tmp_path / "in-graded" / "results"
    while not results.is_dir() or len(list(results.glob("[!.]*.json"))) < 2:
        time.sleep(0.02)
    running.send_signal(signal.SIGKILL)
    running.wait()
    kept = {path: path.stat().st_mtime_ns for path in results.glob("[!.]*.json")}

    assert 2 <= len(kept) < 6
    assert run_command(["class", str(there), "--processes", "1"]) == 0
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    assert len(list(results.glob("[!.]*.json"))) == 6


def test_an_answer_is_found_however_it_was_packed(course, tmp_path):
    place = tmp_path / "in"
    place.mkdir()
    deep = place / "ann" / "My Robot" / "exercises" / "Exercise1"
    deep.mkdir(parents=True)
    (deep / "answers.toml").write_text(RIGHT, encoding="utf-8")
    (deep / "checks.py").write_text("raise SystemExit", encoding="utf-8")
    (deep / "data").mkdir()
    (deep / "data" / "answers.toml").write_text("size = 0\n", encoding="utf-8")
    with zipfile.ZipFile(place / "ben.zip", "w") as archive:
        archive.writestr("course\\exercises\\exercise1\\answers.toml", HALF)
        archive.writestr("../../exercise1/answers.toml", "size = 0\n")  # leads out of it
    (place / "cat").mkdir()
    (place / "cat" / "answers.toml").write_text(RIGHT, encoding="utf-8")  # only one has this name
    (place / "dan.zip").write_bytes(b"PK\x03\x04 not quite")
    (place / ".DS_Store").write_bytes(b"")
    (place / "__MACOSX").mkdir()
    found = {one.student: one for one in find_submissions(place, list_exercises(course))}

    assert found["ann"].files == {"exercise1": {"answers.toml": RIGHT.encode()}}
    assert found["ben"].files == {"exercise1": {"answers.toml": HALF.encode()}}
    assert found["cat"].files == {"exercise1": {"answers.toml": RIGHT.encode()}}
    assert "cannot be read" in found["dan"].problem
    assert set(found) == {"ann", "ben", "cat", "dan"}


@pytest.mark.usefixtures("course")
def test_folder_of_an_unknown_student_is_reported_and_does_not_stop_the_grading(tmp_path):
    there = hand_in(tmp_path / "in", ann=RIGHT, **{"x" * 100: RIGHT})

    assert run_command(["class", str(there)]) == 1
    text = (tmp_path / "in-graded" / "index.html").read_text("utf-8")
    assert "the student&#39;s name is too long: 100 characters" in text
    assert len(list((tmp_path / "in-graded" / "students").iterdir())) == 2


@pytest.mark.skipif(not hasattr(os, "symlink") or os.name == "nt", reason="links need a right")
def test_a_link_is_not_graded_as_an_answer(course, tmp_path):
    place = tmp_path / "in" / "ann" / "exercise1"
    place.mkdir(parents=True)
    (tmp_path / "key.toml").write_text(RIGHT, encoding="utf-8")
    (place / "answers.toml").symlink_to(tmp_path / "key.toml")

    assert read_submission(tmp_path / "in" / "ann", list_exercises(course)).files == {}


@pytest.mark.parametrize(
    "make",
    [
        lambda _: None,
        lambda place: place.mkdir(),
        lambda place: hand_in(place, ann=RIGHT, ANN=RIGHT),
    ],
    ids=["no-folder", "empty", "twins"],
)
@pytest.mark.usefixtures("course")
def test_class_that_cannot_be_graded_gets_a_one_line_error(tmp_path, capsys, make, reads):
    make(tmp_path / "in")

    assert run_command(["class", str(tmp_path / "in")]) == 2
    reads(capsys.readouterr().err)


@pytest.mark.usefixtures("course")
def test_unknown_format_and_unknown_exercise_are_refused(tmp_path, capsys):
    there = hand_in(tmp_path / "in", ann=RIGHT)

    assert run_command(["class", str(there), "--export", "paper"]) == 2
    assert "no format 'paper'. Choose one of: canvas, " in capsys.readouterr().err
    assert run_command(["class", str(there), "--exercise", "7"]) == 2


@pytest.mark.usefixtures("course")
def test_roster_shows_absent_and_unknown_students(tmp_path, capsys, reads):
    there = hand_in(tmp_path / "in", ann=RIGHT, stranger=RIGHT)
    roster = tmp_path / "roster.csv"
    roster.write_text("team;Student\n1;Ann\n1;Zoë\n", encoding="utf-8-sig")

    assert run_command(["class", str(there), "--roster", str(roster)]) == 1
    rows = (tmp_path / "in-graded" / "gradebook.csv").read_text("utf-8-sig").splitlines()
    points = dict(row.split(",")[:2] for row in rows[1:])
    page = (tmp_path / "in-graded" / "index.html").read_text("utf-8")
    said = capsys.readouterr()
    assert points == {"Ann": "3", "Zoë": ""}
    assert said.out.splitlines()[1].startswith("1 of 2 students handed something in")
    assert "<b>stranger</b>: stranger does not match any name on the roster." in page
    assert "1 of 2</td>" in page
    reads(said.err)


def test_feedback_never_names_a_deleted_folder(course, tmp_path, capsys):
    checks = course / "exercises" / "exercise1" / "checks.py"
    text = checks.read_text(encoding="utf-8")
    checks.write_text(f'{text}\nBESIDE = ("fit.py",)\n', encoding="utf-8")
    there = hand_in(tmp_path / "in", ann="", ben="size = [", cat=RIGHT, dan="", eve="")
    (there / "cat").rename(there / "cat.old")
    (there / "cat" / "EXERCISE1").mkdir(parents=True)
    (there / "cat.old" / "exercise1" / "answers.toml").rename(
        there / "cat" / "EXERCISE1" / "MY.TOML"
    )
    (there / "dan" / "exercise1" / "answers.toml").rename(there / "dan" / "exercise1" / "fit.py")
    for name in ("a.toml", "b.toml"):
        (there / "eve" / "exercise1" / name).write_text(HALF, encoding="utf-8")
    (there / "eve" / "exercise1" / "answers.toml").unlink()

    assert run_command(["class", str(there), "--export", "junit"]) == 1
    records = {
        name: graded(tmp_path / "in-graded", name)["grades"][0]
        for name in ("ann", "ben", "cat", "dan", "eve")
    }
    assert records["ann"]["reason"].startswith("answers.toml: the file is empty.")
    assert records["ben"]["reason"].startswith("answers.toml, line 1: ")
    assert records["cat"]["score"] == 3
    assert records["dan"]["reason"] == "answers.toml is missing; there is only fit.py"
    assert records["eve"]["score"] == 2.5  # twice the same answer
    assert tempfile.gettempdir() not in json.dumps(records)
    assert tempfile.gettempdir() not in (tmp_path / "in-graded" / "junit.xml").read_text("utf-8")
    assert "Traceback" not in capsys.readouterr().err


def test_an_untouched_starter_is_not_handed_in(course, tmp_path, capsys):
    starter = b"size = 0\nmore = 1\n"
    digest = hashlib.sha256(starter).hexdigest()
    (course / "exercises" / "starters.toml").write_text(
        f'[exercise1]\n"answers.toml" = "{digest}"\n', encoding="utf-8"
    )
    there = hand_in(tmp_path / "in", ann=RIGHT, ben="", cat="", dan="")
    (there / "ben" / "exercise1" / "answers.toml").write_bytes(starter.replace(b"\n", b"\r\n"))
    (there / "cat" / "exercise1" / "answers.toml").write_bytes(starter)
    (there / "cat" / "exercise1" / "answers.docx").write_bytes(b"the answers")
    (there / "dan" / "exercise1" / "answers.toml").write_bytes(starter + b"# I tried\n")

    assert run_command(["class", str(there)]) == 1
    status = {
        name: graded(tmp_path / "in-graded", name)["grades"][0]["status"]
        for name in ("ann", "ben", "cat", "dan")
    }
    assert status == {"ann": "passed", "ben": "missing", "cat": "ungradable", "dan": "failed"}
    assert "\n3 of 4 students handed something in" in capsys.readouterr().out


def test_export_of_canvas_works_as_a_roster(tmp_path):
    path = tmp_path / "canvas.csv"
    path.write_text(
        "Student,ID,SIS User ID,SIS Login ID,Section,Quiz\n,,,,,Manual Posting\n"
        "    Points Possible,,,,,9\n"
        '"Lee, Ann",17,s17,ann,A\n"Student, Test",99,,0f1e2d,A\n',
        encoding="utf-8",
    )

    assert [*read_class_roster(path).rows] == ["ann"]
    row = read_class_roster(path).rows["ann"]
    assert (row["Student"], row["ID"], row["SIS User ID"], row["Section"]) == (
        "Lee, Ann", "17", "s17", "A",
    )  # fmt: skip


@pytest.mark.parametrize(
    "text",
    ["who\nann\n", "student\nann\nANN\n", "student\n", "student,mail\nMüller, Zoë,z@x\n"],
)
def test_a_roster_that_does_not_say_who_is_who_is_refused(tmp_path, text, reads):
    (tmp_path / "roster.csv").write_text(text, encoding="utf-8")

    with pytest.raises(BadRequest) as refused:
        read_class_roster(tmp_path / "roster.csv")
    reads(refused.value)


@pytest.mark.usefixtures("course")
def test_secret_in_the_environment_that_differs_from_the_file_is_refused(
    tmp_path, monkeypatch, capsys
):
    there = hand_in(tmp_path / "in", ann=RIGHT)
    (tmp_path / "class.secret").write_text("the secret of this class", encoding="utf-8")
    monkeypatch.setenv("SYSID_SECRET", "the secret of another class")

    assert run_command(["class", str(there), "--secret", str(tmp_path / "class.secret")]) == 2
    assert "hold different secrets" in capsys.readouterr().err
    assert not (tmp_path / "in-graded").exists()
