"""Gains that vary from run to run, as random effects.

The gains of run i are θ + b_i with b_i ~ N(0, T), T diagonal. A battery warms up, a chain lies
differently, a model lacks something that only some tests excite: then the runs of a log disagree by
more than noise, and the error of their common gains is that of a mean over few runs:

    cov θ = (Σ_i (T + f_i G_i⁻¹)⁻¹)⁻¹        G_i the Fisher information of run i

f_i is the variance of the scores of short intervals of the run, divided by that which independent
innovations would give: correlated innovations are fewer independent samples.

A parameter with a prior is the size of a small effect whose formula is only approximate: breakaway
friction is not exactly exponential, and drag not exactly quadratic. So its size has a further error
of ``FORM`` of itself, and the other parameters change with it.

The voltage between two samples is not in the log. With a joint, where it matters, the parameters
may be off by as much as they shift if that voltage is at its largest.

T is estimated from the scores of the runs: given T, that of run i is normal with covariance
G_i + G_i T G_i.

Source: N. Laird and J. Ware, "Random-effects models for longitudinal data", Biometrics 38, 1982.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import make_joint_jacobian

VARIES: Mapping[str, float] = {
    "kS": 0.04, "kV": 0.007, "kA": 0.04, "kG": 0.02, "level": 0.02, "upright": 0.02,
}  # fmt: skip
"""Gain -> first guess of its standard deviation between runs of one day, as a share of it."""
LEAST_VOLTS = 0.05  # [V] a smaller kS or kG varies as much as one of this size
FORM = 0.05  # [share of a small effect] error of its formula on a robot
FIXED = 1e-4  # [share of a parameter's size] standard deviation of those that do not vary
LEAST_SINGULAR = 1e-10  # [1] singular value of a root with columns of length 1; less is rounding
LARGEST_ERROR = 1e6  # [sizes of a parameter] a larger standard error is rounding alone
NO_INFORMATION = 1e-12  # [1/size²] keeps the error of an undetermined parameter finite
SIMULATION = 1e-3  # [share of a parameter] error of an effect that is simulated in a search's steps
INTERVAL = 0.5  # [s] within which the innovations of an incomplete model are correlated
LEAST_EIGENVALUE = 1e-6  # [share of the largest] of the information; a smaller one is rounding
GRID: Array = 2.0 ** np.arange(-10.0, 6.0)  # [guesses] standard deviations that are averaged
SWEEPS = 2  # over all gains


@dataclass(frozen=True, eq=False)
class RunInformation:
    """Fisher information and score of one run, its nuisance parameters marginalized.

    Args:
        root: (j, k) root R of the Fisher information G = RᵀR.
        score: (k,) gradient of half the sum of squares.
    """

    root: Array
    score: Array

    def select_parameters(self, chosen: NDArray[np.bool_]) -> "RunInformation":
        """The information about some of the parameters, the others known."""
        return RunInformation(self.root[:, chosen], self.score[chosen])

    @property
    def information(self) -> Array:
        """(k, k) Fisher information G."""
        return self.root.T @ self.root


def compute_run_variation_covariance(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(searched, searched) covariance of the parameters when gains vary from run to run.

    Args:
        problem: the measurements.
        point: the best estimate.
    """
    if problem.varying_friction:  # T contains the variance of the friction
        problem = replace(problem, varying_friction=False)
        point = problem.change(point, nuisance=point.nuisance.with_common_friction)
    sizes = _list_parameter_sizes(problem, point)
    runs = _run_information(problem, point, sizes)
    known = problem.select_priors(point.structure)
    names = point.structure.searched_names
    free = np.array([name not in known for name in names])
    guess = np.array([VARIES.get(name, FIXED) for name in names])
    square = guess**2
    square[free] = _estimate_variances([run.select_parameters(free) for run in runs], guess[free])
    priors = np.diag([1.0 / known.get(name, math.inf) for name in names]) * sizes
    # roots instead of information, so that rounding loses no weak prior
    roots = np.vstack([*(_compute_marginal_root(run, square) for run in runs), priors[~free]])
    covariance = _invert_root(roots) * np.outer(sizes, sizes)
    # how all parameters change with the size of each small effect
    change = np.zeros((sizes.size, np.count_nonzero(~free)))
    change[free] = -np.linalg.lstsq(roots[:, free], roots[:, ~free], rcond=None)[0]
    change[~free] = np.eye(change.shape[1])
    values = np.array([point.values[name] for name in names])
    form = sizes[:, None] * change * (FORM * values / sizes)[~free]
    shift = _compute_voltage_shift(problem, point)
    return np.asarray(covariance + form @ form.T + np.outer(shift, shift))


def _compute_voltage_shift(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(searched,) shift of the parameters of a joint by the voltage between samples."""
    count = len(point.structure.searched_names)
    sliding = any(record.measurements.voltage_slide.any() for record in problem.records)
    if not (sliding and point.structure.has_joint):
        return np.zeros(count)
    raised = replace(problem, records=tuple(one.raise_voltage() for one in problem.records))
    innovations = raised.predict_errors(point.model, point.nuisance, point.kalman_filter)
    change = problem.whiten(point, innovations - point.innovations)
    return make_joint_jacobian(problem, point, fine=True).compute_shift(change)[:count]


def compute_standard_errors(problem: PredictionErrorProblem, point: Estimate) -> dict[str, float]:
    """Searched parameter -> its standard error; infinite where the log does not determine it.

    Those of effects include the error of the search's simulation.

    Args:
        problem: the measurements.
        point: the best estimate.
    """
    structure = point.structure
    variances = np.diag(compute_run_variation_covariance(problem, point)).tolist()
    errors = {}
    for name, variance in zip(structure.searched_names, variances, strict=True):
        value, error = point.values[name], math.sqrt(max(variance, 0.0))
        if name in structure.parameters:
            error = math.hypot(error, SIMULATION * value)
        most = LARGEST_ERROR * structure.find_parameter_scale(name, value)
        errors[name] = error if error < most else math.inf
    return errors


def _estimate_variances(runs: list[RunInformation], guess: Array) -> Array:
    """(k,) variances of the parameters between runs: posterior means, one gain after another.

    A flat prior over the logarithm of the standard deviation, from 2⁻¹⁰ to 2⁵ times the guess,
    keeps a variance finite that the runs do not determine.
    """
    square, varying = np.full(guess.size, FIXED**2), np.flatnonzero(guess > FIXED)
    square[varying] = guess[varying] ** 2
    for _ in range(SWEEPS):
        for place in varying:
            tried = np.repeat(square[None, :], GRID.size, axis=0)
            tried[:, place] = (GRID * guess[place]) ** 2
            likelihood = _log_likelihood(runs, tried)
            weight = np.exp(likelihood - likelihood.max())
            square[place] = float(weight @ tried[:, place] / weight.sum())
    return square


def _log_likelihood(runs: list[RunInformation], square: Array) -> Array:
    """(tried,) log likelihood of the scores of all runs, up to a constant.

    Args:
        runs: their information.
        square: (tried, k) variances between runs.
    """
    root = np.sqrt(square)
    information = np.array([run.information for run in runs])
    scores = np.array([run.score for run in runs])
    values, vectors = np.linalg.eigh(root[:, None, :, None] * information * root[:, None, None, :])
    values = np.maximum(values, 0.0)
    along = np.einsum("tk,rk,trkj->trj", root, scores, vectors)
    return np.asarray(0.5 * np.sum(along**2 / (1.0 + values) - np.log1p(values), axis=(1, 2)))


def _compute_marginal_root(run: RunInformation, square: Array) -> Array:
    """(j, k) root of (T + G⁻¹)⁻¹, the information of a run about the common parameters.

    Args:
        run: its information.
        square: (k,) variances between runs, the diagonal of T.
    """
    varied = np.eye(len(run.root)) + (run.root * square) @ run.root.T
    return np.asarray(np.linalg.solve(np.linalg.cholesky(varied), run.root))


def _invert_root(root: Array) -> Array:
    """(k, k) inverse of RᵀR for a root R (n, k), with huge variances where it is singular."""
    size = np.maximum(np.linalg.norm(root, axis=0), math.sqrt(NO_INFORMATION))
    _, values, vectors = np.linalg.svd(root / size, full_matrices=False)
    inverse = vectors.T / np.maximum(values, LEAST_SINGULAR) / size[:, None]
    return np.asarray(inverse @ inverse.T)


def _run_information(
    problem: PredictionErrorProblem, point: Estimate, sizes: Array
) -> list[RunInformation]:
    """The information of each run that is compared."""
    jacobian = problem.compute_jacobian(point, fine=True)
    innovations = problem.whiten(point, point.innovations)
    count, runs = sizes.size, []
    effects = problem.list_random_effects(point.values)
    known = np.array([1.0 / sd**2 for sd in effects.values()])
    places = count + len(problem.records) * np.arange(len(effects))
    for number, samples in enumerate(problem.run_slices):
        rows = slice(2 * samples.start, 2 * samples.stop)
        columns = jacobian[rows, :count] * sizes
        if not columns.any():
            continue
        moved = jacobian[rows][:, places + number]
        own = np.array([getattr(point.nuisance, name)[number] for name in effects]) * known
        shares = np.linalg.solve(moved.T @ moved + np.diag(known), moved.T @ columns)
        free = columns - moved @ shares
        information = free.T @ columns
        score = free.T @ innovations[rows] - shares.T @ own
        time = problem.records[number].measurements.time
        begins = np.diff((time - time[0]) // INTERVAL, prepend=-1.0)
        starts = 2 * np.flatnonzero(begins)  # two measurements to a sample
        scores = np.add.reduceat(free.T * innovations[rows], starts, axis=1).T
        excess = max(_compute_overdispersion(information, scores), 1.0)
        whole = np.vstack([free, np.sqrt(known)[:, None] * shares])
        root = np.asarray(np.linalg.qr(whole, mode="r"))
        runs.append(RunInformation(root / math.sqrt(excess), score / excess))
    return runs


def _compute_overdispersion(information: Array, scores: Array) -> float:
    """[1] variance of the intervals' scores, divided by that of independent innovations.

    Args:
        information: (k, k) Fisher information of the run.
        scores: (intervals, k) scores of its intervals.
    """
    values, vectors = np.linalg.eigh(information)
    known = values > LEAST_EIGENVALUE * values[-1]
    projected = scores @ vectors[:, known]
    return float(np.mean(np.sum(projected**2, axis=0) / values[known]))


def _list_parameter_sizes(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(searched,) size of each parameter; its standard deviation between runs is a share of it."""
    values, known = point.values, problem.select_priors(point.structure)
    gravity = math.hypot(values.get("level", 0.0), values.get("upright", 0.0))
    volts = {"kS": values["kS"], "kG": values.get("kG", 0.0), "level": gravity, "upright": gravity}
    return np.array(
        [
            known.get(name)
            or (max(abs(volts[name]), LEAST_VOLTS) if name in volts else 0.0)
            or point.structure.find_parameter_scale(name, values[name])
            for name in point.structure.searched_names
        ]
    )
