"""The data of every selection step: measurements and cross-validation folds."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from sim.core.log import Log
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.physics.voltage_residual import VoltageResidual, compute_voltage_residual
from sim.reconcile.cross_validation import Fold


@dataclass(frozen=True, eq=False)
class SelectionData:
    """The data that effects are selected by.

    Args:
        log: all runs that may be fitted.
        problem: their measurements.
        folds: the cross-validation folds.
        progress: called with a step's description and the share done [1].
        budget: [samples] that may be simulated; after that the best model so far is taken.
        is_stopped: whether the user has stopped the search, which then ends in the same way.
    """

    log: Log
    problem: PredictionErrorProblem
    folds: Sequence[Fold]
    progress: Callable[[str, float], None] = lambda _, __: None
    budget: float = math.inf
    is_stopped: Callable[[], bool] = lambda: False

    def is_budget_spent(self) -> bool:
        """Whether no further search may begin."""
        return self.problem.simulated.count > self.budget or self.is_stopped()

    def voltage_residual(self, point: Estimate) -> VoltageResidual:
        """The voltage residual of the log under an estimate's base model."""
        gains = dict(point.model.gains)
        return compute_voltage_residual(self.log, gains, type=point.structure.type)
