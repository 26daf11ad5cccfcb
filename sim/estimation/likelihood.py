"""The likelihood of a model's parameters, given the measurements of all runs.

The prediction-error method (Ljung, *System Identification*, chapter 7): a steady-state Kalman
filter predicts each sample from those before it, and the parameters are those that make its
innovations most likely.

    -2 log L = n_x·log Σ_xx + n_v·log Σ_vv + n_xv·log(1 - ρ²) + Σ (x/σ)² + Σ (δ/τ)² + Σ (d/λ)²

Σ is the (2, 2) covariance of the innovations, ρ their correlation, and n_x, n_v and n_xv the
numbers of compared positions, velocities and pairs; where all are equal, the first three terms are
N·log det Σ. A run may start at an offset x from its first reading, its friction may differ by δ
from that of the others (``random_friction.py``), and so may the lag of its readings, by d. All have
a normal prior. The backlash phase of a run has one, too (``run_nuisance.py``).
"""

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from itertools import pairwise
from threading import Lock
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.kalman import OPEN_LOOP, GainSchedule, KalmanFilter, make_steady_state_filter
from sim.estimation.measurements import SensorNoise, compute_noise_at_speed, estimate_noise
from sim.estimation.model_structure import ModelStructure
from sim.estimation.random_friction import get_friction_sd
from sim.estimation.run_nuisance import FRICTION, LAG, POSITION, RunNuisance
from sim.estimation.run_records import RunRecord
from sim.physics.engine import RunBatch, Track, filter_runs
from sim.physics.model import Model

START_SD = 2.0  # [noises of a position] standard deviation of a start position
TOP = 0.98  # quantile of the speeds that is the top speed, so that one bad sample is not
STEP = 1e-3  # [of a value's size] step of a derivative
COARSE_STEP = 0.02  # [of it] the same where the simulation is not smooth in the parameter
LAG_STEP = 0.02  # [of its standard deviation] step of the derivative by a run's own lag
LARGEST = 1e100  # [1] innovation whose square is still a number
SHORTEST = 0.02  # [sample periods] a shorter kA/kV cannot be measurements, and needs too fine steps
PARALLEL = 10_000  # [samples] of a log from which on simulations run in parallel


class SampleCounter:
    """Number of simulated samples: the work of a search, the same on every machine."""

    def __init__(self) -> None:
        self.count = 0
        self._lock = Lock()  # long logs are simulated in several threads

    def add(self, samples: int) -> None:
        """Count further samples."""
        with self._lock:
            self.count += samples


@dataclass(frozen=True, eq=False)
class Estimate:
    """Parameter values of a model structure, and how well they fit.

    Args:
        structure: the model structure.
        values: parameter -> value.
        nuisance: the nuisance parameters of each run.
        process_noise: [unit²/s³] spectral density of the random acceleration.
        kalman_filter: the filter that made the innovations.
        innovations: (n, 2) of position and velocity; 0 where a reading is not compared, scaled
            where a voltage is uncertain.
        innovation_cov: (2, 2) covariance of the innovations.
        cost: -2 log L, up to a constant.
    """

    structure: ModelStructure
    values: Mapping[str, float]
    nuisance: RunNuisance
    process_noise: float
    kalman_filter: KalmanFilter
    innovations: Array
    innovation_cov: Array
    cost: float

    @cached_property
    def model(self) -> Model:
        """The model with these values."""
        return self.structure.model(self.values)

    @cached_property
    def whitening(self) -> Array:
        """(2, 2) matrix that makes innovations independent, with unit variance."""
        return np.asarray(np.linalg.inv(np.linalg.cholesky(self.innovation_cov)))


@dataclass(frozen=True, eq=False)
class PredictionErrorProblem:
    """The measurements of some runs, and the likelihood of parameters given them.

    Args:
        records: the runs.
        noise: standard deviations of their samples, estimated without a model.
        max_process_noise: [unit²/s³] upper limit of the process noise.
        varying_friction: whether kS may differ from run to run.
        lag_sd: [s] standard deviation of the runs' lags about their mean; 0 if they are equal.
        backlash_allowance: [unit] how far backlash outside the model may shift a run's start.
        priors: parameter of an effect -> standard deviation of its normal prior about zero.
        simulated: counts the samples that it has simulated, together with all problems made from it
            by ``replace`` or ``select_runs``.
    """

    records: tuple[RunRecord, ...]
    noise: SensorNoise
    max_process_noise: float = math.inf
    varying_friction: bool = True
    lag_sd: float = 0.0
    backlash_allowance: float = 0.0
    priors: Mapping[str, float] = field(default_factory=dict)
    simulated: SampleCounter = field(default_factory=SampleCounter)

    @classmethod
    def from_records(cls, records: Sequence[RunRecord]) -> "PredictionErrorProblem":
        """The problem of these runs, their noise estimated from their samples."""
        return cls(tuple(records), estimate_noise(tuple(one.measurements for one in records)))

    def select_runs(
        self, chosen: Sequence[int], *, compared: Sequence[int] | None = None
    ) -> "PredictionErrorProblem":
        """The problem of some runs, with the same noise and priors.

        Args:
            chosen: indices of the runs that are simulated.
            compared: indices of the runs whose samples are compared; None compares all of them.
        """
        records = tuple(
            self.records[n] if compared is None or n in compared else self.records[n].exclude()
            for n in chosen
        )
        return replace(self, records=records)

    @cached_property
    def run_edges(self) -> NDArray[np.intp]:
        """(runs + 1,) index of each run's first sample among all, and their number."""
        return np.concatenate(
            ([0], np.cumsum([record.measurements.time.size for record in self.records]))
        )

    @cached_property
    def run_slices(self) -> tuple[slice, ...]:
        """Per run, its samples among all."""
        return tuple(slice(*edges) for edges in pairwise(self.run_edges.tolist()))

    def _join(self, name: str) -> NDArray[Any]:
        """A signal of the measurements, of all runs."""
        return np.concatenate([getattr(record.measurements, name) for record in self.records])

    @cached_property
    def batch(self) -> RunBatch:
        """The runs as contiguous arrays for the engine."""
        signals = [self._join(one) for one in ("time", "voltage", "voltage_slide", "measured")]
        starts = [(one.measurements.position, one.measurements.velocity) for one in self.records]
        numbers = [(one.low, one.high, one.clock, one.memory_group) for one in self.records]
        each = (*np.transpose(starts), *np.transpose(numbers))
        arrays = (self.run_edges, *signals, *each)
        return RunBatch(*(np.ascontiguousarray(one, dtype=np.float64) for one in arrays))

    @cached_property
    def measured(self) -> Array:
        """(n, 2) positions and velocities of all runs."""
        return self._join("measured")

    @cached_property
    def voltage_error(self) -> Array:
        """(n,) [V] standard deviation of the mean voltage since the sample before."""
        errors = [record.measurements.voltage_error for record in self.records]
        return np.concatenate([np.concatenate(([0.0], one[:-1])) for one in errors])

    @cached_property
    def _voltage_is_uncertain(self) -> bool:
        return bool(self.voltage_error.any())

    @cached_property
    def informative(self) -> NDArray[np.bool_]:
        """(n,) whether a sample is compared; the first of a run is not, the run starts from it."""
        informative = self._join("informative")
        informative[self.run_edges[:-1]] = False
        return informative & ~np.isnan(self.measured).all(axis=1)

    @cached_property
    def ignored_readings(self) -> NDArray[np.bool_]:
        """(n, 2) whether a reading is not compared."""
        ignored = np.isnan(self.measured) | ~self.informative[:, None]
        ignored[:, 0] |= self._join("at_rest")
        return ignored

    @cached_property
    def _ignored_places(self) -> NDArray[np.intp]:
        return np.flatnonzero(self.ignored_readings)

    @cached_property
    def compared_counts(self) -> tuple[int, int, int]:
        """Numbers of compared positions, velocities and pairs of both; each at least 1."""
        x, v = ~self.ignored_readings.T
        positions, velocities, both = (int(np.count_nonzero(one)) for one in (x, v, x & v))
        return max(positions, 1), max(velocities, 1), max(both, 1)

    @cached_property
    def moving(self) -> NDArray[np.bool_]:
        """(n,) whether the mechanism moves at each sample."""
        return self._join("moving")

    @cached_property
    def sample_count(self) -> int:
        """Number of compared samples."""
        return int(np.count_nonzero(~self.ignored_readings.all(axis=1)))

    @cached_property
    def period(self) -> float:
        """[s] median time between samples."""
        steps = [np.diff(record.measurements.time) for record in self.records]
        return float(np.median(np.concatenate(steps)))

    @cached_property
    def top_speed(self) -> float:
        """[unit/s] top speed: a high quantile of the compared speeds."""
        speeds = np.abs(self.measured[self.informative, 1])
        speeds = speeds[~np.isnan(speeds)]
        return float(np.quantile(speeds, TOP)) if speeds.size else 0.0

    @cached_property
    def velocity_floor(self) -> float:
        """[unit/s] root mean square of the velocity's noise, at the speeds that were recorded."""
        measurements = [record.measurements for record in self.records]
        return max(compute_noise_at_speed(measurements, self.noise), self.noise.velocity)

    @cached_property
    def start_sd(self) -> float:
        """[unit] standard deviation of a start position."""
        return max(START_SD * self.noise.position, self.backlash_allowance)

    @property
    def initial_nuisance(self) -> RunNuisance:
        """Nuisance parameters to start from: no offsets."""
        return RunNuisance.at_first_samples(len(self.records))

    def select_priors(self, structure: ModelStructure) -> dict[str, float]:
        """Searched parameter -> standard deviation of its prior, for those that have one."""
        return {name: sd for name, sd in self.priors.items() if name in structure.searched_names}

    # -- simulate --------------------------------------------------------------------------------

    def simulate(
        self, model: Model, nuisance: RunNuisance, kalman_filter: KalmanFilter = OPEN_LOOP
    ) -> Track:
        """Simulate all runs, one after another.

        Args:
            model: the model.
            nuisance: the nuisance parameters of each run.
            kalman_filter: corrects the state; the default is an open-loop simulation.
        """
        return Track(*self._filter_runs(model, nuisance, kalman_filter, self.batch).T)

    def predict_errors(
        self,
        model: Model,
        nuisance: RunNuisance,
        kalman_filter: KalmanFilter,
        clocks: Array | None = None,
    ) -> Array:
        """(n, 2) innovations: measured minus predicted; 0 where nothing is compared.

        Args:
            model: the model.
            nuisance: the nuisance parameters of each run.
            kalman_filter: corrects the state.
            clocks: (runs,) [s] start time of each run; None takes the recorded one.
        """
        batch = self.batch if clocks is None else replace(self.batch, clocks=clocks)
        errors = np.empty(self.measured.shape)
        self._filter_runs(model, nuisance, kalman_filter, batch, errors)
        errors.reshape(-1)[self._ignored_places] = 0.0
        if (schedule := self._schedule_gains(kalman_filter)) is not None:
            rows = schedule.uncertain
            errors[rows] = (schedule.scales @ errors[rows, :, None])[..., 0]
            errors.reshape(-1)[self._ignored_places] = 0.0
        return np.asarray(errors)

    def _filter_runs(
        self, model: Model, nuisance: RunNuisance, kalman_filter: KalmanFilter, batch: RunBatch,
        errors: Array | None = None,
    ) -> Array:  # fmt: skip
        schedule = self._schedule_gains(kalman_filter)
        gain = kalman_filter.steady if schedule is None else schedule.gains
        self.simulated.add(batch.time.size)
        return filter_runs(
            model, batch, kalman_gain=gain,
            position_offset=nuisance.position_offset, backlash_phase=nuisance.backlash_phase,
            friction_offset=nuisance.friction_offset, lag_offset=nuisance.lag_offset, errors=errors,
        )  # fmt: skip

    def _compute_log_determinant(self, kalman_filter: KalmanFilter) -> float:
        """Log det S, a term of -2 log L, of the innovations with an uncertain voltage."""
        if (schedule := self._schedule_gains(kalman_filter)) is None:
            return 0.0
        scales = schedule.scales[self.informative[schedule.uncertain]]
        return float(-2.0 * np.sum(np.log(scales[:, 0, 0] * scales[:, 1, 1])))  # triangular

    def _schedule_gains(self, kalman_filter: KalmanFilter) -> GainSchedule | None:
        """The gain at each sample; None if no voltage is uncertain, so that it is constant."""
        if not self._voltage_is_uncertain:
            return None
        found = self._schedules.get(kalman_filter)
        if found is None:
            starts = self.run_edges[:-1].tolist()
            found = kalman_filter.schedule(self.voltage_error, starts)
            self._schedules[kalman_filter] = found
        return found

    @cached_property
    def _schedules(self) -> WeakKeyDictionary[KalmanFilter, GainSchedule]:
        """Kalman filter -> its schedule; all derivatives at one estimate share one."""
        return WeakKeyDictionary()

    def evaluate(
        self,
        structure: ModelStructure,
        values: Mapping[str, float],
        nuisance: RunNuisance,
        process_noise: float,
    ) -> Estimate:
        """The estimate at these values; its cost is infinite where they are not physical.

        Args:
            structure: the model structure.
            values: value of each of its parameters.
            nuisance: the nuisance parameters of each run.
            process_noise: [unit²/s³] spectral density of the random acceleration.
        """
        if not structure.has_backlash:
            nuisance = nuisance.without_backlash_phase
        given = (structure, values, nuisance, process_noise)
        nowhere = Estimate(*given, OPEN_LOOP, np.empty((0, 2)), np.eye(2), math.inf)
        possible = values["kV"] > 0.0 and values["kA"] > SHORTEST * self.period * values["kV"]
        if not (possible and self.sample_count):
            return nowhere
        model = structure.model(values)
        with np.errstate(
            over="ignore", invalid="ignore"
        ):  # a diverging simulation has an infinite cost
            kalman_filter = make_steady_state_filter(
                values["kV"], values["kA"], noise=self.noise,
                process_noise=process_noise, period=self.period,
            )  # fmt: skip
            innovations = self.predict_errors(model, nuisance, kalman_filter)
            cov = self.compute_covariance(innovations)
            cost = self._compute_cost(cov) + float(np.sum(nuisance.backlash_phase_costs))
            cost += sum(
                float(np.sum((getattr(nuisance, name) / sd) ** 2))
                for name, sd in self.list_random_effects(values).items()
            )
            cost += sum(
                (values[name] / sd) ** 2 for name, sd in self.select_priors(structure).items()
            )
            cost += self._compute_log_determinant(kalman_filter)
        if not math.isfinite(cost):
            return nowhere
        return Estimate(*given, kalman_filter, innovations, cov, cost)

    def change(
        self, point: Estimate, *, structure: ModelStructure | None = None,
        values: Mapping[str, float] | None = None, nuisance: RunNuisance | None = None,
        process_noise: float | None = None,
    ) -> Estimate:  # fmt: skip
        """An estimate evaluated on these measurements, some of its arguments changed."""
        q = point.process_noise if process_noise is None else process_noise
        return self.evaluate(
            structure or point.structure, values or point.values, nuisance or point.nuisance, q
        )

    # -- compare ---------------------------------------------------------------------------------

    def compute_covariance(self, innovations: Array) -> Array:
        """(2, 2) covariance of innovations, kept positive definite."""
        x, v = innovations.T.copy()
        positions, velocities, both = self.compared_counts
        xx, vv = float(x @ x) / positions, float(v @ v) / velocities
        limit = 0.99 * math.sqrt(xx * vv)
        xv = min(max(float(x @ v) / both, -limit), limit)
        least_x, least_v = self.noise.resolution
        return np.array([[xx + least_x**2, xv], [xv, vv + least_v**2]])

    def _compute_cost(self, cov: Array) -> float:
        (xx, xv), (_, vv) = cov.tolist()
        if not (xx > 0.0 and vv > 0.0 and math.isfinite(xx * vv)):
            return math.inf
        positions, velocities, both = self.compared_counts
        uncorrelated = positions * math.log(xx) + velocities * math.log(vv)
        return uncorrelated + both * math.log1p(-xv * xv / (xx * vv))

    def whiten(self, point: Estimate, table: Array, out: Array | None = None) -> Array:
        """(2 n,) innovations or their derivatives, whitened with an estimate's covariance.

        Diverging innovations are clipped, so that their squares can be summed.

        Args:
            point: the estimate.
            table: (n, 2) innovations, or their derivatives by a parameter.
            out: (2 n,) array for the result, or None.
        """
        into = None if out is None else out.reshape(table.shape)
        with np.errstate(over="ignore", invalid="ignore"):
            white = np.matmul(table, point.whitening.T, out=into).ravel()
            if math.isfinite(float(white @ white)):
                return np.asarray(white)
        clipped = np.clip(np.nan_to_num(table, nan=LARGEST), -LARGEST, LARGEST)
        return np.asarray(np.matmul(clipped, point.whitening.T, out=into).ravel())

    def compute_jacobian(self, point: Estimate, *, fine: bool = False) -> Array:
        """(2 n, searched + nuisance) derivatives of the whitened innovations.

        The columns are each searched parameter, then the start of each run, then, where they vary
        between runs, the friction and the lag of each run.

        Args:
            point: the estimate.
            fine: central differences for the parameters, for a covariance.

        Raises:
            ValueError: the cost of the estimate is infinite.
        """
        kept = self._jacobians.get(point, {})
        if fine not in kept:
            kept = {fine: self._compute_jacobian(point, fine=fine)}
            self._keep_jacobian(point, kept)
        return kept[fine]

    @cached_property
    def _jacobians(self) -> WeakKeyDictionary[Estimate, dict[bool, Array]]:
        """Estimate -> its Jacobian by ``fine``, of the last estimate only, which is used again."""
        return WeakKeyDictionary()

    def _keep_jacobian(self, point: Estimate, kept: dict[bool, Array]) -> None:
        self._jacobians.clear()
        self._jacobians[point] = kept

    def _compute_jacobian(self, point: Estimate, *, fine: bool) -> Array:
        names = point.structure.searched_names
        if fine:
            known = self.compute_jacobian(point)
            table = np.empty(known.shape[::-1])
            table[len(names) :] = known.T[len(names) :]
            self._fill_parameter_rows(table[: len(names)], point, names, known=known)
            return table.T
        effects = self.list_random_effects(point.values)
        changes = [self._compute_run_change(point, name) for name in effects]
        runs, count = len(self.records), len(names)
        table = np.zeros((count + runs * len(changes), point.innovations.size))
        self._fill_parameter_rows(table[:count], point, names)
        for place, change in enumerate(changes):
            self._fill_run_rows(table[count + place * runs :], change)
        return table.T

    def extend_jacobian(self, point: Estimate, known: Array) -> None:
        """Store the Jacobian of an estimate with absent effects, extended from that without them.

        Args:
            point: the estimate.
            known: (2 n, others + nuisance) the fine Jacobian at it in a structure without them.
        """
        every, parameters = point.structure.searched_names, point.structure.parameters
        nuisance = len(self.records) * len(self.list_random_effects(point.values))
        others = known.shape[1] - nuisance
        # an absent effect's other parameters change nothing: their derivatives are zero
        sizes = [name for name in every[others:] if parameters[name].neutral == 0.0]
        table = np.zeros((len(every) + nuisance, len(known)))
        table[:others], table[len(every) :] = known.T[:others], known.T[others:]
        self._fill_parameter_rows([table[every.index(name)] for name in sizes], point, sizes)
        self._keep_jacobian(point, {True: table.T})

    def _fill_parameter_rows(
        self, rows: Sequence[Array] | Array, point: Estimate, names: Sequence[str], *,
        known: Array | None = None,
    ) -> None:  # fmt: skip
        """Write derivatives of the whitened innovations by some parameters into rows.

        Args:
            rows: (2 n,) for each parameter.
            point: the estimate.
            names: the parameters.
            known: (2 n, names or more) these derivatives as one-sided differences. If given, the
                mean with the difference to the other side is written.
        """
        sides = [
            self._compute_difference_step(point, name, back=known is not None) for name in names
        ]
        tried = [
            (point.structure.model({**point.values, name: value}), point.nuisance)
            for name, value in zip(names, sides, strict=True)
            if value is not None
        ]
        with np.errstate(over="ignore", invalid="ignore"):  # diverging ones are clipped by whiten
            results = self._simulate_in_parallel(tried, point.kalman_filter)
            for place, (row, name, value) in enumerate(zip(rows, names, sides, strict=True)):
                if value is not None:
                    change = next(results)
                    change -= point.innovations
                    change /= value - point.values[name]
                    self.whiten(point, change, out=row)
                if known is not None:
                    column = known[:, place]
                    row[:] = column if value is None else 0.5 * (column + row)

    def compute_run_jacobian(self, point: Estimate, name: str) -> Array:
        """(2 n, runs) derivatives of the whitened innovations by an offset of each run."""
        table = np.zeros((len(self.records), point.innovations.size))
        self._fill_run_rows(table, self._compute_run_change(point, name))
        return table.T

    def _compute_run_change(self, point: Estimate, name: str) -> Array:
        """(2 n,) derivative of the whitened innovations by an offset of all runs together."""
        by = {
            POSITION: self.noise.position,
            FRICTION: get_friction_sd(point.values),
            LAG: LAG_STEP * self.lag_sd,
        }[name]
        ways = (by, -by) if name == FRICTION else (by,)  # friction that holds has a kink
        tried = [(point.model, point.nuisance.add(name, way)) for way in ways]
        with np.errstate(over="ignore", invalid="ignore"):  # diverging ones are clipped by whiten
            found = [*self._simulate_in_parallel(tried, point.kalman_filter), point.innovations]
            return self.whiten(point, (found[0] - found[1]) / (by * len(ways)))

    def list_random_effects(self, values: Mapping[str, float]) -> dict[str, float]:
        """Offset that differs at random from run to run -> standard deviation of its prior.

        They have the order of the Jacobian's columns.

        Args:
            values: the parameters; friction varies by a share of kS.
        """
        effects = {POSITION: self.start_sd}
        if self.varying_friction:
            effects[FRICTION] = get_friction_sd(values)
        if self.lag_sd:
            effects[LAG] = self.lag_sd
        return effects

    def _compute_difference_step(self, point: Estimate, name: str, *, back: bool) -> float | None:
        """The value of a parameter at which to simulate for a finite difference.

        It is one step up, or down if the parameter is at its upper limit. ``back`` asks for the
        step to the other side, which is None if that is outside of the limits.
        """
        structure, value = point.structure, point.values[name]
        coarse = name in structure.parameters and structure.parameters[name].stepwise
        size = max(structure.find_parameter_scale(name, value), self.priors.get(name, 0.0))
        step = (COARSE_STEP if coarse else STEP) * size
        above, below = value + step, value - step
        if structure.clamp_value(name, above) != above:
            return None if back else structure.clamp_value(name, below)
        if not back:
            return above
        return below if structure.clamp_value(name, below) == below else None

    def _simulate_in_parallel(
        self, tried: Sequence[tuple[Model, RunNuisance]], kalman_filter: KalmanFilter
    ) -> Iterator[Array]:
        """The innovations of several simulations, in threads if the log is long."""

        def predict_errors_of(pair: tuple[Model, RunNuisance]) -> Array:
            return self.predict_errors(*pair, kalman_filter)

        return (_make_thread_pool().map if len(self.measured) > PARALLEL else map)(
            predict_errors_of, tried
        )

    def _fill_run_rows(self, rows: Array, change: Array) -> None:
        """Copy each run's part of the changes (2 n,) into that run's row; its rest stays zero.

        All runs change at once, because a run also changes those after it: it may heat the motor.
        """
        for number, (first, last) in enumerate(pairwise((2 * self.run_edges).tolist())):
            rows[number, first:last] = change[first:last]


@cache
def _make_thread_pool() -> ThreadPoolExecutor:
    """A pool with one thread for each core, for long logs."""
    return ThreadPoolExecutor(os.cpu_count(), thread_name_prefix="simulate")
