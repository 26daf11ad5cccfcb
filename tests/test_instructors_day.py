"""An instructor's day, typed from the guide: release, start, answer, hand in, grade, export.

On the real course, in a folder with a space and an umlaut in its name, with relative paths. Each
student answers in the authored way and hands it in as another school does. The day is gone through
with the code of this folder, and once more, by one student, with what pip makes of the wheel.
"""

import csv
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import zipfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from places import ROOT
from wheel import LEFT_OUT, build_wheel

from grader.exercise.course_check import list_mistakes, solve
from grader.exercise.exercise import find_exercise, list_exercises
from grader.student_data.variant import use_class_secret
from sim.support.student_names import make_folder_name

pytestmark = pytest.mark.slow

if TYPE_CHECKING:
    from collections.abc import Callable

WHOLE = 239  # points of the thirteen exercises and of practice
PROGRAMS = {"grade": "grader.cli", "sysid": "sim.cli"}
ALONE = ("Anna Bauer", "Diaz Cara", "week-3-ginah-2010")  # exercises in folders, whole courses
TRIED = "exercise12"  # found by trying, which takes ten seconds: some students answer it
TRYING = ("Anna Bauer", "Jane Doe", "Gina Hall")
LESSONS_SHOWN = 1  # of the eleven that `grade edition` runs: the others take minutes


@dataclass(frozen=True)
class Student:
    """One student, and how their school hands in."""

    name: str
    canvas_id: str
    github: str
    hand_in: "Callable[[Path, Path], None]"  # the student's course folder, the class's folder


def pack(source: Path, target: Path, *, top: str = "") -> None:
    """Pack a folder as a browser or a file manager would."""
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(source.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                archive.write(path, Path(top, path.relative_to(source)).as_posix())


def _as_folders(course: Path, there: Path) -> None:
    for one in list_exercises(course):
        target = there / "Anna Bauer" / one.name
        target.mkdir(parents=True)
        for name in (*one.files, *one.companion_files):
            shutil.copy(one.folder / name, target)


def _as_course(course: Path, there: Path) -> None:
    shutil.copytree(course, there / "Diaz Cara" / "course")  # family name first


STUDENTS = (
    Student("Anna Bauer", "101", "anna-b", _as_folders),
    Student("Ben Öztürk", "102", "benoz", lambda course, there: pack(
        course / "exercises", there / "Ben Öztürk.zip", top="exercises")),
    Student("Cara Diaz", "103", "cara", _as_course),
    Student("Jane Doe", "104", "jdoe", lambda course, there: pack(
        course / "exercises", there / "doejane_LATE_104_5555_exercises-1.zip", top="exercises")),
    Student("Eve Fox", "105", "evefox", lambda course, there: pack(
        course, there / "Eve Fox - my work.zip", top="course")),
    Student("Gina Hall", "106", "ginah-2010", lambda course, there: shutil.copytree(
        course, there / "week-3-ginah-2010")),
    Student("Finn Gray", "107", "finn", lambda course, there: (
        (there / "Finn Gray_4711_assignsubmission_file_").mkdir(),
        pack(course / "exercises", there / "Finn Gray_4711_assignsubmission_file_" / "work.zip"))),
)  # fmt: skip


def commands(heading: str) -> list[list[str]]:
    """Our commands that the guide prints under a heading, as a shell would split them."""
    guide = (ROOT / "INSTRUCTORS.md").read_text(encoding="utf-8")
    section = guide.partition(f"\n## {heading}")[2].partition("\n## ")[0]
    blocks = re.findall(r"```shell\n(.*?)```", section, flags=re.DOTALL)
    lines = [shlex.split(line) for block in blocks for line in block.splitlines()]
    return [words for words in lines if words[0] in PROGRAMS]


def start(words: list[str], *, cwd: Path, installed: Path = ROOT) -> "subprocess.Popen[str]":
    """Start one of our commands as a terminal would; ``installed`` is where its code lies."""
    code = f"from {PROGRAMS[words[0]]} import main; main()"
    environment = {**os.environ, "PYTHONPATH": str(installed), "COLUMNS": "200", "PYTHONUTF8": "1"}
    for name in ("SYSID_SECRET", "PYTHONUNBUFFERED"):
        environment.pop(name, None)
    return subprocess.Popen(
        [sys.executable, "-P", "-c", code, *words[1:]], cwd=cwd, env=environment, encoding="utf-8",
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip


def say(words: list[str], *, cwd: Path, code: int = 0, installed: Path = ROOT) -> str:
    """Run one of our commands; what it says."""
    running = start(words, cwd=cwd, installed=installed)
    said, _ = running.communicate(timeout=600)
    assert running.returncode == code, f"{shlex.join(words)}:\n{said}"
    return said


def fetched(place: Path, students: tuple[Student, ...] = STUDENTS) -> Path:
    """The instructor's copy of the course, as it is fetched, and a roster beside it."""
    shutil.copytree(ROOT, place, ignore=shutil.ignore_patterns(*LEFT_OUT))
    rows = [("student", "ID", "github_username")]
    rows += [(one.name, one.canvas_id, one.github) for one in students]
    with (place.parent / "roster.csv").open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream).writerows(rows)
    return place


def answered(student: Student, packages: Path, place: Path, *, installed: Path = ROOT) -> Path:
    """A student's own course folder: unzipped, started without a name, answered."""
    for name in ("course.zip", f"students/{make_folder_name(student.name)}.zip"):
        with zipfile.ZipFile(packages / name) as archive:
            archive.extractall(place)
    mine = place / "course"
    said = say(["grade", "start", "--no-lab"], cwd=mine, installed=installed)
    assert student.name in said
    for one in list_exercises(mine):
        data = one.folder / "data"
        folders = [path.name for path in data.iterdir()] if data.is_dir() else []
        assert folders in ([], [make_folder_name(student.name)]), "somebody else's numbers"
        if one.name == TRIED and student.name not in TRYING:
            continue
        texts = solve(
            one,
            data / make_folder_name(student.name),
            solution=ROOT / "solutions" / one.name,
        )
        for name, text in texts.items():
            (one.folder / name).write_text(text, encoding="utf-8")
    return mine


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """Where the instructor works."""
    return fetched(tmp_path_factory.mktemp("day") / "Robotik für alle" / "the course")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """What pip makes of the wheel: the packages, and no course around them."""
    place = tmp_path_factory.mktemp("wheel")
    with zipfile.ZipFile(build_wheel(place)) as opened:
        opened.extractall(place / "site-packages")
    return place / "site-packages"


@pytest.fixture(scope="module")
def packages(course):
    """What the guide's first command makes."""
    (release,) = (words for words in commands("A class") if words[1] == "release")
    say(release, cwd=course)
    return course.parent / "packages"


@pytest.fixture(scope="module")
def at_home(course, packages):
    """Each student's own course folder."""
    homes = course.parent / "homes of students"
    return {one.name: answered(one, packages, homes / one.github) for one in STUDENTS}


@pytest.fixture(scope="module")
def handed_in(course, at_home):
    """The class's folder, with a hand-in of each form."""
    there = course.parent / "handed-in"
    there.mkdir()
    for one in STUDENTS:
        one.hand_in(at_home[one.name], there)
    return there


def points_of(out: Path) -> dict[str, list[float]]:
    """Student -> points by exercise, and in all, as the gradebook has them."""
    with (out / "gradebook.csv").open(encoding="utf-8-sig", newline="") as stream:
        rows = list(csv.reader(stream))[1:]
    return {row[0]: [float(cell or 0) for cell in row[1:-3]] for row in rows}


def test_a_class_earns_every_point_of_its_answers_in_every_form_of_handing_in(course, handed_in):
    (grade,) = (words for words in commands("A class") if words[1] == "class")
    said = say([*grade, "--export", "canvas"], cwd=course)
    out = handed_in.with_name("handed-in-graded")
    totals = {name: points[-1] for name, points in points_of(out).items()}
    with (out / "canvas.csv").open(encoding="utf-8", newline="") as stream:
        canvas = list(csv.reader(stream))

    tried = sum(check.points for check in find_exercise(TRIED, course).checks)
    earned = {one.name: WHOLE - tried * (one.name not in TRYING) for one in STUDENTS}
    assert totals == earned, said
    assert {(row[0], row[1]): float(row[-1]) for row in canvas[2:]} == {
        (one.name, one.canvas_id): earned[one.name] for one in STUDENTS
    }
    assert (out / "index.html").is_file()


def test_each_exercise_alone_earns_every_point_too(course, handed_in):
    alone = course.parent / "some of them"
    for name in ALONE:
        shutil.copytree(handed_in / name, alone / name)
    for number, one in enumerate(list_exercises(course)[::5]):  # each takes four seconds
        out = handed_in.with_name(f"alone-{number}")
        words = ["grade", "class", f"../{alone.name}", "--roster", "../roster.csv", "--secret",
                 "../class.secret", "--exercise", one.name, "-o", f"../{out.name}"]  # fmt: skip
        say(words, cwd=course)
        most = sum(check.points for check in one.checks)

        earned = [points[-1] for points in points_of(out).values() if points[-1]]
        assert earned == [most] * len(ALONE), one.name


def test_planted_mistakes_lose_in_a_class_what_they_lose_one_by_one(course, at_home, tmp_path):
    student = STUDENTS[0]
    there = tmp_path / "in" / student.name
    shutil.copytree(at_home[student.name] / "exercises", there)
    expected = {}
    for one in list_exercises(course):
        mistake = list_mistakes(replace(one, folder=ROOT / "exercises" / one.name))[0]
        file = there / one.name / mistake.file
        file.write_text(mistake.edit_text(file.read_text(encoding="utf-8")), encoding="utf-8")
        secret = (course.parent / "class.secret").read_bytes().strip()
        with use_class_secret(secret):
            expected[one.name] = one.grade(there / one.name, student=student.name).score
    words = ["grade", "class", str(tmp_path / "in"), "--roster", "../roster.csv", "--secret",
             "../class.secret", "-o", str(tmp_path / "out")]  # fmt: skip
    say(words, cwd=course)
    points = points_of(tmp_path / "out")[student.name]

    assert dict(zip(expected, points, strict=False)) == expected
    assert points[-1] < WHOLE


def test_another_students_package_is_named_and_not_graded(course, at_home, tmp_path):
    shutil.copytree(at_home["Anna Bauer"], tmp_path / "in" / "Ben Öztürk")
    words = ["grade", "class", str(tmp_path / "in"), "--roster", "../roster.csv", "--secret"]
    said = say([*words, "../class.secret"], cwd=course, code=1)

    assert "its package was issued to Anna Bauer, and Ben Öztürk handed it in" in said
    assert points_of(tmp_path / "in-graded")["Ben Öztürk"][-1] == 0


def test_without_the_secret_nothing_is_graded_on_other_numbers(course, at_home, tmp_path):
    shutil.copytree(at_home["Anna Bauer"] / "exercises", tmp_path / "in" / "Anna Bauer")
    said = say(["grade", "class", str(tmp_path / "in")], cwd=course, code=2)

    assert "the numbers of Anna Bauer were made for the class Robotics 1, which has" in said
    assert not (tmp_path / "in-graded").exists()


def test_datasets_and_pages_are_made_as_the_guide_says(course):
    for words in commands("Your own damaged datasets"):
        say(words, cwd=course)
    (edition,) = commands("To show and to print")
    for path in sorted((course / "lessons").iterdir())[2 * LESSONS_SHOWN :]:
        path.unlink()
    say(edition, cwd=course)

    assert list((course.parent / "week3").rglob("*.wpilog"))
    assert (course.parent / "pages" / "handout.html").is_file()


def test_the_exports_of_the_guide_are_written(course, packages):
    assert packages.is_dir()
    for words in commands("A class"):
        if words[1] == "export":
            say(words, cwd=course)

    assert zipfile.is_zipfile(course.parent / "autograder.zip")
    assert "grade class" in (course.parent / "grade.yml").read_text(encoding="utf-8")
    assert (course.parent / "hub" / "jupyterhub_config.py").is_file()


def test_course_day_runs_the_same_from_an_installed_wheel(wheel, tmp_path):
    (pupil,) = (one for one in STUDENTS if one.name == "Jane Doe")
    course = fetched(tmp_path / "Überblick für alle" / "the course", (pupil,))
    there = course.parent / "handed-in"
    there.mkdir()
    lines = {words[1]: words for words in commands("A class") if words[1] != "export"}
    say(lines["release"], cwd=course, installed=wheel)
    mine = answered(pupil, course.parent / "packages", tmp_path / "home", installed=wheel)
    pupil.hand_in(mine, there)
    said = say(lines["class"], cwd=course, installed=wheel)
    for words in commands("A class"):
        if words[1] == "export":
            say(words, cwd=course, installed=wheel)

    assert points_of(there.with_name("handed-in-graded"))[pupil.name][-1] == WHOLE, said
    assert zipfile.is_zipfile(course.parent / "autograder.zip")


def test_every_command_in_the_guides_sentences_does_what_it_says(at_home, tmp_path):
    """Those of the blocks, and the autograder's line, are run by the tests around this one."""
    guide = re.sub(r"```.*?```", "", (ROOT / "INSTRUCTORS.md").read_text("utf-8"), flags=re.DOTALL)
    spans = set(re.findall(r"`((?:grade|sysid) [^`]+)`", re.sub(r"\s+", " ", guide)))
    home = shutil.copytree(at_home["Cara Diaz"], tmp_path / "course für mich")
    shutil.copy(home / "exercises" / "exercise9" / "answers.toml", home / "mine.toml")
    shutil.copy(home / "exercises" / "exercise9" / "fit.py", home / "fit.py")
    (log,) = (home / "exercises" / "exercise9" / "data").glob("*/log.wpilog")
    expected = {  # span -> what is typed, the exit code, what is said
        "grade EXERCISE --hint": ("grade exercise9 --hint", 0, "Hint 1"),
        "grade doctor": ("grade doctor", 0, "isolated"),
        "grade exercise9 mine.toml --student practice": ("", 1, "kV"),
        "sysid contaminate FILE --fault encoder-slip -o BAD": (
            f"sysid contaminate '{log}' --fault encoder-slip -o bad.wpilog", 0, "bad.wpilog"),
        "sysid effects": ("", 0, "drag"),
        "sysid faults": ("", 0, "encoder-slip"),
    }  # fmt: skip
    elsewhere = {"grade watch", "grade release", "grade check-course exercise14"}
    assert spans - elsewhere == {*expected} | {one for one in spans if "SUBMISSION" in one}
    for span, (typed, code, words) in expected.items():
        said = say(shlex.split(typed or span), cwd=home, code=code)

        assert words in said, span


def test_the_autograder_line_gives_gradescopes_result(course, handed_in, tmp_path):
    guide = (ROOT / "INSTRUCTORS.md").read_text(encoding="utf-8")
    line = re.search(r"`(grade class SUBMISSION [^`]+)`", guide)
    assert line is not None
    places = {"SUBMISSION": str(handed_in / "week-3-ginah-2010"), "NAME": "Gina Hall",
              "RESULTS": str(tmp_path)}  # fmt: skip
    words = [places.get(word, word) for word in line[1].split()]
    say([*words, "--secret", "../class.secret"], cwd=course)
    (path,) = tmp_path.glob("gradescope/*/results.json")
    result = json.loads(path.read_text(encoding="utf-8"))

    assert sum(test["score"] for test in result["tests"]) == sum(
        test["max_score"] for test in result["tests"]
    )
