"""Mechanisms and their physics: gains of parts, stages of an elevator."""

import math
from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS, find_mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.core.units import find_unit
from sim.fit import fit
from sim.fit.physics import Parts, check_plausibility, compare_parts
from sim.physics.motors import MOTORS, find_motor

GENTLE = Routine(ramp=0.5, step=3.5)
TURN = 2.0 * math.pi


def rng(seed=0):
    return np.random.default_rng(seed)


PARTED = tuple(  # whose position is the output's own, so that one motor's parts describe it
    name
    for name, one in MECHANISMS.items()
    if one.radius == 1.0 or not find_unit(one.units).angular
)


def true_parts(mechanism):
    return Parts(
        mechanism.motor, mechanism.motor_count, mechanism.ratio, mechanism.radius, mechanism.load
    )


def recorded(mechanism, seed=1):
    return simulate(mechanism, GENTLE, rng=rng(seed))


def found_in(kind, **changes):
    """The bench's mechanism, fitted; ``changes`` are made to the gains afterwards."""
    found = FOUND.get(kind)
    if found is None:
        found = FOUND[kind] = fit(recorded(MECHANISMS[kind]))
    return replace(found, gains={**found.gains, **changes}) if changes else found


FOUND = {}


def read_as(kind, factor):
    """The fit of a log whose positions are ``factor`` times what they should be."""
    log = recorded(MECHANISMS[kind])
    runs = tuple(
        replace(run, position=factor * run.position, velocity=factor * run.velocity)
        for run in log.runs
    )
    return fit(replace(log, runs=runs))


def gravity_advice(mechanism):
    """What an elevator whose weight is not its inertia times g is advised to look at."""
    advice = {"cascade-elevator": "gravity-above-g", "counterweight-elevator": "gravity-below-g"}
    return [advice[mechanism.name]] if mechanism.name in advice else []


def codes(doubts):
    return [doubt.code for doubt in doubts]


def about(doubts, code):
    (message,) = [doubt.message for doubt in doubts if doubt.code == code]
    return message


@pytest.mark.parametrize("kind", PARTED)
@pytest.mark.parametrize("method", ["output-error", "sysid"])
def test_clean_log_with_true_parts_gets_no_warning(kind, method):
    mechanism = MECHANISMS[kind]
    found = fit(recorded(mechanism), method=method)

    said = codes(check_plausibility(found, parts=true_parts(mechanism)))

    # the recipe does not simulate between samples, and 29 ms are less than two of 20 ms
    fast = ["fast-mechanism"] * ((kind, method) == ("intake", "sysid"))
    assert said == gravity_advice(mechanism) + fast


@pytest.mark.parametrize(
    ("kind", "factor"),
    [
        # the log's number over the true one -> what made it
        ("turret", 1.0 / TURN),
        ("turret", TURN),
        ("shooter", 60.0),
        ("shooter", 60.0 / TURN),
        ("turret", 180.0 / math.pi),
        ("drivetrain", 6.75),
        ("drivetrain", 1.0 / 6.75),
        ("drivetrain", 2.0),
        ("drivetrain", 1.0 / 0.3048),
        ("elevator", 1.0 / 0.0254),
        ("elevator", 0.0254),
    ],
)
def test_a_wrong_unit_in_the_log_is_named(kind, factor):
    said = check_plausibility(read_as(kind, factor), parts=true_parts(MECHANISMS[kind]))

    code = "kv-below-theory" if factor > 1.0 else "kv-above-theory"
    assert about(said, code)
    # kA is off as much, and says where to look
    kas = [doubt.message for doubt in said if doubt.code.startswith("ka-")]
    assert len(kas) == 1
    assert "the log's unit" in kas[0]


@pytest.mark.parametrize(
    ("kind", "wrong", "code", "named"),
    [
        ("drivetrain", {"radius": 0.1016}, "kv-above-theory", "a diameter given as the radius"),
        ("drivetrain", {"radius": 0.0508 * TURN}, "kv-above-theory", "a circumference given"),
        ("drivetrain", {"ratio": 1 / 6.75}, "kv-above-theory", "upside down"),
        ("drivetrain", {"ratio": 8.14}, "kv-below-theory", "a gear ratio of 6.75"),
        ("drivetrain", {"ratio": 6.12}, "kv-drag", "10% above"),
        ("drivetrain", {"ratio": 6.12}, "ka-below-theory", "the ratio and the radius"),
        ("drivetrain", {"radius": 0.0475}, "kv-below-theory", "50.8 mm"),  # worn by 3 mm
        ("turret", {"motor": find_motor("krakenX60")}, "kv-below-theory", "krakenX44"),
        ("arm", {"motor": find_motor("minion")}, "kv-above-theory", "neo"),
        ("elevator", {"load": 10.0}, "ka-above-theory", "20 kg or 1 motor would fit"),
        ("elevator", {"load": 40.0}, "ka-below-theory", "20 kg"),
        ("shooter", {"load": 0.003}, "ka-above-theory", "kV fits"),
        ("drivetrain", {"count": 2}, "ka-below-theory", "or 4 motors"),
        ("drivetrain", {"ratio": 8.14}, "ka-above-theory", "the inverse factor"),
    ],
)
def test_wrong_parts_are_caught_and_fitting_ones_proposed(kind, wrong, code, named):
    parts = replace(true_parts(MECHANISMS[kind]), **wrong)

    assert named in about(check_plausibility(found_in(kind), parts=parts), code)


def test_a_model_that_does_not_hold_comes_before_the_parts():
    mechanism = MECHANISMS["arm"].hide("asymmetric-back-emf")  # kV reads 12 % low

    found = fit(recorded(mechanism))
    sure = replace(found, errors={gain: 0.01 * abs(value) for gain, value in found.gains.items()})

    # the errors of such a fit are so wide that nothing surely contradicts the parts
    assert check_plausibility(found, parts=true_parts(mechanism)) == ()
    said = check_plausibility(sure, parts=true_parts(mechanism))
    assert about(said, "kv-below-theory").endswith("find it first.")


@pytest.mark.parametrize("name", MOTORS)
def test_an_ideal_motor_with_a_little_drag_is_within_theory(name):
    parts = Parts(find_motor(name), 1, 10.0)
    for drag in (0.0, 0.08):
        kv = find_motor(name).back_emf * 10.0 * (1.0 + drag)
        assert check_plausibility(found_in("turret", kV=kv), parts=parts) == ()


@pytest.mark.parametrize(
    ("drag", "code"),
    [(0.05, None), (0.15, "kv-drag"), (0.3, "kv-above-theory")],
)
def test_drag_is_reported_with_its_size(drag, code):
    mechanism = replace(MECHANISMS["drivetrain"], drag=drag)
    said = check_plausibility(fit(recorded(mechanism)), parts=true_parts(mechanism))

    assert codes(said) == ([code] if code else [])
    assert not any(doubt.grave for doubt in said)


@pytest.mark.parametrize(
    ("share", "code"),
    [
        (1.10, None),
        (1.0, None),
        (0.90, "gravity-above-g"),
        (0.55, "gravity-above-g"),
        (0.45, "gravity-above-g"),
        (1.30, "gravity-below-g"),
    ],
)
def test_weight_over_inertia_of_an_elevator_is_at_most_g_and_of_a_cascade_2_g(share, code):
    truth = MECHANISMS["elevator"].gains["kA"]

    said = check_plausibility(found_in("elevator", kA=truth * share))

    assert codes(said) == ([code] if code else [])
    assert [doubt.grave for doubt in said] == ([share < 0.5] if code else [])
    assert all("cascade" in doubt.message for doubt in said if 0.5 < share < 1.0)
    assert all("m/s²" in doubt.message for doubt in said)


@pytest.mark.parametrize(
    ("kind", "ks", "code"),
    [
        ("drivetrain", 0.45, None),
        ("drivetrain", 0.6, "friction-watch"),
        ("drivetrain", 5.5, "friction-stop"),  # more than kV takes for 2 m/s
        ("arm", 0.74, None),  # the highest read on a real arm
        ("arm", 0.9, "friction-watch"),
    ],
)
def test_friction_has_a_band_to_watch_and_a_red_flag(kind, ks, code):
    said = check_plausibility(found_in(kind, kS=ks))

    assert codes(said) == ([code] if code else [])
    assert [doubt.grave for doubt in said] == ([code == "friction-stop"] if code else [])


@pytest.mark.parametrize(
    "ask",
    [
        lambda: Parts(find_motor("neo"), 0, 5.0),
        lambda: Parts(find_motor("neo"), 1, math.nan),
        lambda: check_plausibility(
            found_in("turret"), parts=Parts(find_motor("neo"), 1, 5.0, 0.05)
        ),
        lambda: check_plausibility(found_in("drivetrain"), parts=Parts(find_motor("neo"), 1, 5.0)),
        lambda: check_plausibility(found_in("turret"), period=0.0),
        lambda: compare_parts(
            {"left": found_in("turret"), "right": found_in("drivetrain")}, "side"
        ),
    ],
)
def test_incomparable_fit_and_parts_are_refused(ask):
    with pytest.raises(BadRequest) as refused:
        ask()
    assert refused.value.advice


G = 9.81  # [m/s²]
SLOWLY = Routine(ramp=1.0, step=4.0)
NEO = find_motor("neo")

# name, [kg] what the motors carry, [kg] what they accelerate, [m/s²] weight over inertia.
# Cascade: a carriage of 12 kg and a stage of 8 kg at half its speed: 12 + 8/2 and 12 + 8/4.
# Counterweight: 15 kg and 6 kg on the other end of the rope: 15 - 6 and 15 + 6.
ELEVATORS = [
    ("cascade-elevator", 16.0, 14.0, 11.21),
    ("counterweight-elevator", 9.0, 21.0, 4.20),
]


def recorded_elevator(name):
    return simulate(find_mechanism(name), SLOWLY, rng=np.random.default_rng(4))


@pytest.mark.parametrize(("name", "weight", "inertia", "lift"), ELEVATORS)
def test_elevator_has_the_weight_and_inertia_of_its_stages(name, weight, inertia, lift):
    built = find_mechanism(name)
    radius = 2.0 * 0.0222 if name == "cascade-elevator" else 0.0222
    volts_per_newton = NEO.resistance * radius / (2 * NEO.torque_constant * built.ratio)

    assert built.gains["kG"] == pytest.approx(volts_per_newton * weight * G, rel=1e-9)
    assert built.gains["kA"] == pytest.approx(volts_per_newton * inertia, rel=1e-9)
    assert built.gains["kG"] / built.gains["kA"] == pytest.approx(lift, abs=0.01)


@pytest.mark.parametrize("name", [row[0] for row in ELEVATORS])
def test_a_fit_finds_its_gains(name):
    found = fit(recorded_elevator(name))

    for gain, true in find_mechanism(name).gains.items():
        assert found.gains[gain] == pytest.approx(true, rel=0.03), gain
    assert not [doubt for doubt in found.doubts if doubt.grave]
