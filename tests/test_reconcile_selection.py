"""Which effects are added, kept and taken away again, and how likely they are right."""

import math
import sys
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reconcile_made import NOWHERE, based, recorded, rubbing

from sim.core.log import Log
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.measurements import SensorNoise
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.estimation.run_variation import compute_run_variation_covariance, compute_standard_errors
from sim.physics.effects import EFFECTS
from sim.physics.engine import State
from sim.physics.model import Model, Part
from sim.reconcile.backward_elimination import remove_needless_effects, simplify_effects
from sim.reconcile.candidates import Candidate, score_estimate
from sim.reconcile.cross_validation import (
    Fold,
    Gap,
    compute_open_loop_errors,
    compute_rms_gap,
    compute_validation_gap,
    make_folds,
    select_usable_folds,
)
from sim.reconcile.forward_selection import add_pair, find_alternative
from sim.reconcile.local_minimum import minimize
from sim.reconcile.model_selection import HARDLY, WIDENS, choose_next, is_ordinary_size
from sim.reconcile.probability import (
    Evidence,
    compute_log_size,
    compute_probability,
    compute_rival_share,
)
from sim.reconcile.residual_tests.repeatability import RepeatedResidual
from sim.reconcile.residual_tests.spectrum import SpectralPeak
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.residual_tests.whiteness import WorstWindow
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound, WeighedCandidate
from sim.reconcile.story import TriedCandidate
from sim.reconcile.thresholds import FARTHEST, LARGEST_SIZE, PERIODIC, REPEATED, UNLIKELY_WINDOW


def weighed(effect, score, *, gap=0.95, why="", **values):
    """A candidate with its score, its gap ratio and its parameters."""
    structure = ModelStructure("simple") + effect
    effects = {f"{effect}.{name}": value for name, value in values.items()}
    named = {"kS": 0.2, "kV": 0.05, "kA": 0.005, **effects}
    point = replace(NOWHERE, structure=structure, values=named)
    tried = TriedCandidate(effect, score, gap, admitted=not why, why=why)
    return WeighedCandidate(Candidate(effect, point, 0.0), Gap(gap, gap), tried)


@pytest.mark.parametrize(
    ("one", "other", "taken"),
    [
        (("drag", 45.0, 0.7), ("heating", 43.0, 0.7), "drag"),
        (("stribeck", 308.0, 0.74), ("deadband", 237.0, 0.35), "deadband"),  # closes far more
        (("stribeck", 308.0, 0.74), ("deadband", 237.0, 0.5), "stribeck"),
        (("stribeck", 308.0, 0.74), ("deadband", 140.0, 0.35), "stribeck"),  # not half as likely
        (("heating", 308.0, 0.74), ("inertia-change", 280.0, 0.3), "heating"),  # may be an accident
        # an effect and its simpler form: both have paid for their parameters
        (("spring", 45.0, 0.7), ("constant-load", 43.0, 0.7), "spring"),
        (("constant-load", 45.0, 0.7), ("spring", 43.0, 0.7), "constant-load"),
        # what may be an accident in one run has to be far likelier than what lasts
        (("inertia-change", 280.0, 0.7), ("heating", 160.0, 0.7), "heating"),
        (("inertia-change", 300.0, 0.7), ("heating", 160.0, 0.7), "inertia-change"),
    ],
)
def test_the_likelier_candidate_is_added_or_one_that_closes_far_more(one, other, taken):
    tried = [weighed(name, score, gap=gap) for name, score, gap in (one, other)]

    assert choose_next(tried).candidate.effect == taken


# -- pairs ----------------------------------------------------------------------------------------

QUICK = recorded(
    "dynamic-forward", Model("simple", {"kS": 0.2, "kV": 0.05, "kA": 0.005}),
    step=6.0, state=State.cold_at(0.0), noise=(1.0, 1.0), rng=np.random.default_rng(5),
)  # fmt: skip
PROBLEM = PredictionErrorProblem(
    make_run_records(Log((QUICK,), units="meters", type="simple")),
    SensorNoise(1.0, 1.0, (0.0, 0.0)),
)
DATA = SelectionData(None, PROBLEM, ())


def make_round(effect, *, gap, candidates=()):
    """A round with its effect and its gap."""
    made = SelectionRound.make_base(Candidate(effect, NOWHERE, 0.0), Gap(gap, gap))
    return replace(made, candidates=candidates)


@pytest.mark.parametrize(
    ("score", "why", "path", "taken"),
    [
        (900.0, WIDENS, (5.0, 1.2), True),  # the second closes what the first opened
        (900.0, WIDENS, (5.0, 4.5), False),  # together they widen it, too
        (900.0, WIDENS, (5.0, 3.8), False),  # and a pair has to close much of it
        (900.0, WIDENS, (5.0,), False),  # no second was found
        (90.0, WIDENS, (5.0, 1.2), False),  # hardly likelier
        (900.0, HARDLY, (5.0, 1.2), False),
    ],
)
def test_two_effects_that_mask_each_other_are_tried_as_a_pair(monkeypatch, score, why, path, taken):
    blocked = weighed("spring", score, gap=1.2, why=why, rate=2.0, preload=0.0)
    done = [make_round("", gap=4.0, candidates=(blocked,))]
    longer = [*done, *(make_round(f"effect {n}", gap=gap) for n, gap in enumerate(path))]
    begun = []

    def add_effects(_, rounds):
        begun.append(rounds[-1].candidate.effect)
        return longer

    monkeypatch.setattr(sys.modules[add_pair.__module__], "_add_effects", add_effects)

    assert add_pair(DATA, done) == (longer if taken else done)
    assert set(begun) <= {"spring"}


# -- other paths ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("others", "by_gap", "begun"),
    [
        ([("delay", 300.0, 0.9), ("spring", 200.0, 0.8)], False, ["", "delay"]),
        ([("delay", 300.0, 0.9), ("spring", 200.0, 0.8)], True, ["", "spring"]),
        ([("delay", 90.0, 0.9)], False, []),  # less than a quarter of what drag explains
    ],
)
def test_a_second_search_begins_with_a_candidate_that_scored_nearly_as_well(others, by_gap, begun):
    tried = tuple(
        weighed(name, score, gap=gap) for name, score, gap in (("drag", 400.0, 0.9), *others)
    )
    widens = weighed("heating", 390.0, gap=1.3, why=WIDENS)
    done = [make_round("", gap=9.0, candidates=(*tried, widens)), make_round("drag", gap=5.0)]

    assert [one.candidate.effect for one in find_alternative(done, by_gap=by_gap)] == begun


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


def test_cogging_over_a_long_travel_is_rated_with_simulated_friction():
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


PLAIN = Evidence(
    likelihood=5.0,
    gap=-0.3,
    size=1.0,
    rival=0.4,
    later=0.0,
    structure=0.0,
    once=0.0,
    damaged=0.0,
)  # of an effect that is worth 150 and closes a quarter of the gap


@pytest.mark.parametrize("kv", [0.5, 2.0])
def test_a_little_drag_is_on_any_robot_and_counts_at_the_free_speed(kv):
    little, much = ({"kV": kv, "drag.drag": volts * (kv / 12.0) ** 2} for volts in (0.8, 1.8))

    assert is_ordinary_size("drag", little)
    assert not is_ordinary_size("drag", much)
    assert compute_log_size("drag", much) == pytest.approx(math.log(2.0), abs=1e-3)


@pytest.mark.parametrize(
    ("name", "by", "likelier"),
    [
        ("likelihood", 1.0, True),
        ("gap", 0.2, False),  # it closes less of the gap
        ("size", 1.0, True),
        ("rival", 0.5, False),
        ("later", 1.0, False),
        ("structure", 1.0, False),
        ("once", 1.0, False),
        ("damaged", 1.0, False),
    ],
)
def test_each_piece_of_evidence_counts_as_it_should(name, by, likelier):
    other = replace(PLAIN, **{name: getattr(PLAIN, name) + by})

    assert (compute_probability(other) > compute_probability(PLAIN)) is likelier


@given(times=st.floats(0.2, 10.0))
def test_the_size_of_an_effect_is_given_in_everyday_sizes(times):
    # The largest everyday lag, times a factor, is that factor in everyday sizes.
    (lag,) = EFFECTS["delay"].parameters

    found = compute_log_size("delay", {"kV": 2.0, f"delay.{lag.name}": times * lag.everyday})

    assert -FARTHEST <= found <= LARGEST_SIZE
    assert found == pytest.approx(min(math.log(times), LARGEST_SIZE), abs=0.01)


@pytest.mark.parametrize(
    ("window", "repeated", "peak", "ratio"),
    [
        (UNLIKELY_WINDOW, 0.0, 0.0, 1.0),
        (0.0, 2.0 * REPEATED, 0.0, 2.0),
        (0.5 * UNLIKELY_WINDOW, 0.0, 0.9 * PERIODIC, 0.9),
    ],
)
def test_residuals_are_judged_by_their_worst_statistic(window, repeated, peak, ratio):
    left = ResidualSummary(
        WorstWindow(window),
        replace(RepeatedResidual(), size=repeated),
        replace(SpectralPeak(), size=peak),
    )

    assert left.largest_ratio == pytest.approx(ratio)
    assert left.has_structure is (ratio > 1.0)


@given(
    own=st.floats(1.0, 1e5),
    others=st.dictionaries(
        st.sampled_from(["heating", "drag", "inertia-change"]), st.floats(-50, 1e6)
    ),
)
def test_a_rival_counts_only_if_it_lasts_as_the_effect_does(own, others):
    share = compute_rival_share("battery-sag", own, {"battery-sag": own, **others})
    lasting = [score for name, score in others.items() if name != "inertia-change"]

    assert 0.0 <= share <= 1.0
    assert share == pytest.approx(min(max(max(lasting, default=0.0) / own, 0.0), 1.0))


@pytest.fixture(scope="module")
def fitted():
    log = rubbing(GAINS, (1.0, 1.0, 1.0, 1.0), noise=NOISE, step=4.0, seed=0)
    problem, point = based(log, GAINS)
    return problem, minimize(problem, point)


def excluded(problem, *runs):
    records = [one.exclude() if n in runs else one for n, one in enumerate(problem.records)]
    return replace(problem, records=tuple(records))


def test_which_samples_are_compared_does_not_depend_on_the_model(fitted):
    problem, point = fitted
    stuck = problem.evaluate(
        point.structure, {**point.values, "kS": 50.0}, point.nuisance, point.process_noise
    )

    moving, still = (compute_open_loop_errors(problem, one, one.nuisance) for one in (point, stuck))

    assert len(moving) == len(still) == np.count_nonzero(problem.informative | problem.moving)


def test_empty_fold_is_not_used_and_has_no_gap(fitted):
    problem, _ = fitted
    damaged = excluded(problem, 2)
    folds = make_folds([0] * 4)

    assert [one.predicted for one in select_usable_folds(damaged, folds)] == [(0,), (1,), (3,)]
    assert select_usable_folds(excluded(problem, 0, 1, 2), folds) == ()
    assert select_usable_folds(damaged, [Fold((2,), (0, 1))]) == ()
    gap = compute_rms_gap(np.empty((0, 2)))
    assert math.isnan(gap.velocity)
    assert math.isnan(gap.position)


def test_standard_errors_are_those_of_the_covariance_and_say_what_is_not_known(fitted):
    problem, point = fitted
    structure = point.structure + "deadband"
    values = {**point.values, "deadband.band": 0.01}  # below every voltage at which it moves
    beside = problem.evaluate(structure, values, point.nuisance, point.process_noise)

    errors = compute_standard_errors(problem, point)
    unknown = compute_standard_errors(problem, beside)

    variance = np.diag(compute_run_variation_covariance(problem, point))
    assert list(errors.values()) == pytest.approx(np.sqrt(variance).tolist())
    assert unknown["deadband.band"] == math.inf
    assert unknown["kV"] == pytest.approx(errors["kV"], rel=0.05)
