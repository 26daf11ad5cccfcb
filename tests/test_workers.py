"""Workers that grade a class: what hangs, dies or bombs is named, and everybody else is graded."""

import multiprocessing
import zipfile

import pytest
from small_course import RIGHT, lay_out

from grader.classroom import workers
from grader.classroom.class_grading import GradedClass, grade_class, plan_grading
from grader.classroom.store import ResultStore
from grader.classroom.submissions import find_submissions
from grader.cli import run_command
from grader.exercise.exercise import list_exercises

pytestmark = pytest.mark.slow

DOES = '''
"""An exercise whose check does what the answer asks for."""
import os, time
from grader.checks.check import check
from grader.answers.submission import read_answers
FILES = ("answers.toml",)

def read(path, *, student):
    return read_answers(path)

@check(points=3)
def there(answers):
    """Something is there."""
    if answers.get("does") == "hang":
        time.sleep(3600)
    if answers.get("does") == "die":
        os._exit(3)
    if answers.get("does") == "eat":
        raise MemoryError
'''


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course whose exercise can hang, die and eat memory; the folder commands run in."""
    lay_out(tmp_path / "course")
    checks = tmp_path / "course" / "exercises" / "exercise1" / "checks.py"
    checks.write_text(DOES, encoding="utf-8")
    monkeypatch.chdir(tmp_path / "course")
    return tmp_path / "course"


def hand_in(place, **does):
    for student, what in does.items():
        there = place / student / "exercise1"
        there.mkdir(parents=True)
        (there / "answers.toml").write_text(f'does = "{what}"\n', encoding="utf-8")
    return place


def grade_answer(course, there, out):
    """Student -> score and reason, and who was graded in this run."""
    work = GradedClass(
        find_submissions(there, list_exercises(course)), list_exercises(course), course
    )
    store = ResultStore(out)
    kept, left = plan_grading(work, store, travel=False, again=False)
    found = grade_class(work, kept, left, store, processes=2, cluster=None, say=lambda: None)
    results = {one.student: (one.grades[0].score, one.grades[0].reason) for one in found}
    return results, [job.submission.student for job in left]


def test_hanging_dying_or_greedy_job_is_named_and_stops_no_other(course, tmp_path, monkeypatch):
    monkeypatch.setattr(workers, "SECONDS", 4.0)
    there = hand_in(tmp_path / "in", ann="", ben="hang", cat="die", dan="eat", eve="", fay="")
    results, _ = grade_answer(course, there, tmp_path / "out")

    assert {name: score for name, (score, _) in results.items()} == {
        "ann": 3.0, "ben": 0.0, "cat": 0.0, "dan": 0.0, "eve": 3.0, "fay": 3.0,
    }  # fmt: skip
    assert results["ben"][1] == workers.TOO_LONG
    assert results["cat"][1] == workers.ENDED
    assert results["dan"][1] == "grading it needed more memory than this computer has"
    assert multiprocessing.active_children() == []
    _, again = grade_answer(course, there, tmp_path / "out")
    assert again == []  # what hung is not tried again


def test_ctrl_c_ends_a_run_whose_worker_hangs(course, tmp_path):
    there = hand_in(tmp_path / "in", ben="hang")
    work = GradedClass(
        find_submissions(there, list_exercises(course)), list_exercises(course), course
    )
    store = ResultStore(tmp_path / "out")
    plan = plan_grading(work, store, travel=False, again=False)
    looks = []

    def stop_if_asked():
        looks.append(None)
        if len(looks) > 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        grade_class(
            work, *plan, store, processes=1, cluster=None, say=lambda: None,
            stop_if_asked=stop_if_asked,
        )  # fmt: skip
    assert multiprocessing.active_children() == []


def bomb(path):
    """A zip file of 0.1 MB that unpacks to 100 MB."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("exercise1/answers.toml", b" " * 100_000_000)


def corrupt(path):
    """A zip file whose table is whole and whose content is not."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("exercise1/answers.toml", RIGHT * 100)
    raw = bytearray(path.read_bytes())
    raw[60:90] = bytes(30)
    path.write_bytes(bytes(raw))


@pytest.mark.usefixtures("course")
def test_a_class_of_hostile_files_grades_everybody_else(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(workers, "SECONDS", 4.0)
    there = hand_in(tmp_path / "in", ann="", ben="hang", zoe="")
    bomb(there / "bomb.zip")
    corrupt(there / "corrupt.zip")
    try:
        hand_in(there, odd="")
        (there / "odd").rename(there / "odd\udcff")  # a name that is not UTF-8
        odd = "odd?"
    except (OSError, UnicodeError):  # a system whose names are all UTF-8
        odd = ""

    assert run_command(["class", str(there)]) == 1
    said = capsys.readouterr().err
    rows = (tmp_path / "in-graded" / "gradebook.csv").read_text("utf-8-sig").splitlines()[1:]
    points = dict(row.split(",")[:2] for row in rows)

    assert points["ann"] == points["zoe"] == "3"
    assert points["ben"] == points["bomb"] == points["corrupt"] == ""
    assert "bomb.zip cannot be read: exercise1/answers.toml unpacks to 100.0 MB" in said
    assert "corrupt.zip cannot be read" in said
    assert not odd or f"{odd}" in said
    index = (tmp_path / "in-graded" / "index.html").read_text("utf-8")
    assert all(name in index for name in ("ben", "bomb", "corrupt", odd))


def test_largest_accepted_zip_bomb_uses_little_memory(course, tmp_path):
    """A file within the ratio of an honest one is cut off where answers end."""
    with zipfile.ZipFile(tmp_path / "ann.zip", "w") as archive:
        archive.writestr("exercise1/answers.toml", b"#" * 5_000_000)
    (tmp_path / "in").mkdir()
    (tmp_path / "ann.zip").rename(tmp_path / "in" / "ann.zip")
    (one,) = find_submissions(tmp_path / "in", list_exercises(course))

    assert len(one.files["exercise1"]["answers.toml"]) == 1_000_001
