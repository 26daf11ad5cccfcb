"""Whatever stands in an answer, it commands no terminal and turns no page around."""

import re
import unicodedata

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from small_course import answer

from grader.checks.check import Result, Status
from grader.cli import run_command
from grader.feedback.report import compose_feedback
from grader.notebook.submit import submit
from sim.support.printable import DIRECTIONS, make_printable

COMMANDS = re.compile(
    "[" + "".join(map(re.escape, sorted(DIRECTIONS))) + "\x00-\x08\x0b-\x1f\x7f-\x9f]"
)
NASTY = "\x1b]0;you\x07\x1b[31m\u202egnorw\u2066\x9b2J\r\x08"


@given(st.text())
def test_control_characters_are_removed_and_the_rest_stays(text):
    shown = make_printable(text)

    assert not COMMANDS.search(shown)
    assert len(shown) == len(text)
    assert all(
        new == old or old in DIRECTIONS or unicodedata.category(old) in {"Cc", "Cs"}
        for new, old in zip(shown, text, strict=True)
    )


@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.text(max_size=20).map(lambda text: NASTY + text))
def test_control_characters_of_an_answer_reach_neither_terminal_nor_notebook(course, capsys, text):
    quoted = "".join(
        f"\\U{ord(sign):08x}" for sign in text if ord(sign) not in range(0xD800, 0xE000)
    )
    answer(course, f'size = "{quoted}"\n')
    run_command(["exercise1"])
    run_command(["exercise1", "--plain"])
    said = capsys.readouterr()
    shown = submit(1)

    for whole in (said.out, said.err, str(shown), shown.html):
        assert not COMMANDS.search(whole)


@pytest.mark.usefixtures("course")
def test_a_page_of_a_class_and_its_exports_hold_no_control_characters(tmp_path):
    place = tmp_path / "in" / "ann" / "exercise1"
    place.mkdir(parents=True)
    quoted = "".join(f"\\U{ord(sign):08x}" for sign in NASTY)
    (place / "answers.toml").write_text(f'size = "{quoted}"\n', encoding="utf-8")
    command = ["class", str(tmp_path / "in"), "--export", "gradescope", "--export", "junit"]

    assert run_command(command) == 0
    written = [path for path in (tmp_path / "in-graded").rglob("*") if path.is_file()]
    pages = [path for path in written if path.suffix in {".html", ".csv", ".xml"}]
    assert len(pages) >= 4
    for path in pages:
        assert not COMMANDS.search(path.read_text(encoding="utf-8").replace("\r\n", "\n")), path
    failed = Result("size", "The size", Status.FAILED, 0.0, 1.0, NASTY, NASTY)
    assert not COMMANDS.search(compose_feedback(failed))
