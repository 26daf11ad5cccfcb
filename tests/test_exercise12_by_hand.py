"""Exercise 12 solved with what lesson 9's widget shows and does, and nothing else."""

import os
import runpy
import shutil
from pathlib import Path

import pytest

from grader.exercise import Exercise
from sim.reconcile import reconcile

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "exercises" / "exercise12"
SOLVE = runpy.run_path(str(ROOT / "solutions" / "exercise12" / "solve.py"))["solve"]
STUDENTS = int(os.environ.get("SYSID_STUDENTS", "1"))  # ten take two minutes
NEEDED = 0.9  # [share of the students] with full marks


def test_who_follows_the_largest_share_and_stops_in_time_gets_full_marks(tmp_path):
    points = {}
    for number in range(STUDENTS):
        student = f"student {2 + number}"
        folder = tmp_path / student / "exercise12"
        shutil.copytree(FOLDER, folder, ignore=shutil.ignore_patterns("data", "__pycache__"))
        own = Exercise("exercise12", folder)
        own.prepare(student, say=lambda _: None)
        (files,) = (folder / "data").iterdir()
        answer = folder / "answers.toml"
        answer.write_text(SOLVE(folder, files)["answers.toml"], encoding="utf-8")
        points[student] = sum(one.points for one in own.grade(answer, student=student).checks)

    full = [student for student, earned in points.items() if earned == 10]
    assert len(full) >= NEEDED * STUDENTS, points


def test_reconcile_has_the_same_gap_and_the_same_first_effect():
    variant = Exercise("exercise12", FOLDER).module.draw("student 10")
    story = reconcile(
        variant.log, validation=variant.validation, held_out=variant.held_out, type="simple"
    )
    hand = variant.make_search()
    fits = {"gap_before": hand.fit(), "gap_after": hand.fit(variant.hidden)}

    assert [one.effect for one in story.findings] == [*variant.hidden]
    for name, point in fits.items():
        gap = getattr(story, name) / story.noise_floor
        assert hand.measure_gap(point, "held_out") == pytest.approx(gap, rel=0.02)
