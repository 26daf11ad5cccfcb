"""The damage to a learner's log: two stops, and single readings that are far off."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sim.core.log import Log, Run
from sim.inspect.contaminate import contaminate
from sim.inspect.log_features import Flags

PRESSED = (1.0, 2.0)  # [severity] of a hard stop: 0.6 to 1.2 s against it
STOPS = {"quasistatic": (0.65, 0.92), "dynamic": (0.55, 0.85)}  # [share of the run] where it hits
SPIKES = (3, 5)  # [samples] of each test that are far off, one by one
HEIGHT = (0.25, 0.6)  # [share of the top speed] by which they are
LONELY = 6  # [samples] at least from one spike to the next
QUIET = 0.4  # [s] before a stop without any: a median does not outvote the last reading of a window
MOVING, RISEN = 0.1, 0.9  # [share of a test's top speed] where it moves, where a step has risen


def add_hard_stops(log: Log, *, rng: np.random.Generator) -> tuple[Log, dict[str, float]]:
    """Make one ramp and one step hit a hard stop.

    Returns:
        The log, and where it hits: test -> [s] since it began.
    """
    impacts = {}
    for kind, share in STOPS.items():
        test = f"{kind}-{rng.choice(('forward', 'reverse'))}"
        (run,) = log.list_runs_of_test(test)
        at = float(rng.uniform(*share) * (run.time[-1] - run.time[0]))
        severity = float(rng.uniform(*PRESSED))
        log = contaminate(log, "hard-stop", severity=severity, test=test, at=at, rng=rng).log
        impacts[test] = at
    return log, impacts


def find_valid_samples(run: Run, impacts: dict[str, float], rests: dict[str, float]) -> Flags:
    """Whether each sample tells of the mechanism: it moves, or, in a step, gets up to speed."""
    since = run.time - run.time[0]
    before = since < impacts.get(run.test, np.inf)
    speed = np.abs(run.velocity)
    if run.kind == "quasistatic":
        return before & (run.time > rests.get(run.test, -np.inf)) & (speed > 0.0)
    risen = int(np.argmax(speed > RISEN * np.percentile(speed[before], 98)))
    return (since <= since[risen]) & (np.abs(run.voltage) > 0.0)


def measure_noise_at_rest(runs: Sequence[Run], rests: dict[str, float]) -> float:
    """[m/s or rad/s] the largest standard deviation of a velocity up to when its test moves [s]."""
    still = (run.velocity[run.time <= rests[run.test]] for run in runs if run.test in rests)
    return max(float(np.std(velocity)) for velocity in still)


def add_spikes(
    run: Run,
    valid: Flags,
    impact: float | None,
    rng: np.random.Generator,
) -> Run:
    """The run with single readings that are far off."""
    velocity = run.velocity.copy()
    top = float(np.abs(velocity[valid]).max())
    first = int(np.argmax(valid))
    early = run.time - run.time[0] < (np.inf if impact is None else impact - QUIET)
    moving = np.flatnonzero((np.abs(velocity) > MOVING * top) & early)
    count = int(rng.integers(SPIKES[0], SPIKES[1] + 1))
    places: list[int] = []
    for place in rng.permutation(moving[moving >= first]).tolist():
        if len(places) < count and all(abs(place - other) >= LONELY for other in places):
            places.append(place)
    for place in places:
        velocity[place] += float(rng.choice((-1.0, 1.0)) * rng.uniform(*HEIGHT)) * top
    return replace(run, velocity=velocity)
