"""Scan all onset times of effects that happen once.

A small effect is simulated from each moment to the end of the run, in all runs at the same time. To
first order, the innovations change in proportion to its size, so the likeliest size and the gain of
the likelihood follow from sums. An acceleration computed from a noisy velocity says less: late in a
step the acceleration is small, but the position still shows the difference.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise, product

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
SHOWN = 2  # moments of each kind that are worth a start
PROBE = 0.1  # [1] of kA: so little that the innovations change in proportion to it
LEAST, MOST = -0.5, 2.0  # [1] of kA that may leave, and that may join: a search goes on from there
HARDLY = 1e-9  # [1] of its square below which gains and first samples can do all that it does


@dataclass(frozen=True, eq=False)
class _Sums:
    """What a change does to innovations: sums over the rows of some runs.

    Args:
        product: with what the point leaves unexplained.
        square: with itself.
        projection: (k,) with what values and starts can make of it.
    """

    product: float
    square: float
    projection: Array

    def __add__(self, other: "_Sums") -> "_Sums":
        return _Sums(
            self.product + other.product,
            self.square + other.square,
            self.projection + other.projection,
        )

    def best_size(self, least: float, most: float) -> tuple[float, float]:
        """[of -2 log L] that it explains at most between two sizes, and at which."""
        own = self.square - float(self.projection @ self.projection)
        if not own > HARDLY * self.square:
            return 0.0, 0.0
        size = min(max(-self.product / own, least), most)
        return -size * (2.0 * self.product + size * own), size


def scan_onsets(
    problem: PredictionErrorProblem, point: Estimate, effect: Effect, *, kept: JointJacobian
) -> Iterator[dict[str, float]]:
    """Parameter values at the onset times that explain most.

    Args:
        problem: the measurements.
        point: the best without it.
        effect: that happens once.
        kept: what the point adjusts to.
    """
    scan = _Scan(problem, point, effect, kept)
    for kind in list_fixed_choices(effect):
        likeliest = sorted(scan.scan_coarsely(kind), key=lambda one: -one.improvement)[:SHOWN]
        for one in map(scan.refine, likeliest):
            yield {
                f"{effect.name}.{name}": value for name, value in scan.parameter_values(one).items()
            }


def flip_duration(problem: PredictionErrorProblem, point: Estimate) -> Iterator[Estimate]:
    """The estimate with a permanent effect made temporary, and the other way round.

    No search moves from one to the other, and what was likelier before another effect was added may
    not be likelier beside it.
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
        over = min((end for end in ends if end > onset), default=LATER)
        for kind, until in product(list_fixed_choices(effect), (over, LATER)):
            changed = {f"{name}.{one}": value for one, value in {**kind, UNTIL: until}.items()}
            values = {**point.values, **changed}
            if values != point.values:
                yield problem.evaluate(point.structure, values, point.nuisance, point.process_noise)


def refine_onset(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate with the likeliest onset nearby.

    No search moves a moment: across a sample what is likely jumps.
    """
    for name in point.structure.effects:
        if not EFFECTS[name].has_onset:
            continue
        onset, step, structure = f"{name}.{ONSET}", problem.period, point.structure
        for _ in range(HALVINGS):
            around = (
                structure.clamp_value(onset, point.values[onset] + by) for by in (-step, step)
            )
            moved = ({**point.values, onset: moment} for moment in around)
            tried = [
                problem.evaluate(structure, one, point.nuisance, point.process_noise)
                for one in moved
            ]
            point = min(point, *tried, key=lambda one: one.cost)
            step *= 0.5
    return point


def list_fixed_choices(effect: Effect) -> Iterator[Mapping[str, float]]:
    """Values of the parameters that the search keeps fixed, apart from onset times."""
    ends = {
        one.name: (one.least, one.most)
        for one in effect.parameters
        if not one.searched and one.name not in {ONSET, UNTIL}
    }
    for chosen in product(*ends.values()):
        yield dict(zip(ends, chosen, strict=True))


@dataclass(frozen=True, eq=False)
class _Moment:
    """One that was tried.

    Args:
        kind: values of what is neither searched nor a moment.
        run: in which it is.
        share: [1] of that run, before it.
        here: what it does in that run.
        later: what it does in all runs after it; None if it is over with its run.
        ka: of the point.
    """

    kind: Mapping[str, float]
    run: int
    share: float
    here: _Sums
    later: _Sums | None
    ka: float

    @cached_property
    def best(self) -> tuple[float, float]:
        """[of -2 log L] that it explains, and its size; what leaves takes no momentum of others."""
        sums = self.here + self.later if self.later else self.here
        least = 0.0 if any(self.kind.values()) else LEAST * self.ka
        return sums.best_size(least, MOST * self.ka)

    @property
    def improvement(self) -> float:
        return self.best[0]


class _Scan:
    def __init__(
        self, problem: PredictionErrorProblem, point: Estimate, effect: Effect, kept: JointJacobian
    ) -> None:
        self.problem, self.point, self.effect, self.kept = problem, point, effect, kept.basis
        most = min(one.most for one in effect.parameters if one.searched)
        self.ka = min(point.values["kA"], most / MOST)  # which may be any number in the wild
        self.lasts = [
            float(record.measurements.time[-1] - record.measurements.time[0])
            for record in problem.records
        ]
        self._some: dict[tuple[int, ...], tuple[PredictionErrorProblem, RunNuisance]] = {}
        rest = problem.whiten(point, point.innovations)
        self.rest = rest - kept.basis @ kept.project(rest)

    def scan_coarsely(self, kind: Mapping[str, float]) -> Iterator[_Moment]:
        """Each run's likeliest moment, for the rest of the run and for good.

        What takes momentum is looked for where speed is lost, anything else all over the run.
        """
        every = range(len(self.problem.records))
        takes_momentum = any(kind.values())
        shares = [0.0] if takes_momentum else [0.0, *((n + 0.5) / CELLS for n in range(CELLS))]
        table = [self._sums(kind, share, every) for share in shares]
        later = _Sums(0.0, 0.0, np.zeros(self.kept.shape[1]))
        for run in reversed(every):
            sums = [(share, row[run]) for share, row in zip(shares, table, strict=True)]
            if takes_momentum:
                sums += [
                    (one, self._sums(kind, one, (run,))[0]) for one in self._velocity_losses(run)
                ]
            for more in (None, later) if run < every[-1] else (None,):
                tried = (
                    _Moment(kind, run, share, here, more, self.ka)
                    for share, here in sums
                    if share or run or more is None  # else it was never otherwise
                )
                yield max(tried, key=lambda one: one.improvement)
            later += table[0][run]

    def refine(self, one: _Moment) -> _Moment:
        """The same, at the likeliest moment around."""
        step = 1.0 / CELLS
        for _ in range(HALVINGS if one.share else 0):
            step *= 0.5
            shares = (one.share - step, one.share + step)
            tried = [
                replace(one, share=share, here=self._sums(one.kind, share, (one.run,))[0])
                for share in shares
                if 0.0 < share < 1.0
            ]
            one = max((one, *tried), key=lambda one: one.improvement)
        return one

    def parameter_values(self, one: _Moment) -> dict[str, float]:
        """Of all parameters, if it happens then."""
        began = self.problem.records[one.run].clock
        return {
            **self._fit_size(one.best[1]),
            **one.kind,
            ONSET: began + one.share * self.lasts[one.run],
            UNTIL: LATER if one.later else began + self.lasts[one.run] + MOMENT,
        }

    def _velocity_losses(self, run: int) -> list[float]:
        """[1] of a run, about its sharpest loss of speed, which is over too soon for any grid.

        The innovations after it are correlated with the response to such a loss (a matched filter).
        """
        rest = self.rest[slice(*self._edges[run : run + 2])].reshape(-1, 2)
        speed = self.problem.measured[slice(*self.problem.run_edges[run : run + 2]), 1]
        response = self._velocity_response[: len(rest)]
        size = np.cumsum(np.sum(np.square(response), axis=1))
        last = len(response) - 1
        seen = sum(np.correlate(rest[:, n], response[:, n], "full")[last:] for n in (0, 1))
        left = np.minimum(np.arange(len(rest), 0, -1), len(response))
        lost = -np.asarray(seen) * np.sign(np.nan_to_num(speed)) / np.sqrt(size[left - 1])
        time = self.problem.records[run].measurements.time
        within = 0.5 * (time[:-1] + time[1:]) - time[0]
        place = int(np.argmax(lost[1:]))
        near = within[max(place - 1, 0) : place + 2] / self.lasts[run]
        return [float(one) for one in near]

    @cached_property
    def _velocity_response(self) -> Array:
        """(samples, 2) white innovations after a velocity that is one more than expected."""
        rate, dt = self.point.values["kV"] / self.ka, self.problem.period
        kept = math.exp(-rate * dt)
        step = np.array([[1.0, (1.0 - kept) / rate], [0.0, kept]]) @ (
            np.eye(2) - self.point.kalman_filter.steady
        )
        off, errors = np.array([0.0, 1.0]), []
        for _ in range(RESPONSE):
            errors.append(off)
            off = step @ off
        return self.problem.whiten(self.point, np.array(errors)).reshape(-1, 2)

    def _fit_size(self, size: float) -> dict[str, float]:
        return {one.name: size for one in self.effect.parameters if one.searched}

    def _sums(self, kind: Mapping[str, float], share: float, runs: Sequence[int]) -> list[_Sums]:
        """What it changes from that share of each of these runs on, to its end."""
        some, nuisance = self._isolate_runs(tuple(runs))
        moment = max(self.lasts)  # on the clocks of all runs at once
        clocks = moment - share * np.array([self.lasts[run] for run in runs])
        size = PROBE * self.ka
        given = {**self._fit_size(size), **kind, ONSET: moment, UNTIL: LATER}
        model = self.point.structure.model(self.point.values)
        with np.errstate(over="ignore", invalid="ignore"):  # what flies off explains nothing
            model += Part(self.effect.name, given)
            ahead = some.predict_errors(model, nuisance, self.point.kalman_filter, clocks)
            return [
                self._sum_rows(run, (ahead[slice(*rows)] - self._run_innovations[run]) / size)
                for run, rows in zip(runs, pairwise(some.run_edges.tolist()), strict=True)
            ]

    def _sum_rows(self, run: int, change: Array) -> _Sums:
        one, rows = self.problem.whiten(self.point, change), slice(*self._edges[run : run + 2])
        return _Sums(float(one @ self.rest[rows]), float(one @ one), self.kept[rows].T @ one)

    def _isolate_runs(self, runs: tuple[int, ...]) -> tuple[PredictionErrorProblem, RunNuisance]:
        """These runs, none finding warm what another heated, and how they begin."""
        if runs not in self._some:
            records = (replace(self.problem.records[run], memory_group=run) for run in runs)
            some = replace(self.problem, records=tuple(records))
            self._some[runs] = some, self.point.nuisance.select_runs(runs)
        return self._some[runs]

    @property
    def _edges(self) -> list[int]:
        """(runs + 1,) where each run begins among white innovations."""
        edges: list[int] = (2 * self.problem.run_edges).tolist()
        return edges

    @cached_property
    def _run_innovations(self) -> list[Array]:
        """A run -> (n, 2) innovations without it."""
        alone, nuisance = self._isolate_runs(tuple(range(len(self.problem.records))))
        model = self.point.structure.model(self.point.values)
        ahead = alone.predict_errors(model, nuisance, self.point.kalman_filter)
        return [ahead[slice(*rows)] for rows in pairwise(self.problem.run_edges.tolist())]
