"""Whatever stands where a number or a word is asked for, it is a wrong answer and nothing worse."""

import re
import tomllib
from pathlib import Path

import pytest
from authored import authored_answer

from grader.exercise import exercises
from grader.submission import read_answers
from sim.core.errors import UnreadableFile

ROOT = Path(__file__).resolve().parents[1]
STUDENT = "ann"
ANSWERED_IN_TOML = [one for one in exercises(ROOT) if "answers.toml" in one.files]
SLOW = {"practice", "exercise12"}  # a tenth of a second each: some of the values are enough
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
    """The right answer of an exercise, in a folder of its own: the folder and the text."""

    def written(one):
        place = tmp_path_factory.mktemp(one.name)
        one.prepare(STUDENT, say=lambda _: None)
        for name, text in authored_answer(one, one.folder / "data" / STUDENT).items():
            (place / name).write_text(text, encoding="utf-8")
        return place, (place / "answers.toml").read_text(encoding="utf-8")

    return written


@pytest.mark.parametrize("one", ANSWERED_IN_TOML, ids=lambda one: one.name)
def test_no_value_earns_a_point_or_breaks_a_check(one, answered):
    place, right = answered(one)
    known = one.grade(place, student=STUDENT, run=False)
    assert len(VALUES) >= 60
    keys = [key for key, value in tomllib.loads(right).items() if not isinstance(value, dict)]
    for key in keys:
        line = re.compile(rf"^{re.escape(key)} = .*$", re.MULTILINE)
        asked = isinstance(tomllib.loads(right)[key], int | float) or right.count(f"\n{key} =")
        for number, value in enumerate(VALUES):
            if one.name in SLOW and number % 6:
                continue
            text, count = line.subn(lambda _, new=f"{key} = {value}": new, right)
            if not count or not asked:
                continue
            (place / "answers.toml").write_text(text, encoding="utf-8")
            found = one.grade(place, student=STUDENT, run=False)
            broken = [check.seen for check in found.checks if check.status == "error"]

            assert broken == [], f"{key} = {value[:60]}"
            assert "fault of the course" not in found.reason
            assert found.score <= known.score


@pytest.mark.parametrize("text", TOO_LONG.values(), ids=TOO_LONG)
def test_what_nobody_writes_as_an_answer_is_refused_at_once(text, tmp_path):
    (tmp_path / "answers.toml").write_text(text, encoding="utf-8")

    with pytest.raises(UnreadableFile) as refused:
        read_answers(tmp_path / "answers.toml")
    assert re.search(r"characters|too deep", str(refused.value))


@pytest.mark.parametrize(
    "content",
    [b"", b"\xe4\xf6\xfc = 1\n", b"#" * 1_100_000],
    ids=["empty", "Latin-1", "too large"],
)
def test_a_function_that_cannot_be_read_is_said_and_is_nobodys_fault(content, answered):
    (one,) = (one for one in ANSWERED_IN_TOML if one.name == "exercise9")
    place, _ = answered(one)
    (place / "fit.py").write_bytes(content)
    found = one.grade(place, student=STUDENT)
    (function,) = (check for check in found.checks if check.id == "function")

    assert (found.status, function.status, function.points) == ("failed", "not-reached", 0.0)
    assert "fit.py" in function.seen
