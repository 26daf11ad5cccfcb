"""The voltage residual of a model, sample by sample: measured voltage minus that of the model.

    missing = V - (kS·sgn(v) + kV·v + kA·a + gravity)

The start values of an effect are computed from it (``Effect.start_values``). The acceleration is a
difference over a few samples, to reduce noise. Samples at rest are left out, because there friction
is only known to be below kS.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.core.log import AT_REST, Array, Log, Run
from sim.core.units import find_unit

SPAN = 0.04  # [s] over which velocities are differentiated; at least two samples
ENDLESS = 8.0 * np.pi  # [rad] four turns: more than any arm or turret makes, unlike a wheel
MIN_SAMPLES = 5  # [samples] of a run that can be differentiated
NEGLIGIBLE = 1e-9  # [1] a smaller relative norm or eigenvalue is rounding


@dataclass(frozen=True, eq=False)
class VoltageResidual:
    """The voltage residual at the samples at which a mechanism moved.

    Args:
        log: the log.
        gains: of the model: kS [V], kV [V·s/unit], kA [V·s²/unit], and kG [V] for an elevator, or
            kG with ``offset_rad`` for an arm.
        run: (n,) index of the run in the log.
        clock: (n,) [s] since the log began; pauses between runs count if the log shows them.
        since: (n,) [s] since its run began.
        voltage: (n,) [V] mean over the span of the acceleration.
        position: (n,) [m or rad].
        velocity: (n,) [m/s or rad/s].
        acceleration: (n,) [m/s² or rad/s²].
        missing: (n,) [V] voltage minus that of the model.
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
        """Whether it turned farther than a mechanism with limited travel can."""
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
        """Regression coefficients (k,) of ``missing`` on k columns (n,), together with the gains.

        The terms of the gains are regressors as well, and their coefficients are dropped. So a
        column does not get what a change of kS, kV, kA or gravity explains.
        """
        return np.asarray(self.fit_column_sets(*(column[:, None] for column in columns))[:, 0])

    def fit_column_sets(self, *columns: Array) -> Array:
        """(k, m) coefficients of m separate regressions on k columns each; a column is (n, m)."""
        basis, rest = self._projection
        table = np.stack(columns)
        whole = np.linalg.norm(table, axis=1)
        table -= basis @ (basis.T @ table)
        size = np.linalg.norm(table, axis=1)
        size[size <= NEGLIGIBLE * whole] = np.inf
        table /= size[:, None]
        square = np.array([[np.sum(one * other, axis=0) for other in table] for one in table])
        values, vectors = np.linalg.eigh(square.T)
        parts = vectors.transpose(0, 2, 1) @ (rest @ table).T[..., None]
        parts /= np.where(values > NEGLIGIBLE, values, np.inf)[..., None]
        return np.asarray((vectors @ parts)[..., 0].T / size)

    def fit_one_column(self, column: Array) -> tuple[float, float]:
        """Coefficient of one column (n,), and the sum of squares [V²] of ``missing`` it explains.

        The terms of the gains are regressors as well, as in ``fit_columns``.
        """
        basis, rest = self._projection
        left = column - basis @ (basis.T @ column)
        square = float(left @ left)
        if square <= NEGLIGIBLE**2 * float(column @ column):
            return 0.0, 0.0
        product = float(left @ rest)
        return product / square, product**2 / square

    @cached_property
    def _projection(self) -> tuple[Array, Array]:
        """(n, k) orthonormal basis of the gains' terms, (n,) ``missing`` minus its projection."""
        columns = [np.sign(self.velocity), self.velocity, self.acceleration]
        if "offset_rad" in self.gains:
            columns += [np.cos(self.position), np.sin(self.position)]
        elif "kG" in self.gains:
            columns.append(np.ones_like(self.velocity))
        known = np.column_stack(columns)
        size = np.linalg.norm(known, axis=0)
        size[size == 0.0] = 1.0
        basis, _ = np.linalg.qr(known / size)
        return basis, self.missing - basis @ (basis.T @ self.missing)


def compute_voltage_residual(log: Log, gains: Mapping[str, float], *, type: str) -> VoltageResidual:  # noqa: A002 - the field's own word
    """The voltage residual of a log under given gains.

    Args:
        log: any runs.
        gains: kS, kV, kA, and kG (with ``offset_rad`` for an arm) where ``type`` has gravity, in
            SI.
        type: ``simple``, ``elevator`` or ``arm``.
    """
    starts = list_run_start_times(log)
    parts = [_compute_rows(run, number, starts[number]) for number, run in enumerate(log.runs)]
    top = max((float(np.max(np.abs(p[5]), initial=0.0)) for p in parts), default=0.0)
    table = np.concatenate([p[:, np.abs(p[5]) > AT_REST * top] for p in parts], axis=1)
    run, clock, since, voltage, position, velocity, acceleration = table
    modelled = gains["kS"] * np.sign(velocity) + gains["kV"] * velocity + gains["kA"] * acceleration
    if type == "elevator":
        modelled += gains["kG"]
    elif type == "arm":
        modelled += gains["kG"] * np.cos(position + gains.get("offset_rad", 0.0))
    return VoltageResidual(
        log, gains, run.astype(np.intp), clock, since, voltage, position, velocity, acceleration,
        voltage - modelled,
    )  # fmt: skip


def list_run_start_times(log: Log) -> Array:
    """(runs,) [s] start of each run, from the start of the first.

    If the times of the runs overlap, as in a file in which each begins at zero, the runs are placed
    one after another without pauses.
    """
    first = np.array([run.time[0] for run in log.runs])
    last = np.array([run.time[-1] for run in log.runs])
    if shares_clock(log):
        return np.asarray(first - first[0])
    return np.concatenate(([0.0], np.cumsum(last - first)[:-1]))


def shares_clock(log: Log) -> bool:
    """Whether the runs share one clock, so that the pauses between them are known.

    If they do not, the time for which a motor cooled is unknown, and each run begins cold.
    """
    runs = log.runs
    return all(one.time[-1] < other.time[0] for one, other in pairwise(runs))


def _compute_rows(run: Run, number: int, clock: float) -> Array:
    """(7, n): run, time, time in the run, voltage, position, velocity, acceleration."""
    since = run.time - run.time[0]
    if len(run) < MIN_SAMPLES:
        return np.empty((7, 0))
    reach = max(1, round(0.5 * SPAN / float(np.median(np.diff(run.time)))))
    if len(run) <= 2 * reach:
        return np.empty((7, 0))
    acceleration = (run.velocity[2 * reach :] - run.velocity[: -2 * reach]) / (
        run.time[2 * reach :] - run.time[: -2 * reach]
    )
    # the voltage that caused this difference is the mean over its span
    mean = run.voltage + 0.5 * run.voltage_slide
    integral = np.concatenate(([0.0], np.cumsum(mean[:-1] * np.diff(run.time))))
    voltage = (integral[2 * reach :] - integral[: -2 * reach]) / (
        run.time[2 * reach :] - run.time[: -2 * reach]
    )
    inner = slice(reach, -reach)
    size = acceleration.size
    return np.vstack(
        [np.full(size, number), clock + since[inner], since[inner], voltage, run.position[inner],
         run.velocity[inner], acceleration]
    )  # fmt: skip
