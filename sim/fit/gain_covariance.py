"""Covariances of the fitted gains: sensor noise, errors that last, and variation between runs.

The error of a gain is the largest that one of these gives. Noise alone is right for a model that
holds. What a model lacks errs one way for a while, which a sandwich estimate over intervals allows
for, and differs from run to run, which random effects do.
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

EXACT = 1e-5  # [1/s] q over a velocity's variance that noise never asks for: more, and errors last
FORM = 0.05  # [of a small effect] by which its formula is wrong on a robot
TOGETHER = 0.5  # [s] for which what is missing errs one way


def compute_gain_covariances(
    problem: PredictionErrorProblem, point: Estimate, followed: OpenLoopReplay
) -> Iterator[tuple[Estimate, Array]]:
    """For each cause of error, an estimate and the (searched, searched) covariance by this cause.

    The causes are noise with effects too small to see, variation from run to run, and what the
    model lacks.

    Args:
        problem: what was searched.
        point: the best estimate.
        followed: how it follows.
    """
    extended, wide = problem, point
    if not problem.priors:
        extended, wide = add_absent_effects(problem, point)
    table, rest = append_prior_rows(extended, wide, fine=True)
    count = len(wide.structure.searched_names)
    known = extended.select_priors(wide.structure)
    weak = np.zeros(table.shape[1], dtype=bool)
    weak[:count] = [name in known for name in wide.structure.searched_names]
    noise, together = invert_information(table, weak=weak)
    yield wide, noise[:count, :count] + _form_covariance(wide, together[:count], weak[:count])
    yield wide, compute_run_variation_covariance(extended, wide, table, rest)
    lacks = point.process_noise > EXACT * problem.noise.velocity**2
    if followed.has_misfit or lacks:
        yield wide, _sandwich(extended, table, rest, noise)[:count, :count]
    if lacks and not followed.has_misfit:
        del table, rest, noise  # large for a long log, and so are their successors
        q = OPEN_LOOP * problem.noise.velocity**2
        left = extended.evaluate(wide.structure, wide.values, wide.nuisance, q)
        if not problem.priors:
            same = problem.evaluate(point.structure, point.values, point.nuisance, q)
            extended.extend_jacobian(left, problem.compute_jacobian(same, fine=True))
        table, rest = append_prior_rows(extended, left, fine=True)
        noise, _ = invert_information(table, weak=weak)
        yield left, _sandwich(extended, table, rest, noise)[:count, :count]


def _form_covariance(point: Estimate, together: Array, effects: NDArray[np.bool_]) -> Array:
    """(searched, searched) covariance from small effects whose form is only about right.

    Friction at a crawl is no exact exponential, and drag no exact square. Each fitted size is
    known to ``FORM`` of itself at best; the other parameters shift with it.

    Args:
        point: the best estimate.
        together: (searched, effects) by how much all parameters move with each small effect.
        effects: (searched,) which parameters are those of small effects.
    """
    values = np.array([point.values[name] for name in point.structure.searched_names])
    shift = FORM * values[effects] * together
    return np.asarray(shift @ shift.T)


def _sandwich(problem: PredictionErrorProblem, table: Array, rest: Array, bread: Array) -> Array:
    """(parameters, parameters) covariance with scores summed over ``TOGETHER``.

    Source: the sandwich of White (1980).
    """
    rows, parts = 2 * len(problem.measured), []
    for record, first in zip(problem.records, problem.run_edges, strict=False):
        parts.append(2 * (first + find_interval_starts(record.measurements.time, TOGETHER)))
    scores = np.add.reduceat(table[:rows].T * rest[:rows], np.concatenate(parts), axis=1)
    return np.asarray(bread @ (scores @ scores.T) @ bread)
