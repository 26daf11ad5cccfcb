"""Where a search begins: what is small, and what acts by a threshold, is found all the same."""

from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import SESSIONS, bench, session, told

from sim.model import Part
from sim.reconcile.descent import adjusting, promise
from sim.reconcile.hypothesis import Hypothesis
from sim.reconcile.lanes import lanes
from sim.reconcile.problem import Problem

BAND = 0.25  # [V] of an elevator whose ramps begin at 1.5 V upward, and at once downward
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
    built = bench("drivetrain", "backlash", size=SUBTLE)
    truth = built.hidden[0].parameters["slack"]
    problem = Problem.of(lanes(session(built, "log")))
    base = Hypothesis("simple")
    values = {name: built.gains[name] for name in base.names}
    point = problem.at(base, values, np.zeros(len(problem.lanes)), problem.noise.velocity**2)
    far = {"backlash.slack": FAR * truth, "backlash.share": 0.25}

    begun = promise(problem, point, base + "backlash", [far], kept=adjusting(problem, point))

    at_once = next(gained for gained, one in begun if one.values["backlash.slack"] == FAR * truth)
    most, best = max(begun, key=lambda one: one[0])
    assert at_once < 0.0  # so far off that nothing else would ever have been tried
    assert most > 0.0
    assert best.values["backlash.slack"] == pytest.approx(truth, rel=1.0)
