"""What guessing earns in every exercise: one word for all answers, or all words at once."""

import re
from pathlib import Path
from statistics import mean

import pytest

from grader.course.progress import find_course
from grader.exercise.exercise import list_exercises

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("robot_code_once")]

MOST = 1 / 3  # [share] of an exercise that one word everywhere may earn, on average over students
CHANCE = 0.5  # [share] of a check that the words it can read earn on average: a coin
STUDENTS = tuple(f"guesser {number}" for number in range(4))
EXERCISES = {one.name: one for one in list_exercises(find_course(Path(__file__).resolve().parent))}
FILLED_IN = [name for name, one in EXERCISES.items() if "answers.toml" in one.files]
LETTERS_AND_NUMBERS = (*"abcdefghijk", "0", "1", "10", "timeout", "all")
NO_ANSWER = re.compile(r"nothing yet|which is n(?:o|one|ot)\b|but two times are needed|\d faults")


def list_words(one):
    """What the README and the file to fill in name as an answer, letters, and some numbers."""
    readme, starter = (
        (one.folder / name).read_text("utf-8") for name in ("README.md", "answers.toml")
    )
    named = re.findall(r"`([\w/-]+)`|^\| ([a-z-]+) \|", readme, re.MULTILINE)
    words = ["".join(found) for found in named]
    words += re.findall(r"[\w/-]+", " ".join(re.findall(r"#(.*)", starter)))
    return [*dict.fromkeys([*words, *LETTERS_AND_NUMBERS])]


def grade_filled(one, folder, student, *, word, several):
    """The results of an answer with one word everywhere, and a list of words where one is asked."""
    text = (one.folder / "answers.toml").read_text("utf-8")
    text = re.sub(r'^(\w+) = ""', rf'\1 = "{word}"', text, flags=re.MULTILINE)
    text = re.sub(r"^(\w+) = \[\]", rf"\1 = {several}", text, flags=re.MULTILINE)
    path = folder / "answers.toml"
    path.write_text(text, encoding="utf-8")
    return one.grade(path, student=student, run=False).checks


@pytest.fixture(scope="module", params=FILLED_IN)
def guessed(request, tmp_path_factory):
    """An exercise, and word -> for each student, the results of that word everywhere."""
    one, folder = EXERCISES[request.param], tmp_path_factory.mktemp("guess")
    return one, {
        word: [grade_filled(one, folder, who, word=word, several=[word]) for who in STUDENTS]
        for word in list_words(one)
    }


def sum_points(results):
    return sum(check.points for check in results)


def is_answer(check):
    """Whether a check took the word for an answer."""
    return check.status == "passed" or not NO_ANSWER.search(check.seen)


def test_the_same_answer_everywhere_earns_little(guessed):
    one, results = guessed
    most = sum(check.points for check in one.checks)
    earned = {word: mean(map(sum_points, of_all)) / most for word, of_all in results.items()}

    assert {word: share for word, share in earned.items() if share > MOST} == {}


def test_the_words_of_a_check_earn_on_average_what_chance_does(guessed):
    one, results = guessed
    for place, check in enumerate(one.checks):
        each = [of_one[place] for of_all in results.values() for of_one in of_all]
        earned = [found.points / check.points for found in each if is_answer(found)]

        assert mean(earned or [0.0]) <= CHANCE, check.id


def test_answering_with_all_words_earns_nothing(guessed, tmp_path):
    """In a list, or with a + between them; only words that some check took for an answer."""
    one, results = guessed
    for place in range(len(one.checks)):
        words = [word for word, (first, *_) in results.items() if is_answer(first[place])]
        for student in STUDENTS if words else ():
            together = " + ".join(words)
            found = grade_filled(one, tmp_path, student, word=together, several=words)

            assert found[place].points == 0, (one.checks[place].id, words)


@pytest.mark.parametrize("name", sorted(EXERCISES.keys() - {*FILLED_IN}))
def test_starter_code_earns_nothing(name):
    for file in EXERCISES[name].files:
        assert EXERCISES[name].grade(EXERCISES[name].folder / file, student="ann").score == 0
