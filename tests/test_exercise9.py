"""Exercise 9: everybody gets a mechanism of their own, and its log."""

import json
import re
import shutil
from pathlib import Path

import pytest

from grader.cli import run
from grader.exercise import Exercise

ROOT = Path(__file__).resolve().parents[1]
OWN = Exercise("exercise9", ROOT / "exercises" / "exercise9")
STUDENTS = ("ann", "ben", "zoë")  # between them they get both kinds


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the exercise in a course of its own, in whose folder the command runs."""
    folder = tmp_path / "exercises" / "exercise9"
    shutil.copytree(OWN.folder, folder, ignore=shutil.ignore_patterns("data", "__pycache__"))
    (tmp_path / "lessons").mkdir()
    monkeypatch.chdir(tmp_path)
    return Exercise("exercise9", folder)


def test_fifty_students_get_mechanisms_that_can_be_fitted():
    variants = [OWN.module.draw(f"student {number}") for number in range(50)]

    assert {variant.mechanism.name for variant in variants} == set(OWN.module.KINDS)
    for variant in variants:
        for name, asked in variant.asked.items():
            assert asked.right(variant.fit.gains[name])


def test_a_student_gets_the_same_mechanism_every_time_and_nobody_elses():
    first, again, other = (OWN.module.draw(name) for name in ("ann", "Ann", "ben"))

    assert first.mechanism == again.mechanism
    assert first.mechanism != other.mechanism


def test_a_shooter_is_asked_for_in_rotations():
    assert {OWN.module.draw(student).mechanism.name for student in STUDENTS} == {*OWN.module.KINDS}
    for student in STUDENTS:
        variant = OWN.module.draw(student)
        symbol = {"drivetrain": "m", "shooter": "rot"}[variant.mechanism.name]

        assert variant.asked["kV"].unit == f"V·s/{symbol}"


@pytest.mark.parametrize("student", STUDENTS)
def test_nothing_a_learner_reads_holds_the_answer(copy, student, capsys):
    variant = OWN.module.draw(student)
    said = " ".join(OWN.hints) + (OWN.folder / "README.md").read_text("utf-8")
    for text in ("kS = 1\nkV = 1\nkA = 1", "kS = -1\nkV = 60\nkA = 0.001"):
        (copy.folder / "answers.toml").write_text(text, "utf-8")
        run(["9", "--student", student])
        run(["9", "--student", student, "--json"])
    said += capsys.readouterr().out
    numbers = [float(text) for text in re.findall(r"\d+\.\d+", said)]

    for asked in variant.asked.values():
        close = [n for n in numbers if abs(n - asked.expected) < 0.001 * asked.expected]
        assert close == []


def test_a_log_that_was_changed_is_made_anew(copy):
    said = []
    copy.prepare("ann", say=said.append)
    log = copy.folder / "data" / "ann" / "log.csv"
    right = log.read_bytes()
    copy.prepare("ann", say=said.append)
    log.write_bytes(right[:1000])
    copy.prepare("ann", say=said.append)

    assert log.read_bytes() == right
    assert len(said) == 2
    assert sorted(file.name for file in log.parent.iterdir()) == ["log.csv", "log.wpilog"]


@pytest.mark.usefixtures("copy")
def test_where_no_log_can_be_written_it_says_so(capsys, monkeypatch):
    def full(*_args, **_more):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "mkdir", full)

    assert run(["9"]) == 2
    assert "your log cannot be written: No space left on device" in capsys.readouterr().err


def test_explaining_the_voltage_is_recognized(copy):
    for student in ("ann", "ben", "cat", "dan", "eve", "fay"):
        variant = OWN.module.draw(student)
        lookalike = OWN.module.read(
            OWN.folder / "answers.toml", student=student
        ).key.scene.lookalikes["kA"][0]
        if variant.asked["kA"].right(lookalike.value):
            continue
        text = f"kA = {lookalike.value}"
        (copy.folder / "answers.toml").write_text(text, "utf-8")
        result = copy.grade(None, student=student)
        (check,) = (one for one in result.checks if one.id == "ka")

        assert "Explain the acceleration instead" in check.hint
        return
    pytest.fail("no student's log shows the difference")


def test_the_log_is_made_on_first_use_and_said_so_beside_the_result(copy, capsys):
    assert run(["9", "--student", "ann", "--json"]) == 1
    out, err = capsys.readouterr()

    assert json.loads(out)["max_score"] == 5
    assert "exercises/exercise9/data/ann/log.wpilog" in err
    assert (copy.folder / "data" / "ann" / "log.csv").is_file()


def test_names_of_answers_may_be_written_in_small_letters(copy):
    (copy.folder / "answers.toml").write_text("ks = 1\nKV = 1\nka = 1\n", "utf-8")
    seen = [check.seen for check in copy.grade(None, student="ann").checks[:3]]

    assert all(said.startswith("1 V") for said in seen)
