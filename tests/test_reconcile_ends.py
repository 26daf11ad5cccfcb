"""Where a search ends: as far as it leads, and with no more parameters than are due."""

from itertools import pairwise

import pytest
from reconcile_made import rubbing

from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.model import Part
from sim.reconcile.backward_elimination import remove_needless_effects, simplify_effects
from sim.reconcile.candidates import score_estimate
from sim.reconcile.cross_validation import (
    compute_open_loop_errors,
    compute_rms_gap,
    compute_validation_gap,
    make_folds,
)
from sim.reconcile.local_minimum import minimize
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound

GAINS = {"kS": 0.5, "kV": 0.5, "kA": 0.05}
NOISE = (1e-3, 1e-2)  # [m] and [m/s]


def session(*parts, step, frictions=(1.0, 1.0, 1.0, 1.0)):
    return rubbing(GAINS, frictions, *parts, noise=NOISE, step=step, seed=round(100.0 * step))


def at(problem, values, *effects, process_noise=1.0):
    structure = ModelStructure("simple", effects)
    size = process_noise * problem.noise.velocity**2
    return problem.evaluate(
        structure, values, RunNuisance.at_first_samples(len(problem.records)), size
    )


def make_rounds(found, gaps):
    """The base and a round for each further model."""
    pairs = pairwise(zip(found, gaps, strict=True))
    return [
        SelectionRound.make_base(found[0], gaps[0]),
        *(SelectionRound(*now, *before) for before, now in pairs),
    ]


def test_a_wave_along_a_long_way_is_weighed_beside_friction_that_is_simulated():
    wave = {"cosine": 0.19, "sine": 0.0, "turns": 3.0}  # ten of them to an error of 0.2 rad
    log = session(Part("cogging", wave), step=4.0, frictions=(1.05, 0.95, 0.96, 1.04))
    problem = PredictionErrorProblem.from_records(make_run_records(log))
    values = {**GAINS, **{f"cogging.{name}": value for name, value in wave.items()}}
    truth, without = at(problem, values, "cogging"), at(problem, GAINS)

    plain = (
        compute_rms_gap(compute_open_loop_errors(problem, truth, truth.nuisance)).velocity
        / problem.noise.velocity
    )
    eased = compute_rms_gap(
        compute_open_loop_errors(problem, truth, truth.nuisance, own_friction=True)
    ).velocity
    bare = compute_rms_gap(
        compute_open_loop_errors(problem, without, without.nuisance, own_friction=True)
    ).velocity

    assert plain > 5.0
    assert eased < 0.3 * plain * problem.noise.velocity
    assert eased < 0.3 * bare  # which was wider, where friction was only extrapolated


def test_an_effect_that_needs_fewer_parameters_by_now_gives_way_to_its_sister():
    log = session(Part("constant-load", {"load": 0.3}), step=4.0)
    problem = PredictionErrorProblem.from_records(make_run_records(log))
    parts = make_folds([one.session for one in problem.records])
    base = score_estimate(problem, minimize(problem, at(problem, GAINS)))
    spring = {**GAINS, "spring.rate": 1e-4, "spring.preload": 0.3}
    taken = score_estimate(problem, minimize(problem, at(problem, spring, "spring")), "spring")
    gaps = [compute_validation_gap(problem, one.estimate, parts) for one in (base, taken)]
    done = make_rounds([base, taken], gaps)

    told = simplify_effects(SelectionData(log, problem, parts), done)

    assert [one.candidate.effect for one in told] == ["", "constant-load"]
    assert told[-1].candidate.estimate.structure.effects == ("constant-load",)
    assert told[-1].candidate.estimate.values["constant-load.load"] == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize("others", [("constant-load",), ("constant-load", "stribeck")])
def test_effects_that_a_later_one_has_made_needless_are_removed(others):
    log = session(Part("drag", {"drag": 0.2}), step=4.0)
    problem = PredictionErrorProblem.from_records(make_run_records(log))
    folds = make_folds([one.session for one in problem.records])
    starts = {"constant-load.load": 0.1, "stribeck.extra": 0.2, "stribeck.slow": 0.2}
    values = {**GAINS, "drag.drag": 0.2, **starts}

    def fit(*effects):
        point = minimize(problem, at(problem, values, *effects))
        return score_estimate(problem, point, effects[-1] if effects else "")

    found = [fit(), *(fit(*others[: n + 1]) for n in range(len(others))), fit(*others, "drag")]
    gaps = [compute_validation_gap(problem, one.estimate, folds) for one in found]
    done = make_rounds(found, gaps)

    base, drag = remove_needless_effects(SelectionData(log, problem, folds), done)

    assert base is done[0]
    assert drag.candidate.effect == "drag"
    assert drag.candidate.estimate.structure.effects == ("drag",)
