"""What a class's package gives away: no right answer of a student, and no key to look one up."""

import json
import os
import re
import subprocess
import sys
import tomllib
from functools import cache

import pytest
from places import ROOT, read_all
from test_release import lay_out, read

from grader.answers.answer_key import load_answer_key
from grader.classroom.bundle import pack_course
from grader.classroom.release import StudentPackage, make_student_package, pack_course_folder
from grader.course.package_files import select_package_files
from grader.exercise.course_check import solve
from grader.exercise.exercise import Exercise, list_exercises
from grader.student_data.variant import use_class_secret

pytestmark = pytest.mark.slow

SECRET = b"0123456789abcdef-keys"
STUDENT = "ann"
EXERCISES = {one.name: one for one in list_exercises(ROOT)}
FILLED_IN = [name for name, one in EXERCISES.items() if "answers.toml" in one.files]
DATA = (".csv", ".wpilog")
LITTLE = 1 / 3  # [share] of an exercise: what guessing may earn, see test_guessing

SOLVER = """
# Answers everything from what a package's own modules hold: options with shares, tables of answers.
import importlib, json, sys
from pathlib import Path
from grader.exercise.exercise import list_exercises

ABOUT = ("right", "correct", "decision", "always", "answer", "solution", "expected")

def look(thing):
    options = getattr(thing, "options", ())
    if options and hasattr(options[0], "share"):
        return max(options, key=lambda one: one.share).text
    found = thing if isinstance(thing, (str, float)) else None
    words = (getattr(thing, about, "") for about in ABOUT)
    return found or next((word for word in words if isinstance(word, str) and word), None)

answers = {}
for one in list_exercises(Path.cwd()):
    names = {*one.answer_names}
    mine = answers.setdefault(one.name, {})
    for path in one.folder.glob("*.py"):
        try:
            module = importlib.import_module(f"{one.module.__name__}.{path.stem}")
        except Exception:
            continue
        for value in vars(module).values():
            pairs = value.items() if isinstance(value, dict) else ()
            if isinstance(value, tuple):
                pairs = [(getattr(item, "name", None), item) for item in value]
            for name, item in pairs:
                if isinstance(name, str) and name in names and look(item) is not None:
                    mine[name] = look(item)
print(json.dumps(answers))
"""


@pytest.fixture(scope="module", params=[False, True], ids=["class", "self-study"])
def common(request, tmp_path_factory):
    """The common package of a class and that for self-study, unpacked; whether it has keys."""
    files = read(pack_course_folder(select_package_files(ROOT, with_keys=request.param).files))
    return lay_out(tmp_path_factory.mktemp("common"), files), request.param


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory):
    """The folder of both of a student's zip files, unpacked."""
    files = read(pack_course_folder(select_package_files(ROOT, with_keys=False).files))
    mine = make_student_package(StudentPackage(STUDENT, SECRET, "East", pack_course(ROOT)))[1]
    return lay_out(tmp_path_factory.mktemp(STUDENT), files, read(mine))


@pytest.fixture(scope="module")
def right(unpacked):
    """Exercise -> name -> right answer."""
    return {
        name: _flatten(solve(EXERCISES[name], _find_data(unpacked, name))) for name in FILLED_IN
    }


def _find_data(course, name):
    (data,) = (course / "exercises" / name / "data").iterdir()
    return data


def _flatten(files):
    """Name -> answer, also of the tables of exercise 12: velocity-filter.lag."""
    found = tomllib.loads(files["answers.toml"])
    tables = {name: one for name, one in found.items() if isinstance(one, dict)}
    left_out = {*tables, "language"}  # in which language a learner writes is their own choice
    plain = {name: one for name, one in found.items() if name not in left_out and one != ""}
    return plain | {f"{t}.{name}": one for t, some in tables.items() for name, one in some.items()}


@cache
def list_texts(course):
    """File -> its text; of a log, the names and metadata among its bytes."""
    return {name: content.decode("latin-1") for name, content in read_all(course).items()}


def shows(text, name, answer):
    """Whether a text gives the answer to a question: its name, and right after it the answer."""
    if name not in text:
        return False
    if isinstance(answer, list):
        answer = r'",\s*"'.join(map(re.escape, answer))
    elif isinstance(answer, float):
        answer = re.escape(f"{answer:.3g}")
    else:
        answer = re.escape(str(answer))
    return bool(re.search(rf"\b{re.escape(name)}\b[\"']?\s*[:=,]\s*[\"'\[(]*{answer}", text))


@pytest.mark.parametrize("name", FILLED_IN)
def test_no_file_gives_a_right_answer_of_its_student(name, unpacked, right):
    for file, text in list_texts(unpacked).items():
        if file.startswith(("lessons/", "exercises/")) and f"/{name}/" not in file:
            continue  # a lesson teaches; kS of another exercise is another kS
        given = {one for one, value in right[name].items() if shows(text, one, value)}

        assert given == set(), file


def test_right_numbers_appear_nowhere_to_four_digits(unpacked, right):
    numbers = {
        f"{abs(value):.4g}": f"{name}: {answer}"
        for name, answers in right.items()
        for answer, value in answers.items()
        if isinstance(value, float) and len(f"{abs(value):.4g}".strip("0.").replace(".", "")) == 4
    }
    assert len(numbers) > 20
    for file, text in list_texts(unpacked).items():
        if file.endswith(DATA) or "/data/" not in file:
            continue
        there = {*re.findall(r"(?<![\d.])\d+\.\d+", text)}

        assert {numbers[one] for one in there & numbers.keys()} == set(), file


def test_a_class_gets_no_key_and_no_text_of_one(unpacked):
    keys = ROOT.glob("exercises/*/answer_key.py")
    everything = "".join(
        text for file, text in list_texts(unpacked).items() if "/data/" not in file
    )
    eleventh = load_answer_key(EXERCISES["exercise11"].module.__name__)
    options = [o.text for one in eleventh.QUESTIONS.values() for o in one.options if o.share]

    assert {path.parent.name for path in keys} >= {"exercise3", "exercise6", "exercise11"}
    for kind in ("exercises/*/answer_key.py", "**/*.pyc"):
        assert list(unpacked.glob(kind)) == []
    assert [one for one in options if len(one) > 20 and one in everything] == []


def test_a_solver_that_only_reads_the_package_earns_what_guessing_earns(common, tmp_path):
    course, has_keys = common
    done = subprocess.run(
        [sys.executable, "-c", SOLVER],
        cwd=course,
        env={**os.environ, "PYTHONPATH": str(course), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=True,
    )
    shares = {}
    with use_class_secret(SECRET):
        for name in FILLED_IN:
            lines = [f"{n} = {json.dumps(a)}" for n, a in json.loads(done.stdout)[name].items()]
            (tmp_path / "answers.toml").write_text("\n".join(lines), encoding="utf-8")
            grade = EXERCISES[name].grade(tmp_path / "answers.toml", student=STUDENT, run=False)
            shares[name] = grade.score / grade.max_score

    assert {one: share for one, share in shares.items() if share > LITTLE} == (
        {"exercise11": pytest.approx(31 / 39), "exercise3": 0.4} if has_keys else {}
    )


def test_a_class_package_grades_numbers_at_home_and_names_who_checks_the_words(common):
    course, has_keys = common
    third, eleventh = (
        Exercise(name, course / "exercises" / name) for name in ("exercise3", "exercise11")
    )
    results = {one.id: one for one in third.grade(None, student="practice").checks}
    words = results["elevator-type"]

    assert results["elevator-kg"].status == "failed"  # with feedback
    assert words.status == ("failed" if has_keys else "not-reached")
    assert ("only your instructor can check this" in words.seen) != has_keys
    eleventh.prepare("practice", say=lambda _: None)
    assert (eleventh.folder / "data").is_dir() == has_keys
    assert eleventh.grade(None, student="practice").status == (
        "failed" if has_keys else "ungradable"
    )
