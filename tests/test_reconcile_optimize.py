"""Where a search begins, and what it leads to: what is small is found as well."""

import math
from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import NOWHERE, SESSIONS, bench, session, told

from sim.estimation.likelihood import LARGEST, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import make_joint_jacobian
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.model import Part
from sim.reconcile.local_minimum import rate_starts
from sim.reconcile.thresholds import MAJOR

BAND = 0.25  # [V] of an elevator whose ramps begin at 1.5 V upward, and at once downward
RIPPLE, RIPPLES = 0.04, 12.0  # [V] less than what is everyday, and how often along the way
SUBTLE, FAR = 0.3, 8.0  # [1] of an ordinary size, and how much too large a start may be


def sessions(mechanism, effect, **values):
    built = replace(bench(mechanism), hidden=(Part(effect, values),))
    return {name: session(built, name) for name in SESSIONS}


@pytest.mark.parametrize("band", [BAND, 1.6 * BAND])
def test_a_threshold_far_below_where_the_ramps_begin_is_found(band):
    story = told(sessions("elevator", "deadband", band=band), type="elevator")

    first = story.findings[0]
    assert first.effect == "deadband"
    assert first.parameters["band"].value == pytest.approx(band, rel=0.1)


def test_a_start_that_is_far_too_large_is_halved():
    built = bench("drivetrain", "compliance", size=SUBTLE)
    truth = built.hidden[0].parameters["softness"]
    problem = PredictionErrorProblem.from_records(make_run_records(session(built, "log")))
    base = ModelStructure("simple")
    values = {name: built.gains[name] for name in base.names}
    point = problem.evaluate(
        base, values, RunNuisance.at_first_samples(len(problem.records)), problem.noise.velocity**2
    )
    far = {
        "compliance.softness": FAR * truth, "compliance.share": 0.25,
        "compliance.damping": 0.05, "compliance.motor_friction": 0.25,
    }  # fmt: skip

    begun = rate_starts(
        problem, point, base + "compliance", [far], jacobian=make_joint_jacobian(problem, point)
    )

    gained, at_once = begun[0]
    most, best = max(begun, key=lambda one: one[0])
    assert at_once.values["compliance.softness"] == FAR * truth
    assert gained < 0.0  # so far off that nothing else would ever have been tried
    assert most > 0.0
    assert best.values["compliance.softness"] == pytest.approx(truth, rel=1.0)


@pytest.mark.parametrize("far", [1e200, math.inf, -math.inf, math.nan])
def test_what_a_change_makes_fly_off_is_large_and_its_squares_are_numbers(far):
    problem = PredictionErrorProblem.from_records(
        make_run_records(session(bench("drivetrain"), "log"))
    )
    table = np.zeros_like(problem.measured)
    table[3] = far

    white = problem.whiten(NOWHERE, table)

    assert np.isfinite(np.sum(np.square(white)))
    assert np.max(np.abs(white)) >= LARGEST


@pytest.mark.parametrize("part", [-0.2, -2.0, 8.0])
def test_a_start_that_goes_the_wrong_way_or_too_far_is_turned(part):
    built = bench("drivetrain", "asymmetric-back-emf")
    truth = built.hidden[0].parameters["lean"]
    problem = PredictionErrorProblem.from_records(make_run_records(session(built, "log")))
    base, name = ModelStructure("simple"), "asymmetric-back-emf"
    values = {name: built.gains[name] for name in base.names}
    point = problem.evaluate(
        base, values, RunNuisance.at_first_samples(len(problem.records)), problem.noise.velocity**2
    )

    begun = rate_starts(
        problem,
        point,
        base + name,
        [{f"{name}.lean": part * truth}],
        jacobian=make_joint_jacobian(problem, point),
    )

    _, best = max(begun, key=lambda one: one[0])
    assert best.values[f"{name}.lean"] == pytest.approx(truth, rel=0.5)


# -- what is no alarm -----------------------------------------------------------------------------


def test_a_ripple_that_any_robot_has_is_no_finding_however_much_of_the_gap_it_takes():
    turns = 2.0 * math.pi * RIPPLES / bench("elevator").scale.reach

    story = told(
        sessions("elevator", "cogging", cosine=RIPPLE, sine=0.0, turns=turns), type="elevator"
    )

    assert story.findings == ()
    assert any("a little cogging" in note for note in story.notes)
    assert story.gap_after < MAJOR * story.gap_before  # but for its size it would be major
    assert story.verdict == "nothing-missing"


@pytest.mark.parametrize("effect", ["heating", "drag"])
def test_a_start_moves_its_own_run_and_heats_as_the_runs_before_it_did(effect):
    built = bench("drivetrain", effect)
    problem = PredictionErrorProblem.from_records(make_run_records(session(built, "log")))
    base = ModelStructure("simple") + effect
    values = {name: built.gains[name] for name in base.names if name in built.gains}
    values |= {f"{effect}.{name}": one for name, one in built.hidden[0].parameters.items()}
    nuisance, count = RunNuisance.at_first_samples(len(problem.records)), len(problem.records)
    point = problem.evaluate(base, values, nuisance, problem.noise.velocity**2)

    starts = problem.compute_jacobian(point)[:, -2 * count : -count]

    for number in range(count):
        by = np.zeros(count)
        by[number] = problem.noise.position
        moved = problem.evaluate(base, values, nuisance.shift_positions(by), point.process_noise)
        change = (
            problem.whiten(point, moved.innovations - point.innovations) / problem.noise.position
        )
        size = np.abs(change).max()
        assert starts[:, number] == pytest.approx(change, abs=0.02 * size)
