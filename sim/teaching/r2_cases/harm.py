"""The kinds of damage to a log of which the cases are made."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from sim.bench.routine import LOOPS_BEFORE_DRIVE
from sim.core.log import Array, Log, Run, integrate_velocity
from sim.inspect.fault import FaultStrike, replace_run, rescale_motion
from sim.inspect.faults import find_fault
from sim.inspect.step_rise import simulate_wheels
from sim.teaching.r2_cases.drivetrains import Setup

Harm: TypeAlias = Callable[[Log, np.random.Generator], Log]

FORWARD_RAMP, STEPS = 0, (2, 3)  # indices of tests in a log
RAMPS = (FORWARD_RAMP, 1)
PERIOD = 0.02  # [s] between samples
SPIKE = 1.6  # [m/s] height of a spike
WITHIN = (0.3, 0.9)  # [share of the ramp] interval with spikes
JUMP, JUMP_LASTS, JUMP_BEGINS = 1.2, 0.2, 3.0  # height [m/s], duration and start [s]
STOP, PRESSED = 0.6, 0.3  # speed at the stop [share of the top speed], time against it [s]
CUT = FaultStrike(FORWARD_RAMP, start=1.5, severity=1.0)
LATE = 0.2  # [share of the loops] that are late
SHORTEST = 0.04  # [s] shortest late loop
GRIP = 1.1 * 9.81  # [m/s²] largest acceleration on carpet
FINE = 20  # simulation steps per sample
RATIO = 1.25  # error of the gear ratio


def leave_unchanged(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
    """Return the log unchanged."""
    return log


def add_spikes(count: int) -> Harm:
    """Damage that adds velocity spikes to the forward ramp, up and down in turn."""

    def spoil(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
        run = log.runs[FORWARD_RAMP]
        at = (np.linspace(*WITHIN, count + 2)[1:-1] * len(run)).astype(int)
        velocity = run.velocity.copy()
        velocity[at] += SPIKE * (-1.0) ** np.arange(count)
        return replace_run(log, FORWARD_RAMP, replace(run, velocity=velocity))

    return spoil


def add_encoder_slip(loss: float) -> Harm:
    """Damage by which the encoder misses a share of the motion in the second half of both ramps."""

    def spoil(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
        for index in RAMPS:
            run = log.runs[index]
            late = run.time > 0.5 * (run.time[0] + run.time[-1])
            log = replace_run(log, index, rescale_motion(run, np.where(late, 1.0 - loss, 1.0)))
        return log

    return spoil


def add_position_jump(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
    """Add a sudden motion to the forward ramp: 1.2 m/s too fast at most, for 0.2 s."""
    run = log.runs[FORWARD_RAMP]
    since = np.clip((run.time - run.time[0] - JUMP_BEGINS) / JUMP_LASTS, 0.0, 1.0)
    bump = JUMP * np.sin(np.pi * since)
    moved = run.position + np.cumsum(bump) * PERIOD
    return replace_run(
        log, FORWARD_RAMP, replace(run, velocity=run.velocity + bump, position=moved)
    )


def add_early_stop(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
    """Let both step tests hit a stop at 60 % of the top speed, with voltage for 0.3 s more."""
    for index in STEPS:
        run = log.runs[index]
        speed = np.abs(run.velocity)
        hit = int(np.argmax(speed > STOP * speed.max()))
        stopped = rescale_motion(run, np.where(np.arange(len(run)) < hit, 1.0, 0.0))
        log = replace_run(log, index, stopped.select(slice(hit + round(PRESSED / PERIOD))))
    return log


def log_commanded_voltage(setup: Setup) -> Harm:
    """Damage that replaces the motor voltage by the commanded voltage."""

    def spoil(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
        return replace(
            log, runs=tuple(replace(r, voltage=_command_voltage(r, setup)) for r in log.runs)
        )

    return spoil


def add_brownout(log: Log, rng: np.random.Generator) -> Log:
    """Switch the motors off for a moment while the log still shows a voltage."""
    return find_fault("brownout").spoil(log, CUT, rng).log


def drop_samples(longest: float) -> Harm:
    """Damage that drops the samples of late loops, up to a length [s]."""

    def spoil(log: Log, rng: np.random.Generator) -> Log:
        return replace(
            log, runs=tuple(_drop_late_loops(run, longest=longest, rng=rng) for run in log.runs)
        )

    return spoil


def add_wheel_slip(setup: Setup) -> Harm:
    """Damage by which the wheels spin in both steps until the robot has their speed."""

    def spoil(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
        for index in STEPS:
            log = replace_run(log, index, _add_slip(log.runs[index], setup))
        return log

    return spoil


def scale_encoder(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
    """Divide the encoder's position and velocity by a wrong gear ratio."""
    return _scale_motion(log, 1.0 / RATIO)


def flip_encoder(log: Log, rng: np.random.Generator) -> Log:  # noqa: ARG001 - as every harm
    """Reverse the sign of the encoder."""
    return _scale_motion(log, -1.0)


def _scale_motion(log: Log, factor: float) -> Log:
    runs = (
        replace(r, position=factor * r.position, velocity=factor * r.velocity) for r in log.runs
    )
    return replace(log, runs=tuple(runs))


def _command_voltage(run: Run, setup: Setup) -> Array:
    """The routine's commanded voltage (n,) [V]."""
    since = run.time - run.time[0] + LOOPS_BEFORE_DRIVE * PERIOD
    return np.array([setup.routine.command_voltage(run.test, t) for t in since.tolist()])


def _drop_late_loops(run: Run, *, longest: float, rng: np.random.Generator) -> Run:
    """The run without the samples that late loops did not log."""
    keep = np.ones(len(run), dtype=bool)
    place = 1
    while place < len(run) - 1:
        lost = 0
        if rng.random() < LATE:
            lost = int(rng.uniform(SHORTEST, longest) / PERIOD) - 1
            keep[place : place + lost] = False
        place += lost + 1
    keep[-1] = True
    return run.select(keep)


def _add_slip(run: Run, setup: Setup) -> Run:
    """The step with wheel slip, with the grip of the carpet; the encoder's noise stays."""
    gains = setup.mechanism.gains
    time = np.linspace(run.time[0], run.time[-1], FINE * len(run))
    held = np.abs(run.voltage)[np.searchsorted(run.time, time, side="right") - 1]
    push = (held - gains["kS"]) / gains["kV"]
    plain, slipping = simulate_wheels(
        push,
        time,
        scales=np.full(2, gains["kA"] / gains["kV"]),
        grips=np.array([np.inf, gains["kA"] * GRIP / gains["kV"]]),
        limits=np.full(2, np.inf),
    ).speed
    more = np.sign(run.voltage[0]) * np.interp(run.time, time, slipping - plain)
    moved = run.position + integrate_velocity(run.time, more)
    return replace(run, velocity=run.velocity + more, position=moved)
