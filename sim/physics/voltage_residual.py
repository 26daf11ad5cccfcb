"""The voltage residual of a model, sample by sample: what its terms do not account for.

    missing = V - (kS·sgn(v) + kV·v + kA·a + gravity)

An effect starts its search from this (``Effect.start_values``). The acceleration is taken over a
few samples, so that noise does not drown what is looked for; where the mechanism does not move,
friction is a bound and not a value, and nothing is said.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log, Run
from sim.core.units import find_unit

ACROSS = 0.04  # [s] that a difference of velocities spans, at least two samples
ENDLESS = 8.0 * np.pi  # [rad] four turns: more than any arm or turret, soon done by a wheel
SHORTEST = 5  # [samples] of a run that can be differentiated
HARDLY = 1e-9  # [1] of a combination of columns that the log says anything about
MOVING = 0.03  # [share of the top speed] slower samples say nothing about a gain


@dataclass(frozen=True, eq=False)
class VoltageResidual:
    """The voltage residual at the samples at which a mechanism moved.

    Args:
        log: where they come from.
        gains: of the model: kS [V], kV, kA, and kG [V] with ``offset_rad`` where there is gravity.
        run: (n,) which run of the log, from 0.
        clock: (n,) [s] since the log began; pauses between runs count if the log shows them.
        since: (n,) [s] since its run began.
        voltage: (n,) [V].
        position: (n,) [m or rad].
        velocity: (n,) [m/s or rad/s].
        acceleration: (n,) [m/s² or rad/s²].
        missing: (n,) [V].
    """

    log: Log
    gains: Mapping[str, float]
    run: NDArray[np.intp]
    clock: Array
    since: Array
    voltage: Array
    position: Array
    velocity: Array
    acceleration: Array
    missing: Array

    @property
    def top_speed(self) -> float:
        """[m/s or rad/s] largest speed of the samples."""
        return float(np.max(np.abs(self.velocity), initial=0.0))

    @property
    def is_unbounded(self) -> bool:
        """Whether it turned so far that its travel cannot be limited."""
        return find_unit(self.log.units).angular and bool(np.ptp(self.position) > ENDLESS)

    def select_samples(self, some: slice) -> "VoltageResidual":
        """A copy with some of the samples."""
        arrays = {
            name: getattr(self, name)[some]
            for name in (
                "run", "clock", "since", "voltage", "position", "velocity", "acceleration",
                "missing",
            )
        }  # fmt: skip
        return replace(self, **arrays)

    def fit_columns(self, *columns: Array) -> Array:
        """Least-squares weights with which columns (n,) sum up to ``missing``; the gains adjust.

        A column that looks like friction, back-EMF, inertia or a constant is not credited with what
        those can explain by themselves: they are in the sum, and forgotten.
        """
        return np.asarray(self.fit_column_sets(*(column[:, None] for column in columns))[:, 0])

    def fit_column_sets(self, *columns: Array) -> Array:
        """(k, m) least-squares weights of k columns, each (n, m): m separate fits."""
        kept, rest = self._adjusted
        table = np.stack(columns)
        whole = np.linalg.norm(table, axis=1)
        table -= kept @ (kept.T @ table)
        size = np.linalg.norm(table, axis=1)
        size[size <= HARDLY * whole] = np.inf
        table /= size[:, None]
        square = np.array([[np.sum(one * other, axis=0) for other in table] for one in table])
        told, ways = np.linalg.eigh(square.T)
        parts = ways.transpose(0, 2, 1) @ (rest @ table).T[..., None]
        parts /= np.where(told > HARDLY, told, np.inf)[..., None]
        return np.asarray((ways @ parts)[..., 0].T / size)

    def fit_one_column(self, column: Array) -> tuple[float, float]:
        """Weight of one column (n,), and the sum of squares [V²] of ``missing`` it explains.

        The gains adjust, as in ``fit_columns``.
        """
        kept, rest = self._adjusted
        left = column - kept @ (kept.T @ column)
        square = float(left @ left)
        if square <= HARDLY**2 * float(column @ column):
            return 0.0, 0.0
        product = float(left @ rest)
        return product / square, product**2 / square

    @cached_property
    def _adjusted(self) -> tuple[Array, Array]:
        """(n, k) friction, back-EMF, inertia and gravity, orthonormal; (n,) what is missing off."""
        columns = [np.sign(self.velocity), self.velocity, self.acceleration]
        if "offset_rad" in self.gains:
            columns += [np.cos(self.position), np.sin(self.position)]
        elif "kG" in self.gains:
            columns.append(np.ones_like(self.velocity))
        known = np.column_stack(columns)
        size = np.linalg.norm(known, axis=0)
        size[size == 0.0] = 1.0
        kept, _ = np.linalg.qr(known / size)
        return kept, self.missing - kept @ (kept.T @ self.missing)


def compute_voltage_residual(log: Log, gains: Mapping[str, float], *, type: str) -> VoltageResidual:  # noqa: A002 - the field's own word
    """The voltage residual of a log under given gains.

    Args:
        log: any runs.
        gains: kS, kV, kA, and kG (with ``offset_rad`` for an arm) where ``type`` has gravity.
        type: ``simple``, ``elevator`` or ``arm``.
    """
    starts = list_run_start_times(log)
    parts = [_rows(run, number, starts[number]) for number, run in enumerate(log.runs)]
    top = max((float(np.max(np.abs(p[5]), initial=0.0)) for p in parts), default=0.0)
    table = np.concatenate([p[:, np.abs(p[5]) > MOVING * top] for p in parts], axis=1)
    run, clock, since, voltage, position, velocity, acceleration = table
    accounted = (
        gains["kS"] * np.sign(velocity) + gains["kV"] * velocity + gains["kA"] * acceleration
    )
    if type == "elevator":
        accounted += gains["kG"]
    elif type == "arm":
        accounted += gains["kG"] * np.cos(position + gains.get("offset_rad", 0.0))
    return VoltageResidual(
        log, gains, run.astype(np.intp), clock, since, voltage, position, velocity, acceleration,
        voltage - accounted,
    )  # fmt: skip


def list_run_start_times(log: Log) -> Array:
    """(runs,) [s] start of each run, from the start of the first.

    Where the times of runs do not follow one another, as in a file in which each begins at zero,
    they are laid end to end.
    """
    first = np.array([run.time[0] for run in log.runs])
    last = np.array([run.time[-1] for run in log.runs])
    if shares_clock(log):
        return np.asarray(first - first[0])
    return np.concatenate(([0.0], np.cumsum(last - first)[:-1]))


def shares_clock(log: Log) -> bool:
    """Whether the runs share one clock, so that the pauses between them are known.

    Where they do not, nobody knows how long a motor cooled: each run is taken to begin cold.
    """
    runs = log.runs
    return all(one.time[-1] < other.time[0] for one, other in pairwise(runs))


def _rows(run: Run, number: int, clock: float) -> Array:
    """(7, n): run, clock, since, voltage, position, velocity, acceleration."""
    since = run.time - run.time[0]
    if len(run) < SHORTEST:
        return np.empty((7, 0))
    reach = max(1, round(0.5 * ACROSS / float(np.median(np.diff(run.time)))))
    if len(run) <= 2 * reach:
        return np.empty((7, 0))
    acceleration = (run.velocity[2 * reach :] - run.velocity[: -2 * reach]) / (
        run.time[2 * reach :] - run.time[: -2 * reach]
    )
    # the voltage that made this difference is the mean over its span, not the one in its middle
    mean = run.voltage + 0.5 * run.voltage_slide
    paid = np.concatenate(([0.0], np.cumsum(mean[:-1] * np.diff(run.time))))
    voltage = (paid[2 * reach :] - paid[: -2 * reach]) / (
        run.time[2 * reach :] - run.time[: -2 * reach]
    )
    inner = slice(reach, -reach)
    size = acceleration.size
    return np.vstack(
        [np.full(size, number), clock + since[inner], since[inner], voltage, run.position[inner],
         run.velocity[inner], acceleration]
    )  # fmt: skip
