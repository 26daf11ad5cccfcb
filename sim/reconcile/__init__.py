"""Reconcile: find where model and log disagree, name the missing effects, add them.

    story = reconcile(log, validation=other, held_out=third, type="arm")

Damaged intervals are excluded first, and the base model is fitted. Forward selection tries every
effect of the catalogue on top of it, adds the likeliest that does not widen the gap on runs it was
not fitted to, refits all parameters, and repeats. Backward elimination then removes effects that
have become needless. The held-out log chooses no effect: the gap is shown on it, and an effect with
which that gap grows is not named.

After the prediction-error method (Kristensen, Madsen and Jørgensen 2004).
"""

from collections.abc import Callable, Mapping, Sequence

from sim.core.errors import refuse_unknown
from sim.core.log import Log
from sim.core.vocabulary import TYPES
from sim.estimation.likelihood import PredictionErrorProblem
from sim.reconcile.backward_elimination import remove_needless_effects
from sim.reconcile.base_model import fit_base_model, make_data_folds
from sim.reconcile.damage import DamagedInterval, judge_damage
from sim.reconcile.findings import make_findings, make_suspicions
from sim.reconcile.forward_selection import select_effects
from sim.reconcile.gains import estimate_gains, fit_without_effects
from sim.reconcile.held_out import HeldOutLog
from sim.reconcile.input_checks import check_logs
from sim.reconcile.model_variant import ModelVariants
from sim.reconcile.recordings import Recordings
from sim.reconcile.remarks import list_remarks, select_reported_rounds
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.story import NOTHING_MISSING, Story
from sim.reconcile.thresholds import SEARCH_BUDGET
from sim.reconcile.verdict import reach_verdict

__all__ = ["DamagedInterval", "Story", "reconcile"]


def reconcile(
    log: Log,
    *,
    validation: Log | None = None,
    held_out: Log | None = None,
    type: str,  # noqa: A002 - the field's own word
    travel: float | None = None,
    damages: Mapping[str, Sequence[DamagedInterval]] | None = None,
    effort: float = 1.0,
    progress: Callable[[str, float], None] = lambda _, __: None,
    is_stopped: Callable[[], bool] = lambda: False,
) -> Story:
    """Compare logs with the model of their mechanism and name the effects that it lacks.

    Args:
        log: runs to fit, the four tests at least.
        validation: other runs, by which an effect is admitted; None: each run is predicted by the
            others.
        held_out: runs on which the gap is shown, and which may refute an effect; None shows the
            validation, or the log itself.
        type: the base model: ``simple``, ``elevator`` or ``arm``.
        travel: [log's unit] from stop to stop, if known.
        damages: ``log``, ``validation``, ``held_out`` -> what an inspection found there.
        effort: [1] how many times ``SEARCH_BUDGET`` samples the search may simulate. Then it stops
            with the best model so far, and the headline says so.
        progress: called with a step's description and the share done [1].
        is_stopped: asked now and then; if True, the search stops as at the end of its effort.

    Raises:
        BadRequest: an unknown type, logs that do not fit together, or a travel far too short.
        NotIdentifiable: nothing moves, or too little was recorded; the message says what to record.

    Examples:
        >>> from numpy.random import default_rng
        >>> from sim.bench.mechanisms import MECHANISMS
        >>> from sim.bench.routine import Routine
        >>> from sim.bench.simulate import simulate
        >>> robot = MECHANISMS["drivetrain"].hide("velocity-filter", 2.0)
        >>> log = simulate(robot, Routine(ramp=2.0, step=5.0, timeout=2.0), rng=default_rng(0))
        >>> story = reconcile(log, type="simple")
        >>> story.findings[0].effect
        'velocity-filter'
    """
    refuse_unknown("type", type, TYPES)
    damage = judge_damage(damages or {})
    recordings = Recordings(log, validation, held_out, type=type, damage=damage)
    check_logs(recordings, travel=travel)
    problem = recordings.make_problem()
    folds, budget = make_data_folds(problem, recordings), effort * SEARCH_BUDGET
    shown = HeldOutLog.choose(recordings)
    progress("base model", 0.05)
    base = fit_base_model(problem, recordings)
    data = SelectionData(recordings.fitted_runs, problem, folds, progress, budget, is_stopped)
    rounds = select_effects(data, base)
    complete = not data.is_budget_spent()  # before the refits that follow
    rounds = remove_needless_effects(data, rounds)
    progress("what remains", 0.9)
    return _make_story(problem, rounds, shown, recordings, complete=complete)


def _make_story(
    problem: PredictionErrorProblem,
    rounds: Sequence[SelectionRound],
    shown: HeldOutLog,
    recordings: Recordings,
    *,
    complete: bool,
) -> Story:
    """The story of a selection.

    Args:
        problem: the measurements.
        rounds: the base model and the selection rounds.
        shown: the log that the gap is shown on.
        recordings: all logs.
        complete: whether the search ended before its budget.
    """
    unit = recordings.unit
    chapters = shown.make_chapters(rounds)
    residuals = ResidualSummary.summarize(problem, rounds[-1].candidate.estimate)
    findings, judged, refuted = make_findings(
        problem, rounds, recordings.damage.reported, chapters,
        without=shown.measure_gaps_without(rounds), residuals=residuals, unit=unit,
    )  # fmt: skip
    reported = select_reported_rounds(rounds, findings)
    chapters = chapters[: len(reported)]
    log_notes = shown.notes(reported[-1], chapters[-1].gap)
    gains = gains_without = fit_without_effects(recordings, problem, rounds[0].candidate.estimate)
    if any(one.kind == "effect" for one in findings):
        gains = estimate_gains(problem, reported[-1].candidate.estimate, unit)
    verdict, remainder, remains = reach_verdict(
        findings,
        rounds,
        problem,
        residuals=residuals,
        complete=complete,
        refuted=refuted,
        unit=unit,
    )
    if remainder and verdict != NOTHING_MISSING:
        findings += make_suspicions(recordings.damage.suspected, findings, chapters[0].gap)
    return Story(
        verdict=verdict, findings=findings, remainder=remainder, remains=remains,
        noise_floor=shown.noise_floor,
        gap_before=chapters[0].gap, gap_after=chapters[-1].gap,
        where=shown.find_gap_places(chapters[0]),
        chapters=chapters, shown=shown.log, how=shown.usage,
        gains=gains, gains_without=gains_without,
        notes=(*list_remarks(problem, rounds, findings, judged, residuals), *log_notes),
        compared=tuple(one.measurements.informative for one in shown.problem.records),
        judged=judged,
        complete=complete,
        variants=ModelVariants(recordings, problem, reported[-1].candidate, shown),
    )  # fmt: skip
