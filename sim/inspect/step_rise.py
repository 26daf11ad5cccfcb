"""The rise after a voltage step: free, under a current limit, or with wheels that slip.

    wheels:  kA_w·v' = min(V - kS - kV·v, L) - F        robot:  kA·v' = F

with L the limit and F the traction. Without slip, the wheels have the speed of the robot. Voltages,
limit and traction are given as speeds: those at which they would end.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Run
from sim.inspect.baseline_model import BaselineModel
from sim.inspect.launch import find_step_start
from sim.inspect.log_features import find_held_samples

LIGHT = 0.1  # [share of kA] inertia of wheels and rotors
STEPS = 120  # of the simulation
SCALES, SLOWEST = 32, 2.5  # time constants that are tried; the longest [times the usual one]
DELAYS = 25  # between voltage and motion that are tried
LATEST = 0.08  # [s] the longest of them
SIZE = (0.7, 1.4)  # [1] limits of the top speed over that predicted from the rest of the log
WIDE, LONGEST = 6.0, 3.0  # [time constants, s] length of a rise,
LEAST = 15  # [samples] at least
SAMPLES = 60  # [samples] of a rise that are used
FEWEST = 8  # [samples] of a rise that is fitted
STALE = 2  # [samples] median length of a repeated reading in a log of slow frames
ALL, NEVER = np.ones(1), np.full(1, np.inf)
FINER = (1.0, 0.5, 0.2, 0.07)  # [share of the coarse grid's cells] the finer grids
CELLS = np.linspace(-1.0, 1.0, 9)  # of a finer grid, around the best point so far


class Spin(NamedTuple):
    """Simulated wheels, for several mechanisms at once.

    Args:
        speed: (k, n) [m/s or rad/s] speed of the wheels.
        push: (k, n) [m/s or rad/s] steady-state speed of each voltage.
        loose: (k, n) whether the wheels slip.
    """

    speed: Array
    push: Array
    loose: NDArray[np.bool_]


def simulate_wheels(
    push: Array, time: Array, *, scales: Array, grips: Array, limits: Array
) -> Spin:
    """Simulate the speed of wheels after a voltage step, by exact steps of a first-order lag.

    Args:
        push: (n,) [m/s or rad/s] steady-state speed of each voltage.
        time: (n,) [s].
        scales: (k,) [s] time constants.
        grips: (k,) [m/s or rad/s] largest ``push`` above the speed that the tires transmit.
        limits: (k,) [m/s or rad/s] largest ``push`` above the speed under a current limit.
    """
    wheel, robot = np.zeros(scales.size), np.zeros(scales.size)
    traction = np.where(np.isfinite(grips), grips, 0.0)
    asked = np.minimum(push[0], limits)
    loose = asked > grips
    speeds, pushes, slips = [wheel], [asked], [loose]
    for step, target in zip(np.diff(time).tolist(), push.tolist(), strict=False):
        asked = np.minimum(target, wheel + limits)
        share = step / np.where(loose, LIGHT * scales, scales)
        held = np.where(loose, traction, 0.0)
        free = target - held + (wheel - target + held) * np.exp(-share)
        wheel = np.minimum(free, wheel + (limits - held) * share)
        robot = np.where(loose, robot + traction * step / scales, wheel)
        caught = loose & (robot >= wheel)
        wheel = np.where(caught, robot, wheel)
        loose = (loose & ~caught) | (~loose & (asked - wheel > grips))
        speeds.append(wheel)
        pushes.append(asked)
        slips.append(loose)
    return Spin(np.stack(speeds, axis=1), np.stack(pushes, axis=1), np.stack(slips, axis=1))


@dataclass(frozen=True)
class FittedRise:
    """A simulated rise that is nearest to a measured one.

    Args:
        error: RMS error, in the unit of the measured signal.
        scale: [s] time constant.
        share: [share of the step] limit of grip or current; 1 if there is none.
        delay: [s] between voltage and motion.
        size: [1] its speed over that predicted from the rest of the log.
    """

    error: float
    scale: float = 1.0
    share: float = 1.0
    delay: float = 0.0
    size: float = 1.0


@dataclass(frozen=True, eq=False)
class StepRise:
    """The start of a step test, to which simulated rises are fitted.

    Args:
        time: (n,) [s] since the voltage step.
        signal: (n,) the measured speed, or the measured distance.
        push: (``STEPS``,) [m/s or rad/s] steady-state speed in the step's direction, at even times.
        scale: [s] approximate time constant of the mechanism.
        period: [s] usual time between samples of the log.
        summed: whether the signal is the distance, from an unknown start.
    """

    time: Array
    signal: Array
    push: Array
    scale: float
    period: float
    summed: bool = False

    @property
    def step(self) -> float:
        """[m/s or rad/s] the largest steady-state speed."""
        return float(self.push.max())

    def fit(
        self, limited_by: str = "", shares: Array = ALL, *, fastest: float = 0.15
    ) -> FittedRise:
        """The nearest rise, searched on a coarse grid and then on finer ones.

        Args:
            limited_by: ``grip``, ``current``, or empty for a free rise.
            shares: [share of the step] limits to try.
            fastest: [times the time constant] shortest time constant to try.
        """
        delays, cell = np.linspace(-self.period, LATEST, DELAYS, retstep=True)
        scales = self.scale * np.geomspace(fastest, SLOWEST, SCALES)
        best = self._search(limited_by, scales, shares, delays)
        for narrow in FINER:
            scales = best.scale * (1.0 + 0.2 * narrow) ** CELLS
            scales = np.maximum(scales, fastest * self.scale)
            if limited_by:
                shares = np.clip(best.share + 0.15 * narrow * CELLS, 0.05, 1.0)
            delays = np.maximum(best.delay + 2.0 * cell * narrow * CELLS, -self.period)
            better = self._search(limited_by, scales, shares, delays)
            best = min(best, better, key=lambda one: one.error)
        return best

    def find_slip_end(self, rise: FittedRise) -> float:
        """[s] time since the step at which the wheels of a rise limited by grip stop to slip."""
        fine, spin = self._simulate("grip", np.array([rise.scale]), np.array([rise.share]))
        loose = np.flatnonzero(spin.loose[0])
        return float(fine[loose[-1]]) if loose.size else 0.0

    def _simulate(self, limited_by: str, scales: Array, shares: Array) -> tuple[Array, Spin]:
        """The times of a simulation [s], and the wheels at each time constant and limit."""
        fine = np.linspace(0.0, float(self.time[-1]), STEPS)
        limits = {"grip": NEVER, "current": NEVER} | {limited_by: shares * self.step}
        return fine, simulate_wheels(
            self.push,
            fine,
            scales=scales,
            grips=np.broadcast_to(limits["grip"], scales.shape),
            limits=np.broadcast_to(limits["current"], scales.shape),
        )

    def _search(self, limited_by: str, scales: Array, shares: Array, delays: Array) -> FittedRise:
        """The nearest rise on a grid of time constants, limits and delays."""
        scale, share = (grid.ravel() for grid in np.meshgrid(scales, shares, indexing="ij"))
        fine, spin = self._simulate(limited_by, scale, share)
        step, shapes, signal = fine[1], spin.speed.T, self.signal
        if self.summed:
            shapes = np.cumsum(step * shapes, axis=0) - 0.5 * step * shapes
            signal = signal - signal.mean()
        best = FittedRise(np.inf)
        for delay in delays.tolist():
            at = np.clip((self.time - delay) / step, 0.0, STEPS - 1.001)
            low = at.astype(int)
            moved = shapes[low] + (at - low)[:, None] * (shapes[low + 1] - shapes[low])
            if self.summed:
                moved -= moved.mean(axis=0)
            product, norm = signal @ moved, np.einsum("ij,ij->j", moved, moved)
            size = product / np.maximum(norm, 1e-300)
            size = size if self.summed else np.clip(size, *SIZE)
            errors = np.maximum(signal @ signal - 2.0 * size * product + size**2 * norm, 0.0)
            i = int(np.argmin(errors))
            error = float(np.sqrt(errors[i] / signal.size))
            if error < best.error:
                best = FittedRise(error, float(scale[i]), float(share[i]), delay, float(size[i]))
        return best


def find_rise(
    run: Run, baseline: BaselineModel, *, period: float, summed: bool = False
) -> StepRise | None:
    """The rise at the start of a step test; None if it has too few samples.

    Of slow frames, only new readings count.

    Args:
        run: the test.
        baseline: the baseline model of its log.
        period: [s] usual time between samples.
        summed: whether to take the distance, which no filter delays, instead of the speed.
    """
    first = find_step_start(run)
    lasts = max(min(WIDE * baseline.timescale, LONGEST), LEAST * period)
    end = int(np.searchsorted(run.time, run.time[first] + lasts, side="right"))
    if end - first < FEWEST:
        return None
    starts, lengths = find_held_samples(run.velocity[first:end])
    if float(np.median(lengths)) < STALE:
        starts = np.arange(end - first)
    part = first + starts[:: max(1, starts.size // SAMPLES)]
    way = float(np.sign(run.voltage[first]))
    fine = np.linspace(run.time[first], run.time[part[-1]], STEPS)
    voltage, position = (np.interp(fine, run.time, one) for one in (run.voltage, run.position))
    push = way * baseline.compute_steady_speed(voltage, position)
    if part.size < FEWEST or not push.max() > 0.0:
        return None
    signal = way * run.position[part] if summed else np.abs(run.velocity[part])
    time = run.time[part] - run.time[first]
    return StepRise(time, signal, push, baseline.timescale, period, summed)
