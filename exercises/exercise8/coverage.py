"""Share of the valid samples that a preparation keeps, and whether it keeps the fast ends."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array, Log, Run
from sim.inspect.log_features import Flags

from .preparation import Preparation

ENOUGH = 0.6  # [share] of a test's valid samples that has to be kept
FAST_END = 0.9  # [share] of a ramp's fastest valid speed that has to be among them
FIRST_RISE = 0.1  # [share] of a step's fastest valid speed up to which a start may be cut


@dataclass(frozen=True)
class Coverage:
    """The share of one test that a preparation keeps.

    Args:
        test: its name.
        share: of its valid samples.
        reaches: it still has its fast end, if it is a ramp, or its first rise, if it is a step.
    """

    test: str
    share: float
    reaches: bool

    @property
    def enough(self) -> bool:
        """Whether enough of the test is kept."""
        return self.share >= ENOUGH


def measure_coverage(
    log: Log,
    preparation: Preparation,
    *,
    valid: Mapping[str, Flags],
    clean: Mapping[str, Array],
) -> tuple[Coverage, ...]:
    """Measure how much of each test a preparation keeps.

    Args:
        log: damaged.
        preparation: what the learner does with it.
        valid: test -> (n,) which samples tell of the mechanism.
        clean: test -> (n,) [m/s or rad/s] its velocity without the damage.
    """
    return tuple(
        _measure_coverage(run, valid[run.test], clean[run.test], preparation) for run in log.runs
    )


def _measure_coverage(run: Run, valid: Flags, clean: Array, preparation: Preparation) -> Coverage:
    speed = np.abs(clean)
    trimmed = preparation.kept(run).time
    kept = valid & np.isin(run.time, trimmed)
    if run.kind == "quasistatic":
        kept &= np.abs(run.velocity) >= preparation.threshold
    share = float(kept.sum() / valid.sum())
    top = float(speed[valid].max())
    if not kept.any():
        return Coverage(run.test, 0.0, reaches=False)
    if run.kind == "quasistatic":
        return Coverage(run.test, share, reaches=bool(speed[kept].max() >= FAST_END * top))
    rises = int(np.argmax(valid & (speed > FIRST_RISE * top)))
    return Coverage(run.test, share, reaches=int(np.argmax(kept)) <= rises)
