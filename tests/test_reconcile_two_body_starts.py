"""A joint has many local minima: those of a light and of a heavy motor are found on step tests."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from reconcile_made import SESSIONS, bench, session, told

from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import levenberg_marquardt
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.effects import EFFECTS
from sim.physics.model import Part
from sim.physics.voltage_residual import compute_voltage_residual
from sim.reconcile.two_body_starts import MINIMA, MOST, SAME, TwoBodyStarts, _best_of_each

BASE = ModelStructure("simple")
SLACK = 0.02  # [rad]
STEPS = 3  # downhill
SOFT = BASE + "compliance"
BELT = {"softness": 0.02, "share": 0.3, "damping": 0.05, "motor_friction": 0.3}


def built(effect="", **values):
    hidden = (Part(effect, values),) if effect else ()
    return replace(bench("turret"), hidden=hidden)


def looked(mechanism):
    """The step tests of a log, the best model of one body, and what the log shows."""
    log = session(mechanism, "log")
    problem = PredictionErrorProblem.from_records(make_run_records(log))
    values = {name: mechanism.gains[name] for name in BASE.names}
    begun = problem.evaluate(
        BASE, values, RunNuisance.at_first_samples(len(problem.records)), problem.noise.velocity**2
    )
    point = levenberg_marquardt(problem, begun, steps=STEPS)
    evidence = compute_voltage_residual(log, dict(BASE.model(point.values).gains), type="simple")
    return TwoBodyStarts(problem, point), evidence


def starts(effect, evidence):
    return [
        {f"{effect}.{name}": value for name, value in start.items()}
        for start in EFFECTS[effect].start_values(evidence)
    ]


@pytest.mark.parametrize("share", [0.2, 0.46])
def test_free_play_is_found_whatever_its_motor_weighs(share):
    mechanism = built("backlash", slack=SLACK, share=share, damping=0.3, motor_friction=share)

    story = told({name: session(mechanism, name) for name in SESSIONS}, type="simple")

    first = story.findings[0]
    assert first.effect == "backlash"
    # if no run crosses all of it, the least is told that does the same
    assert 0.4 < first.parameters["slack"].value / math.degrees(SLACK) < 1.1
    assert first.parameters["share"].value == pytest.approx(share, rel=0.2)


def test_minima_explain_the_step_tests_and_differ():
    lively, evidence = looked(built("compliance", **BELT))

    found = lively.list_starts(SOFT, starts("compliance", evidence), heavy=False)

    assert 0 < len(found) <= MINIMA
    for one in found:
        there = lively.problem.evaluate(
            SOFT, {**lively.point.values, **one}, lively.point.nuisance, lively.point.process_noise
        )
        assert levenberg_marquardt(lively.problem, there, steps=STEPS).cost < lively.point.cost
    for one, other in pairwise(found):
        assert not all(math.isclose(one[name], other[name], rel_tol=SAME) for name in one)


def test_the_start_nearest_to_what_is_there_need_not_promise_most():
    lively, _ = looked(built("compliance", **BELT))
    values = {**lively.point.values, **{f"compliance.{name}": BELT[name] for name in BELT}}
    nuisance, q = lively.point.nuisance, lively.point.process_noise
    heavy, light = (
        lively.problem.evaluate(SOFT, {**values, "compliance.share": share}, nuisance, q)
        for share in (0.5, 0.15)
    )

    kept = _best_of_each([*((90.0, heavy) for _ in range(9)), (-5.0, light)], "compliance")

    assert light in kept
    assert kept.count(heavy) == MOST


def test_what_makes_the_lively_runs_less_likely_is_not_tried_on_all():
    lively, _ = looked(built())
    far = {f"compliance.{name}": BELT[name] for name in BELT}
    far |= {"compliance.softness": 50.0, "compliance.share": 0.01}  # all of the load hangs loose

    assert lively.list_starts(SOFT, [far], heavy=False) == []
