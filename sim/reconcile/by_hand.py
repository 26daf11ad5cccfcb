"""Reconcile by hand: a person chooses the effects, with the fits and gaps of ``reconcile``.

    search = HandSearch(log, validation=other, held_out=third)
    found = search.fit(["cogging"])
    search.measure_gap(found, "validation")       # [times the noise]

A model's gap on the validation and on the held-out log is the one that ``reconcile`` shows.
"""

from collections.abc import Sequence
from contextlib import suppress
from functools import cached_property

from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import levenberg_marquardt
from sim.physics.effects import find_effect
from sim.physics.model import Model, Part
from sim.reconcile.base_model import fit_base_model, make_data_folds
from sim.reconcile.candidates import rank_candidates
from sim.reconcile.cross_validation import Fold, compute_validation_gap, count_noise_floors
from sim.reconcile.held_out import measure_open_loop_gap
from sim.reconcile.local_minimum import minimize
from sim.reconcile.recordings import Recordings
from sim.reconcile.search_effort import STEPS
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.thresholds import NARROWER

VALIDATION = "validation"


class HandSearch:
    """A search for missing effects in which a person chooses each effect.

    Args:
        log: runs to fit, the four tests at least.
        validation: other runs, on which the gap decides; None: each run is predicted by the others.
        held_out: runs on which the gap is only shown.
        type: the base model: ``simple``, ``elevator`` or ``arm``.
    """

    def __init__(
        self,
        log: Log,
        *,
        validation: Log | None = None,
        held_out: Log | None = None,
        type: str = "simple",  # noqa: A002 - the field's own word
    ) -> None:
        self.recordings = Recordings(log, validation, held_out, type=type)
        self._fits: dict[tuple[str, ...], Estimate] = {}

    @cached_property
    def _problem(self) -> PredictionErrorProblem:
        return self.recordings.make_problem()

    @cached_property
    def _folds(self) -> tuple[Fold, ...]:
        return make_data_folds(self._problem, self.recordings)

    def fit(self, effects: Sequence[str] = ()) -> Estimate:
        """The gains and the parameters of some effects, fitted to the log and the validation.

        Raises:
            BadRequest: an unknown effect, or one that the model cannot have.
        """
        names = tuple(effects)
        if names not in self._fits:
            self._fits[names] = (
                self._add_effect(self.fit(names[:-1]), names[-1])
                if names
                else fit_base_model(self._problem, self.recordings)
            )
        return self._fits[names]

    def _add_effect(self, before: Estimate, effect: str) -> Estimate:
        find_effect(effect)
        data = SelectionData(self.recordings.fitted_runs, self._problem, self._folds)
        residual = data.voltage_residual(before)
        found = rank_candidates(self._problem, before, residual, only=[effect])
        if not found:
            raise BadRequest(
                f"{effect} cannot be fitted to this log",
                advice="Nothing in the log looks like it, or the model has it. Choose another.",
            )
        return found[0].estimate

    def fit_gains(self, parts: Sequence[Part]) -> Estimate:
        """The gains, fitted while the effects keep their given parameters.

        A joint has local minima, so gains are also searched from those that fit with free
        parameters of the same effects.
        """
        values = {f"{one.effect}.{name}": v for one in parts for name, v in one.parameters.items()}
        names, base = tuple(one.effect for one in parts), self.fit()
        if not names:
            return base
        structure = ModelStructure(base.structure.type, names, tuple(values))
        starts = [base.values]
        if any(find_effect(name).is_joint for name in names):
            with suppress(BadRequest):
                starts.append(self.fit(names).values)
        found = [
            minimize(self._problem, self._evaluate_model(structure, {**one, **values}))
            for one in starts
        ]
        return min(found, key=lambda one: one.cost)

    def evaluate_model(self, model: Model) -> Estimate:
        """An estimate with the parameters of a model, of which nothing is fitted."""
        return self._evaluate_model(*ModelStructure.split_model(model))

    def fit_near(self, model: Model) -> Estimate:
        """The fit after a few search steps from a model's parameters: quicker than ``fit``."""
        return levenberg_marquardt(self._problem, self.evaluate_model(model), steps=STEPS)

    def _evaluate_model(self, structure: ModelStructure, values: dict[str, float]) -> Estimate:
        problem = self._problem
        nuisance, noise = problem.initial_nuisance, problem.noise.velocity**2
        return problem.evaluate(structure, values, nuisance, noise)

    def measure_gap(self, point: Estimate, log: str = VALIDATION) -> float:
        """The gap of a model, in times the noise of the velocity.

        Args:
            point: the model.
            log: ``validation``, which the model is fitted without, ``log`` or ``held_out``.
        """
        if log == VALIDATION:
            gap = compute_validation_gap(self._problem, point, self._folds)
            return count_noise_floors(gap.velocity, self._problem)
        problem = self.recordings.make_shown_problem(log)
        return count_noise_floors(measure_open_loop_gap(problem, point), problem)


def is_narrower(gap: float, before: float) -> bool:
    """Whether a gap is smaller than another by more than a refit by chance changes it."""
    return gap <= NARROWER * before
