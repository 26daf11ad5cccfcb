"""Forward selection: try every candidate, add the best, refit, repeat."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import ENOUGH
from sim.physics.effects import EFFECTS
from sim.reconcile.backward_elimination import simplify_effects
from sim.reconcile.candidates import Seeds, score_estimate
from sim.reconcile.cross_validation import (
    compute_missed_motion,
    compute_validation_gap,
    count_noise_floors,
)
from sim.reconcile.local_minimum import minimize, minimize_fully
from sim.reconcile.model_selection import (
    choose_next,
    is_ordinary_size,
    is_wider,
    list_blocked_candidates,
    list_rivals,
    weigh_candidates,
)
from sim.reconcile.onset_scan import flip_duration, refine_onset
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound, WeighedCandidate
from sim.reconcile.thresholds import (
    COMPARABLE,
    EQUAL_SCORE,
    LEAST_SCORE,
    LOST,
    MAJOR,
    MAJOR_UNEXPLAINED,
    MOST_EFFECTS,
    UNDRIVEN,
    VISIBLE_FLOORS,
)


def select_effects(data: SelectionData, base: Estimate) -> list[SelectionRound]:
    """The base model, then one round for each effect that was added.

    Args:
        data: the measurements.
        base: the best estimate without effects.
    """
    gap = compute_validation_gap(data.problem, base, data.folds)
    rounds = _add_effects(data, [SelectionRound.make_base(score_estimate(data.problem, base), gap)])
    rounds = choose_path(data, add_pair(data, rounds))
    return simplify_effects(data, rounds)


def add_pair(data: SelectionData, rounds: list[SelectionRound]) -> list[SelectionRound]:
    """Add a candidate that widens the gap, if further effects then close much of it.

    Of a spring and a current limit, the model with the spring alone is far likelier, but predicts
    other runs worse until the limit is added, too.
    """
    now = rounds[-1]
    blocked = list_blocked_candidates(now.candidates)
    if not blocked or len(rounds) >= MOST_EFFECTS or not math.isfinite(blocked[0].gap.velocity):
        return rounds
    path = _add_effects(data, [*rounds, _make_next_round(now, blocked[0])])
    closes = path[-1].gap.velocity <= MAJOR * now.gap.velocity
    return path if closes and not is_wider(path[-1].gap, now.gap) else rounds


def choose_path(data: SelectionData, rounds: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, or those of an alternative path if the model at its end is better.

    The first effect that is added may resemble two others at once, and mask both.
    """
    if count_noise_floors(rounds[-1].gap.velocity, data.problem) <= VISIBLE_FLOORS:
        return rounds
    start = find_alternative(rounds, by_gap=_is_dead_end(data.problem, rounds))
    if not start:
        return rounds
    path = _add_effects(data, start)
    likelier = path[-1].candidate.bic < rounds[-1].candidate.bic
    return path if likelier and not is_wider(path[-1].gap, rounds[-1].gap) else rounds


def find_alternative(rounds: Sequence[SelectionRound], *, by_gap: bool) -> list[SelectionRound]:
    """The start of an alternative path: the first rounds, and a candidate that was nearly added.

    An effect that resembles two others at once scores as much as both of them together.

    Args:
        rounds: the path.
        by_gap: whether to take the candidate with the smallest gap instead of the likeliest.

    Returns:
        The rounds; none if no other candidate came close.
    """
    for place, (one, added) in enumerate(pairwise(rounds)):
        admitted = [other for other in one.candidates if other.report.admitted]
        top = max((other.report.improvement for other in admitted), default=0.0)
        near = [
            other
            for other in admitted
            if other.report.improvement >= COMPARABLE**2 * top
            and other.candidate.effect != added.candidate.effect
        ]
        if near:
            likeliest = max(near, key=lambda other: other.report.improvement)
            nearest = min(near, key=lambda other: other.report.gap_ratio)
            return [*rounds[: place + 1], _make_next_round(one, nearest if by_gap else likeliest)]
    return []


def _add_effects(data: SelectionData, rounds: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, and one more for each added effect, until no candidate is admissible."""
    rounds = list(rounds)
    while len(rounds) <= MOST_EFFECTS and not _is_dead_end(data.problem, rounds):
        data.progress(
            f"round {len(rounds)}: every candidate", 0.1 + 0.7 * len(rounds) / (MOST_EFFECTS + 1)
        )
        now = rounds[-1]
        weighed = weigh_candidates(data, now)
        seeds = {**now.seeds, **_collect_seeds(weighed)}
        rounds[-1] = now = replace(now, seeds=seeds, candidates=tuple(weighed))
        admitted = select_admissible(weighed)
        if not admitted:
            break
        chosen = choose_next(admitted)
        best, near = _finish_search(data, chosen), list_rivals(chosen, weighed)
        if best is not chosen:
            most = best.candidate.bic + EQUAL_SCORE
            near = [one for one in near if _finish_search(data, one).candidate.bic <= most]
        rivals = tuple(one.candidate.effect for one in near)
        rounds.append(replace(_make_next_round(now, best), rivals=rivals))
    return rounds


def _make_next_round(now: SelectionRound, added: WeighedCandidate) -> SelectionRound:
    """The round after ``now``, whose model is a candidate of ``now``."""
    return SelectionRound(added.candidate, added.gap, now.candidate, now.gap, seeds=now.seeds)


def select_admissible(weighed: Sequence[WeighedCandidate]) -> list[WeighedCandidate]:
    """Candidates that may be added next.

    If an everyday effect is nearly the likeliest, it alone is admissible: only with it in the model
    are the scores of the others reliable. A current limit, for example, resembles a delay and a
    weak battery together more than each of these does.

    Args:
        weighed: the candidates of a round, the likeliest first.
    """
    admitted = [one for one in weighed if one.report.admitted]
    for one in admitted:
        if one.report.improvement < COMPARABLE * admitted[0].report.improvement:
            break
        if is_ordinary_size(one.candidate.effect, one.candidate.estimate.values):
            return [one]
    return admitted


def _is_dead_end(problem: PredictionErrorProblem, rounds: Sequence[SelectionRound]) -> bool:
    """Whether a model misses more than ``LOST`` of the motion, and further effects cannot help.

    They cannot if the voltage does not drive the base model, or the last effect hardly narrowed the
    gap. Nothing would be reported of such a model, and candidates would take minutes to try.
    """
    now = rounds[-1]
    share = compute_missed_motion(now.gap.velocity, problem)
    if share <= LOST:
        return False
    values = now.candidate.estimate.values
    if len(rounds) == 1:
        return values["kA"] > UNDRIVEN * values["kV"]
    return not now.gap.velocity <= MAJOR_UNEXPLAINED * now.gap_without.velocity


def _finish_search(data: SelectionData, best: WeighedCandidate) -> WeighedCandidate:
    """The candidate after a full search, or as it was if that widens its gap or changes little."""
    candidate, problem = best.candidate, data.problem
    point = minimize_fully(problem, candidate.estimate)
    for other in flip_duration(problem, point):
        found = minimize(problem, other)
        if found.cost < point.cost - EQUAL_SCORE:
            point = found
    near = refine_onset(problem, point)
    if near is not point:
        point = minimize(problem, near)
    if abs(candidate.estimate.cost - point.cost) < ENOUGH:
        return best
    gap = compute_validation_gap(problem, point, data.folds)
    if is_wider(gap, best.gap):
        return best
    return replace(best, candidate=score_estimate(problem, point, candidate.effect), gap=gap)


def _collect_seeds(weighed: Sequence[WeighedCandidate]) -> Seeds:
    """The parameter values of the candidates whose score is at least ``LEAST_SCORE``."""
    found = {}
    for one in weighed:
        if one.report.improvement >= LEAST_SCORE:
            name, values = one.candidate.effect, one.candidate.estimate.values
            found[name] = {f"{name}.{p}": values[f"{name}.{p}"] for p in EFFECTS[name].names}
    return found
