"""Three tools on one task: how each is given it, what is run, and where its scores stand."""

import json
import os
import subprocess
import sys
import time
import venv
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from bench_class import CODE
from bench_grade import spent

BAND = 0.1  # [share] of the key that a right number may be off
KERNEL = "ipykernel"  # what notebooks run in; not every tool brings it along
GAINS = ("kS", "kV", "kA")

Numbers = Mapping[str, float]
Scores = Mapping[str, tuple[float, ...]]  # student -> points for each number

CHECKS = '''"""Three numbers of a fixed log."""

from grader.answers.number_answer import AskedNumber, Band, read_answer_number
from grader.check import Check, WrongAnswer, check
from grader.answers.submission import read_answers

FILES = ("answers.toml",)
KEY = {key}


def read(path, *, student):
    """The numbers as they were written."""
    return read_answers(path)


def _of(name):
    def look(answers):
        asked = AskedNumber(name, KEY[name], "", Band({band}, {band}))
        if not asked.is_right(read_answer_number(answers.get(name), asked)):
            raise WrongAnswer("outside", hint="Fit once more.")

    look.__name__, look.__doc__ = name, f"{{name}} of the log."
    return check(points=1)(look)


kS, kV, kA = (_of(name) for name in KEY)
'''
OTTER = """OK_FORMAT = False
name = "{name}"
from otter.test_files import test_case

@test_case(points=1)
def test_it({name}):
    assert abs({name} - {key!r}) <= {width!r}
"""
GRADEBOOK = """
import json
from nbgrader.api import Gradebook
with Gradebook("sqlite:///gradebook.db") as book:
    print(json.dumps({
        one.student.id: {grade.name: grade.score for grade in one.notebooks[0].grades}
        for one in book.assignment_submissions("task")
    }))
"""


@dataclass(frozen=True)
class Timed:
    """One tool's run.

    Args:
        command: what was timed.
        seconds: wall time [s].
        work: processor time of it all [s].
        scores: of every submission.
    """

    command: str
    seconds: float
    work: float
    scores: Scores


@dataclass(frozen=True)
class Task:
    """What is graded: the key, and what everybody hands in."""

    key: Numbers
    given: Mapping[str, Numbers]


def said(command: list[str], folder: Path, *, tools: Path | None = None) -> str:
    """Run a command to its end; what it says.

    Raises:
        RuntimeError: it failed.
    """
    surroundings = dict(os.environ)
    if tools:
        surroundings["PATH"] = os.pathsep.join((str(tools), surroundings["PATH"]))
    ran = subprocess.run(
        command, cwd=folder, capture_output=True, check=False, env=surroundings, encoding="utf-8"
    )
    if ran.returncode:
        raise RuntimeError(f"{' '.join(command[:4])}: {(ran.stderr or ran.stdout)[-600:]}")
    return ran.stdout


def timed(command: str, run: Callable[[], object], scores: Callable[[], Scores]) -> Timed:
    """Run, and read the scores afterwards."""
    before, begin = spent(), time.perf_counter()
    run()
    took, work = time.perf_counter() - begin, spent() - before
    return Timed(command, took, work, scores())


def ours(folder: Path, asked: Task) -> Timed:
    """A course of one exercise, and a class that answers it."""
    exercise, handed_in = folder / "exercises" / "exercise1", folder / "class"
    exercise.mkdir(parents=True)
    (folder / "lessons").mkdir()
    checks = CHECKS.format(key=dict(asked.key), band=BAND)
    (exercise / "checks.py").write_text(checks, encoding="utf-8")
    (exercise / "README.md").write_text("# Exercise 1: Three numbers\n", encoding="utf-8")
    for who, numbers in asked.given.items():
        place = handed_in / who / "exercise1"
        place.mkdir(parents=True)
        text = "".join(f"{name} = {value!r}\n" for name, value in numbers.items())
        (place / "answers.toml").write_text(text, encoding="utf-8")

    def scores() -> Scores:
        kept = [
            json.loads(path.read_text(encoding="utf-8"))
            for path in (folder / "class-graded" / "results").glob("*.json")
        ]
        return {
            one["student"]: tuple(check["points"] for check in one["records"][0]["checks"])
            for one in kept
        }

    command = [sys.executable, "-c", CODE, "class", "class", "--processes", "1"]
    return timed("grade class class --processes 1", lambda: said(command, folder), scores)


def installed(name: str, place: Path) -> Path:
    """The folder of the commands of an environment with one package of the index."""
    environment = place / name
    commands = environment / ("Scripts" if os.name == "nt" else "bin")
    if not (environment / "ready").is_file():
        venv.create(environment, with_pip=True, clear=True)
        said([str(commands / "python"), "-m", "pip", "install", "--quiet", name, KERNEL], place)
        (environment / "ready").touch()
    return commands


def notebook(cells: list[tuple[str, dict[str, object]]]) -> str:
    """A notebook of code cells with these texts and metadata."""
    made = [
        {
            "cell_type": "code",
            "id": f"cell{number}",
            "metadata": metadata,
            "source": text,
            "outputs": [],
            "execution_count": None,
        }
        for number, (text, metadata) in enumerate(cells)
    ]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    metadata = {"kernelspec": kernel}
    return json.dumps({"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5})


def answer(numbers: Numbers) -> str:
    """The cell that a student fills in."""
    return "\n".join(f"{name} = {value!r}" for name, value in numbers.items())


def otter(folder: Path, asked: Task, commands: Path) -> Timed:
    """One ``otter run`` after another."""
    (folder / "tests").mkdir(parents=True)
    for name, key in asked.key.items():
        text = OTTER.format(name=name, key=key, width=BAND * key)
        (folder / "tests" / f"{name}.py").write_text(text, encoding="utf-8")
    tool = str(commands / "otter")
    said([tool, "generate", "-o", "autograder.zip", "--no-environment"], folder, tools=commands)
    for who, numbers in asked.given.items():
        (folder / f"{who}.ipynb").write_text(notebook([(answer(numbers), {})]), encoding="utf-8")
        (folder / who).mkdir()

    def run() -> None:
        for who in asked.given:
            said([tool, "run", "--no-logo", "-o", who, f"{who}.ipynb"], folder, tools=commands)

    def scores() -> Scores:
        results = {
            who: json.loads((folder / who / "results.json").read_text(encoding="utf-8"))["tests"]
            for who in asked.given
        }
        return {
            who: tuple(next(one["score"] for one in tests if one["name"] == gain) for gain in GAINS)
            for who, tests in results.items()
        }

    return timed("otter run -o OUT SUBMISSION.ipynb, for each", run, scores)


def nbgrader(folder: Path, asked: Task, commands: Path) -> Timed:
    """A course of one assignment, graded at one go."""

    def marked(**more: object) -> dict[str, object]:
        plain = {"schema_version": 3, "grade": False, "locked": False, "solution": False}
        return {"nbgrader": {**plain, "task": False, **more}}

    tests = [
        (
            f"assert abs({name} - {key!r}) <= {BAND * key!r}",
            marked(grade=True, locked=True, grade_id=name, points=1, cell_type="code"),
        )
        for name, key in asked.key.items()
    ]
    filled = marked(solution=True, grade_id="answer", cell_type="code")
    source = folder / "source" / "task"
    source.mkdir(parents=True)
    text = notebook([(answer(asked.key), filled), *tests])
    (source / "task.ipynb").write_text(text, encoding="utf-8")
    tool = str(commands / "nbgrader")
    said([tool, "generate_assignment", "task"], folder, tools=commands)
    released = (folder / "release" / "task" / "task.ipynb").read_text(encoding="utf-8")
    for who, numbers in asked.given.items():
        place = folder / "submitted" / who / "task"
        place.mkdir(parents=True)
        made = json.loads(released)
        made["cells"][0]["source"] = answer(numbers)
        (place / "task.ipynb").write_text(json.dumps(made), encoding="utf-8")

    def scores() -> Scores:
        book = json.loads(said([str(commands / "python"), "-c", GRADEBOOK], folder, tools=commands))
        return {who: tuple(found[gain] for gain in GAINS) for who, found in book.items()}

    command = [tool, "autograde", "task"]
    return timed("nbgrader autograde task", lambda: said(command, folder, tools=commands), scores)
