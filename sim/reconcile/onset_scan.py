"""Scan all onset times of effects with an onset.

A small effect is simulated from each onset to the end of the run, in all runs at the same time. To
first order, the innovations change in proportion to its size, so the likeliest size and the
decrease of -2 log L follow from sums. An acceleration computed from a noisy velocity says less:
late in a step the acceleration is small, but the position still shows the difference.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import product
from typing import NamedTuple

import numpy as np

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import JointJacobian
from sim.estimation.run_nuisance import RunNuisance
from sim.physics.effect import LATER, MOMENT, ONSET, UNTIL, Effect
from sim.physics.effects import EFFECTS
from sim.physics.model import Part
from sim.reconcile.search_effort import HALVINGS
from sim.reconcile.thresholds import CELLS

RESPONSE = 50  # [samples] after a sudden loss of speed in which innovations show it
STARTS_PER_KIND = 2  # likeliest onsets that become starts
PROBE = 0.1  # [kA] simulated size: so small that the innovations change in proportion to it
LEAST, MOST = -0.5, 2.0  # [kA] smallest and largest size of a start
INDEPENDENT = 1e-9  # [1] least share of a change's square that no other parameter can cause


def scan_onsets(
    problem: PredictionErrorProblem, point: Estimate, effect: Effect, *, jacobian: JointJacobian
) -> Iterator[dict[str, float]]:
    """Start values of an effect at the onset times with the largest predicted improvements.

    Args:
        problem: the measurements.
        point: the estimate without the effect.
        effect: the effect, which has an onset.
        jacobian: joint Jacobian at ``point``.
    """
    scan = _Scan(problem, point, effect, jacobian)
    for kind in list_fixed_choices(effect):
        likeliest = sorted(scan.scan_coarsely(kind), key=lambda one: -one.improvement)
        for one in likeliest[:STARTS_PER_KIND]:
            values = scan.parameter_values(scan.refine(one))
            yield {f"{effect.name}.{name}": value for name, value in values.items()}


def flip_duration(problem: PredictionErrorProblem, point: Estimate) -> Iterator[Estimate]:
    """The estimate with a permanent effect made temporary, and the other way round.

    No search moves from one to the other, and with further effects in the model the other one may
    have become likelier.
    """
    for name in point.structure.effects:
        effect = EFFECTS[name]
        if not effect.has_onset:
            continue
        onset = point.values[f"{name}.{ONSET}"]
        ends = [
            record.clock + float(np.ptp(record.measurements.time)) + MOMENT
            for record in problem.records
        ]
        run_end = min((end for end in ends if end > onset), default=LATER)
        for kind, until in product(list_fixed_choices(effect), (run_end, LATER)):
            changed = {f"{name}.{one}": value for one, value in {**kind, UNTIL: until}.items()}
            values = {**point.values, **changed}
            if values != point.values:
                yield problem.change(point, values=values)


def refine_onset(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate with the likeliest onset nearby.

    An optimizer does not move an onset, because the likelihood jumps at each sample.
    """
    for name in point.structure.effects:
        if not EFFECTS[name].has_onset:
            continue
        onset, step, structure = f"{name}.{ONSET}", problem.period, point.structure
        for _ in range(HALVINGS):
            around = [
                structure.clamp_value(onset, point.values[onset] + by) for by in (-step, step)
            ]
            tried = [problem.change(point, values={**point.values, onset: t}) for t in around]
            point = min(point, *tried, key=lambda one: one.cost)
            step *= 0.5
    return point


def list_fixed_choices(effect: Effect) -> Iterator[Mapping[str, float]]:
    """All choices of the values that a search keeps fixed, other than onset and end."""
    ends = {
        one.name: (one.least, one.most)
        for one in effect.parameters
        if not one.searched and one.name not in {ONSET, UNTIL}
    }
    for chosen in product(*ends.values()):
        yield dict(zip(ends, chosen, strict=True))


class _Onset(NamedTuple):
    """An onset time that was tried.

    Args:
        improvement: [of -2 log L] predicted decrease at the best size.
        size: [V·s²/unit] that size.
        kind: fixed values, one of ``list_fixed_choices``.
        run: index of the run that contains the onset.
        share: [1] onset as a share of that run's duration.
        later: sums over all later runs; None if the effect ends with its run.
    """

    improvement: float
    size: float
    kind: Mapping[str, float]
    run: int
    share: float
    later: Array | None


class _Scan:
    """Sums of the effect's changes of the whitened innovations, for an onset in each run.

    Sums are (2 + k,) arrays: the scalar products of a change with the residual of the estimate and
    with itself, and its projection on the orthonormal basis of the joint Jacobian.
    """

    def __init__(
        self,
        problem: PredictionErrorProblem,
        point: Estimate,
        effect: Effect,
        jacobian: JointJacobian,
    ) -> None:
        self.problem, self.point, self.effect, self.basis = problem, point, effect, jacobian.basis
        most = min(one.most for one in effect.parameters if one.searched)
        self.ka = min(point.values["kA"], most / MOST)  # kA has no limit of its own
        self.durations = [float(np.ptp(record.measurements.time)) for record in problem.records]
        self._isolated: dict[tuple[int, ...], tuple[PredictionErrorProblem, RunNuisance]] = {}
        white = problem.whiten(point, point.innovations)
        self.residual = white - jacobian.basis @ jacobian.project(white)

    def scan_coarsely(self, kind: Mapping[str, float]) -> Iterator[_Onset]:
        """Each run's likeliest onset of an effect that ends with the run, and of a permanent one.

        Inertia that shares momentum is searched where speed is lost, any other in the whole run.
        """
        every = range(len(self.problem.records))
        shares_momentum = any(kind.values())
        shares = [0.0] if shares_momentum else [0.0, *((n + 0.5) / CELLS for n in range(CELLS))]
        table = [self._sum_effect(kind, share, every) for share in shares]
        later = np.zeros_like(table[0][0])
        for run in reversed(every):
            sums = [(share, row[run]) for share, row in zip(shares, table, strict=True)]
            if shares_momentum:
                sums += [
                    (one, self._sum_effect(kind, one, (run,))[0])
                    for one in self._compute_velocity_losses(run)
                ]
            for after in (None, later) if run < every[-1] else (None,):
                tried = (
                    self._fit_onset_size(kind, run, share, here, after)
                    for share, here in sums
                    if share or run or after is None  # else it acts on all samples, as kA does
                )
                yield max(tried, key=lambda one: one.improvement)
            later = later + table[0][run]

    def refine(self, one: _Onset) -> _Onset:
        """The likeliest onset nearby."""
        step = 1.0 / CELLS
        for _ in range(HALVINGS if one.share else 0):
            step *= 0.5
            tried = [
                self._fit_onset_size(
                    one.kind, one.run, share, self._sum_effect(one.kind, share, (one.run,))[0],
                    one.later,
                )
                for share in (one.share - step, one.share + step)
                if 0.0 < share < 1.0
            ]  # fmt: skip
            one = max((one, *tried), key=lambda one: one.improvement)
        return one

    def parameter_values(self, one: _Onset) -> dict[str, float]:
        """Values of all parameters of the effect with this onset."""
        start = self.problem.records[one.run].clock
        return {
            **self._make_size_parameters(one.size),
            **one.kind,
            ONSET: start + one.share * self.durations[one.run],
            UNTIL: start + self.durations[one.run] + MOMENT if one.later is None else LATER,
        }

    def _fit_onset_size(
        self, kind: Mapping[str, float], run: int, share: float, here: Array, later: Array | None
    ) -> _Onset:
        """An onset with its best size; only added inertia can share momentum."""
        sums = here if later is None else here + later
        product, own = sums[:2].tolist()
        square = own - float(sums[2:] @ sums[2:])
        improvement = size = 0.0
        if square > INDEPENDENT * own:
            least = 0.0 if any(kind.values()) else LEAST * self.ka
            size = min(max(-product / square, least), MOST * self.ka)
            improvement = -size * (2.0 * product + size * square)
        return _Onset(improvement, size, kind, run, share, later)

    def _compute_velocity_losses(self, run: int) -> list[float]:
        """Shares of a run's duration around its sharpest loss of speed, which a grid would miss.

        The innovations are correlated with the response to a loss of speed (a matched filter).
        """
        residual = self.residual[self._find_run_rows(run)].reshape(-1, 2)
        speed = self.problem.measured[self.problem.run_slices[run], 1]
        response = self._velocity_response[: len(residual)]
        size = np.cumsum(np.sum(np.square(response), axis=1))
        last = len(response) - 1
        products = sum(np.correlate(residual[:, n], response[:, n], "full")[last:] for n in (0, 1))
        count = np.minimum(np.arange(len(residual), 0, -1), len(response))
        lost = -np.asarray(products) * np.sign(np.nan_to_num(speed)) / np.sqrt(size[count - 1])
        time = self.problem.records[run].measurements.time
        within = 0.5 * (time[:-1] + time[1:]) - time[0]
        place = int(np.argmax(lost[1:]))
        near = within[max(place - 1, 0) : place + 2] / self.durations[run]
        return [float(one) for one in near]

    @cached_property
    def _velocity_response(self) -> Array:
        """(RESPONSE, 2) whitened innovations after a velocity error of 1 unit/s."""
        rate, dt = self.point.values["kV"] / self.ka, self.problem.period
        decay = math.exp(-rate * dt)
        step = np.array([[1.0, (1.0 - decay) / rate], [0.0, decay]]) @ (
            np.eye(2) - self.point.kalman_filter.steady
        )
        error, errors = np.array([0.0, 1.0]), []
        for _ in range(RESPONSE):
            errors.append(error)
            error = step @ error
        return self.problem.whiten(self.point, np.array(errors)).reshape(-1, 2)

    def _make_size_parameters(self, size: float) -> dict[str, float]:
        return {one.name: size for one in self.effect.parameters if one.searched}

    def _sum_effect(
        self, kind: Mapping[str, float], share: float, runs: Sequence[int]
    ) -> list[Array]:
        """For each run, the sums of the effect from that share of the run to its end."""
        isolated, nuisance = self._isolate_runs(tuple(runs))
        onset = max(self.durations)  # the same in all runs, whose clocks are shifted to it
        clocks = onset - share * np.array([self.durations[run] for run in runs])
        size = PROBE * self.ka
        given = {**self._make_size_parameters(size), **kind, ONSET: onset, UNTIL: LATER}
        found = []
        with np.errstate(over="ignore", invalid="ignore"):  # a diverged simulation explains nothing
            model = self.point.model + Part(self.effect.name, given)
            errors = isolated.predict_errors(model, nuisance, self.point.kalman_filter, clocks)
            for run, part in zip(runs, isolated.run_slices, strict=True):
                change = (errors[part] - self._run_innovations[run]) / size
                white, rows = self.problem.whiten(self.point, change), self._find_run_rows(run)
                products = white @ self.residual[rows], white @ white
                found.append(np.concatenate((products, self.basis[rows].T @ white)))
        return found

    def _isolate_runs(self, runs: tuple[int, ...]) -> tuple[PredictionErrorProblem, RunNuisance]:
        """The problem of these runs, none of which heats the motor for another; their nuisance."""
        if runs not in self._isolated:
            records = (replace(self.problem.records[run], memory_group=run) for run in runs)
            isolated = replace(self.problem, records=tuple(records))
            self._isolated[runs] = isolated, self.point.nuisance.select_runs(runs)
        return self._isolated[runs]

    def _find_run_rows(self, run: int) -> slice:
        """The rows of a run among whitened innovations."""
        samples = self.problem.run_slices[run]
        return slice(2 * samples.start, 2 * samples.stop)

    @cached_property
    def _run_innovations(self) -> list[Array]:
        """Per run, (n, 2) innovations without the effect."""
        alone, nuisance = self._isolate_runs(tuple(range(len(self.problem.records))))
        found = alone.predict_errors(self.point.model, nuisance, self.point.kalman_filter)
        return [found[rows] for rows in self.problem.run_slices]
