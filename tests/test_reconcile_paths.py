"""Which path a search goes: what it turns to where the first one leads astray."""

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
from sim.physics.effects import EFFECTS
from sim.physics.engine import State
from sim.physics.model import Model
from sim.reconcile.backward_elimination import replace_effects
from sim.reconcile.candidates import Candidate
from sim.reconcile.cross_validation import Gap
from sim.reconcile.forward_selection import (
    add_pair,
    choose_path,
    list_alternative_paths,
    select_admissible,
    take_nearest,
)
from sim.reconcile.model_selection import HARDLY, WIDENS, choose_simplest
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound, WeighedCandidate
from sim.reconcile.story import TriedCandidate


def weighed(effect, score, *, gap=0.95, why="", **values):
    """A suspect, as far as choosing among them asks: how likely, how near, how large."""
    structure = ModelStructure("simple") + effect
    named = {f"{effect}.{name}": value for name, value in values.items()}
    point = replace(NOWHERE, structure=structure, values=named)
    tried = TriedCandidate(effect, score, gap, admitted=not why, why=why)
    return WeighedCandidate(Candidate(effect, point, 0.0), Gap(gap, gap), tried)


def model(effect, score, *, gap, others=()):
    """A round, as far as choosing a path asks: what it added, how likely, how far off."""
    suspect = Candidate(effect, NOWHERE, score)
    weighed = tuple(
        WeighedCandidate(
            Candidate(name, NOWHERE, 0.0),
            Gap(gap, gap),
            TriedCandidate(name, more, 0.9, admitted=good, why=""),
        )
        for name, more, good in others
    )
    return SelectionRound(suspect, Gap(gap, gap), Gap(gap, gap), candidates=weighed)


QUICK = recorded(
    "dynamic-forward", Model("simple", {"kS": 0.2, "kV": 0.05, "kA": 0.005}),
    step=6.0, state=State.cold_at(0.0), noise=(1.0, 1.0), rng=np.random.default_rng(5),
)  # fmt: skip
ONE_NOISE = PredictionErrorProblem(
    make_run_records(Log((QUICK,), units="meters", type="simple")),
    SensorNoise(1.0, 1.0, (0.0, 0.0)),
)  # at a hundred times as much it runs: what is missed by some noises is not lost
FIRST = [("drag", 400.0, True), ("delay", 300.0, True), ("spring", 200.0, False)]
THEN = [("cogging", 90.0, True), ("stribeck", 80.0, True), ("delay", 10.0, True)]


def gone(*, end):
    return [
        model("", 1000.0, gap=9.0, others=FIRST),
        model("drag", 600.0, gap=5.0, others=THEN),
        model("cogging", 510.0, gap=end),
    ]


def test_other_paths_turn_off_early_where_an_admitted_effect_came_near():
    turned = list_alternative_paths(gone(end=4.0), lost=False)

    # spring was not admitted, and a delay of 10 is no ninth of what cogging explained
    assert [(place, one.candidate.effect) for place, one in turned] == [
        (0, "delay"),
        (1, "stribeck"),
    ]


@pytest.mark.parametrize(
    ("lost", "order"), [(False, ["compliance", "limit"]), (True, ["limit", "compliance"])]
)
def test_a_path_that_is_lost_gives_way_to_what_comes_nearest_not_to_the_likeliest(lost, order):
    others = {"backlash": (790.0, 0.91), "compliance": (780.0, 0.90), "limit": (730.0, 0.61)}
    tried = tuple(weighed(name, score, gap=gap) for name, (score, gap) in others.items())
    base = replace(model("", 1000.0, gap=9.0), candidates=tried)

    turned = list_alternative_paths([base, model("backlash", 210.0, gap=8.2)], lost=lost)

    assert [one.candidate.effect for _, one in turned] == order


@pytest.mark.parametrize(
    ("end", "other", "taken"),
    [
        (4.0, (300.0, 1.2), True),  # likelier and nearer
        (4.0, (300.0, 4.5), False),  # likelier, and farther off on runs it was not fitted to
        (4.0, (505.0, 3.9), False),  # hardly likelier
        (1.2, (300.0, 1.0), False),  # the first path does not stray: no other is gone
    ],
)
def test_another_path_is_taken_where_the_first_strays_and_it_does_not(
    monkeypatch, end, other, taken
):
    done = gone(end=end)
    score, gap = other
    path = [done[0], model("delay", score, gap=gap)]
    monkeypatch.setattr(sys.modules[choose_path.__module__], "_continue_search", lambda *_: path)

    found = choose_path(SelectionData(None, ONE_NOISE, ()), done)

    assert (found is path) is taken


BLOCKED = ("compliance", 900.0, WIDENS)


@pytest.mark.parametrize(
    ("other", "path", "taken"),
    [
        (BLOCKED, (5.0, 1.2), True),  # the second closes what the first opened
        (BLOCKED, (5.0, 4.5), False),  # together they widen it, too
        (BLOCKED, (5.0, 3.8), False),  # and a pair has to close much of it
        (BLOCKED, (1.2,), False),  # no second was found
        (("compliance", 90.0, WIDENS), (5.0, 1.2), False),  # hardly likelier
        (("compliance", 900.0, HARDLY), (5.0, 1.2), False),
        (("inertia-change", 900.0, WIDENS), (5.0, 1.2), False),  # masks nothing
        (("delay", 900.0, WIDENS), (5.0, 1.2), False),  # any robot has as much
    ],
)
def test_two_effects_that_mask_each_other_are_tried_as_a_pair(monkeypatch, other, path, taken):
    effect, score, why = other
    small = {f"{effect}.{name}": 0.001 for name in EFFECTS[effect].names}
    point = replace(NOWHERE, values=small)
    tried = TriedCandidate(effect, score, 1.2, admitted=False, why=why)
    another = WeighedCandidate(Candidate(effect, point, 0.0), Gap(5.0, 5.0), tried)
    done = [replace(model("", 1000.0, gap=4.0), candidates=(another,))]
    asked = []

    def gone_on(_, begun, *__):
        asked.append(begun[-1].candidate.effect)
        new = (model(f"effect {n}", 100.0, gap=gap) for n, gap in enumerate(path))
        return [*done, *new]

    room = sys.modules[choose_path.__module__]
    monkeypatch.setattr(room, "_continue_search", gone_on)

    found = add_pair(SelectionData(None, ONE_NOISE, ()), done)

    assert (found is not done) is taken
    assert set(asked) <= {"compliance"}


@pytest.mark.parametrize(
    ("pair", "taken"), [(("compliance", "spring"), True), (("spring",), False)]
)
def test_a_pair_that_makes_needless_what_was_there_is_a_pair(monkeypatch, pair, taken):
    small = {f"compliance.{name}": 0.001 for name in EFFECTS["compliance"].names}
    tried = TriedCandidate("compliance", 900.0, 1.2, admitted=False, why=WIDENS)
    suspect = Candidate("compliance", replace(NOWHERE, values=small), 0.0)
    blocked = WeighedCandidate(suspect, Gap(5.0, 5.0), tried)
    base = model("", 1000.0, gap=4.0)
    done = [base, replace(model("cogging", 900.0, gap=3.8), candidates=(blocked,))]
    path = [base, *(model(name, 100.0, gap=1.2) for name in pair)]
    room = sys.modules[choose_path.__module__]
    monkeypatch.setattr(room, "_continue_search", lambda *_: path)

    found = add_pair(SelectionData(None, ONE_NOISE, ()), done)

    assert found == (path if taken else done)


# -- which of two is taken ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other", "taken"),
    [
        (("drag", 45.0, 0.74), ("heating", 43.0, 0.58), "heating"),  # the validation prefers it
        (("drag", 45.0, 0.74), ("heating", 43.0, 0.735), "drag"),  # hardly: the likelier
        (("drag", 45.0, 0.74), ("heating", 30.0, 0.58), "drag"),  # surely likelier
        (("stribeck", 308.0, 0.74), ("deadband", 237.0, 0.35), "deadband"),  # closes far more
        (("stribeck", 308.0, 0.74), ("deadband", 237.0, 0.5), "stribeck"),
        (("stribeck", 308.0, 0.74), ("deadband", 140.0, 0.35), "stribeck"),  # not half as likely
        (("spring", 45.0, 0.58), ("drag", 43.0, 0.74), "drag"),  # fewer parameters go first
        # of an effect and its simpler form, the likelier, which has paid for its parameters
        (("spring", 45.0, 0.58), ("constant-load", 43.0, 0.58), "spring"),
        (("constant-load", 45.0, 0.58), ("spring", 43.0, 0.58), "constant-load"),
        # what may be one run's accident has to be far likelier than what lasts
        (("inertia-change", 280.0, 0.9), ("heating", 160.0, 0.9), "heating"),
        (("inertia-change", 300.0, 0.9), ("heating", 160.0, 0.9), "inertia-change"),
    ],
)
def test_of_two_about_as_likely_the_validation_decides(one, other, taken):
    tried = [weighed(name, score, gap=gap) for name, score, gap in (one, other)]

    assert choose_simplest(tried).candidate.effect == taken


# -- what goes first ------------------------------------------------------------------------------


LIMIT = weighed("current-limit", 491.0, limit=4.3)
SAG = weighed("battery-sag", 283.0, share=0.6)


@pytest.mark.parametrize(
    ("other", "admitted"),
    [
        (weighed("delay", 357.0, lag=0.003), ["delay"]),
        (weighed("delay", 200.0, lag=0.003), ["current-limit", "battery-sag", "delay"]),
        (weighed("delay", 357.0, lag=0.03), ["current-limit", "battery-sag", "delay"]),
        (weighed("delay", 357.0, lag=0.003, why=WIDENS), ["current-limit", "battery-sag"]),
    ],
)
def test_an_everyday_effect_goes_first_where_it_is_nearly_the_likeliest(other, admitted):
    found = select_admissible([LIMIT, SAG, other])

    assert [one.candidate.effect for one in found] == admitted


@pytest.mark.parametrize(
    ("other", "gains", "taken"),
    [
        ("inertia-change", 50.0, "battery-sag"),  # what may be one run's accident
        ("inertia-change", 200.0, "inertia-change"),
        ("drag", 50.0, "drag"),
    ],
)
def test_what_happens_once_takes_the_place_of_what_lasts_only_if_it_is_far_likelier(
    monkeypatch, other, gains, taken
):
    one_gap = Gap(1.0, 1.0)
    alike = (("battery-sag", 425.0, True), (other, 366.0, True))
    base = model("", 1000.0, gap=2.0, others=alike)
    point = replace(
        NOWHERE,
        structure=ModelStructure("simple") + "battery-sag" + "stribeck",
        values={"kS": 0.1, "kV": 1.0, "kA": 0.1, "battery-sag.share": 0.5, "stribeck.extra": 0.2,
                "stribeck.slow": 0.1},
    )  # fmt: skip
    last = SelectionRound(Candidate("stribeck", point, 500.0), one_gap, one_gap)
    done = [base, model("battery-sag", 600.0, gap=1.1), last]
    path = sys.modules["sim.reconcile.backward_elimination"]
    monkeypatch.setattr(SelectionData, "voltage_residual", lambda *_: None)
    monkeypatch.setattr(path, "refit_without_effect", lambda *_: Candidate("", point, 900.0))
    monkeypatch.setattr(
        path, "rank_candidates", lambda *_, **__: [Candidate(other, point, 500.0 - gains)]
    )
    monkeypatch.setattr(path, "compute_validation_gap", lambda *_: one_gap)

    found = replace_effects(SelectionData(None, ONE_NOISE, ()), done)

    assert [one.candidate.effect for one in found] == ["", taken, "stribeck"]


@pytest.mark.parametrize(
    ("last", "others", "taken"),
    [
        (5.0, [weighed("velocity-filter", 900.0, gap=1.0)], "velocity-filter"),
        (0.5, [weighed("velocity-filter", 900.0, gap=1.0)], "backlash"),
        (1.001, [weighed("velocity-filter", 900.0, gap=1.0)], "backlash"),
        (5.0, [weighed("velocity-filter", 900.0, gap=1.0, why=WIDENS)], "backlash"),
        (5.0, [], "backlash"),
    ],
)
def test_a_search_without_time_for_a_next_round_takes_what_closes_most_of_the_gap(
    last, others, taken
):
    before = replace(model("", 1000.0, gap=9.0), candidates=tuple(others))

    found = take_nearest([before, model("backlash", 600.0, gap=last)])

    assert [one.candidate.effect for one in found] == ["", taken]


def test_a_search_that_looked_for_a_next_effect_keeps_its_last_one():
    before = replace(
        model("", 1000.0, gap=9.0), candidates=(weighed("velocity-filter", 900.0, gap=1.0),)
    )
    done = [before, model("backlash", 600.0, gap=5.0, others=THEN)]

    assert take_nearest(done) is done
