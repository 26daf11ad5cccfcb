"""Exercise 8: a damaged log of one's own, and what is left of it to fit."""

import sys
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from places import ROOT

from grader.checks.check import WrongAnswer
from grader.exercise.exercise import Exercise
from sim.core.log import FOUR_TESTS
from sim.core.units import find_unit
from sim.fit import fit

OWN = Exercise("exercise8", ROOT / "exercises" / "exercise8")
CHECKS = OWN.module
DRAWN, PREPARATION = (sys.modules[f"{CHECKS.__name__}.{name}"] for name in ("drawn", "preparation"))
STUDENTS = tuple(f"student {number}" for number in range(20))
RAMPS, STEPS = FOUR_TESTS[:2], FOUR_TESTS[2:]


@cache
def variant(student):
    return CHECKS.draw(student)


def graded(preparation, *, student="ann"):
    """The results of a preparation, by check."""
    answers = CHECKS.Answers(preparation, variant(student))
    return {check.id: check.run(answers) for check in OWN.checks}


def points(preparation, *, student="ann"):
    return {name: result.points for name, result in graded(preparation, student=student).items()}


ALL = dict(kept=2, reach=2, ks=2, kv=2, ka=2)


@pytest.mark.parametrize("student", STUDENTS)
def test_log_can_be_repaired_and_needs_every_repair(student):
    reference = variant(student).reference
    nothing = points(DRAWN.NOTHING, student=student)

    assert points(reference, student=student) == ALL
    assert sum(nothing.values()) < 3
    assert nothing["kept"] == nothing["reach"] == 0
    for part, gain in (
        (dict(keep={}), "ka"),
        (dict(threshold=0.0), "ks"),
        (dict(median=1), "ka"),
        (dict(median=15), "ka"),
    ):
        assert points(replace(reference, **part), student=student)[gain] < 2


def test_twenty_students_get_all_kinds_of_logs():
    kinds = {variant(student).mechanism.units for student in STUDENTS}
    stops = {test for student in STUDENTS for test in variant(student).reference.keep}

    assert kinds == {"meters", "degrees"}
    assert stops == {*FOUR_TESTS}


def test_standstill_may_be_cut_by_a_window_or_by_a_threshold():
    for student in STUDENTS[:8]:
        mine = variant(student)
        keep = dict(mine.reference.keep)
        for ramp in RAMPS:
            (one,) = mine.log.list_runs_of_test(ramp)
            first = one.time[np.argmax(mine.valid[ramp])] - one.time[0]
            keep[ramp] = (first, keep.get(ramp, (0.0, 99.0))[1])
        trimmed = replace(mine.reference, keep=keep, threshold=0.0)

        assert points(trimmed, student=student)["kept"] == 2
        assert points(trimmed, student=student)["ks"] == 2


@pytest.mark.parametrize("median", [1, 3, 5])
def test_keeping_every_sample_earns_nothing(median):
    for student in ("ann", "ben", "zoë"):
        earned = points(DRAWN.Preparation({}, 0.0, median), student=student)

        assert (earned["kept"], earned["reach"]) == (0, 0)


@pytest.mark.parametrize(("ramp", "step"), [(4.0, 0.5), (5.0, 0.7), (6.0, 0.5), (99.0, 0.5)])
def test_a_cut_that_is_the_same_for_everybody_earns_little(ramp, step):
    earned = []
    for student in STUDENTS:
        reference = variant(student).reference
        keep = dict.fromkeys(RAMPS, (0.0, ramp)) | dict.fromkeys(STEPS, (0.0, step))
        earned.append(sum(points(replace(reference, keep=keep), student=student).values()))

    assert np.mean(earned) <= 10 / 3


def test_a_gain_counts_only_where_the_fast_ends_are_kept():
    reference = variant("ann").reference
    ramp = next(test for test in RAMPS if test not in reference.keep)
    results = graded(replace(reference, keep={**reference.keep, ramp: (0.0, 4.0)}))

    assert results["reach"].points == 1.5
    assert {results[name].points for name in ("ks", "kv", "ka")} == {0}


def test_samples_lost_cost_half_a_point_for_each_test():
    reference = variant("ann").reference

    def kept(span, *tests):
        results = points(replace(reference, keep={**reference.keep, **dict.fromkeys(tests, span)}))
        return results["kept"], results["reach"]

    assert kept((0.0, 2.0), RAMPS[0]) == (1.5, 1.5)
    assert kept((0.0, 2.0), *RAMPS) == (1.0, 1.0)
    assert kept((0.2, 0.5), *STEPS) == (1.0, 1.0)
    assert kept((90.0, 91.0), *RAMPS, *STEPS) == (0.0, 0.0)


def test_who_cuts_nothing_good_is_not_told_to_have_cut_it():
    whole = variant("gus")
    rests = {
        test: float(np.argmax(flags)) * 0.02
        for test, flags in whole.valid.items()
        if "quasi" in test
    }
    keep = whole.reference.keep
    mine = {test: (rests.get(test, begin), end) for test, (begin, end) in keep.items()}
    for median, threshold in ((1, 0.0), (1, whole.reference.threshold), (15, 0.0)):
        for name in ("kS", "kV", "kA"):
            said, _ = CHECKS.blame(name, whole, PREPARATION.Preparation(mine, threshold, median))

            assert "you cut away" not in said
    same = whole.reference
    assert "Move the ends" in CHECKS.blame("kS", whole, replace(same, keep=mine))[0]


@pytest.mark.parametrize(
    ("raw", "expected"),
    [
        ("0.4 to 5.2", (0.4, 5.2)),
        ("0,4 - 5,2 s", (0.4, 5.2)),
        ("from 1 s until 3 s", (1.0, 3.0)),
        ([0.5, 2], (0.5, 2.0)),
        ("all", None),
        (" ALL ", None),
        ("0,4 to 5,2", (0.4, 5.2)),
        ("0,4, 5,2", (0.4, 5.2)),
        ("0.4,5.2", (0.4, 5.2)),
        ("(0.4; 5.2)", (0.4, 5.2)),
    ],
)
def test_a_window_may_be_written_in_many_ways(raw, expected):
    given = dict.fromkeys((one.replace("-", "_") for one in FOUR_TESTS), "all")
    given |= {"dynamic_forward": raw, "threshold": "0,2 m/s", "median": "3"}
    found = PREPARATION.read_preparation(given, symbol="m", si=1.0)

    assert found.keep.get("dynamic-forward") == expected
    assert (found.threshold, found.median) == (0.2, 3)


def test_a_threshold_is_read_in_the_unit_of_the_log():
    given = dict.fromkeys((one.replace("-", "_") for one in FOUR_TESTS), "all")
    degrees = find_unit("degrees")

    for written in (20, "20 deg/s", "0.34907 rad/s"):
        given |= {"threshold": written, "median": 1}
        found = PREPARATION.read_preparation(given, symbol=degrees.symbol, si=degrees.si)
        assert found.threshold == pytest.approx(0.34907, rel=1e-4)  # 20·π/180


@pytest.mark.parametrize(
    ("name", "raw", "says"),
    [
        ("dynamic_forward", None, "dynamic_forward: nothing yet"),
        ("dynamic_forward", "", "dynamic_forward: nothing yet"),
        ("dynamic_forward", 3, "but two times are needed"),
        ("dynamic_forward", "1 to 2 and 3 to 4", "but two times are needed"),
        ("dynamic_forward", "4 to 2", '"4 to 2"'),
        *(("dynamic_forward", raw, raw) for raw in ("0 to 3.90x", "from 1 kg to 2", "1 or 2")),
        *(("dynamic_forward", raw, raw) for raw in ("1,5,5", "0,4,5,2", "from 1,5,5 s")),
        ("threshold", "", "threshold: nothing yet"),
        ("threshold", -1, "threshold -1"),
        ("threshold", "0.2 V", "threshold: the unit"),
        ("threshold", True, "threshold: true"),
        ("median", 0, "median 0"),
        ("median", 16, "median 16"),
        ("median", 2.5, "median 2.5"),
        ("median", "wide", "median: "),
    ],
)
def test_a_line_that_cannot_be_read_is_named_and_nothing_else_is_judged(name, raw, says):
    given = dict.fromkeys((one.replace("-", "_") for one in FOUR_TESTS), "all")
    given |= {"threshold": 0, "median": 1, name: raw}
    with pytest.raises(WrongAnswer) as wrong:
        PREPARATION.read_preparation(given, symbol="m", si=1.0)
    results = graded(wrong.value)

    assert says in wrong.value.seen
    assert results.pop("kept").status == "failed"
    assert {one.status for one in results.values()} == {"not-reached"}


def test_empty_preparation_gives_the_fit_of_the_raw_log():
    mine = variant("ann")
    theirs = fit(mine.log, method="sysid").in_log_units()

    assert PREPARATION.fit_prepared(mine.log, DRAWN.NOTHING).gains == theirs.gains
