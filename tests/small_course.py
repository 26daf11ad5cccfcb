"""A course of one small exercise, to test the examiner with."""

CHECKS = '''
"""An exercise to test the examiner with."""
from grader.checks.check import WrongAnswer, check
from grader.answers.submission import read_answers
FILES = ("answers.toml",)

def read(path, *, student):
    return read_answers(path)

@check(points=2)
def size(answers):
    """The size is 3."""
    if answers.get("size") == "boom":
        raise KeyError("boom")
    if answers.get("size") != 3:
        raise WrongAnswer(
            str(answers.get("size")), hint="Measure again: ≈ ±1 is enough.", misconception="M-UNITS"
        )

@check(points=1, after=size)
def color(answers):
    """The color is green."""
    if answers.get("color") != "green":
        raise WrongAnswer(str(answers.get("color")), hint="Look again.", earned=0.5)
'''
HINTS = 'concept = "The size is a length."\npointer = "Look at the ruler."\nstep = "One, two, …"\n'

RIGHT, HALF = 'size = 3\ncolor = "green"\n', 'size = 3\ncolor = "blue"\n'  # 3 and 2.5 of 3 points


def lay_out(course):
    """Lay out the course in an empty folder; its answer is wrong."""
    folder = course / "exercises" / "exercise1"
    folder.mkdir(parents=True)
    (course / "lessons").mkdir()
    (folder / "README.md").write_text("# Exercise 1: Measure\n\ngrade exercise1\n", "utf-8")
    (folder / "checks.py").write_text(CHECKS, "utf-8")
    (folder / "hints.toml").write_text(HINTS, "utf-8")
    answer(course, "size = 0\n")


def answer(course, text):
    """Write the learner's answer."""
    (course / "exercises" / "exercise1" / "answers.toml").write_text(text, "utf-8")


def put(folder, files):
    """Write files: path within the folder -> text."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
