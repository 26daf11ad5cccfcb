"""Simulate a fit's gains under each run's voltage and compare with the measurement.

The simulation is open loop and starts with each run. It includes the lag and the averaging of the
velocity that the fit found, so the residual is noise and what the gains do not explain.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sim.core.errors import BadRequest
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.estimation.measurements import (
    MIN_SAMPLES,
    RunMeasurements,
    compute_noise_at_speed,
    estimate_noise,
    measure_runs,
)
from sim.fit import Fit
from sim.fit.result import multiply_gains
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model, Part

LEAST_LAG = 1e-5  # [s] a shorter lag is left out


@dataclass(frozen=True, eq=False)
class RunReplay:
    """One run, measured and simulated.

    Args:
        run: the run, from the first sample that a fit uses.
        position: (n,) [m or rad] simulated position.
        velocity: (n,) [m/s or rad/s] simulated velocity, as the sensor would report it.
        moving: (n,) whether the mechanism moves.
        velocity_noise: [m/s or rad/s] standard deviation of one sample.
    """

    run: Run
    position: Array
    velocity: Array
    moving: NDArray[np.bool_]
    velocity_noise: float

    @property
    def position_error(self) -> Array:
        """(n,) [m or rad] measured minus simulated position."""
        return self.run.position - self.position

    @property
    def velocity_error(self) -> Array:
        """(n,) [m/s or rad/s] measured minus simulated velocity."""
        return self.run.velocity - self.velocity


def replay_fit(found: Fit, log: Log) -> tuple[RunReplay, ...]:
    """Simulate every run of a log with a fit's gains.

    Args:
        found: the fit, in any unit.
        log: the fitted log, or any other of the same mechanism.

    Raises:
        BadRequest: one measures a length, the other an angle, or kV or kA is not positive.
    """
    model, _, measured = measure_as_fitted(found, log)
    if not measured:
        return ()
    tracks = [
        simulate_run(
            model, time=part.time, voltage=part.voltage,
            state=State.cold_at(part.position, part.velocity),
        )
        for part in measured
    ]  # fmt: skip
    runs = [run for run in log.runs if len(run) >= MIN_SAMPLES]
    noise = estimate_noise(measured)
    velocity_noise = max(compute_noise_at_speed(measured, noise), noise.velocity)
    return tuple(
        RunReplay(
            run.select(slice(len(run) - part.time.size, None)),
            track.position,
            track.seen,
            part.moving,
            velocity_noise,
        )
        for run, part, track in zip(runs, measured, tracks, strict=True)
    )


def measure_as_fitted(found: Fit, log: Log) -> tuple[Model, Log, tuple[RunMeasurements, ...]]:
    """The model of a fit, the long runs with voltages that drive forward, their measurements.

    Raises:
        BadRequest: one measures a length, the other an angle, or kV or kA is not positive.
    """
    fitted = found.in_units("radians" if find_unit(log.units).angular else "meters")
    sign, model = make_fit_model(fitted)
    long = (run for run in log.runs if len(run) >= MIN_SAMPLES)
    log = replace(log, runs=tuple(replace(run, voltage=sign * run.voltage) for run in long))
    friction = None if fitted.type == "simple" else model.gains["kS"]
    return model, log, measure_runs(log, friction=friction)


def make_fit_model(found: Fit) -> tuple[float, Model]:
    """Sign of the voltage that drives forward, and the model of a fit.

    Raises:
        BadRequest: kV or kA is not positive, or only one of them is negative.
    """
    sign = -1.0 if found.gains["kV"] < 0.0 and found.gains["kA"] < 0.0 else 1.0
    gains = multiply_gains(found.gains, sign)
    gains["kS"] = max(gains["kS"], 0.0)  # no negative friction
    if not (gains["kV"] > 0.0 and gains["kA"] > 0.0):
        raise BadRequest(
            f"nothing can be simulated with kV = {found.gains['kV']:.3g}, "
            f"kA = {found.gains['kA']:.3g}",
            advice="First find out why a gain is negative.",
        )
    return sign, Model(found.type, gains, (*_list_sensor_lags(found), *found.parts))


SENSOR_LAGS = frozenset({"velocity-filter", "delay"})  # effects that every fit estimates


def _list_sensor_lags(found: Fit) -> list[Part]:
    """The lag and the averaging of the velocity that an output-error fit found."""
    if found.method != "output-error":
        return []
    window = 2.0 * (found.velocity_delay - found.position_delay)
    sizes = {
        "velocity-filter": ("window", window),
        "delay": ("lag", found.position_delay),
    }
    return [
        Part(effect, {name: size}) for effect, (name, size) in sizes.items() if size > LEAST_LAG
    ]
