"""A joint has many local minima: those of a light and of a heavy motor are found on step tests."""

import math
from dataclasses import replace

import pytest
from reconcile_made import SESSIONS, bench, session, told

from sim.estimation.model_structure import ModelStructure
from sim.physics.model import Part

BASE = ModelStructure("simple")
SLACK = 0.02  # [rad]
STEPS = 3  # downhill
SOFT = BASE + "compliance"
BELT = {"softness": 0.02, "share": 0.3, "damping": 0.05, "motor_friction": 0.3}


def built(effect="", **values):
    hidden = (Part(effect, values),) if effect else ()
    return replace(bench("turret"), hidden=hidden)


@pytest.mark.parametrize("share", [0.2, 0.46])
def test_free_play_is_found_whatever_its_motor_weighs(share):
    mechanism = built("backlash", slack=SLACK, share=share, damping=0.3, motor_friction=share)

    story = told({name: session(mechanism, name) for name in SESSIONS}, type="simple")

    first = story.findings[0]
    assert first.effect == "backlash"
    # if no run crosses all of it, the least is told that does the same
    assert 0.4 < first.parameters["slack"].value / math.degrees(SLACK) < 1.1
    assert first.parameters["share"].value == pytest.approx(share, rel=0.2)
