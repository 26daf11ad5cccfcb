"""A robot on slipping wheels: how a step spins them up, and which tires follow a log best.

    wheels:  kA_w·v' = V - kS - kV·v - F        robot:  kA·v' = F

with F what the tires hold, as a speed: the part of the push, in m/s, that they turn into motion.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

LIGHT = 0.1  # [share of kA] that is the wheels' and rotors' own
SIZE = (0.7, 1.4)  # [1] top speed over what the rest of the log promises, in a sound log
SCALES = np.geomspace(0.4, 2.5, 12)  # [times the timescale] that are tried
DELAYS = np.arange(0.0, 0.045, 0.01)  # [s] between voltage and motion that are tried
LIMITS = (1.0, 0.8, 0.6, 0.45, 0.3)  # [share of the step] that current limits let through
SAMPLES = 60  # of a rise that are looked at; more tell no more


@dataclass(frozen=True, eq=False)
class SpunWheels:
    """Speeds of wheels that spin up, for several tires at once.

    Args:
        speed: (k, n) [m/s or rad/s] of the wheels.
        push: (k, n) [m/s or rad/s] the speed at which each voltage would end.
        loose: (k, n) whether they slip.
    """

    speed: Array
    push: Array
    loose: NDArray[np.bool_]


def spin_wheels(
    push: Array, since: Array, *, scales: Array, held: Array, limit: float = math.inf
) -> SpunWheels:
    """Simulate the speed of wheels after a voltage step, by exact steps of a first-order lag.

    Args:
        push: (n,) [m/s or rad/s] the speed at which each voltage would end.
        since: (n,) [s] time since the step.
        scales: (k,) [s] timescales.
        held: (k,) [m/s or rad/s] largest part of ``push`` that the tires hold without slip.
        limit: [m/s or rad/s] of ``push`` above the speed, where the current is limited.
    """
    wheel, robot = np.zeros(scales.size), np.zeros(scales.size)
    loose = min(push[0], limit) > held
    wants = np.minimum(np.full(scales.size, push[0]), limit)
    speeds, pushes, slips = [wheel], [wants], [loose]
    for step, want in zip(np.diff(since).tolist(), push.tolist(), strict=False):
        wants = np.minimum(want, wheel + limit)
        toward = np.where(loose, wants - held, wants)
        keep = np.exp(-step / np.where(loose, LIGHT * scales, scales))
        wheel = toward + (wheel - toward) * keep
        robot = np.where(loose, robot + held * step / scales, wheel)
        caught = loose & (robot >= wheel)
        wheel = np.where(caught, robot, wheel)
        loose = (loose & ~caught) | (~loose & (wants - wheel > held))
        speeds.append(wheel)
        pushes.append(wants)
        slips.append(loose)
    return SpunWheels(np.stack(speeds, axis=1), np.stack(pushes, axis=1), np.stack(slips, axis=1))


@dataclass(frozen=True, eq=False)
class StepRise:
    """The rise of the velocity at the start of a dynamic test.

    Args:
        speed: (n,) [m/s or rad/s].
        since: (n,) [s] since the voltage came on.
        push: (n,) [m/s or rad/s] the speed at which each voltage would end.
        scale: [s] the mechanism's timescale, about.
    """

    speed: Array
    since: Array
    push: Array
    scale: float

    def fit(self, held: Array) -> tuple[float, float, float]:
        """Least RMS error [m/s or rad/s], its tire parameter, and the time of grip [s]."""
        scales, tires = (
            grid.ravel() for grid in np.meshgrid(SCALES * self.scale, held, indexing="ij")
        )
        fine = max(1, SAMPLES // self.since.size)
        at = np.arange(0.0, self.since.size - 1 + 0.5 / fine, 1.0 / fine)
        since = np.interp(at, np.arange(self.since.size), self.since)
        spun = spin_wheels(
            self.push[np.minimum(at.astype(int), self.push.size - 1)],
            since,
            scales=scales,
            held=tires * float(self.push.max()),
        )
        misses = self._misses(spun.speed[:, ::fine])
        best = int(np.argmin(misses))
        loose = np.flatnonzero(spun.loose[best])
        grips = float(since[loose[-1]]) if loose.size else 0.0
        return float(misses[best]), float(tires[best]), grips

    def fit_limited(self) -> float:
        """Least RMS error of a current-limited rise, for a log of the commanded voltage."""
        scale, share = (
            grid.ravel()[:, None]
            for grid in np.meshgrid(SCALES * self.scale, LIMITS, indexing="ij")
        )
        until = scale * (1.0 - share) / share
        later = 1.0 - share * np.exp(-(self.since - until) / scale)
        rise = np.where(self.since < until, share * self.since / scale, later)
        return float(np.min(self._misses(rise * float(self.push.max()))))

    def _misses(self, shapes: Array) -> Array:
        """(k,) the miss of each shape (k, n), at its best size and delay."""
        period = float(np.median(np.diff(self.since)))
        least = np.full(len(shapes), np.inf)
        for late in sorted({round(delay / period) for delay in DELAYS.tolist()}):
            if late >= shapes.shape[1]:
                continue
            moved = np.zeros_like(shapes)
            moved[:, late:] = shapes[:, : shapes.shape[1] - late]
            norms = np.maximum(np.sum(moved**2, axis=1), 1e-300)
            size = np.clip(moved @ self.speed / norms, *SIZE)
            left = self.speed - size[:, None] * moved
            least = np.minimum(least, np.sqrt(np.mean(left**2, axis=1)))
        return least
