"""Whatever stands where a number or a word is asked for, it is a wrong answer and nothing worse."""

import re
import time
import tomllib
from functools import cache

import pytest
from places import ROOT

from grader.answers.submission import read_answers
from grader.exercise.course_check import prepare_solved
from grader.exercise.exercise import list_exercises
from sim.core.errors import UnreadableFile

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("robot_code_once")]

STUDENT = "ann"
ANSWERED_IN_TOML = [one for one in list_exercises(ROOT) if "answers.toml" in one.files]
PATIENCE = 5.0  # [s] of the processor for one answer, the first one of a process left out
# Values that say what an answer may be, in whatever way they are written: they may earn points.
MEANT = {
    ("exercise6", "step", '"1 V per V per V"'): "a volt, as V per (V per V)",
    ("exercise8", "forward", "[1, 2]"): "from 1 s to 2 s",
    ("exercise8", "reverse", "[1, 2]"): "from 1 s to 2 s",
    ("exercise8", "threshold", "1e-320"): "0, which drops nothing",
    ("exercise8", "threshold", "0x7fffffffffffffff"): "no ramps; the steps are right as they were",
}
ONE = "0b1"  # the number 1, which is a good answer where an answer is about 1
DEEP = "[" * 400 + "]" * 400
VALUES = (
    '"x"', "true", "false", "[]", "[[]]", "[[[[1]]]]", '["a"]', '["a", "a"]', "[1, 2]", "{}",
    "{a = 1}", "{a = {b = 1}}", "-1", "1e400", "nan", "inf", "-inf", "9" * 1900, "1e-320",
    "0x7fffffffffffffff", '"9999e9999"', '"1 V per V per V"', '"' + "1 V" + " per V" * 300 + '"',
    '"1 m' + " " * 1500 + 'x"', '"1,5,5"', '"\\u0000"', '"\\u001b[31m"', '"\\u202eabc"',
    "1979-05-27", "1979-05-27T07:32:00Z", "07:32:00", '"""a\nb"""', "[nan]", "[{a = 1}, {b = 2}]",
    '["wheel-size", 1]', '"%s%n"', '"{0}"', '"{0.__class__}"', '"<script>"', '"../../etc/passwd"',
    '"/dev/zero"', '".."', '"None"', '"' + "a" * 1900 + '"', DEEP, "[1e308, 1e308]",
    "-9223372036854775808", '"-"', '"∞"', '"=1+1"', "{start_s = 1, end_s = 0}",
    '[{fault = "encoder-slip", start_s = "x", end_s = nan}]', '"(((((((((("', '"1 V^9^9^9"',
    '"1 V/(m/(s/(V/(m))))"', '"1 °°°"', '"٣٫٥٣"', '"½"', "[true, false]", '"\\t\\n"', "0b1",
)  # fmt: skip
TOO_LONG = {
    "a key of 100 kB": ".".join("a" * 50_000) + " = 1\n",
    "a number of 5,000 digits": "kV = " + "1" * 5_000 + "\n",
    "lists in lists": "kV = " + "\n".join("[" * 1900) + "\n" + "\n".join("]" * 1900) + "\n",
    "fifty thousand keys": "".join(f"a{number} = 1\n" for number in range(50_000)),
}


@pytest.fixture(scope="module")
def answered(tmp_path_factory):
    """Copies an exercise, once, and solves it: the copy and the text of its answers."""

    @cache
    def written(one):
        solved = prepare_solved(one, STUDENT, tmp_path_factory.mktemp(one.name))
        for name, text in solved.right.items():
            (solved.exercise.folder / name).write_text(text, encoding="utf-8")
        return solved.exercise, solved.right["answers.toml"]

    return written


def single_lines(right):
    """Every answer that stands on a line of its own, and the pattern of that line."""
    for key, value in tomllib.loads(right).items():
        line = re.compile(rf"^{re.escape(key)} = .*$", re.MULTILINE)
        found = line.search(right)
        if not isinstance(value, dict) and found and found[0].count("[") == found[0].count("]"):
            yield key, line


def may_earn(one, key, value):
    """Whether a value is an answer there, however it is written."""
    part = key.rpartition("_")[2]
    return value == ONE or (one.name, part, value) in MEANT


@pytest.mark.parametrize("one", ANSWERED_IN_TOML, ids=lambda one: one.name)
def test_no_value_earns_a_point_breaks_a_check_or_takes_long(one, answered):
    copy, right = answered(one)

    def grade(key, line, value):
        text = line.sub(lambda _: f"{key} = {value}", right)
        (copy.folder / "answers.toml").write_text(text, encoding="utf-8")
        begun = time.process_time()
        return copy.grade(copy.folder, student=STUDENT, run=False), time.process_time() - begun

    assert len(VALUES) >= 60
    for key, line in single_lines(right):
        unanswered, _ = grade(key, line, '""')
        for value in VALUES:
            found, seconds = grade(key, line, value)
            broken = [check.seen for check in found.checks if check.status == "error"]

            assert broken == [], f"{key} = {value[:60]}"
            assert "fault of the course" not in found.reason
            assert found.score <= unanswered.score or may_earn(one, key, value), (key, value[:60])
            assert seconds < PATIENCE, f"{key} = {value[:60]}"


@pytest.mark.parametrize("one", ANSWERED_IN_TOML, ids=lambda one: one.name)
def test_the_same_value_everywhere_earns_nothing(one, answered):
    copy, right = answered(one)
    for value in VALUES:
        text = right
        for key, line in single_lines(right):
            text = line.sub(lambda _, new=f"{key} = {value}": new, text)
        (copy.folder / "answers.toml").write_text(text, encoding="utf-8")

        assert copy.grade(copy.folder, student=STUDENT, run=False).score == 0, value[:60]


@pytest.mark.parametrize("text", TOO_LONG.values(), ids=TOO_LONG)
def test_absurd_value_is_refused_at_once(text, tmp_path):
    (tmp_path / "answers.toml").write_text(text, encoding="utf-8")

    with pytest.raises(UnreadableFile) as refused:
        read_answers(tmp_path / "answers.toml")
    assert re.search(r"characters|too deep", str(refused.value))


@pytest.mark.parametrize(
    "content",
    [b"", b"\xe4\xf6\xfc = 1\n", b"#" * 1_100_000],
    ids=["empty", "Latin-1", "too large"],
)
def test_unreadable_function_is_reported_and_not_blamed_on_the_learner(content, answered):
    (one,) = (one for one in ANSWERED_IN_TOML if one.name == "exercise9")
    copy, _ = answered(one)
    (copy.folder / "fit.py").write_bytes(content)
    found = copy.grade(copy.folder, student=STUDENT)
    (function,) = (check for check in found.checks if check.id == "function")

    assert (found.status, function.status, function.points) == ("failed", "not-reached", 0.0)
    assert "fit.py" in function.seen


@pytest.mark.parametrize(
    "row",
    ["verdict = inspect", "steps = [run-tests, place-gains]  # in order", "release = timeout"],
)
def test_a_word_without_quotes_gets_the_advice_to_add_them(tmp_path, row):
    path = tmp_path / "answers.toml"
    path.write_text(f"{row}\n", encoding="utf-8")

    with pytest.raises(UnreadableFile, match="Put quotes around each word"):
        read_answers(path)
