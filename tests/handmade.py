"""Logs made by hand, so that every number in a test can be worked out without the bench."""

from dataclasses import replace

import numpy as np

from sim.core.log import DIRECTIONS, KINDS, Log, Run

PERIOD = 0.02
BEGIN = {"quasistatic-forward": 1.0, "quasistatic-reverse": 12.0, "dynamic-forward": 23.0}


def run_of(test, *, seconds=10.0, period=PERIOD, gravity=0.0, start=None):
    """A ramp of 0.5 V/s or a step of 4 V on kS 0.2 V, kV 2 V·s/m, without inertia."""
    since = period * np.arange(round(seconds / period))
    sign = 1.0 if test.endswith("forward") else -1.0
    volts = sign * (np.full(since.size, 4.0) if test.startswith("dynamic") else 0.5 * since)
    push = volts - gravity
    speed = np.sign(push) * np.maximum(np.abs(push) - 0.2, 0.0) / 2.0
    time = (BEGIN.get(test, 34.0) if start is None else start) + since
    return Run(test, time, volts, np.cumsum(speed) * period, speed)


def log_of(*tests, **how):
    return Log(tuple(run_of(test, **how) for test in tests))


FOUR = log_of(*(f"{kind}-{way}" for kind in KINDS[:2] for way in DIRECTIONS))


def with_gaps(run, gaps):
    """The run with some of its steps longer: place -> seconds."""
    steps = np.diff(run.time)
    for place, length in gaps.items():
        steps[place] = length
    return replace(run, time=run.time[0] + np.concatenate([[0.0], np.cumsum(steps)]))


def each(log, change):
    """The log with a change made to each of its runs."""
    return replace(log, runs=tuple(change(run) for run in log.runs))


def change_signals(log, **signals):
    """The log with some signals of each run made anew from the run."""
    return each(log, lambda run: replace(run, **{name: of(run) for name, of in signals.items()}))
