"""What happens once: at its moment on one clock, and over by the next log, or there for good."""

from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import bench, recorded, session, told

from sim.core.log import Log
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import make_joint_jacobian
from sim.estimation.run_nuisance import RunNuisance
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
    problem = PredictionErrorProblem.from_records(make_run_records(log))
    begun = RunNuisance.at_first_samples(len(problem.records))
    point = minimize(
        problem, problem.evaluate(ModelStructure("simple"), GAINS, begun, problem.noise.velocity**2)
    )

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
def test_what_is_had_back_at_another_pace_was_no_inertia(joined, size, record, after, is_belied):
    problem, point = joined
    start = float(problem.records[record].measurements.time[0]) + after
    left = ResidualSummary(worst_window=WorstWindow(size, record, start, start + 0.1))

    assert is_contradicted("inertia-change", problem, point, left) is is_belied
    assert not is_contradicted("drag", problem, point, left)
