"""Levenberg–Marquardt search for parameters, and a line search for the process noise.

The residuals are the whitened innovations, with a row for each prior. Derivatives are finite
differences of simulations.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.run_nuisance import FRICTION

FIRST_DAMPING, LEAST_DAMPING, TRIES = 1e-3, 1e-9, 5
ENOUGH = 0.5  # [of -2 log L] a step that gains less ends the search
LEAST_PREDICTED = 0.1  # [of -2 log L] a step that is predicted to gain less is not taken
FACTOR = 4.0  # [1] by which a line search changes the process noise
LEAST_Q = 1e-12  # [noises of a velocity, squared, per second] less is no process noise
TINY = 1e-9  # [of a parameter's size] step that shows whether a parameter is at its limit
LEAST_INFORMATION = 1e-100  # of a parameter, so that it has an inverse
LEAST_EIGENVALUE = 1e-11  # [1] of the scaled information; a smaller one is rounding
NO_INFORMATION = 1e-20  # [1] what replaces such an eigenvalue


@dataclass(frozen=True, eq=False)
class JointJacobian:
    """Projection of innovations onto the Jacobian of parameters and nuisance parameters.

    Args:
        columns: (2 n, k) the Jacobian without its prior rows.
        root: (k, k) inverse of the triangle R of the QR decomposition of the Jacobian with them.
        prior: (k,) the prior rows' residuals in the orthonormal basis Q.
    """

    columns: Array
    root: Array
    prior: Array

    @cached_property
    def basis(self) -> Array:
        """(2 n, k) orthonormal basis of the Jacobian's column space, without its prior rows."""
        return np.asarray(self.columns @ self.root)

    def project(self, white: Array) -> Array:
        """(k,) coordinates of whitened innovations (2 n,) in the Jacobian's column space."""
        return self._project_data(white) + self.prior

    def _project_data(self, white: Array) -> Array:
        """(k, ...) coordinates of (2 n, ...), without the residuals of the priors."""
        return np.asarray(self.root.T @ (self.columns.T @ white))

    def compute_residual_square(self, white: Array) -> float:
        """Sum of squares with the Jacobian's columns projected out, up to a constant."""
        projected = self.project(white)
        return float(white @ white - projected @ projected)

    def compute_improvement(self, white: Array, columns: Array, sd: float) -> float:
        """Predicted decrease of -2 log L by further parameters.

        Args:
            white: (2 n,) whitened innovations.
            columns: (2 n, m) their derivatives by the further parameters.
            sd: standard deviation of the further parameters' normal prior.
        """
        slope, square = self.compute_residual_products(columns, white)
        square = square + np.eye(columns.shape[1]) / sd**2
        return float(slope @ np.linalg.solve(square, slope))

    def compute_shift(self, change: Array) -> Array:
        """(k,) shift of the parameters by a small change (2 n,) of whitened innovations."""
        return np.asarray(-self.root @ self._project_data(change))

    def compute_residual_products(self, columns: Array, white: Array) -> tuple[Array, Array]:
        """(m,) and (m, m) products of changes (2 n, m) with innovations and with each other.

        The Jacobian is projected out of both.
        """
        projected = self._project_data(columns)
        product = columns.T @ white - projected.T @ self.project(white)
        return product, columns.T @ columns - projected.T @ projected


def make_joint_jacobian(
    problem: PredictionErrorProblem, point: Estimate, *, fine: bool = False
) -> JointJacobian:
    """The joint Jacobian at an estimate; ``fine`` takes central differences."""
    table = problem.compute_jacobian(point, fine=fine)
    rows, residuals = make_prior_rows(problem, point)
    triangle = np.linalg.qr(np.vstack([np.linalg.qr(table, mode="r"), rows]), mode="r")
    root = np.linalg.pinv(triangle)
    return JointJacobian(table, root, root.T @ (rows.T @ residuals))


def make_prior_rows(problem: PredictionErrorProblem, point: Estimate) -> tuple[Array, Array]:
    """The priors' rows of the Jacobian (priors, k) and their residuals (priors,).

    Rows of nuisance parameters come first.
    """
    runs, names = len(problem.records), point.structure.searched_names
    effects = problem.list_random_effects(point.values)
    known = problem.select_priors(point.structure)
    count, columns = runs * len(effects), len(names)
    rows = np.zeros((count + len(known), columns + count))
    rows[:count, columns:] = np.diag(np.repeat([1.0 / sd for sd in effects.values()], runs))
    for row, (name, sd) in enumerate(known.items(), count):
        rows[row, names.index(name)] = 1.0 / sd
    values = [point.values[name] / sd for name, sd in known.items()]
    offsets = (getattr(point.nuisance, name) / sd for name, sd in effects.items())
    return rows, np.concatenate([*offsets, values])


def levenberg_marquardt(
    problem: PredictionErrorProblem, point: Estimate, *, steps: int, enough: float = ENOUGH
) -> Estimate:
    """The estimate after Levenberg–Marquardt steps, with unchanged process noise.

    Args:
        problem: the measurements.
        point: the estimate to start from.
        steps: the largest number of steps.
        enough: [of -2 log L] a step that gains less is the last.
    """
    if not math.isfinite(point.cost):
        return point
    damping = FIRST_DAMPING
    for _ in range(steps):
        slope, square = compute_gradient_and_information(problem, point)
        size = np.sqrt(np.diag(square))
        size[size == 0.0] = 1.0
        slope /= size
        free = _find_movable_columns(point, slope)
        slope, square = slope[free], (square / np.outer(size, size))[np.ix_(free, free)]
        found = point
        for _ in range(TRIES):
            way = -np.linalg.solve(square + damping * np.eye(slope.size), slope)
            if -float(way @ (2.0 * slope + square @ way)) < LEAST_PREDICTED:
                break
            by = np.zeros(free.size)
            by[free] = way / size[free]
            moved = _take_step(problem, point, by)
            if moved.cost < point.cost:
                found, damping = moved, max(damping / 10.0, LEAST_DAMPING)
                break
            damping *= 10.0
        gained, point = point.cost - found.cost, found
        if not gained > enough:
            break
    return point


def compute_gradient_and_information(
    problem: PredictionErrorProblem, point: Estimate, *, fine: bool = False
) -> tuple[Array, Array]:
    """(k,) half the gradient of -2 log L by all parameters, and (k, k) their information JᵀJ."""
    table = problem.compute_jacobian(point, fine=fine)
    white = problem.whiten(point, point.innovations)
    rows, residuals = make_prior_rows(problem, point)
    with np.errstate(over="ignore"):  # the columns of a diverging simulation are clipped, but large
        return table.T @ white + rows.T @ residuals, table.T @ table + rows.T @ rows


def _find_movable_columns(point: Estimate, slope: Array) -> NDArray[np.bool_]:
    """(k,) whether a step may change it: not if its limit is in the way of a lower cost."""
    free = np.ones(slope.size, dtype=bool)
    structure = point.structure
    for column, name in enumerate(structure.searched_names):
        value = point.values[name]
        by = TINY * structure.find_parameter_scale(name, value) * np.sign(slope[column])
        free[column] = structure.clamp_value(name, value - by) != value
    return free


def _take_step(problem: PredictionErrorProblem, point: Estimate, by: Array) -> Estimate:
    """The estimate after a step."""
    structure, values = point.structure, dict(point.values)
    searched = structure.searched_names
    for name, step in zip(searched, by.tolist(), strict=False):
        values[name] = structure.step_value(name, values[name], step)
    own, nuisance = by[len(searched) :].reshape(-1, len(problem.records)), point.nuisance
    for name, offsets in zip(problem.list_random_effects(point.values), own, strict=True):
        nuisance = nuisance.add(name, offsets)
    if problem.varying_friction:
        # the mean of the runs' frictions belongs to kS: the priors alone hardly keep it zero
        common = float(np.mean(nuisance.friction_offset))
        values["kS"] = max(values["kS"] + common, 0.0)
        nuisance = nuisance.add(FRICTION, -common)
    return problem.change(point, values=values, nuisance=nuisance)


def tune_process_noise(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate with the likeliest process noise: factors of four, then a parabola."""
    least = LEAST_Q * problem.noise.velocity**2

    def at(factor: float) -> Estimate:
        return problem.change(point, process_noise=point.process_noise * factor)

    neighbor = {factor: at(factor) for factor in (FACTOR, 1.0 / FACTOR)}
    for factor in (FACTOR, 1.0 / FACTOR):
        while (
            neighbor[factor].cost < point.cost - 0.1
            and least < neighbor[factor].process_noise < problem.max_process_noise
        ):
            neighbor[1.0 / factor], point = point, neighbor[factor]
            neighbor[factor] = at(factor)
    more, less = neighbor[FACTOR].cost, neighbor[1.0 / FACTOR].cost
    bend = more + less - 2.0 * point.cost
    if not (
        math.isfinite(bend)
        and bend > 0.0
        and neighbor[FACTOR].process_noise < problem.max_process_noise
    ):
        return point
    other = at(FACTOR ** (0.5 * (less - more) / bend))
    return min(point, other, key=lambda one: one.cost)


def compute_parameter_covariance(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(searched, searched) covariance of the parameters, the nuisance parameters marginalized.

    A combination of parameters that the log does not determine has a huge variance, not zero.

    Args:
        problem: the measurements.
        point: the best estimate.
    """
    _, square = compute_gradient_and_information(problem, point, fine=True)
    inverse = invert_symmetric(square)
    count = len(point.structure.searched_names)
    return np.asarray(inverse[:count, :count])


def invert_symmetric(square: Array) -> Array:
    """(k, k) inverse of an information matrix (k, k), with huge variances where it is singular."""
    size = np.sqrt(np.maximum(np.diag(square), LEAST_INFORMATION))
    eigenvalues, vectors = np.linalg.eigh(square / np.outer(size, size))
    eigenvalues = np.where(eigenvalues > LEAST_EIGENVALUE, eigenvalues, NO_INFORMATION)
    return np.asarray((vectors / eigenvalues) @ vectors.T / np.outer(size, size))
