"""Where a search begins, and which path it goes: what is small or masked is found as well."""

import math
import sys
from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import SESSIONS, bench, session, told

from sim.effects import EFFECTS
from sim.engine import Track
from sim.evidence import gather
from sim.fit.seen import Noise
from sim.model import Part
from sim.reconcile.descent import adjusting, promise
from sim.reconcile.gates import Gap, errors_of, rms
from sim.reconcile.hypothesis import Hypothesis
from sim.reconcile.lanes import SetAside, lanes
from sim.reconcile.outset import Outset
from sim.reconcile.problem import FARTHEST, Point, Problem
from sim.reconcile.round import Round, Weighed
from sim.reconcile.rounds import best_path, paired, rounds, turnings
from sim.reconcile.story import Tried
from sim.reconcile.suspects import Suspect, suspects
from sim.reconcile.thresholds import MAJOR
from sim.reconcile.weighing import HARDLY, WIDENS, simplest, why_not

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
    problem = Problem.of(lanes(session(built, "log")))
    base = Hypothesis("simple")
    values = {name: built.gains[name] for name in base.names}
    point = problem.at(base, values, Outset.seen(len(problem.lanes)), problem.noise.velocity**2)
    far = {"compliance.softness": FAR * truth, "compliance.share": 0.25}

    begun = promise(problem, point, base + "compliance", [far], kept=adjusting(problem, point))

    gained, at_once = begun[0]
    most, best = max(begun, key=lambda one: one[0])
    assert at_once.values["compliance.softness"] == FAR * truth
    assert gained < 0.0  # so far off that nothing else would ever have been tried
    assert most > 0.0
    assert best.values["compliance.softness"] == pytest.approx(truth, rel=1.0)


@pytest.mark.parametrize("far", [1e200, math.inf, -math.inf, math.nan])
def test_what_a_change_makes_fly_off_is_large_and_its_squares_are_numbers(far):
    problem = Problem.of(lanes(session(bench("drivetrain"), "log")))
    table = np.zeros_like(problem.measured)
    table[3] = far

    white = problem.white(NOWHERE, table)

    assert np.isfinite(np.sum(np.square(white)))
    assert np.max(np.abs(white)) >= FARTHEST


@pytest.mark.parametrize("part", [-0.2, -2.0, 8.0])
def test_a_start_that_goes_the_wrong_way_or_too_far_is_turned(part):
    built = bench("drivetrain", "asymmetric-back-emf")
    truth = built.hidden[0].parameters["lean"]
    problem = Problem.of(lanes(session(built, "log")))
    base, name = Hypothesis("simple"), "asymmetric-back-emf"
    values = {name: built.gains[name] for name in base.names}
    point = problem.at(base, values, Outset.seen(len(problem.lanes)), problem.noise.velocity**2)

    begun = promise(
        problem,
        point,
        base + name,
        [{f"{name}.lean": part * truth}],
        kept=adjusting(problem, point),
    )

    _, best = max(begun, key=lambda one: one[0])
    assert best.values[f"{name}.lean"] == pytest.approx(truth, rel=0.5)


def test_what_cannot_be_negative_is_not_turned():
    built = bench("drivetrain", "drag")
    problem = Problem.of(lanes(session(built, "log")))
    base = Hypothesis("simple")
    values = {name: built.gains[name] for name in base.names}
    point = problem.at(base, values, Outset.seen(len(problem.lanes)), problem.noise.velocity**2)
    more = [{"drag.drag": size * built.hidden[0].parameters["drag"]} for size in (0.05, 4.0)]

    begun = promise(problem, point, base + "drag", more, kept=adjusting(problem, point))

    assert all(one.values["drag.drag"] >= 0.0 for _, one in begun)


def test_two_bodies_are_tried_where_all_lively_runs_were_set_aside():
    built = bench("drivetrain")
    log = session(built, "log")
    runs = [
        one.without(SetAside(number, 0.0, math.inf)) if "dynamic" in one.test else one
        for number, one in enumerate(lanes(log))
    ]
    problem = Problem.of(runs)
    base = Hypothesis("simple")
    values = {name: built.gains[name] for name in base.names}
    point = problem.at(base, values, Outset.seen(len(runs)), problem.noise.velocity**2)
    evidence = gather(log, dict(base.model(values).gains), type="simple")

    found = suspects(problem, point, evidence, only=["backlash"])

    assert all(math.isfinite(one.score) for one in found)


@pytest.mark.parametrize(
    ("inertia", "gaps", "asked"),
    [
        (0.05, [0.3, 0.29], 2),  # it follows the log: every suspect is tried, and again
        (5000.0, [0.9], 0),  # voltage drives nothing in it
        (5000.0, [0.3, 0.29], 2),  # and yet it follows
        (0.05, [0.9, 0.85, 0.8], 1),  # the first effect took little away
        (0.05, [0.9, 0.45, 0.44], 2),  # the first did, the second did not
    ],
)
def test_a_search_that_leads_nowhere_is_given_up(monkeypatch, inertia, gaps, asked):
    log = session(bench("drivetrain"), "log")
    problem = Problem.of(lanes(log))
    moves = np.sqrt(np.nanmean(problem.measured[problem.moving, 1] ** 2))
    sizes = [Gap(share * float(moves), 1.0) for share in gaps]
    values = {"kS": 0.1, "kV": 2.0, "kA": 2.0 * inertia}
    begun = Outset.seen(len(problem.lanes))
    base = problem.at(Hypothesis("simple"), values, begun, problem.noise.velocity**2)
    calls = []

    def weighed(_, now, *__):
        calls.append(now)
        if len(calls) == len(sizes):
            return []
        other = replace(now.suspect, effect="drag", score=now.suspect.score - 500.0)
        return [Weighed(other, sizes[len(calls)], Tried("drag", 500.0, 0.9, admitted=True, why=""))]

    room = sys.modules["sim.reconcile.rounds"]
    monkeypatch.setattr(room, "weigh", weighed)
    monkeypatch.setattr(room, "outside", lambda *_: sizes[0])
    monkeypatch.setattr(room, "ended", lambda _, point: point)
    monkeypatch.setattr(room, "_seeds", lambda _: {})
    for name in ("reconsidered", "simplified", "missed_by", "best_path", "paired"):
        monkeypatch.setattr(room, name, lambda _, done, *__: done)

    done = rounds(problem, base, log, [], lambda *_: None)

    assert len(calls) == asked
    assert len(done) == 1 + min(asked, len(sizes) - 1)


# -- which path is gone ---------------------------------------------------------------------------


def model(effect, score, *, gap, others=()):
    """A round, as far as choosing a path asks: what it added, how likely, how far off."""
    suspect = Suspect(effect, NOWHERE, score)
    weighed = tuple(
        Weighed(
            Suspect(name, NOWHERE, 0.0),
            Gap(gap, gap),
            Tried(name, more, 0.9, admitted=good, why=""),
        )
        for name, more, good in others
    )
    return Round(suspect, Gap(gap, gap), Gap(gap, gap), weighed=weighed)


NOTHING = np.empty((0, 2))
NOWHERE = Point(
    Hypothesis("simple"), {}, Outset.seen(0), 0.0, np.zeros((2, 2)), NOTHING, np.eye(2), 0.0
)
ONE_NOISE = Problem((), Noise(1.0, 1.0, (0.0, 0.0)))
FIRST = [("drag", 400.0, True), ("delay", 300.0, True), ("spring", 200.0, False)]
THEN = [("cogging", 90.0, True), ("stribeck", 80.0, True), ("delay", 10.0, True)]


def gone(*, end):
    return [
        model("", 1000.0, gap=9.0, others=FIRST),
        model("drag", 600.0, gap=5.0, others=THEN),
        model("cogging", 510.0, gap=end),
    ]


def test_other_paths_turn_off_early_where_an_admitted_effect_came_near():
    found = [(place, one.suspect.effect) for place, one in turnings(gone(end=4.0))]

    # spring was not admitted, and a delay of 10 is no ninth of what cogging explained
    assert found == [(0, "delay"), (1, "stribeck")]


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
    monkeypatch.setattr(sys.modules[best_path.__module__], "_gone", lambda *_: path)

    found = best_path(ONE_NOISE, done, None, (), lambda *_: None)

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
    tried = Tried(effect, score, 1.2, admitted=False, why=why)
    another = Weighed(Suspect(effect, point, 0.0), Gap(5.0, 5.0), tried)
    done = [replace(model("", 1000.0, gap=4.0), weighed=(another,))]
    asked = []

    def gone_on(_, begun, *__):
        asked.append(begun[-1].suspect.effect)
        new = (model(f"effect {n}", 100.0, gap=gap) for n, gap in enumerate(path))
        return [*done, *new]

    room = sys.modules[best_path.__module__]
    monkeypatch.setattr(room, "_gone", gone_on)

    found = paired(ONE_NOISE, done, None, (), lambda *_: None)

    assert (found is not done) is taken
    assert set(asked) <= {"compliance"}


@pytest.mark.parametrize(
    ("pair", "taken"), [(("compliance", "spring"), True), (("spring",), False)]
)
def test_a_pair_that_makes_needless_what_was_there_is_a_pair(monkeypatch, pair, taken):
    small = {f"compliance.{name}": 0.001 for name in EFFECTS["compliance"].names}
    tried = Tried("compliance", 900.0, 1.2, admitted=False, why=WIDENS)
    suspect = Suspect("compliance", replace(NOWHERE, values=small), 0.0)
    blocked = Weighed(suspect, Gap(5.0, 5.0), tried)
    base = model("", 1000.0, gap=4.0)
    done = [base, replace(model("cogging", 900.0, gap=3.8), weighed=(blocked,))]
    path = [base, *(model(name, 100.0, gap=1.2) for name in pair)]
    room = sys.modules[best_path.__module__]
    monkeypatch.setattr(room, "_gone", lambda *_: path)

    found = paired(ONE_NOISE, done, None, (), lambda *_: None)

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
        # what may be one run's accident has to be far likelier than what lasts
        (("inertia-change", 280.0, 0.9), ("heating", 160.0, 0.9), "heating"),
        (("inertia-change", 300.0, 0.9), ("heating", 160.0, 0.9), "inertia-change"),
    ],
)
def test_of_two_about_as_likely_the_validation_decides(one, other, taken):
    weighed = [
        Weighed(at(name), Gap(1.0, 1.0), Tried(name, score, gap, admitted=True, why=""))
        for name, score, gap in (one, other)
    ]

    assert simplest(weighed).suspect.effect == taken


def at(effect):
    hypothesis = Hypothesis("simple") + effect
    return Suspect(effect, replace(NOWHERE, hypothesis=hypothesis), 0.0)


@pytest.mark.parametrize("gap", [math.nan, math.inf])
@pytest.mark.parametrize("before", [1.0, math.inf])
def test_a_model_that_runs_away_on_the_validation_widens_the_gap(gap, before):
    assert why_not(Gap(gap, 1.0), Gap(before, 1.0), 1000.0) == WIDENS


def test_what_runs_away_is_not_left_out_of_the_gap(monkeypatch):
    problem = Problem.of(lanes(session(bench("drivetrain"), "log")))
    out = np.tile(problem.measured, 4)
    out[-1] = np.nan
    monkeypatch.setattr(Problem, "track", lambda *_, **__: Track.of(out))
    point = replace(NOWHERE, values={"kS": 0.1, "kV": 1.0, "kA": 0.1})

    assert rms(errors_of(problem, point, Outset.seen(4), eased=True)).velocity == math.inf


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
    problem = Problem.of(lanes(session(built, "log")))
    base = Hypothesis("simple") + effect
    values = {name: built.gains[name] for name in base.names if name in built.gains}
    values |= {f"{effect}.{name}": one for name, one in built.hidden[0].parameters.items()}
    outset, count = Outset.seen(len(problem.lanes)), len(problem.lanes)
    point = problem.at(base, values, outset, problem.noise.velocity**2)

    starts = problem.columns(point)[:, -2 * count : -count]

    for number in range(count):
        by = np.zeros(count)
        by[number] = problem.noise.position
        moved = problem.at(base, values, outset.moved(by), point.q)
        change = problem.white(point, moved.ahead - point.ahead) / problem.noise.position
        size = np.abs(change).max()
        assert starts[:, number] == pytest.approx(change, abs=0.02 * size)
