"""Levenberg–Marquardt search for parameters, and a line search for the process noise.

Steps are taken on whitened innovations with a row for each prior; derivatives are differences of
simulations.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem

FIRST_DAMPING, LEAST_DAMPING, TRIES = 1e-3, 1e-9, 5
ENOUGH = 0.5  # [of -2 log L] a step that gains less ends the search
NOTHING = 0.1  # [of -2 log L] a step that promises less is not taken
FACTOR = 4.0  # [1] steps of the process noise
LEAST_Q = 1e-12  # [noises of a velocity, squared, per second] below which it is none
TINY = 1e-9  # [of a value's size] step that tells whether a value is at its limit
LEAST_INFORMATION = 1e-100  # of a parameter, so that it has an inverse
LARGEST_ERROR = 1e6  # [sizes of a parameter] a larger standard error is rounding alone
UNKNOWN, NO_INFORMATION = 1e-11, 1e-20  # [1] share of the information, and what stands for none


@dataclass(frozen=True, eq=False)
class JointJacobian:
    """Projection of innovations onto the Jacobian of parameters and nuisance parameters.

    Args:
        columns: (2 n, k) the Jacobian, its prior rows left out.
        root: (k, k) what makes its columns, with those rows, orthonormal.
        prior: (k,) what the prior rows hold of the estimate, in that basis.
    """

    columns: Array
    root: Array
    prior: Array

    @cached_property
    def basis(self) -> Array:
        """(2 n, k) an orthonormal basis of the Jacobian's columns, its prior rows left out."""
        return np.asarray(self.columns @ self.root)

    def project(self, white: Array) -> Array:
        """(k,) coordinates of whitened innovations (2 n,) in the Jacobian's column space."""
        return self._take(white) + self.prior

    def _take(self, white: Array) -> Array:
        return np.asarray(self.root.T @ (self.columns.T @ white))

    def compute_residual_square(self, white: Array) -> float:
        """Sum of squares with the Jacobian's columns projected out, up to a constant."""
        taken = self.project(white)
        return float(white @ white - taken @ taken)

    def compute_improvement(self, white: Array, columns: Array, sd: float) -> float:
        """Decrease of -2 log L by further columns (2 n, m) with priors of deviation ``sd``."""
        taken = self._take(columns)
        square = columns.T @ columns - taken.T @ taken + np.eye(columns.shape[1]) / sd**2
        slope = columns.T @ white - taken.T @ self.project(white)
        return float(slope @ np.linalg.solve(square, slope))

    def compute_residual_products(self, change: Array, white: Array) -> tuple[float, float]:
        """Products of a change with innovations and itself, the Jacobian projected out."""
        taken = self._take(change)
        product = float(change @ white - taken @ self.project(white))
        return product, float(change @ change - taken @ taken)


def make_joint_jacobian(
    problem: PredictionErrorProblem, point: Estimate, *, fine: bool = False
) -> JointJacobian:
    """The joint Jacobian at an estimate; ``fine`` takes central differences."""
    table = problem.compute_jacobian(point, fine=fine)
    rows, own = make_prior_rows(problem, point)
    triangle = np.linalg.qr(np.vstack([np.linalg.qr(table, mode="r"), rows]), mode="r")
    root = np.linalg.pinv(triangle)
    return JointJacobian(table, root, root.T @ (rows.T @ own))


def append_prior_rows(
    problem: PredictionErrorProblem, point: Estimate, *, fine: bool = False
) -> tuple[Array, Array]:
    """Jacobian and whitened innovations, with a row for the prior of each nuisance parameter."""
    table, rest = (
        problem.compute_jacobian(point, fine=fine),
        problem.whiten(point, point.innovations),
    )
    rows, own = make_prior_rows(problem, point)
    return np.vstack([table, rows]), np.concatenate([rest, own])


def make_prior_rows(problem: PredictionErrorProblem, point: Estimate) -> tuple[Array, Array]:
    """The priors' rows of Jacobian and innovations, nuisance parameters first."""
    runs, names = len(problem.records), point.structure.searched_names
    nuisance = problem.list_nuisance_priors(point)
    known = problem.select_priors(point.structure)
    count, columns = runs * len(nuisance), len(names)
    rows = np.zeros((count + len(known), columns + count))
    rows[:count, columns:] = np.diag(np.repeat([1.0 / sd for sd, _ in nuisance], runs))
    for row, (name, sd) in enumerate(known.items(), count):
        rows[row, names.index(name)] = 1.0 / sd
    values = [point.values[name] / sd for name, sd in known.items()]
    return rows, np.concatenate([*(offset / sd for sd, offset in nuisance), values])


def levenberg_marquardt(
    problem: PredictionErrorProblem, point: Estimate, *, steps: int, enough: float = ENOUGH
) -> Estimate:
    """The estimate after Levenberg–Marquardt steps, with unchanged process noise.

    Args:
        problem: the measurements.
        point: where it begins.
        steps: at most.
        enough: [of -2 log L] what a step must gain for another one.
    """
    if not math.isfinite(point.cost):
        return point
    damping = FIRST_DAMPING
    for _ in range(steps):
        slope, square = compute_gradient_and_information(problem, point)
        size = np.sqrt(np.diag(square))
        size[size == 0.0] = 1.0
        slope /= size
        free = _movable_columns(point, slope)
        slope, square = slope[free], (square / np.outer(size, size))[np.ix_(free, free)]
        found = point
        for _ in range(TRIES):
            way = -np.linalg.solve(square + damping * np.eye(slope.size), slope)
            if -float(way @ (2.0 * slope + square @ way)) < NOTHING:
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
    rest = problem.whiten(point, point.innovations)
    rows, own = make_prior_rows(problem, point)
    with np.errstate(over="ignore"):  # a value that nothing bears to be moved
        return table.T @ rest + rows.T @ own, table.T @ table + rows.T @ rows


def _movable_columns(point: Estimate, slope: Array) -> NDArray[np.bool_]:
    """(columns,) which may move: not a parameter at a limit beyond which the cost would fall."""
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
    own = iter(by[len(searched) :].reshape(-1, len(problem.records)))
    nuisance = point.nuisance.shift_positions(next(own))
    if problem.varying_friction:
        nuisance = nuisance.add_friction(next(own))
        # what all runs have is kS: only the price tells, hardly
        common = float(np.mean(nuisance.friction_offset))
        values["kS"] = max(values["kS"] + common, 0.0)
        nuisance = nuisance.add_friction(np.full_like(nuisance.friction_offset, -common))
    if problem.lag_sd:
        nuisance = nuisance.add_lag(next(own))
    return problem.evaluate(structure, values, nuisance, point.process_noise)


def tune_process_noise(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate with the likeliest process noise: factors of four, then a parabola."""
    least = LEAST_Q * problem.noise.velocity**2

    def at(part: float) -> Estimate:
        return problem.evaluate(
            point.structure, point.values, point.nuisance, point.process_noise * part
        )

    beside = {way: at(way) for way in (FACTOR, 1.0 / FACTOR)}
    for way in (FACTOR, 1.0 / FACTOR):
        while (
            beside[way].cost < point.cost - 0.1
            and least < beside[way].process_noise < problem.max_process_noise
        ):
            beside[1.0 / way], point = point, beside[way]
            beside[way] = at(way)
    more, less = beside[FACTOR].cost, beside[1.0 / FACTOR].cost
    bend = more + less - 2.0 * point.cost
    if not (
        math.isfinite(bend)
        and bend > 0.0
        and beside[FACTOR].process_noise < problem.max_process_noise
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


def compute_standard_errors(problem: PredictionErrorProblem, point: Estimate) -> dict[str, float]:
    """Searched parameter -> its standard error; infinite where the log does not determine it.

    Args:
        problem: the measurements.
        point: the best estimate.
    """
    structure = point.structure
    variances = np.diag(compute_parameter_covariance(problem, point)).tolist()
    errors = {
        name: math.sqrt(max(variance, 0.0))
        for name, variance in zip(structure.searched_names, variances, strict=True)
    }
    most = {
        name: LARGEST_ERROR * structure.find_parameter_scale(name, point.values[name])
        for name in errors
    }
    return {name: error if error < most[name] else math.inf for name, error in errors.items()}


def invert_information(table: Array, *, weak: NDArray[np.bool_]) -> tuple[Array, Array]:
    """(k, k) inverse of JᵀJ for a Jacobian J (n, k), and how parameters move together.

    Args:
        table: (n, k) the Jacobian, its prior rows included.
        weak: (k,) columns that a prior alone tells from others. The others are eliminated first,
            so that a weak prior is not lost beside much information.

    Returns:
        The inverse, with huge errors where it is singular; and (k, weak) by how much all parameters
        move together with each of the weak ones.
    """
    strong = ~weak
    square = table.T @ table
    alone = invert_symmetric(square[np.ix_(strong, strong)])
    shift = alone @ square[np.ix_(strong, weak)]
    together = np.zeros((weak.size, shift.shape[1]))
    together[strong], together[weak] = -shift, np.eye(shift.shape[1])
    free = table @ together
    own = invert_symmetric(free.T @ free)
    inverse = together @ own @ together.T
    inverse[np.ix_(strong, strong)] += alone
    return inverse, together


def invert_symmetric(square: Array) -> Array:
    """(k, k) inverse of an information matrix, with huge errors where it is singular."""
    size = np.sqrt(np.maximum(np.diag(square), LEAST_INFORMATION))
    told, ways = np.linalg.eigh(square / np.outer(size, size))
    share = np.where(told > UNKNOWN, told, NO_INFORMATION)
    return np.asarray((ways / share) @ ways.T / np.outer(size, size))
