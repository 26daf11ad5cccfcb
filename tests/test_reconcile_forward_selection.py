"""Which of the admitted candidates is added next."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import NOWHERE, recorded

from sim.core.log import Log
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.measurements import SensorNoise
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_records import make_run_records
from sim.physics.engine import State
from sim.physics.model import Model
from sim.reconcile.candidates import Candidate
from sim.reconcile.cross_validation import Gap
from sim.reconcile.forward_selection import (
    add_pair,
    find_alternative,
)
from sim.reconcile.model_selection import HARDLY, WIDENS, choose_next
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound, WeighedCandidate
from sim.reconcile.story import TriedCandidate


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


LIMIT = weighed("current-limit", 491.0, limit=4.3)
SAG = weighed("battery-sag", 283.0, share=0.6)


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
def test_another_path_begins_where_an_admitted_candidate_came_near(others, by_gap, begun):
    tried = tuple(
        weighed(name, score, gap=gap) for name, score, gap in (("drag", 400.0, 0.9), *others)
    )
    widens = weighed("heating", 390.0, gap=1.3, why=WIDENS)
    done = [make_round("", gap=9.0, candidates=(*tried, widens)), make_round("drag", gap=5.0)]

    assert [one.candidate.effect for one in find_alternative(done, by_gap=by_gap)] == begun
