"""Where a search begins, and what it leads to: what is small, or happens once, is found as well."""

import math
from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import NOWHERE, SESSIONS, based, bench, recorded, session, told

from sim.core.log import Log
from sim.estimation.likelihood import LARGEST, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import make_joint_jacobian
from sim.estimation.run_nuisance import POSITION, RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.effects import EFFECTS
from sim.physics.engine import State
from sim.physics.model import Model, Part
from sim.physics.voltage_residual import list_run_start_times
from sim.reconcile.judgement import is_contradicted
from sim.reconcile.local_minimum import minimize, rate_starts
from sim.reconcile.onset_scan import scan_onsets
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.residual_tests.whiteness import WorstWindow
from sim.reconcile.thresholds import MAJOR

BAND = 0.25  # [V] of an elevator whose ramps begin at 1.5 V upward, and at once downward
RIPPLE, RIPPLES = 0.04, 12.0  # [V] less than what is everyday, and how often along the way
SUBTLE, FAR = 0.3, 8.0  # [1] of an ordinary size, and how much too large a start may be


def sessions(mechanism, effect, **values):
    built = replace(bench(mechanism), hidden=(Part(effect, values),))
    return {name: session(built, name) for name in SESSIONS}


@pytest.mark.parametrize("band", [BAND, 1.6 * BAND])
def test_deadband_far_below_the_first_motion_is_found(band):
    story = told(sessions("elevator", "deadband", band=band), type="elevator")

    first = story.findings[0]
    assert first.effect == "deadband"
    assert first.parameters["band"].value == pytest.approx(band, rel=0.1)


def begin_search(problem, point, effect, start):
    """What the search tries from one start of an effect: how much each gains, and its point."""
    jacobian = make_joint_jacobian(problem, point)
    return rate_starts(problem, point, point.structure + effect, [start], jacobian=jacobian)


def test_a_start_that_is_far_too_large_is_halved():
    built = bench("drivetrain", "compliance", size=SUBTLE)
    truth = built.hidden[0].parameters["softness"]
    problem, point = based(session(built, "log"), built.gains)
    far = {
        "compliance.softness": FAR * truth, "compliance.share": 0.25,
        "compliance.damping": 0.05, "compliance.motor_friction": 0.25,
    }  # fmt: skip

    begun = begin_search(problem, point, "compliance", far)

    gained, at_once = begun[0]
    most, best = max(begun, key=lambda one: one[0])
    assert at_once.values["compliance.softness"] == FAR * truth
    assert gained < 0.0  # so far off that nothing else would ever have been tried
    assert most > 0.0
    assert best.values["compliance.softness"] == pytest.approx(truth, rel=1.0)


@pytest.mark.parametrize("far", [1e200, math.inf, -math.inf, math.nan])
def test_diverging_residuals_are_clipped_before_squaring(far):
    problem = PredictionErrorProblem.from_records(
        make_run_records(session(bench("drivetrain"), "log"))
    )
    table = np.zeros_like(problem.measured)
    table[3] = far

    white = problem.whiten(NOWHERE, table)

    assert np.isfinite(np.sum(np.square(white)))
    assert np.max(np.abs(white)) >= LARGEST


@pytest.mark.parametrize("part", [-0.2, -2.0, 8.0])
def test_start_value_of_wrong_sign_or_size_is_corrected(part):
    built = bench("drivetrain", "asymmetric-back-emf")
    truth = built.hidden[0].parameters["lean"]
    problem, point = based(session(built, "log"), built.gains)
    lean = "asymmetric-back-emf.lean"

    begun = begin_search(problem, point, "asymmetric-back-emf", {lean: part * truth})

    _, best = max(begun, key=lambda one: one[0])
    assert best.values[lean] == pytest.approx(truth, rel=0.5)


# -- what is no alarm -----------------------------------------------------------------------------


def test_everyday_ripple_is_no_finding_however_much_gap_it_closes():
    turns = 2.0 * math.pi * RIPPLES / bench("elevator").scale.reach

    story = told(
        sessions("elevator", "cogging", cosine=RIPPLE, sine=0.0, turns=turns), type="elevator"
    )

    assert story.findings == ()
    assert any("also has cogging" in note for note in story.notes)
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
        moved = problem.evaluate(base, values, nuisance.add(POSITION, by), point.process_noise)
        change = (
            problem.whiten(point, moved.innovations - point.innovations) / problem.noise.position
        )
        size = np.abs(change).max()
        assert starts[:, number] == pytest.approx(change, abs=0.02 * size)


PERIOD, LATER = 0.02, 1e6  # [s]
JOINS = 0.6  # [1] of kA


def drives(*, onset, until):
    """Something joins at a moment of the log; what ends with its run is not in the others."""
    plain = bench("drivetrain")
    extra = JOINS * plain.gains["kA"]
    part = Part("inertia-change", {"extra": extra, "onset": onset, "until": until, "shared": 1.0})
    after = replace(part, parameters={**part.parameters, "onset": 0.0})
    once = replace(plain, hidden=(part,))
    others = plain if until < LATER else replace(plain, hidden=(after,))
    return extra, {
        "log": session(once, "log"),
        "validation": session(others, "validation"),
        "held_out": session(others, "held_out"),
    }


@pytest.fixture(scope="module")
def third():
    """Beginning of the third run of a plain log, on the log's clock."""
    return float(list_run_start_times(session(bench("drivetrain"), "log"))[2])


@pytest.mark.parametrize("until", [2.9, LATER], ids=["with its run", "for good"])
def test_inertia_added_during_a_run_is_found_to_the_sample(third, until):
    onset = third + 0.513
    extra, sessions = drives(onset=onset, until=third + until if until < LATER else LATER)

    story = told(sessions)

    found = story.findings[0]
    assert found.effect == "inertia-change"
    assert found.parameters["onset"].value == pytest.approx(onset, abs=PERIOD)
    assert found.parameters["extra"].value == pytest.approx(extra, rel=0.15)
    assert story.gap_after < 1.2 * story.noise_floor


# Moments that no velocity tells

GAINS = {"kS": 0.4, "kV": 0.6, "kA": 0.04}
NOISE = (1e-4, 2e-2)  # [m] and [m/s]: the position knows
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")


def log_with(parts):
    """Four tests of a model in which something may happen once."""
    rng = np.random.default_rng(1)
    runs, clock = [], 0.0
    for test in TESTS:
        begun = {"state": replace(State.cold_at(0.0), clock=clock), "began": clock}
        model = Model("simple", GAINS, parts)
        runs.append(recorded(test, model, step=5.0, noise=NOISE, rng=rng, **begun))
        clock = float(runs[-1].time[-1]) + 2.0
    return Log(tuple(runs), units="meters", type="simple")


@pytest.fixture(scope="module")
def dynamic():
    """[s] of the log's clock at which its third run began."""
    return float(list_run_start_times(log_with(()))[2])


@pytest.mark.parametrize(
    ("shared", "after", "lasts", "off"),
    [
        (0.0, 0.25, 2.0, 0.02),
        (0.0, 0.02, 2.0, 0.02),
        (0.0, 0.02, LATER, 0.02),
        (1.0, 0.62, 2.0, 0.005),
        (1.0, 0.62, LATER, 0.005),
    ],
    ids=["late in a step", "early", "early, for good", "at rest", "at rest, for good"],
)
def test_onset_is_where_the_innovations_change(dynamic, shared, after, lasts, off):
    until = dynamic + lasts if lasts < LATER else LATER
    values = {"extra": 0.02, "onset": dynamic + after, "until": until, "shared": shared}
    log = log_with((Part("inertia-change", values),))
    problem, base = based(log, GAINS)
    point = minimize(problem, base)

    jacobian = make_joint_jacobian(problem, point)
    tried = list(scan_onsets(problem, point, EFFECTS["inertia-change"], jacobian=jacobian))

    likeliest = max(
        rate_starts(problem, point, point.structure + "inertia-change", tried, jacobian=jacobian),
        key=lambda one: one[0],
    )[1].values
    found = {name: likeliest[f"inertia-change.{name}"] for name in values}
    assert found["onset"] == pytest.approx(values["onset"], abs=off)
    assert found["shared"] == shared
    assert (found["until"] == LATER) == (lasts == LATER)
    assert found["extra"] == pytest.approx(0.02, rel=0.5)


@pytest.fixture(scope="module")
def joined(dynamic):
    """A log in which inertia joins for good, and the point of it that has it over with its run."""
    part = Part("inertia-change", {"extra": 0.02, "onset": dynamic, "until": LATER, "shared": 0.0})
    problem = PredictionErrorProblem.from_records(make_run_records(log_with((part,))))
    ends = dynamic + float(np.ptp(problem.records[2].measurements.time)) + 1e-6
    over = {**part.parameters, "onset": dynamic + 1e-3, "until": ends}
    values = {**GAINS, **{f"inertia-change.{name}": value for name, value in over.items()}}
    structure = ModelStructure("simple") + "inertia-change"
    return problem, problem.evaluate(
        structure, values, RunNuisance.at_first_samples(4), problem.noise.velocity**2
    )


@pytest.mark.parametrize(
    ("size", "record", "after", "is_belied"),
    [
        (12.0, 2, 0.2, True),
        (12.0, 2, 0.005, False),  # the knock itself
        (12.0, 2, 0.9, False),  # long after
        (12.0, 3, 0.2, False),  # in another run
        (5.0, 2, 0.2, False),  # ordinary
    ],
)
def test_late_residual_contradicts_an_inertia_change(joined, size, record, after, is_belied):
    problem, point = joined
    start = float(problem.records[record].measurements.time[0]) + after
    left = ResidualSummary(worst_window=WorstWindow(size, record, start, start + 0.1))

    assert is_contradicted("inertia-change", problem, point, left) is is_belied
    assert not is_contradicted("drag", problem, point, left)


SLACK = 0.02  # [rad]


def built(effect="", **values):
    hidden = (Part(effect, values),) if effect else ()
    return replace(bench("turret"), hidden=hidden)


@pytest.mark.parametrize("share", [0.2, 0.46])
def test_backlash_is_found_whatever_the_motor_inertia(share):
    mechanism = built("backlash", slack=SLACK, share=share, damping=0.3, motor_friction=share)

    story = told({name: session(mechanism, name) for name in SESSIONS}, type="simple")

    first = story.findings[0]
    assert first.effect == "backlash"
    # if no run crosses all of it, the least is told that does the same
    assert 0.4 < first.parameters["slack"].value / math.degrees(SLACK) < 1.1
    assert first.parameters["share"].value == pytest.approx(share, rel=0.2)
