"""The search of method output-error: gains whose innovations are as small as noise allows.

    -2 log L = N·log det Σ        Σ the covariance (2, 2) of the innovations

Levenberg and Marquardt's steps on innovations made white by Σ, in turn with a line search for the
size q of what pushes at random. Derivatives are differences of simulations.
"""

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from sim.engine import NO_TRUST
from sim.fit.innovations import innovations, model_of, trust_for
from sim.fit.seen import Noise, Seen
from sim.log import Array
from sim.model import Model

ANEW = 1.0  # [1/s] q over the variance of a velocity: what pushes moves it by its noise in a second
COARSE, FINE = 100.0, 4.0  # [1] steps of q
ROBUST = 1.4826  # standard deviations in a median absolute deviation
STRAY = 6.0  # [standard deviations] farther than this no noise goes
STARTS = 0.1  # [s] of a motion in which nothing is left out
AROUND_STRAY = 2  # samples on both sides of one that strays
LARGE = 10_000  # [samples] from which runs are simulated side by side
FARTHEST = 8  # steps of q in one round
STEPS = 8  # of the gains in one round
NUDGE = 1e-4  # [of a gain's own size] by which it is moved for a derivative
LEAST = {"kS": 0.02, "kG": 0.05, "level": 0.05, "upright": 0.05, "window": 0.004, "lag": 0.004}
FLOOR = {"kS": 0.0, "window": 0.0, "lag": 0.0}
CEILING = {"window": 0.9, "lag": 0.45}  # [s] later than this nothing on a robot answers
POSITIVE = ("kV", "kA")
HARDLY = 1e-11  # [1] of a combination of values that the log says anything about


@dataclass(frozen=True, eq=False)
class Point:
    """Where a search stands.

    Args:
        values: name -> value.
        starts: (runs,) [unit] true position at a run's first sample, less the one seen there.
        q: size of what pushes at random.
        trust: (2, 2) by how much a measurement corrects, which follows from values and q.
        ahead: (n, 2) innovations.
        cost: -2 log L, up to a constant.
    """

    values: Mapping[str, float]
    starts: Array
    q: float
    trust: Array
    ahead: Array
    cost: float


@dataclass(frozen=True, eq=False)
class Problem:
    """What is searched: measurements, and how they are compared.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        seen: the runs.
        noise: of the measurements, measured without a model.
        period: [s] between samples.
    """

    type: str
    seen: tuple[Seen, ...]
    noise: Noise
    period: float

    def at(self, values: Mapping[str, float], starts: Array, q: float) -> Point:
        """The point of these values; its cost is infinite where they are no physics."""
        if any(not values[name] > 0.0 for name in POSITIVE):
            return Point(values, starts, q, NO_TRUST, np.empty((0, 2)), math.inf)
        model = model_of(self.type, values)
        trust = trust_for(model, noise=self.noise, q=q, period=self.period)
        ahead = self._ahead(model, starts, trust)
        return Point(values, starts, q, trust, ahead, self.cost(ahead))

    def _ahead(self, model: Model, starts: Array, trust: Array) -> Array:
        """(n, 2) the innovations of every run, one after another."""

        def one(run: Seen, start: float) -> Array:
            return innovations(model, run, start=start, trust=trust)

        if sum(run.time.size for run in self.seen) > LARGE:  # compiled code runs beside other
            return np.concatenate(list(_threads().map(one, self.seen, starts.tolist())))
        return np.concatenate(list(map(one, self.seen, starts.tolist())))

    def without_strays(self, point: Point) -> "Problem":
        """The same without the samples that no noise explains, and those around them.

        A stop that was hit, a tooth that slipped, a voltage that was not applied: one such moment
        may weigh more than all the rest. Their measurements still keep the simulation on course.
        """
        size = ROBUST * np.nanmedian(np.abs(point.ahead), axis=0)
        strays = np.abs(point.ahead) > STRAY * np.maximum(size, self.noise.grain)
        far = strays[:, 0] | strays[:, 1]
        kept, first = [], 0
        for run in self.seen:
            mine = far[first : first + run.time.size].copy()
            first += run.time.size
            # a start is what shows inertia: there a stray is more likely the model's
            begins = run.time[int(np.argmax(run.moving))]
            mine[run.time < begins + STARTS] = False
            wide = np.convolve(mine, np.ones(2 * AROUND_STRAY + 1), mode="same") > 0.0
            kept.append(replace(run, telling=run.telling & ~wide[: run.time.size]))
        return replace(self, seen=tuple(kept))

    def columns(self, point: Point, *, fine: bool = False) -> Array:
        """(2 n, values + runs) by how much the white innovations change with values and starts.

        Args:
            point: where.
            fine: from both sides, so that values that do the same are seen to do the same.
        """
        by_value = (self._by_value(point, name, fine=fine) for name in point.values)
        parts = [*by_value, *self._by_start(point)]
        return np.column_stack([white(self, point, part) for part in parts])

    def _by_value(self, point: Point, name: str, *, fine: bool) -> Array:
        value = point.values[name]
        step = NUDGE * max(abs(value), LEAST.get(name, 0.0))
        model = model_of(self.type, {**point.values, name: value + step})
        more = self._ahead(model, point.starts, point.trust)
        if not fine or value - step < FLOOR.get(name, -math.inf):
            return np.asarray((more - point.ahead) / step)
        model = model_of(self.type, {**point.values, name: value - step})
        return np.asarray((more - self._ahead(model, point.starts, point.trust)) / (2.0 * step))

    def _by_start(self, point: Point) -> Iterator[Array]:
        model = model_of(self.type, point.values)
        first, step = 0, self.noise.position
        for run, start in zip(self.seen, point.starts.tolist(), strict=True):
            last = first + run.time.size
            moved = innovations(model, run, start=start + step, trust=point.trust)
            part = np.zeros_like(point.ahead)
            part[first:last] = (moved - point.ahead[first:last]) / step
            yield part
            first = last

    def cost(self, ahead: Array) -> float:
        """-2 log L of innovations, up to a constant: of each sample what was measured there."""
        spread, count = self._spread(ahead)
        size = float(spread[0, 0] * spread[1, 1] - spread[0, 1] ** 2)
        return count * math.log(size) if size > 0.0 and math.isfinite(size) else math.inf

    def spread(self, ahead: Array) -> Array:
        """(2, 2) covariance of the innovations, never quite nothing."""
        return self._spread(ahead)[0]

    def _spread(self, ahead: Array) -> tuple[Array, int]:
        """The covariance, and how many samples were measured at all."""
        there = ~np.isnan(ahead)
        first, second = there[:, 0], there[:, 1]
        x, v = np.where(first, ahead[:, 0], 0.0), np.where(second, ahead[:, 1], 0.0)
        both = max(int(np.count_nonzero(first & second)), 1)
        xx = float(x @ x) / max(int(np.count_nonzero(first)), 1)
        vv = float(v @ v) / max(int(np.count_nonzero(second)), 1)
        most = 0.99 * math.sqrt(xx * vv)
        xv = min(max(float(x @ v) / both, -most), most)
        spread = np.array([[xx, xv], [xv, vv]])
        return spread + np.diag(np.square(self.noise.grain)), int(np.count_nonzero(first | second))


@cache
def _threads() -> ThreadPoolExecutor:
    """As many as there are cores, for logs that are worth it."""
    return ThreadPoolExecutor(os.cpu_count(), thread_name_prefix="fit")


def near(problem: Problem, values: Mapping[str, float]) -> Point:
    """The best point from a first guess, if each second may go its own way by as much as noise.

    There the search looks only a little ahead at a time, and is not easily led astray.
    """
    q = ANEW * problem.noise.velocity**2
    point = problem.at(values, np.zeros(len(problem.seen)), q)
    return _better(problem, point, steps=STEPS, enough=5.0)


def far(problem: Problem, point: Point) -> Point:
    """The best point, from a near one: less and less is pardoned, as long as that is likelier."""
    for _ in range(FARTHEST):
        other = problem.at(point.values, point.starts, point.q / COARSE)
        other = _better(problem, other, steps=1, enough=1.0)
        if not other.cost < point.cost - 0.5:
            break
        point = other
    return _finished(problem, point)


def promise(problem: Problem, point: Point, more: Sequence[Mapping[str, float]]) -> Array:
    """(more,) [of -2 log L] what other values may gain once the point's own have adjusted to them.

    Args:
        problem: what is searched.
        point: a best point.
        more: values to add, one set after another.
    """
    kept, _ = np.linalg.qr(problem.columns(point))

    def left(ahead: Array) -> float:
        rest = white(problem, point, ahead)
        return float(rest @ rest - np.sum((kept.T @ rest) ** 2))

    now = left(point.ahead)
    tried = (problem.at({**point.values, **one}, point.starts, point.q) for one in more)
    return np.array([now - left(other.ahead) for other in tried])


def _finished(problem: Problem, point: Point) -> Point:
    """The best point near one: q to a factor of ``FINE``, then the values."""
    for way in (FINE, 1.0 / FINE):
        other = problem.at(point.values, point.starts, point.q * way)
        while other.cost < point.cost - 0.1:
            point = other
            other = problem.at(point.values, point.starts, point.q * way)
    return _better(problem, point, steps=STEPS, enough=0.05)


def white(problem: Problem, point: Point, table: Array) -> Array:
    """(2 n,) positions and velocities, made independent and of size one by the spread."""
    inverse = np.linalg.inv(np.linalg.cholesky(problem.spread(point.ahead)))
    return np.asarray((np.nan_to_num(table) @ inverse.T).ravel())


def covariance(problem: Problem, point: Point) -> Array:
    """(values, values) of the values, whatever the starts."""
    columns = problem.columns(point, fine=True)
    square = columns.T @ columns
    size = np.sqrt(np.maximum(np.diag(square), 1e-100))
    told, ways = np.linalg.eigh(square / np.outer(size, size))
    # what nothing tells apart has an error without end, not none
    inverse = (ways / np.maximum(told, HARDLY)) @ ways.T / np.outer(size, size)
    count = len(point.values)
    return np.asarray(inverse[:count, :count])


def _better(problem: Problem, point: Point, *, steps: int, enough: float) -> Point:
    """The point after some steps of the values, fewer when one gains hardly anything."""
    names = list(point.values)
    damping = 1e-4
    for _ in range(steps):
        table, rest = problem.columns(point), white(problem, point, point.ahead)
        size = np.linalg.norm(table, axis=0)
        size[size == 0.0] = 1.0
        table = table / size
        square, slope = table.T @ table, table.T @ rest
        better = point
        for _ in range(6):
            move = -np.linalg.solve(square + damping * np.eye(slope.size), slope) / size
            values = _stepped(point.values, move)
            moved = problem.at(values, point.starts + move[len(names) :], point.q)
            if moved.cost < point.cost:
                better, damping = moved, max(damping / 10.0, 1e-9)
                break
            damping *= 10.0
        gained, point = point.cost - better.cost, better
        if not gained > enough:
            break
    return point


def _stepped(values: Mapping[str, float], move: Array) -> dict[str, float]:
    """The values after a step, kept where they are physics."""
    after = {}
    for (name, value), by in zip(values.items(), move.tolist(), strict=False):
        if name in POSITIVE:  # at most a factor of three at once
            after[name] = value * min(max(1.0 + by / value, 1.0 / 3.0), 3.0)
        else:
            low, high = FLOOR.get(name, -math.inf), CEILING.get(name, math.inf)
            after[name] = min(max(value + by, low), high)
    return after
