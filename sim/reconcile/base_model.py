"""The base model of reconcile, without effects, and the folds that cross-validate it."""

import math

from sim.core.errors import NotIdentifiable
from sim.estimation.initial_guess import clamp_to_physical
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import levenberg_marquardt
from sim.reconcile.cross_validation import Fold, make_folds, select_usable_folds
from sim.reconcile.local_minimum import minimize_fully, scan_process_noise
from sim.reconcile.recordings import Recordings
from sim.reconcile.search_effort import STEPS

SLOW = 0.5  # [s] time scale kA/kV of a slow mechanism


def make_data_folds(problem: PredictionErrorProblem, recordings: Recordings) -> tuple[Fold, ...]:
    """The folds that have samples to fit and to predict.

    Raises:
        NotIdentifiable: no fold has both.
    """
    folds = select_usable_folds(problem, make_folds([one.session for one in problem.records]))
    if not folds:
        raise NotIdentifiable(
            "after the damaged parts are cut out, no run is left to predict",
            where=(recordings.validation or recordings.log).source,
            advice="Inspect the log, and record it again.",
        )
    return folds


def fit_base_model(problem: PredictionErrorProblem, recordings: Recordings) -> Estimate:
    """The best estimate without effects.

    It is searched from two start values of kA: the guess, and that of a slow mechanism. A voltage
    limit or a delayed velocity can make the guess negative, and a search from the almost zero
    inertia to which that is clamped ends at a local minimum.

    Raises:
        NotIdentifiable: the simulation diverges with all gains that were tried.
    """
    guess = clamp_to_physical(recordings.initial_gains)
    structure = ModelStructure(recordings.type)

    def fit_from_inertia(ka: float) -> Estimate:
        values = {name: {**guess, "kA": ka}[name] for name in structure.names}
        noise = problem.noise.velocity**2
        start = problem.evaluate(structure, values, problem.initial_nuisance, noise)
        found = levenberg_marquardt(problem, start, steps=STEPS, enough=1.0)
        return minimize_fully(problem, scan_process_noise(problem, found))

    starts = (guess["kA"], SLOW * guess["kV"])
    base = min(map(fit_from_inertia, starts), key=lambda one: one.cost)
    if not math.isfinite(base.cost):
        parts = "without its damaged parts, " if recordings.damage.excluded else ""
        raise NotIdentifiable(
            f"{parts}no gains fit this log",
            where=recordings.log.source,
            advice="Inspect the log, and record it again.",
        )
    return base
