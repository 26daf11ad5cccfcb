"""Innovations of a fitted model: each reading minus its prediction from the readings before it.

A replay (``replay.py``) is an open-loop simulation, so one slip shifts everything after it. The
Kalman filter corrects the state with each reading, so a large innovation is at the time of its
cause. The innovations of a correct model are white (Ljung, *System Identification*, section 16.6).
"""

import math
from dataclasses import dataclass

from sim.core.log import Array, Log
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import tune_process_noise
from sim.fit import Fit
from sim.fit.replay import measure_as_fitted
from sim.fit.search import TRACKING, make_fit_problem


@dataclass(frozen=True, eq=False)
class RunInnovations:
    """Innovations of one run, at the readings that were compared.

    Args:
        position_time: (m,) [s] times of the position readings, as in the log.
        position: (m,) [m or rad] innovations of the position.
        velocity_time: (n,) [s] times of the velocity readings.
        velocity: (n,) [m/s or rad/s] innovations of the velocity.
    """

    position_time: Array
    position: Array
    velocity_time: Array
    velocity: Array


def compute_innovations(found: Fit, log: Log) -> tuple[RunInnovations, ...]:
    """The innovations of a fit's model on every run that is long enough.

    The process noise is the likeliest for these gains, as in the fit. A reading that only repeats
    the one before it has no innovation.

    Args:
        found: the fit, in any unit.
        log: the fitted log, or any other of the same mechanism.

    Raises:
        BadRequest: one measures a length, the other an angle, or kV or kA is not positive.
    """
    model, log, measured = measure_as_fitted(found, log)
    problem = make_fit_problem(log, measured)
    structure, values = ModelStructure.split_model(model)
    noise = TRACKING * problem.noise.velocity**2
    point = problem.evaluate(structure, values, problem.initial_nuisance, noise)
    if math.isfinite(point.cost):
        point = tune_process_noise(problem, point)
    if not point.innovations.size:
        return ()
    compared = ~problem.ignored_readings
    innovations = []
    for record, rows in zip(problem.records, problem.run_slices, strict=True):
        time, errors = record.measurements.time, point.innovations[rows]
        x, v = compared[rows].T
        innovations.append(RunInnovations(time[x], errors[x, 0], time[v], errors[v, 1]))
    return tuple(innovations)
