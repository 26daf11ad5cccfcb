"""A robot on slipping wheels: simulate a voltage step, and fit the grip of the tires to a log.

    wheels:  kA_w·v' = V - kS - kV·v - F        robot:  kA·v' = F

with F the traction. Traction and voltage are given as speeds [m/s]: those at which they would end.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

LIGHT = 0.1  # [share of kA] inertia of wheels and rotors
SIZE = (0.7, 1.4)  # [1] limits of the top speed over that predicted from the rest of the log
SCALES = np.geomspace(0.4, 2.5, 12)  # [times the time constant] that are tried
DELAYS = np.arange(0.0, 0.045, 0.01)  # [s] between voltage and motion that are tried
LIMITS = (1.0, 0.8, 0.6, 0.45, 0.3)  # [share of the step] of current limits that are tried
SAMPLES = 60  # samples of a rise that are simulated, at least


@dataclass(frozen=True, eq=False)
class SpunWheels:
    """Simulated speeds of spinning wheels, for several tires at once.

    Args:
        speed: (k, n) [m/s or rad/s] speed of the wheels.
        push: (k, n) [m/s or rad/s] steady-state speed of each voltage.
        loose: (k, n) whether the wheels slip.
    """

    speed: Array
    push: Array
    loose: NDArray[np.bool_]


def spin_wheels(
    push: Array, since: Array, *, scales: Array, held: Array, limit: float = math.inf
) -> SpunWheels:
    """Simulate the speed of wheels after a voltage step, by exact steps of a first-order lag.

    Args:
        push: (n,) [m/s or rad/s] steady-state speed of each voltage.
        since: (n,) [s] time since the step.
        scales: (k,) [s] time constants.
        held: (k,) [m/s or rad/s] largest ``push`` above the speed that the tires transmit.
        limit: [m/s or rad/s] largest ``push`` above the speed under a current limit.
    """
    wheel, robot = np.zeros(scales.size), np.zeros(scales.size)
    loose = min(push[0], limit) > held
    limited = np.minimum(np.full(scales.size, push[0]), limit)
    speeds, pushes, slips = [wheel], [limited], [loose]
    for step, target in zip(np.diff(since).tolist(), push.tolist(), strict=False):
        limited = np.minimum(target, wheel + limit)
        toward = np.where(loose, limited - held, limited)
        keep = np.exp(-step / np.where(loose, LIGHT * scales, scales))
        wheel = toward + (wheel - toward) * keep
        robot = np.where(loose, robot + held * step / scales, wheel)
        caught = loose & (robot >= wheel)
        wheel = np.where(caught, robot, wheel)
        loose = (loose & ~caught) | (~loose & (limited - wheel > held))
        speeds.append(wheel)
        pushes.append(limited)
        slips.append(loose)
    return SpunWheels(np.stack(speeds, axis=1), np.stack(pushes, axis=1), np.stack(slips, axis=1))


@dataclass(frozen=True, eq=False)
class StepRise:
    """The rise of the velocity at the start of a dynamic test.

    Args:
        speed: (n,) [m/s or rad/s] measured speed.
        since: (n,) [s] since the voltage step.
        push: (n,) [m/s or rad/s] steady-state speed of each voltage.
        scale: [s] approximate time constant of the mechanism.
    """

    speed: Array
    since: Array
    push: Array
    scale: float

    def fit(self, held: Array) -> tuple[float, float, float]:
        """Fit the grip of the tires.

        Args:
            held: (m,) [share of the largest ``push``] grips to try.

        Returns:
            Least RMS error [m/s or rad/s], its grip, and the time [s] at which the slip ends.
        """
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
        errors = self._rms_errors(spun.speed[:, ::fine])
        best = int(np.argmin(errors))
        loose = np.flatnonzero(spun.loose[best])
        grips = float(since[loose[-1]]) if loose.size else 0.0
        return float(errors[best]), float(tires[best]), grips

    def fit_limited(self) -> float:
        """Least RMS error of a current-limited rise, for a log of the commanded voltage."""
        scale, share = (
            grid.ravel()[:, None]
            for grid in np.meshgrid(SCALES * self.scale, LIMITS, indexing="ij")
        )
        until = scale * (1.0 - share) / share
        later = 1.0 - share * np.exp(-(self.since - until) / scale)
        rise = np.where(self.since < until, share * self.since / scale, later)
        return float(np.min(self._rms_errors(rise * float(self.push.max()))))

    def _rms_errors(self, shapes: Array) -> Array:
        """(k,) RMS error [m/s or rad/s] of each shape (k, n), at its best size and delay."""
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
