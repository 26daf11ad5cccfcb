"""Both methods on the logs of the comparison, and what is made of their gains."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from comparison_plan import Row

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import NotIdentifiable
from sim.core.log import FOUR_TESTS, Log
from sim.fit import fit

RECIPE, OURS = "sysid", "output-error"
METHODS = (RECIPE, OURS)
SUBSETS = tuple(some for n in range(4, -1, -1) for some in combinations(FOUR_TESTS, n))
BUILT = ("drivetrain", "elevator", "arm")  # one of each type
GENTLE = Routine(ramp=0.5, step=3.5)
NEAR = 0.05  # [share of a gain] closer is right, whatever the error stated
NEAR_VOLTS = 0.02  # [V] the same, of kS and kG
STATED = 4.0  # [standard errors] farther is wrong
FARTHEST, FARTHEST_VOLTS = 0.25, 0.1  # farther is wrong, whatever the error stated
OUTCOMES = ("right", "refused", "wrong")


@dataclass(frozen=True, eq=False)
class Found:
    """What one method found in the logs of one row.

    Args:
        gains: gain -> (logs,) value.
        refused: how many logs had no answer.
        r2: (logs,) the simulated velocity R², by which SysId's users judge a fit.
        late: (logs,) [s] delay of the velocity.
    """

    gains: Mapping[str, np.ndarray]
    refused: int
    r2: np.ndarray
    late: np.ndarray


def found(row: Row, *, method: str, logs: int) -> Found:
    """Fit the logs of a row, seeds from 0 on."""
    fits, refused = [], 0
    for seed in range(logs):
        try:
            fits.append(fit(row.log(seed), type="simple", method=method))
        except NotIdentifiable:
            refused += 1
    return Found(
        {gain: np.array([one.gains[gain] for one in fits]) for gain in row.truth},
        refused,
        np.array([one.simulated_velocity_r2 for one in fits]),
        np.array([one.velocity_delay for one in fits]),
    )


def outcomes(tests: tuple[str, ...], *, name: str, method: str, logs: int) -> dict[str, int]:
    """How often some of the four tests of a mechanism give right gains, a refusal, wrong gains."""
    counts = dict.fromkeys(OUTCOMES, 0)
    mechanism = MECHANISMS[name]
    for seed in range(logs):
        log = simulate(mechanism, GENTLE, rng=np.random.default_rng(seed))
        part = replace(log, runs=tuple(run for run in log.runs if run.test in tests))
        counts[outcome(part, mechanism.gains, type_=mechanism.type, method=method)] += 1
    return counts


def outcome(log: Log, truth: Mapping[str, float], *, type_: str, method: str) -> str:
    """What becomes of one log: one of ``OUTCOMES``."""
    try:
        answer = fit(log, type=type_, method=method)
    except NotIdentifiable:
        return "refused"
    for gain, value in truth.items():
        off, volts = abs(answer.gains[gain] - value), gain in {"kS", "kG"}
        near = max(NEAR * value, NEAR_VOLTS if volts else 0.0)
        far = max(FARTHEST * value, FARTHEST_VOLTS if volts else 0.0)
        if not off <= min(max(near, STATED * answer.errors[gain]), far):
            return "wrong"
    return "right"
