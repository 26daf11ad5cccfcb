"""What a class's results become: item analysis, pages, and other people's formats."""

import base64
import csv
import io
import json
import math
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from page_flaws import page_flaws

from grader.checks.check import Check, Result, Status
from grader.classroom.exports import list_exports
from grader.classroom.grading import MISSING, GradedStudent, skip_student
from grader.classroom.item_analysis import analyze_items, count_misconceptions, summarize_exercises
from grader.classroom.result_pages import summarize_class, write_pages
from grader.classroom.results import ClassResults
from grader.exercise.exercise import Exercise, Grade
from sim.core.errors import BadRequest

NASTY = ("=1+1", 'O\'Neil, "Ann"', "José\u0301", "@SUM(A1)", "<script>alert(1)")
GRADESCOPE = {  # https://gradescope-autograders.readthedocs.io/en/latest/specs/#output-format
    "": {"score", "execution_time", "output", "output_format", "test_output_format",
         "test_name_format", "visibility", "stdout_visibility", "extra_data", "tests",
         "leaderboard"},
    "test": {"score", "max_score", "status", "name", "name_format", "number", "output",
             "output_format", "tags", "visibility", "extra_data"},
}  # fmt: skip
JUNIT = {  # Jenkins, junit-10.xsd: element -> what it must have, what it may have, what it may hold
    "testsuites": ((), {"name", "time", "tests", "failures", "disabled", "errors"}, {"testsuite"}),
    "testsuite": (
        ("name", "tests"),
        {"failures", "errors", "time", "disabled", "skipped", "timestamp", "hostname", "id",
         "package"},
        {"properties", "testcase", "system-out", "system-err"},
    ),
    "testcase": (
        ("name", "classname"),
        {"assertions", "time", "status"},
        {"properties", "skipped", "error", "failure", "system-out", "system-err"},
    ),
    "properties": ((), set(), {"property"}),
    "property": (("name", "value"), set(), set()),
    "failure": ((), {"type", "message"}, set()),
    "error": ((), {"type", "message"}, set()),
    "skipped": ((), {"type", "message"}, set()),
}  # fmt: skip


def result(name, points, *, most=2.0, code="", seen="", status=None):
    how = status or (Status.PASSED if points == most else Status.FAILED)
    return Result(name, f"About {name}", how, points, most, seen, "try again", code)


def student(name, *points, code="M-UNITS"):
    """Somebody who earned so many of two points on each check of two exercises."""
    grades = []
    for number, those in enumerate(points, start=1):
        checks = tuple(
            result(f"q{place}", value, code="" if value == 2 else code, seen="7 V")
            for place, value in enumerate(those)
        )
        score, most = sum(those), 2.0 * len(those)
        status = "passed" if score == most else "failed"
        grades.append(Grade(f"exercise{number}", name, score, most, status, checks))
    return GradedStudent(name, "", tuple(grades))


class OneCheck(Exercise):
    """An exercise with one check, of which nothing was handed in."""

    checks = (Check("q0", "About q0", 2.0, (), lambda _: None),)


EMPTY = OneCheck("exercise1", Path())


def some(*people):
    return ClassResults("Robotics 1", people, ("exercise1", "exercise2"))


@pytest.fixture
def results():
    """Five students with names that break careless formats, from good to nothing."""
    marks = ("2222", "2221", "2002", "0001", "0000")
    points = [[float(mark) for mark in those] for those in marks]
    return some(*(student(name, p[:2], p[2:]) for name, p in zip(NASTY, points, strict=True)))


def test_a_question_has_its_share_of_right_answers_and_its_discrimination():
    people = [student(f"s{n}", (2.0 * (n > 2), 2.0), (2.0 * (n > 3), 0.0)) for n in range(6)]
    found = {(one.exercise, one.check): one for one in analyze_items(people)}
    first = found["exercise1", "q0"]

    assert (first.tried, first.full, first.share) == (6, 3, 0.5)
    assert first.misconceptions == (("M-UNITS", 3),)
    assert first.wrong == (("7 V", 3),)
    # the rest of the points is 2 + (0, 0, 0, 0, 2, 2); Pearson by hand: 1/sqrt(2)
    assert first.discrimination == pytest.approx(1 / math.sqrt(2))
    assert found["exercise1", "q1"].discrimination is None  # all alike
    assert found["exercise2", "q1"].share == 0.0
    assert count_misconceptions(people) == (("M-UNITS", 6),)


def test_too_few_students_give_no_discrimination_index():
    people = [student(f"s{n}", (2.0 * n, 2.0)) for n in range(2)]

    assert {one.discrimination for one in analyze_items(people)} == {None}


def test_student_without_a_submission_counts_as_absent_not_as_wrong():
    absent = skip_student("zoe", [EMPTY], status=MISSING, reason="nothing")
    broken = skip_student("bob", [EMPTY], status="ungradable", reason="odd")
    (column,) = summarize_exercises([student("ann", (2.0,)), absent, broken])

    assert (column.handed_in, column.full, column.ungradable, column.mean) == (2, 1, 1, 1.0)
    assert [one.tried for one in analyze_items([student("ann", (2.0,)), absent, broken])] == [1]


def test_the_gradebook_is_safe_for_a_spreadsheet(results, tmp_path):
    (path,) = list_exports()["gradebook"].write(results, tmp_path)
    rows = list(csv.reader(io.StringIO(path.read_text("utf-8-sig"), newline="")))

    assert path.read_bytes().startswith(b"\xef\xbb\xbf")
    assert [row[0] for row in rows[1:]] == ["'=1+1", NASTY[1], NASTY[2], "'@SUM(A1)", NASTY[4]]
    assert [float(row[3]) for row in rows[1:]] == [8, 7, 4, 1, 0]
    assert not any(cell.startswith(("=", "+", "-", "@")) for row in rows for cell in row)


def test_canvas_gets_no_points_of_a_student_with_something_not_graded(tmp_path):
    unread = EMPTY.skip("empty", student="ann")
    half = GradedStudent("ann", "", (*student("ann", (2.0,)).grades, unread))
    people = some(half, student("ben", (2.0,), (0.0,)), student("cat", (2.0,), (2.0,)))
    results = replace(people, remarks={"cat": ("report.pdf is not a file of any exercise",)})
    canvas = list_exports()["canvas"]
    (path,) = canvas.write(results, tmp_path)
    with path.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.reader(stream))

    assert [row[-1] for row in rows[2:]] == ["", "2", ""]
    assert canvas.warn(results) == (
        "canvas.csv has no points for these students, because some of their work was not graded: "
        "ann; cat. Check their work, then run this again"
    )
    assert not canvas.warn(some(student("ben", (2.0,), (0.0,))))


def test_canvas_gets_its_own_columns_back(tmp_path):
    people = some(student("ann", (2.0,), (1.0,)), student("ben", (0.0,), (0.0,)))
    roster = {"ann": {"Student": "Lee, Ann", "ID": "17", "SIS Login ID": "ann", "Section": "A"}}
    known = ClassResults(people.name, people.students, people.exercises, roster)
    (path,) = list_exports()["canvas"].write(known, tmp_path)
    rows = list(csv.reader(io.StringIO(path.read_text("utf-8"), newline="")))

    assert rows[0] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Robotics 1"]
    assert (rows[1][0].strip(), rows[1][5]) == ("Points Possible", "4")
    assert rows[2] == ["Lee, Ann", "17", "", "ann", "A", "3"]
    assert rows[3] == ["ben", "", "", "", "", "0"]


def test_gradescope_can_read_the_results(results, tmp_path):
    paths = list_exports()["gradescope"].write(results, tmp_path)
    totals = []
    for path in paths:
        told = json.loads(path.read_text("utf-8"))
        assert set(told) <= GRADESCOPE[""]
        for test in told["tests"]:
            assert set(test) <= GRADESCOPE["test"]
            assert test["status"] in {"passed", "failed"}
            assert 0 <= test["score"] <= test["max_score"]
            assert isinstance(test["tags"], list)
        totals.append(sum(test["score"] for test in told["tests"]))

    assert len({path.parent for path in paths}) == 5
    assert sorted(totals) == [0, 1, 4, 7, 8]


def test_junit_can_read_the_results(results, tmp_path):
    odd = student("control \x00\x1b\ud800 sign", (0.0,), (2.0,))
    (path,) = list_exports()["junit"].write(some(*results.students, odd), tmp_path)
    top = ET.fromstring(path.read_text("utf-8"))  # noqa: S314 - written by us a moment ago

    def check(element):
        must, may, holds = JUNIT[element.tag]
        assert set(must) <= set(element.attrib) <= {*must, *may}
        assert {child.tag for child in element} <= holds
        for child in element:
            check(child)

    check(top)
    suites = list(top)
    assert [int(suite.get("tests")) for suite in suites] == [4, 4, 4, 4, 4, 2]
    for suite in suites:
        for kind, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
            assert int(suite.get(kind)) == len(suite.findall(f"testcase/{tag}"))
    assert suites[-1].get("name") == "control  sign"


def test_github_can_read_the_results(results, tmp_path):
    paths = list_exports()["github"].write(results, tmp_path)
    found = []
    for path in paths:
        line = path.read_text("utf-8")
        assert re.fullmatch(r"result=[A-Za-z0-9+/]+=*\n", line)
        told = json.loads(base64.b64decode(line.removeprefix("result=")))
        assert set(told) == {"version", "status", "message", "max_score", "tests"}
        assert all(len(test["output"]) <= 500 for test in told["tests"])
        assert {test["status"] for test in told["tests"]} <= {"pass", "fail", "error"}
        found.append((told["status"], sum(test["score"] for test in told["tests"])))

    assert found == [("pass", 8), ("fail", 7), ("fail", 4), ("fail", 1), ("fail", 0)]


def test_pages_load_nothing_and_escape_names(results, tmp_path):
    page, *_ = write_pages(results, tmp_path)
    text = page.read_text("utf-8")
    students = sorted((tmp_path / "students").glob("*.html"))

    assert [one for one in page_flaws(text) if "students/" not in one] == []
    assert "<script>" not in text
    assert "&lt;script&gt;alert(1)" in text
    assert len(students) == 5
    for one in students:
        assert page_flaws(one.read_text("utf-8")) == []
    for link in re.findall(r'href="(students/[^"]+)"', text):
        assert (tmp_path / link).is_file()
    assert "A number means something only with its unit." in text


def ungradable(name, exercise, reason):
    return replace(EMPTY.skip(reason, student=name), exercise=exercise)


def test_list_of_manual_checks_names_student_and_exercises(tmp_path):
    asks = "is this a log, or the whole project?"
    ann = GradedStudent("ann", "", (
        ungradable("ann", "exercise1", "the file is empty"), ungradable("ann", "exercise2", asks),
        ungradable("ann", "exercise3", "the file is empty"),
    ))  # fmt: skip
    ben = GradedStudent("ben", "", tuple(
        ungradable("ben", f"exercise{number}", "no name") for number in (1, 2, 3)
    ))  # fmt: skip
    people = replace(some(ann, ben), exercises=("exercise1", "exercise2", "exercise3"))
    text = write_pages(people, tmp_path)[0].read_text("utf-8")
    page = (tmp_path / "students" / "ann.html").read_text("utf-8")

    assert "<b>ann, exercise1, exercise3</b>: the file is empty</li>" in text
    assert f"<b>ann, exercise2</b>: {asks}</li>" in text
    assert "<b>ben</b>: no name</li>" in text
    assert f"<p>{asks}</p>" in page
    assert "<p>the file is empty.</p>" in page


def test_summary_without_grades_counts_nobody(tmp_path):
    people = some(GradedStudent("ann", "", (ungradable("ann", "exercise1", "empty"),)))
    text = write_pages(replace(people, exercises=("exercise1",)), tmp_path)[0].read_text("utf-8")

    assert "Nothing was graded yet." in text
    assert "nan %" not in text


def test_summary_counts_students_by_their_result():
    nobody = some(skip_student("zoe", [EMPTY], status=MISSING, reason=""))

    assert summarize_class(nobody) == "0 of 1 students handed something in."
    one = some(student("ann", (2.0,), (2.0,)), student("ben", (0.0,), (2.0,)))
    assert summarize_class(one) == (
        "2 of 2 students handed something in; on average they have 75 % of all points, and 1 has "
        "full marks."
    )


def test_a_class_of_five_hundred_gives_a_page_that_can_be_opened(tmp_path):
    people = some(*(student(f"s{n:03d}", (2.0, n % 3), (n % 2, 2.0)) for n in range(500)))
    page, *_ = write_pages(people, tmp_path)

    assert page.stat().st_size < 500_000


@pytest.mark.parametrize("name", list_exports())
def test_output_folder_that_cannot_be_written_gets_a_one_line_error(name, results, tmp_path):
    (tmp_path / "in the way").write_text("", encoding="utf-8")

    with pytest.raises(BadRequest):
        list_exports()[name].write(results, tmp_path / "in the way")


def test_only_students_of_whom_something_was_graded_are_in_the_average_and_the_histogram(tmp_path):
    absent = skip_student("Dora", [EMPTY], status=MISSING, reason="")
    unread = skip_student("Gus", [EMPTY], status="ungradable", reason="a picture")
    people = (student("Ada", [1.0]), absent, unread)
    results = ClassResults("Robotics 1", people, ("exercise1",))

    page = write_pages(results, tmp_path)[0].read_text(encoding="utf-8")

    assert "2 of 3 students handed something in; on average they have 50 %" in page
    assert "Half of the 1 have at least 50 %" in page
    assert "<h1>Results of the class: Robotics 1</h1>" in page
    assert page.count("incomplete") == 2  # the cell, and what it means
