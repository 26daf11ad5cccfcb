"""Feedforward alone: right gains follow, each wrong one shows in its own way, and words say so."""

import math

import numpy as np
import pytest

from sim.core.errors import BadRequest
from sim.feedback import Plant
from sim.feedback.following import follow_profile
from sim.feedback.profile import STEP, make_brisk_profile, make_return_profile
from sim.plot.consequence import Trace, make_profile_traces, plot_consequence

DRIVE = {"kS": 0.15, "kV": 2.5, "kA": 0.2}
LIFT = {"kS": 0.25, "kV": 4.5, "kA": 0.2, "kG": 2.0}
ARM = {"kS": 0.25, "kV": 1.2, "kA": 0.08, "kG": 1.5, "offset_rad": 0.3}
UP = make_return_profile(0.5, rising=0.25, steady=0.75, still=1.0, start=0.5)
PLANTS = {"simple": DRIVE, "elevator": LIFT, "arm": ARM}


def followed(kind, *, wanted=UP, **changes):
    """A mechanism of a kind under a feedforward with some gains changed."""
    plant, believed = Plant(kind, PLANTS[kind]), Plant(kind, {**PLANTS[kind], **changes})
    place = {"simple": "way", "elevator": "height", "arm": "angle"}[kind]
    return follow_profile(
        plant, believed, wanted, name="mechanism", symbol="m", place=place, stops=(0.0, 1.3)
    )


@pytest.mark.parametrize("kind", PLANTS)
def test_right_gains_follow_the_profile(kind, reads):
    one = followed(kind)
    off = np.abs(np.subtract(one.position, one.target.position)).max()

    assert off < 0.015 * 0.5  # of the way
    reads(one.description)


@pytest.mark.parametrize("factor", [0.5, 1.0, 1.7])
def test_the_steady_speed_is_in_proportion_to_kv(factor):
    one = followed(
        "simple", wanted=make_brisk_profile(Plant("simple", DRIVE)), kV=factor * DRIVE["kV"]
    )
    place = one.target.cruise_end

    free = follow_profile(
        Plant("simple", DRIVE), Plant("simple", {**DRIVE, "kV": factor * DRIVE["kV"]}), one.target,
        name="mechanism", symbol="m",
    )  # fmt: skip
    assert free.velocity[place] == pytest.approx(factor * one.target.velocity[place], rel=1e-3)


def test_an_elevator_without_kg_falls_as_its_gains_say():
    one = followed("elevator", kG=0.0)
    at = int(0.5 / STEP)

    assert one.velocity[at] == pytest.approx(-(2.0 - 0.25) / 4.5, rel=1e-3)  # -(kG - kS)/kV
    assert min(one.position) == 0.0  # its stop


@pytest.mark.parametrize(
    ("kind", "changes"),
    [
        ("elevator", {"kG": 0.0}),
        ("elevator", {"kG": 5.5}),
        ("elevator", {"kG": 9.0}),
        ("elevator", {"kG": 2.2}),
        ("elevator", {"kV": 4.5 / 6.28}),
        ("elevator", {"kV": 0.0, "kS": 0.0}),
        ("elevator", {"kV": -4.5}),
        ("elevator", {"kV": 60.0}),
        ("simple", {"kA": 0.0}),
        ("simple", {"kA": 0.6}),
        ("arm", {"offset_rad": 0.3 - math.pi}),
    ],
)
def test_a_wrong_gain_is_described_by_its_effect_on_the_motion(kind, changes, reads):
    reads(followed(kind, **changes).description)


def test_what_cannot_be_drawn_is_refused(reads):
    short = Trace("thing", "way [m]", (0.0, 1.0), (0.0, 1.0), {"what it does": (0.0,)})

    with pytest.raises(BadRequest) as refused:
        plot_consequence([short], words="")
    reads(refused.value)
    with pytest.raises(BadRequest) as refused:
        plot_consequence([], words="")
    reads(refused.value)


def test_picture_shows_the_wanted_and_the_resulting_motion():
    one = followed("elevator", kG=0.0)

    drawn = plot_consequence(make_profile_traces(one), words=one.description)

    speed, height = drawn.figure.axes
    wanted, done = height.get_lines()
    assert one.description in drawn.alt
    assert speed.get_ylabel() == "velocity [m/s]"
    assert wanted.get_ydata()[0] == done.get_ydata()[0] == 0.5
    assert done.get_ydata().min() == 0.0 < wanted.get_ydata().min()
