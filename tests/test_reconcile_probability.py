"""How likely a finding is right: what each piece of evidence does to it."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.physics.effects import EFFECTS
from sim.reconcile.model_selection import is_ordinary_size
from sim.reconcile.probability import (
    Evidence,
    compute_log_size,
    compute_probability,
    compute_rival_share,
)
from sim.reconcile.residual_tests.repeatability import RepeatedResidual
from sim.reconcile.residual_tests.spectrum import SpectralPeak
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.residual_tests.whiteness import NO_WINDOW
from sim.reconcile.thresholds import (
    FARTHEST,
    LARGEST_SIZE,
    PERIODIC,
    REPEATED,
    UNLIKELY_WINDOW,
)

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
def test_the_size_is_told_in_everyday_sizes(times):
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
def test_the_test_that_comes_nearest_to_its_threshold_counts(window, repeated, peak, ratio):
    left = ResidualSummary(
        replace(NO_WINDOW, size=window),
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
