"""Faults of the record: each is struck at random and found again, and clean logs stay clean.

What each is, its module says. What all faults have in common is tested in ``test_faults.py``.
"""

from dataclasses import replace

import numpy as np
import pytest

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.inspect.contaminate import contaminate
from sim.inspect.faults import FAULTS
from sim.inspect.log_features import LogFeatures

LESSON = Routine(ramp=0.5, step=3.5)
MINE = (
    "command-logged",
    "mislabelled-test",
    "missing-test",
    "noisy-standstill",
    "sign-flip",
    "stale-samples",
    "stuck-sensor",
    "unit-error",
    "voltage-dropout",
)
SEEDS = 8  # logs; the share of many is in the table of test_faults.py


def drawn(seed, *, period=0.02):
    """A clean log of some mechanism."""
    rng = np.random.default_rng(seed)
    name = tuple(MECHANISMS)[seed % len(MECHANISMS)]
    built = MECHANISMS[name].draw(rng)
    return simulate(built, LESSON, rng=rng, period=period)


def struck(name, log, seed, *, severity=1.0):
    """The log with one fault, somewhere it may strike."""
    rng = np.random.default_rng(seed + 1000)
    return contaminate(log, name, severity=severity, rng=rng)


def found(name, log):
    return list(FAULTS[name].detect(LogFeatures(log)))


def missed(name, spoilt):
    """The damaged parts that the detective did not find."""
    damages = found(name, spoilt.log)
    return [part for part in spoilt.where if not any(d.where.overlap(part) >= 0.5 for d in damages)]


@pytest.mark.parametrize(("severity", "least"), [(0.3, 6), (3.0, 8)])
@pytest.mark.parametrize("name", MINE)
def test_a_fault_is_found_where_it_struck(name, severity, least):
    logs = [drawn(seed) for seed in range(SEEDS)]

    spoilt = [struck(name, log, seed, severity=severity) for seed, log in enumerate(logs)]

    assert all(one.where for one in spoilt)
    assert sum(not missed(name, one) for one in spoilt) >= least


def names(log):
    return {damage.fault for name in MINE for damage in found(name, log)}


def each(log, change):
    return replace(log, runs=tuple(change(run) for run in log.runs))


def recorded(name, seed=1, *, period=0.02):
    rng = np.random.default_rng(seed)
    return simulate(MECHANISMS[name].draw(rng), LESSON, rng=rng, period=period)


def coarse(run, step):
    """A velocity in steps, which repeats itself because it is coarse."""
    return replace(run, velocity=np.round(run.velocity / step) * step)


def test_a_coarse_velocity_is_not_a_stale_one():
    log = each(recorded("drivetrain"), lambda run: coarse(run, 0.1))

    assert np.mean(np.diff(log.runs[0].velocity) == 0.0) > 0.5
    assert names(log) == set()


def test_a_test_under_another_name_is_mislabelled_and_not_missing():
    log = recorded("elevator")
    wrong = replace(log.runs[2], test="quasistatic-forward")  # the forward step, filed as the ramp

    log = replace(log, runs=(*log.runs[:2], wrong, log.runs[3]))

    damage = found("mislabelled-test", log)
    assert [one.where.run for one in damage] == [2]
    assert "looks like dynamic-forward" in damage[0].evidence
    assert found("missing-test", log) == []


@pytest.mark.parametrize("name", MECHANISMS)
@pytest.mark.parametrize(
    ("change", "runs"),
    [
        (lambda run: replace(run, voltage=-run.voltage), [0, 1, 2, 3]),
        (lambda run: replace(run, voltage=np.abs(run.voltage)), [1, 3]),
        (lambda run: replace(run, position=-run.position), [0, 1, 2, 3]),
    ],
    ids=["inverted", "unsigned", "position alone"],
)
def test_a_sign_is_missed_in_the_runs_that_have_it_wrong(name, change, runs):
    assert [one.where.run for one in found("sign-flip", each(recorded(name), change))] == runs


def test_a_weight_that_beats_the_voltage_has_no_sign_wrong():
    # an elevator that 0.5 V cannot lift: it sinks, in the forward test as in the reverse one
    log = recorded("elevator")
    forward, reverse = (
        log.list_runs_of_test("dynamic-forward")[0],
        log.list_runs_of_test("dynamic-reverse")[0],
    )
    sinks = replace(reverse, test="dynamic-forward", velocity=reverse.velocity * 0.2)
    sinks = replace(
        sinks,
        voltage=np.full(len(sinks), 0.5),
        position=reverse.position[0] + (reverse.position - reverse.position[0]) * 0.2,
    )

    log = replace(log, runs=tuple(sinks if run is forward else run for run in log.runs))

    assert found("sign-flip", log) == []


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (2 * np.pi, "2π, the factor"),
        (1 / 60, "60, the factor"),
        (180 / np.pi, "57.3, the factor"),
        (360.0, "360, the factor"),
        (8.46, "a gear ratio"),
    ],
)
def test_a_unit_is_known_by_its_factor(factor, words):
    log = each(recorded("drivetrain"), lambda run: replace(run, velocity=run.velocity * factor))

    damage = found("unit-error", log)

    assert len(damage) == 4
    assert all(words in one.evidence for one in damage)


@pytest.mark.parametrize("speed", [0.0, "frozen"], ids=["a stop", "a sensor"])
def test_a_stop_has_no_speed_and_a_stuck_sensor_has(speed):
    log = recorded("drivetrain")
    run = log.runs[0]
    at = slice(250, 300)  # a second, halfway up the ramp
    position, velocity = run.position.copy(), run.velocity.copy()
    gone = position[299] - position[250]
    position[at], velocity[at] = position[250], velocity[250] if speed == "frozen" else 0.0
    if speed == 0.0:
        position[300:] -= gone  # it goes on from where it stood
    log = replace(log, runs=(replace(run, position=position, velocity=velocity), *log.runs[1:]))

    damage = found("stuck-sensor", log)

    assert len(damage) == (speed == "frozen")
    if damage:
        assert (damage[0].where.start, damage[0].where.end) == (run.time[250], run.time[299])


def dropped(run, times, *, motion):
    """Voltages of nothing for one sample; the velocity follows for a moment, or does not."""
    voltage, velocity = run.voltage.copy(), run.velocity.copy()
    for time in times:
        at = int(np.searchsorted(run.time, run.time[0] + time))
        voltage[at] = 0.0
        velocity[at + 1 : at + 3] *= 0.5 if motion else 1.0
    return replace(run, voltage=voltage, velocity=velocity)


@pytest.mark.parametrize(
    ("times", "motion", "stories", "words"),
    [
        ((5.0,), False, 1, "The velocity does not change, so only"),
        ((3.0, 6.0), False, 2, "The velocity does not change, so only"),
        ((3.0, 4.0, 5.0, 6.0), False, 1, "4 times, about every 1.00 s"),
        ((3.0, 4.0, 5.0, 6.0), True, 1, "the motor really lost it"),
        ((5.0,), True, 0, ""),  # a brownout may look like that
    ],
    ids=["one", "two", "a series", "a series that is felt", "one that is felt"],
)
def test_drop_outs_are_told_one_by_one_or_as_a_series(times, motion, stories, words):
    log = recorded("drivetrain")
    log = replace(log, runs=(dropped(log.runs[0], times, motion=motion), *log.runs[1:]))

    damage = found("voltage-dropout", log)

    assert len(damage) == stories
    assert all(words in one.evidence for one in damage)


def test_a_clipped_step_that_is_logged_as_applied_is_no_fault():
    log = recorded("drivetrain")
    spoilt = contaminate(log, "command-logged", rng=np.random.default_rng(5)).log
    applied = each(
        spoilt,
        lambda run: (
            replace(run, voltage=run.voltage - 0.8 * np.exp(-5 * (run.time - run.time[0])))
            if run.kind == "dynamic"
            else run
        ),
    )

    assert [one.where.test for one in found("command-logged", spoilt)] == [
        "dynamic-forward",
        "dynamic-reverse",
    ]
    assert found("command-logged", applied) == []


@pytest.mark.parametrize("name", MINE)
def test_damage_grows_with_severity(name):
    log = recorded("turret")

    hurt = [
        sum(
            float(np.abs(a.velocity[-len(b) :] - b.velocity).sum() / b.top_speed)
            + float(np.abs(a.voltage[-len(b) :] - b.voltage).sum())
            + float(np.abs(a.position[-len(b) :] - b.position).sum())
            if a.test == b.test
            else len(b)
            for a, b in zip(spoilt.runs, kept, strict=True)
        )
        + sum(len(run) for run in log.runs if run not in kept)
        for severity in (0.3, 1.0, 3.0)
        for spoilt in (contaminate(log, name, severity=severity, rng=np.random.default_rng(6)).log,)
        for kept in (
            [
                run
                for run in log.runs
                if len(spoilt.runs) == 4 or spoilt.list_runs_of_test(run.test)
            ],
        )
    ]

    assert hurt[0] <= hurt[1] < hurt[2]


@pytest.mark.shared
@pytest.mark.parametrize(
    ("file", "faults"),
    [
        # data/README.md: voltage drop-outs every 0.22 s in both
        ("sciborgs-2023-elbow-arm", {"voltage-dropout"}),
        ("sciborgs-2023-elevator", {"voltage-dropout"}),
        # 20 ms frames logged every 5 ms
        ("sciborgs-2023-wrist-arm", {"stale-samples"}),
        ("frc4646-2022-drivetrain", {"stale-samples"}),
        ("frc501-2020-drivetrain", set()),
    ],
)
def test_in_a_real_log_is_found_what_is_there_and_nothing_else(shared, file, faults):
    assert names(sim.read(shared / "data" / "real" / f"{file}.json")) == faults
