"""Gains that vary from run to run, as random effects.

The gains of run i are θ + b_i with b_i ~ N(0, T), T diagonal. A battery warms up, a chain lies
differently, a model lacks something that only some tests excite: then the runs of a log disagree by
more than noise, and the error of their common gains is that of a mean over few runs:

    cov θ = (Σ_i (T + f_i G_i⁻¹)⁻¹)⁻¹        G_i the Fisher information of run i

f_i is the variance of the scores of short intervals of the run, divided by that which independent
innovations would give: correlated innovations are fewer independent samples.

T is estimated from the scores of the runs: given T, that of run i is normal with covariance
G_i + G_i T G_i.

Source: N. Laird and J. Ware, "Random-effects models for longitudinal data", Biometrics 38, 1982.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem

VARIES: Mapping[str, float] = {
    "kS": 0.04, "kV": 0.007, "kA": 0.04, "kG": 0.02, "level": 0.02, "upright": 0.02,
}  # fmt: skip
"""Gain -> first guess of its standard deviation between runs of one day, as a share of it."""
LEAST_VOLTS = 0.05  # [V] a smaller kS or kG varies as much as one of this size
FIXED = 1e-4  # [share of a parameter's size] standard deviation of those that do not vary
NO_INFORMATION = 1e-12  # [1/size²] keeps the error of an undetermined parameter finite
INTERVAL = 0.5  # [s] within which the innovations of an incomplete model are correlated
LEAST_EIGENVALUE = 1e-6  # [share of the largest] of the information; a smaller one is rounding
GRID: Array = 2.0 ** np.arange(-10.0, 6.0)  # [guesses] standard deviations that are averaged
SWEEPS = 2  # over all gains


@dataclass(frozen=True, eq=False)
class RunInformation:
    """Fisher information and score of one run, its nuisance parameters marginalized.

    Args:
        information: (k, k) Fisher information G.
        score: (k,) gradient of half the sum of squares.
    """

    information: Array
    score: Array

    def select_parameters(self, chosen: NDArray[np.bool_]) -> "RunInformation":
        """The information about some of the parameters, the others known."""
        return RunInformation(self.information[np.ix_(chosen, chosen)], self.score[chosen])


def compute_run_variation_covariance(
    problem: PredictionErrorProblem, point: Estimate, jacobian: Array, innovations: Array
) -> Array:
    """(searched, searched) covariance of the parameters when gains vary from run to run.

    Args:
        problem: the measurements, with ``varying_friction`` off.
        point: the best estimate.
        jacobian: (2 n + ..., searched + nuisance) Jacobian of the whitened innovations.
        innovations: (2 n + ...,) whitened innovations.
    """
    sizes = _sizes(problem, point)
    runs = _run_information(problem, point, jacobian, innovations, sizes)
    known = problem.select_priors(point.structure)
    names = point.structure.searched_names
    free = np.array([name not in known for name in names])
    guess = np.array([VARIES.get(name, FIXED) for name in names])
    square = guess**2
    square[free] = _variances([run.select_parameters(free) for run in runs], guess[free])
    prior = [
        (size / known[name]) ** 2 if name in known else 0.0
        for name, size in zip(names, sizes, strict=True)
    ]
    covariance = _marginal_covariance(runs, square, np.array(prior))
    return np.asarray(covariance * np.outer(sizes, sizes))


def _variances(runs: list[RunInformation], guess: Array) -> Array:
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


def _marginal_covariance(runs: list[RunInformation], square: Array, prior: Array) -> Array:
    """(k, k) covariance of the common parameters, given their variances between runs.

    Args:
        runs: their information.
        square: (k,) variances between runs.
        prior: (k,) information of the priors.
    """
    root, total = np.sqrt(square), np.diag(prior + NO_INFORMATION)
    for run in runs:
        values, vectors = _scaled_eigenvectors(run, root)
        inverse = vectors / square[:, None]
        total = total + (inverse * (values / (1.0 + values))) @ inverse.T
    return np.asarray(np.linalg.inv(total))


def _scaled_eigenvectors(run: RunInformation, root: Array) -> tuple[Array, Array]:
    """Eigenvalues of T^(1/2) G T^(1/2) and (k, k) its eigenvectors times T^(1/2)."""
    values, vectors = np.linalg.eigh(run.information * np.outer(root, root))
    return np.maximum(values, 0.0), root[:, None] * vectors


def _run_information(
    problem: PredictionErrorProblem,
    point: Estimate,
    jacobian: Array,
    innovations: Array,
    sizes: Array,
) -> list[RunInformation]:
    """The information of each run that is compared."""
    count, runs = sizes.size, []
    nuisance = problem.list_nuisance_priors(point)
    known = np.array([1.0 / sd**2 for sd, _ in nuisance])
    places = count + len(problem.records) * np.arange(len(nuisance))
    for number, (first, last) in enumerate(
        zip(problem.run_edges, problem.run_edges[1:], strict=False)
    ):
        rows = slice(2 * int(first), 2 * int(last))
        columns = jacobian[rows, :count] * sizes
        if not columns.any():
            continue
        moved = jacobian[rows][:, places + number]
        own = np.array([offset[number] for _, offset in nuisance]) * known
        shares = np.linalg.solve(moved.T @ moved + np.diag(known), moved.T @ columns)
        free = columns - moved @ shares
        information = free.T @ columns
        score = free.T @ innovations[rows] - shares.T @ own
        time = problem.records[number].measurements.time
        starts = 2 * find_interval_starts(time, INTERVAL)  # two measurements to a sample
        scores = np.add.reduceat(free.T * innovations[rows], starts, axis=1).T
        excess = max(_excess(information, scores), 1.0)
        runs.append(RunInformation(information / excess, score / excess))
    return runs


def find_interval_starts(time: Array, length: float) -> NDArray[np.intp]:
    """Index of the first sample in each interval of this length [s] that has samples."""
    return np.flatnonzero(np.diff((time - time[0]) // length, prepend=-1.0))


def _excess(information: Array, scores: Array) -> float:
    """[1] variance of the intervals' scores, divided by that of independent innovations.

    Args:
        information: (k, k) Fisher information of the run.
        scores: (intervals, k) scores of its intervals.
    """
    values, vectors = np.linalg.eigh(information)
    known = values > LEAST_EIGENVALUE * values[-1]
    projected = scores @ vectors[:, known]
    return float(np.mean(np.sum(projected**2, axis=0) / values[known]))


def _sizes(problem: PredictionErrorProblem, point: Estimate) -> Array:
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
