"""Start values for backlash and compliance, from step tests.

Free play and a soft joint show for a moment after each change of voltage, and hardly in a slow
ramp. −2 log L has many local minima: a light motor, a heavy one, an oscillation whose period is
near that of the samples. So many starts are simulated on the step tests and the best are optimized
there, which takes little time; the local minima that result become starts for all runs.
"""

from collections.abc import Iterable, Sequence
from math import isclose, isfinite

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import levenberg_marquardt, make_joint_jacobian
from sim.physics.effects import EFFECTS
from sim.reconcile.local_minimum import RatedStart, rate_starts
from sim.reconcile.thresholds import LEAST_SCORE

SLOW = "quasistatic"  # tests that hardly show them
MOST = 4  # starts of each kind that are optimized by one step on the step tests
FURTHER = (4, 4)  # of them, how many are optimized by a second step, and by a third
MINIMA = 2  # local minima that are tried on all runs
SAME = 0.2  # [1] by which the parameters of two minima differ at least
NEAR = 0.5  # [1] of the best gain that another minimum reaches, to be tried on all runs, too
HEAVIER = 2.5  # [1] of a single body's kA, which mostly follows the motor that moves first


class TwoBodyStarts:
    """The step tests, and the start values that they suggest.

    Args:
        problem: the measurements of all runs.
        point: the estimate without a joint.
    """

    def __init__(self, problem: PredictionErrorProblem, point: Estimate) -> None:
        chosen = [n for n, record in enumerate(problem.records) if SLOW not in record.test]
        self.available = False
        if not chosen:
            return
        self.problem = problem.select_runs(chosen)
        self.point = self.problem.change(point, nuisance=point.nuisance.select_runs(chosen))
        if isfinite(self.point.cost):  # else all samples are excluded, or it diverges
            self.available = True
            self.jacobian = make_joint_jacobian(self.problem, self.point)

    def list_starts(
        self, structure: ModelStructure, starts: list[dict[str, float]], *, heavy: bool
    ) -> list[dict[str, float]]:
        """The starts to try on all runs: the best local minima on the step tests.

        The list is empty if none is better by ``LEAST_SCORE``, because a joint shows in these runs.

        Args:
            structure: the model with the joint as its last effect.
            starts: values of the parameters that each start adds or changes.
            heavy: whether to try two bodies of more inertia, too.
        """
        effect = structure.effects[-1]
        names = ["kA", *(f"{effect}.{name}" for name in EFFECTS[effect].names)]
        tried = list(starts)
        if heavy:
            tried += [{**one, "kA": HEAVIER * self.point.values["kA"]} for one in starts]
        rated = rate_starts(self.problem, self.point, structure, tried, jacobian=self.jacobian)
        optimized = self._take_steps(_choose_best_of_effect(rated, effect))
        for most in FURTHER:
            optimized = self._take_steps(_keep_distinct_minima(optimized, names)[:most])
        best = _keep_distinct_minima(optimized, names)
        if not best:
            return []
        least = max(NEAR * self._compute_improvement(best[0]), LEAST_SCORE)
        found = [one for one in best if self._compute_improvement(one) > least][:MINIMA]
        return [{name: one.values[name] for name in names} for one in found]

    def _take_steps(self, points: Iterable[Estimate]) -> list[Estimate]:
        return [levenberg_marquardt(self.problem, one, steps=1) for one in points]

    def _compute_improvement(self, point: Estimate) -> float:
        return self.point.cost - point.cost


def _choose_best_of_effect(rated: Iterable[RatedStart], effect: str) -> list[Estimate]:
    """The best ``MOST`` of the starts that differ only in size, not in the motor's share."""
    kinds: dict[tuple[float, ...], list[Estimate]] = {}
    fixed = [f"{effect}.{one.name}" for one in EFFECTS[effect].parameters if one.neutral]
    for _, point in sorted(rated, key=lambda one: -one[0]):
        kinds.setdefault(tuple(point.values[name] for name in fixed), []).append(point)
    return [one for kind in kinds.values() for one in kind[:MOST]]


def _keep_distinct_minima(points: Iterable[Estimate], names: Sequence[str]) -> list[Estimate]:
    """The likeliest estimate near each local minimum, the likeliest first."""
    found: list[Estimate] = []
    for one in sorted(points, key=lambda one: one.cost):
        if not any(_are_near(one, other, names) for other in found):
            found.append(one)
    return found


def _are_near(one: Estimate, other: Estimate, names: Iterable[str]) -> bool:
    """Whether two points lead to one local minimum."""
    return all(isclose(one.values[n], other.values[n], rel_tol=SAME) for n in names)
