"""Where simulation and data disagree: what is planted is found where it is, and only there."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from sim.core.log import DIRECTIONS
from sim.estimation.measurements import SensorNoise
from sim.gap import Residuals, map_gap

NOISE = SensorNoise(position=1e-4, velocity=0.01, resolution=(1e-9, 1e-9))
SIZES = np.array([NOISE.position, NOISE.velocity])
PERIOD, KS, KV = 0.02, 0.2, 2.0
FOUR = [f"{kind}-{way}" for kind in ("quasistatic", "dynamic") for way in DIRECTIONS]
VELOCITY = 1


def expected(test):
    """Voltage and motion without inertia: a ramp of 0.5 V/s, or 4 V after half a second."""
    since = PERIOD * np.arange(400)
    volts = 0.5 * since if test.startswith("quasistatic") else np.where(since < 0.5, 0.0, 4.0)
    volts = volts if test.endswith("forward") else -volts
    speed = np.sign(volts) * np.maximum(np.abs(volts) - KS, 0.0) / KV
    return since, volts, np.column_stack([PERIOD * np.cumsum(speed), speed])


def run_of(test, *, rng, plant=None, start=0.0):
    """A run of which the model leaves noise and, in noises of a velocity, what is planted."""
    since, volts, motion = expected(test)
    missed = rng.normal(size=(since.size, 2)) * SIZES
    if plant:
        at = SimpleNamespace(t=since, u=volts, x=motion[:, 0], v=motion[:, 1])
        missed[:, VELOCITY] += NOISE.velocity * plant(at)
    return Residuals(test, start + since, volts, motion, missed)


def runs_of(*tests, seed=0, plant=None):
    rng = np.random.default_rng(seed)
    return [run_of(test, rng=rng, plant=plant) for test in tests or FOUR]


def since_jump(at):
    return np.where(np.abs(at.u) == 4.0, at.t - at.t[np.argmax(np.abs(at.u) > 2.0)], np.nan)


@pytest.mark.parametrize(
    ("plant", "what", "where", "sign"),
    [
        (
            lambda at: 3.0 * ((at.t > 4.0) & (at.t < 5.4) & (at.u > 0.0) & (at.u < 4.0)),
            "run", "quasistatic-forward (1), 4.0 to", 1.0,
        ),
        (
            lambda at: -4.0 * ((at.v > 0.48) & (at.v < 0.71)),
            "direction-speed", "forward, 25 to 37% of the top speed", -1.0,
        ),
        (
            lambda at: -4.0 * ((at.x < -4.8) & (at.x > -7.1)),
            "direction-position", "reverse, 25 to 33% of the way", 1.0,
        ),
        (
            lambda at: -6.0 * np.sign(at.u) * (since_jump(at) < 0.19),
            "after-steps", "0.00 to 0.20 s after the voltage jumps up", -1.0,
        ),
        (
            lambda at: 3.0 * ((at.v == 0.0) & (at.u > 0.0)),
            "at-rest", "at rest under forward voltage, ", 1.0,
        ),
    ],
    ids=["run and time", "direction and speed", "direction and position", "after steps", "at rest"],
)  # fmt: skip
def test_a_disagreement_is_found_where_it_is(plant, what, where, sign):
    found = map_gap(runs_of(*FOUR, *FOUR, plant=plant), noise=NOISE).find_places(10)

    mine = [place for place in found if place.what == what]
    assert any(place.where.startswith(where) for place in mine), found
    assert {np.sign(place.error) for place in mine} == {sign}
    assert {place.signal for place in mine} == {"velocity"}


def test_noise_alone_is_nowhere_beyond_doubt():
    # 300 cells beyond 4 standard errors: about one log of fifty
    alarms = [bool(map_gap(runs_of(seed=seed), noise=NOISE).find_places(1)) for seed in range(60)]

    assert sum(alarms) <= 4


def test_sorted_by_noisy_measurements_rest_would_show_what_is_not_there():
    rng = np.random.default_rng(3)
    still = Residuals(
        "coast-forward", PERIOD * np.arange(400), np.zeros(400), np.zeros((400, 2)),
        rng.normal(size=(400, 2)) * SIZES,
    )  # fmt: skip
    moving = runs_of("quasistatic-forward", seed=4)[0]
    slow = replace(moving, predicted=moving.predicted * 0.02)  # as slow as the noise is large
    mistaken = [replace(r, predicted=r.predicted + r.error) for r in (still, slow)]

    honest = map_gap([still, slow], noise=NOISE)
    fooled = map_gap(mistaken, noise=NOISE)

    assert honest.find_places(5) == ()
    assert max(place.sure for place in fooled.find_places(5)) > 10.0


@pytest.mark.parametrize("unit", [0.0254, 100.0], ids=["inches", "a hundredth"])
def test_the_places_do_not_depend_on_the_unit(unit):
    runs = runs_of(plant=lambda at: 3.0 * (at.v > 0.5))
    scaled = [replace(r, predicted=r.predicted / unit, error=r.error / unit) for r in runs]
    small = replace(NOISE, position=NOISE.position / unit, velocity=NOISE.velocity / unit)

    mine, other = (
        map_gap(*one, noise=n).find_places(5) for one, n in (([runs], NOISE), ([scaled], small))
    )

    assert [place.where for place in mine] == [place.where for place in other]
    assert [place.error for place in mine] == pytest.approx([place.error for place in other])


# -- steps ---------------------------------------------------------------------------------------

SINCE = PERIOD * np.arange(100)


# -- repeats -------------------------------------------------------------------------------------


def bump(at):
    return 5.0 * np.exp(-((at.t - 4.0) ** 2))


def twice(plant, other):
    rng = np.random.default_rng(6)
    return [
        run_of("quasistatic-forward", rng=rng, plant=one, start=50.0 * i)
        for i, one in enumerate((plant, other))
    ]


@pytest.mark.parametrize(
    ("plant", "other", "verdict"),
    [
        (bump, bump, "comes again"),
        (bump, lambda at: 5.0 * np.exp(-((at.t - 6.0) ** 2)), "changes from run to run"),
        (bump, lambda at: -bump(at), "changes from run to run"),
        (bump, lambda at: 0.4 * bump(at), "comes again in part"),
        (None, None, "is no more than noise"),
    ],
    ids=["the same twice", "elsewhere", "the other way", "weaker", "only noise"],
)
def test_what_comes_again_is_told_from_what_does_not(plant, other, verdict):
    (found,) = map_gap(twice(plant, other), noise=NOISE).repeats

    assert (found.verdict, found.runs) == (verdict, (0, 1))


# -- edges ---------------------------------------------------------------------------------------
