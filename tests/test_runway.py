"""A test on a floor with a tape on it: who lets go when, where it stands, and the picture of it."""

import math
from dataclasses import replace

import numpy as np
import pytest

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.core.errors import BadRequest
from sim.physics.battery import Battery
from sim.plot import plot_runway
from sim.teaching.runway import PERIOD, Floor, drive_test

ROBOT = replace(MECHANISMS["drivetrain"], travel=None)
TIRED = replace(ROBOT, battery=Battery(rest=11.6, resistance=0.035))
SLOW = sim.Routine(ramp=1.0, step=3.5, timeout=10.0)
RAMP, STEP = "quasistatic-forward", "dynamic-forward"


def gone(test, **floor):
    """A test of a good robot on a floor."""
    return drive_test(ROBOT, SLOW, test=test, floor=Floor(**floor))


def test_a_slow_ramp_goes_as_far_as_the_formula_says():
    """With kS 0.15 V, kV 2.52 V·s/m, kA/kV 76 ms: 0.5·(9.7 - 0.076)²/(2·2.52)."""
    went = drive_test(ROBOT, sim.Routine(ramp=0.5), test=RAMP, floor=Floor(wall=50.0))
    off = int(np.argmax(went.time >= went.released - PERIOD / 2))

    assert went.released == pytest.approx(10.0)
    assert went.position[off] == pytest.approx(0.5 * 9.624**2 / (2 * 2.524), rel=0.02)


def test_the_motors_are_off_a_thumb_after_the_tape():
    went = gone(RAMP, wall=12.0, tape=7.0, thumb=0.3)
    passed = went.time[np.argmax(went.position >= 7.0)]

    assert went.released - passed == pytest.approx(0.3)
    assert 7.0 < went.final_position < 12.0
    assert went.hit_wall is None


def test_braking_keeps_to_what_the_carpet_holds():
    went = gone(RAMP, wall=12.0, tape=7.0)
    slows = -np.diff(went.velocity) / PERIOD

    assert slows.max() == pytest.approx(1.1 * 9.81, rel=0.01)


def test_on_slippery_ground_it_goes_further():
    carpet, tiles = (
        gone(RAMP, wall=12.0, tape=7.0, grip=grip).final_position for grip in (1.1, 0.4)
    )
    speed = gone(RAMP, wall=12.0, tape=7.0).velocity.max()

    assert tiles - carpet == pytest.approx(
        speed**2 / (2 * 9.81) * (1 / 0.4 - 1 / 1.1), abs=0.1 * speed
    )


def test_without_a_tape_it_goes_on_until_the_wall():
    went = gone(RAMP, wall=12.0)

    assert went.hit_wall == pytest.approx(went.time[-1])
    assert went.final_position == 12.0
    assert went.released == pytest.approx(10.0)


def test_whoever_watches_ends_it_in_any_case():
    assert gone(STEP, wall=9.0, watched=1.5).released == pytest.approx(1.5)


def test_a_tired_battery_browns_out_in_a_step_and_not_in_a_ramp():
    step, ramp = (
        drive_test(TIRED, SLOW, test=test, floor=Floor(wall=12.0, tape=7.0))
        for test in (STEP, RAMP)
    )

    assert step.browned_out
    assert step.final_position < 0.5 * gone(STEP, wall=12.0, tape=7.0).final_position
    assert not ramp.browned_out


@pytest.mark.parametrize("wrong", [{"wall": 0.0}, {"wall": 9.0, "tape": -1.0}], ids=str)
def test_a_length_that_is_none_is_refused(wrong, reads):
    with pytest.raises(BadRequest) as refused:
        Floor(**wrong)
    reads(refused.value)


def test_a_reverse_test_is_refused(reads):
    with pytest.raises(BadRequest) as refused:
        gone("dynamic-reverse", wall=9.0)
    reads(refused.value)


def test_the_picture_says_what_it_shows():
    picture = plot_runway(gone(RAMP, wall=12.0, tape=7.0), moment=0.5)

    assert "wall stands at 12.0 m" in picture.alt
    assert "tape lies at 7.0 m" in picture.alt
    assert "which is enough" in picture.alt
    assert dict(picture.table.rows)["pushes the wall for [s]"] == "never"


@pytest.mark.parametrize(("tape", "side"), [(3.0, "left"), (7.0, "left"), (10.5, "right")])
def test_the_motors_words_stand_off_the_tape_and_off_the_wall(tape, side):
    picture = plot_runway(gone(RAMP, wall=12.0, tape=tape))

    (words,) = (text for text in picture.figure.axes[0].texts if text.get_text() == "motors off")
    assert words.get_ha() == side  # the tape is passed before, the wall comes after


def test_the_brownout_line_is_named_with_its_volts_and_not_covered():
    went = gone(RAMP, wall=12.0)

    (words,) = plot_runway(went).figure.axes[2].texts
    assert words.get_text() == f"dashed: brownout below {went.brownout:g} V"
    assert words.xy[1] == 0.0


def test_the_picture_of_an_accident_says_so(reads):
    went = gone(RAMP, wall=12.0)
    picture = plot_runway(went)

    reads(picture.alt)
    reads(dict(picture.table.rows)["room left [m]"])


def test_a_brownout_lights_its_lamp():
    dark = plot_runway(gone(STEP, wall=12.0))
    lit = plot_runway(drive_test(TIRED, SLOW, test=STEP, floor=Floor(wall=12.0)))

    assert "which is a brownout" in lit.alt
    assert [axes.get_title(loc="right") for axes in (dark.figure.axes[0], lit.figure.axes[0])] == [
        "✓ battery holds",
        "✗ BROWNOUT",
    ]


def test_the_moment_moves_the_robot():
    went = gone(RAMP, wall=12.0, tape=7.0)

    assert plot_runway(went, moment=0.2).svg != plot_runway(went, moment=0.8).svg
    with pytest.raises(BadRequest, match="Choose 0"):
        plot_runway(went, moment=math.pi)


def test_what_braking_takes_is_no_less_than_the_carpet_asks_for():
    went = gone(RAMP, wall=12.0, tape=7.0)
    off = int(np.argmax(went.time >= went.released - PERIOD / 2))
    speed = went.velocity[off]

    assert speed == went.velocity.max()
    assert went.final_position - went.position[off] > 0.97 * speed**2 / (2 * 1.1 * 9.81)
