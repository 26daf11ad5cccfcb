"""The verdict: what the findings and what is left of the gap come to."""

import numpy as np
import pytest
from reconcile_made import recorded
from story_made import DRAG, SLIP

from sim.engine import State
from sim.log import Log
from sim.model import Model, Part
from sim.reconcile.alike import Alike
from sim.reconcile.gates import Gap
from sim.reconcile.hypothesis import Hypothesis
from sim.reconcile.lanes import lanes
from sim.reconcile.naming import beside
from sim.reconcile.outset import Outset
from sim.reconcile.problem import Problem
from sim.reconcile.remainder import Moment
from sim.reconcile.round import Round
from sim.reconcile.suspects import judged
from sim.reconcile.verdict import verdict_of
from sim.units import unit

GAINS = {"kS": 0.2, "kV": 0.5, "kA": 0.05}
CALM, METERS = Moment(3.0, 0, 0.0, 0.1), unit("meters")
LASTS = 1e6  # [s]


@pytest.fixture(scope="module")
def problem():
    """Two steps, whose velocities have a noise of 1 mm/s beside meters per second."""
    rng = np.random.default_rng(3)
    model = Model("simple", GAINS)
    runs = [
        recorded(test, model, step=6.0, state=State.at(0.0), noise=(1e-5, 1e-3), rng=rng)
        for test in ("dynamic-forward", "dynamic-reverse")
    ]
    return Problem.of(lanes(Log(tuple(runs), units="meters", type="simple")))


def rounds(problem, *gaps, values=GAINS, hypothesis=None):
    """The base and what was added to it, with gaps in noises of the velocity."""
    hypothesis = hypothesis or Hypothesis("simple")
    point = problem.at(hypothesis, values, Outset.seen(2), problem.noise.velocity**2)
    sizes = [Gap(gap * problem.noise.velocity, 1e-5) for gap in gaps]
    before = [sizes[0], *sizes[:-1]]
    return [Round(judged(problem, point), *both) for both in zip(sizes, before, strict=True)]


@pytest.mark.parametrize(
    ("gaps", "findings", "verdict", "remains"),
    [
        ((40.0, 1.1), [DRAG], "explained", False),
        ((40.0, 15.0), [DRAG], "explained", True),  # less than half is left
        ((40.0, 30.0), [DRAG], "unexplained", True),
        ((2.0, 1.6), [DRAG], "explained", False),  # next to nothing
        ((40.0,), [SLIP], "explained", True),  # damage narrows no gap
        ((40.0, 30.0), [SLIP, DRAG], "unexplained", True),
        ((40.0,), [], "unexplained", True),
    ],
)
def test_what_leaves_most_of_the_gap_is_no_explanation(problem, gaps, findings, verdict, remains):
    said = verdict_of(
        findings, rounds(problem, *gaps), problem, moment=CALM, alike=Alike(), per=METERS
    )

    assert said[:2] == (verdict, remains)
    assert bool(said[2]) is remains


@pytest.mark.parametrize(("after", "told"), [(0.2, True), (0.9, False)])
def test_what_is_in_the_model_and_not_named_is_told(problem, after, told):
    onset = float(problem.lanes[0].clock) + 0.5
    joins = {"extra": 0.02, "onset": onset, "until": LASTS, "shared": 0.0}
    part = Part("inertia-change", joins)
    values = {**GAINS, **{f"{part.effect}.{name}": value for name, value in joins.items()}}
    done = rounds(problem, 5.0, values=values, hypothesis=Hypothesis("simple") + part.effect)
    start = float(problem.lanes[0].seen.time[0]) + 0.5 + after
    strange = Moment(20.0, 0, start, start + 0.1)

    (said,) = beside(problem, done, [], strange)

    assert "inertia-change" in said
    assert ("not named" in said) is told
    assert ("a little inertia-change" in said) is not told
