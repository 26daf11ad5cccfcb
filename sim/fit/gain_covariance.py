"""Covariances of the fitted gains: sensor noise, model error, and variation between runs.

The standard error of a gain is the largest of those from the three causes. Sensor noise alone is
right for a correct model. The innovations of an incomplete model are correlated in time, which a
sandwich estimate over intervals allows for, and gains that differ from run to run are random
effects.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import append_prior_rows, invert_information
from sim.estimation.run_variation import compute_run_variation_covariance, find_interval_starts
from sim.fit.everyday_effects import add_absent_effects
from sim.fit.open_loop_fallback import OpenLoopReplay
from sim.fit.search import OPEN_LOOP

EXACT = 1e-5  # [1/s] q over the velocity variance; more shows that the model is incomplete
FORM = 0.05  # [share of a small effect] error of its formula on a robot
INTERVAL = 0.5  # [s] within which the innovations of an incomplete model are correlated


def compute_gain_covariances(
    problem: PredictionErrorProblem, point: Estimate, replay: OpenLoopReplay
) -> Iterator[tuple[Estimate, Array]]:
    """For each cause of error, an estimate and the (searched, searched) covariance from this cause.

    The causes are noise, together with undetected small effects, variation from run to run, and
    errors of the model.

    Args:
        problem: the measurements.
        point: the best estimate.
        replay: its open-loop replay.
    """
    extended, wide = problem, point
    if not problem.priors:
        extended, wide = add_absent_effects(problem, point)
    table, rest = append_prior_rows(extended, wide, fine=True)
    count = len(wide.structure.searched_names)
    known = extended.select_priors(wide.structure)
    weak = np.zeros(table.shape[1], dtype=bool)
    weak[:count] = [name in known for name in wide.structure.searched_names]
    noise, sensitivity = invert_information(table, weak=weak)
    yield wide, noise[:count, :count] + _form_covariance(wide, sensitivity[:count], weak[:count])
    yield wide, compute_run_variation_covariance(extended, wide, table, rest)
    incomplete = point.process_noise > EXACT * problem.noise.velocity**2
    if replay.has_misfit or incomplete:
        yield wide, _sandwich(extended, table, rest, noise)[:count, :count]
    if incomplete and not replay.has_misfit:
        del table, rest, noise  # large for a long log, and so are those that follow
        q = OPEN_LOOP * problem.noise.velocity**2
        left = extended.evaluate(wide.structure, wide.values, wide.nuisance, q)
        if not problem.priors:
            same = problem.evaluate(point.structure, point.values, point.nuisance, q)
            extended.extend_jacobian(left, problem.compute_jacobian(same, fine=True))
        table, rest = append_prior_rows(extended, left, fine=True)
        noise, _ = invert_information(table, weak=weak)
        yield left, _sandwich(extended, table, rest, noise)[:count, :count]


def _form_covariance(point: Estimate, sensitivity: Array, effects: NDArray[np.bool_]) -> Array:
    """(searched, searched) covariance from small effects whose formula is only approximate.

    Breakaway friction is not exactly exponential, and drag not exactly quadratic. Each fitted size
    has an error of ``FORM`` of itself, and the other parameters change with it.

    Args:
        point: the best estimate.
        sensitivity: (searched, effects) change of all parameters per change of each small effect.
        effects: (searched,) whether a parameter is that of a small effect.
    """
    values = np.array([point.values[name] for name in point.structure.searched_names])
    shift = FORM * values[effects] * sensitivity
    return np.asarray(shift @ shift.T)


def _sandwich(problem: PredictionErrorProblem, table: Array, rest: Array, bread: Array) -> Array:
    """(parameters, parameters) covariance with scores summed over ``INTERVAL``.

    Source: the sandwich of White (1980).
    """
    rows, parts = 2 * len(problem.measured), []
    for record, first in zip(problem.records, problem.run_edges, strict=False):
        parts.append(2 * (first + find_interval_starts(record.measurements.time, INTERVAL)))
    scores = np.add.reduceat(table[:rows].T * rest[:rows], np.concatenate(parts), axis=1)
    return np.asarray(bread @ (scores @ scores.T) @ bread)
