"""JUnit's XML, which build servers show: a suite for each student, a case for each check.

What it may hold: the schema of Jenkins, junit-10.xsd. Points stand in properties.
"""

import re
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from grader.checks.check import Result
from grader.classroom.atomic_files import write_private_file
from grader.classroom.grading import GradedStudent
from grader.classroom.results import ClassResults
from grader.exercise.exercise import Grade
from grader.feedback.report import compose_feedback

NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write ``junit.xml``.

    Raises:
        BadRequest: it cannot be written.
    """
    top = ET.Element("testsuites", name=_format_plainly(results.name))
    for one in results.students:
        top.append(_make_suite(one, results.remarks.get(one.student, ())))
    ET.indent(top)
    text = ET.tostring(top, encoding="unicode")
    head = '<?xml version="1.0" encoding="utf-8"?>\n'
    return (write_private_file(folder / "junit.xml", f"{head}{text}\n"),)


def _make_suite(one: GradedStudent, unused: Sequence[str]) -> ET.Element:
    cases = [_make_case(grade, check) for grade in one.grades for check in grade.checks]
    cases += [_make_unused_case(text) for text in unused]
    count = {tag: sum(case.find(tag) is not None for case in cases) for tag in _KINDS}
    suite = ET.Element(
        "testsuite",
        name=_format_plainly(one.student),
        tests=str(len(cases)),
        failures=str(count["failure"]),
        errors=str(count["error"]),
        skipped=str(count["skipped"]),
    )
    suite.extend(cases)
    return suite


def _make_unused_case(text: str) -> ET.Element:
    """A file that may be an answer and was not graded."""
    case = ET.Element("testcase", classname="files", name="not graded")
    ET.SubElement(case, "error", message=_format_plainly(text))
    return case


_KINDS = ("failure", "error", "skipped")


def _make_case(grade: Grade, check: Result) -> ET.Element:
    case = ET.Element(
        "testcase",
        classname=_format_plainly(grade.exercise),
        name=_format_plainly(check.description),
    )
    points = ET.SubElement(case, "properties")
    for name in ("points", "max_points", "misconception"):
        ET.SubElement(points, "property", name=name, value=_format_plainly(getattr(check, name)))
    said = _format_plainly(compose_feedback(check))
    if check.status == "failed":
        ET.SubElement(case, "failure", message=said)
    elif grade.status == "ungradable" or check.status == "error":
        ET.SubElement(case, "error", message=said)
    elif check.status != "passed":
        ET.SubElement(case, "skipped", message=said)
    return case


def _format_plainly(value: object) -> str:
    """Without what XML cannot hold."""
    text = f"{value:g}" if isinstance(value, float) else str(value)
    return NOT_XML.sub("", text)
