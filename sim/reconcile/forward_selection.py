"""Forward selection: try every candidate, add the best, refit, repeat."""

import math
from collections.abc import Sequence
from dataclasses import replace

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import ENOUGH
from sim.physics.effects import EFFECTS
from sim.reconcile.backward_elimination import replace_effects, simplify_effects
from sim.reconcile.candidates import Seeds, score_estimate
from sim.reconcile.cross_validation import (
    compute_missed_motion,
    compute_validation_gap,
    count_noise_floors,
)
from sim.reconcile.local_minimum import minimize, minimize_fully
from sim.reconcile.model_selection import (
    choose_simplest,
    compare_scores,
    is_ordinary_size,
    is_wider,
    list_blocked_candidates,
    list_rivals,
    weigh_candidates,
)
from sim.reconcile.onset_scan import flip_duration, refine_onset
from sim.reconcile.search_effort import ROUNDS
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
    NARROWER,
    UNDRIVEN,
    VISIBLE_FLOORS,
)

SECOND_PATH = 0.85  # [1] of all that is to be done, while another path is gone


def select_effects(data: SelectionData, base: Estimate) -> list[SelectionRound]:
    """The base model, then one round for each effect that was added.

    Args:
        data: the measurements.
        base: the best point without effects.
    """
    gap = compute_validation_gap(data.problem, base, data.folds)
    done = _continue_search(data, [SelectionRound(score_estimate(data.problem, base), gap, gap)])
    done = add_pair(data, done)
    done = choose_path(data, done)
    done = simplify_effects(data, done)
    return take_nearest(done) if data.out_of_time() else done


def _continue_search(data: SelectionData, done: list[SelectionRound]) -> list[SelectionRound]:
    """The same, gone on until nothing is to be added and no earlier effect gives way."""
    for _ in range(ROUNDS):
        done = _add_effects(data, done)
        thought = replace_effects(data, done) if len(done) > 2 else done  # noqa: PLR2004 - two effects may have masked another
        if thought is done:
            break
        done = thought
    return done


def take_nearest(done: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, with the last effect replaced by the one that left the smallest gap.

    What any robot has a little of goes first, since the next round finds the rest. Where there is
    no time for a next round, what closes clearly more of the gap matters more.
    """
    if len(done) == 1 or done[-1].candidates:
        return done
    admitted = [one for one in done[-2].candidates if one.report.admitted]
    nearest = min(admitted, key=lambda one: one.gap.velocity, default=None)
    if nearest is None or not nearest.gap.velocity < NARROWER * done[-1].gap.velocity:
        return done
    return [*done[:-1], _next_round(done[-2], nearest)]


def add_pair(data: SelectionData, done: list[SelectionRound]) -> list[SelectionRound]:
    """Add two effects where one alone is likelier and yet widens the gap.

    What a spring gives back may be hidden by a limit that nobody has named, and misses more than no
    spring until that is there, too. Such a pair has to close much of the gap.
    """
    now = done[-1]
    found = list_blocked_candidates(now.candidates)
    if not found or len(done) >= MOST_EFFECTS or not math.isfinite(found[0].gap.velocity):
        return done
    path = _continue_search(_on_another_path(data), [*done, _next_round(now, found[0])])
    closes = path[-1].gap.velocity <= MAJOR * now.gap.velocity
    narrows = closes and not is_wider(path[-1].gap, now.gap)
    new = {other.candidate.effect for other in path} - {other.candidate.effect for other in done}
    return path if narrows and len(new) > 1 else done  # what was there may have become needless


def choose_path(data: SelectionData, done: list[SelectionRound]) -> list[SelectionRound]:
    """Try one alternative path where the greedy one led astray; the better is returned."""
    best, problem = done, data.problem
    if len(done) == 1 or count_noise_floors(done[-1].gap.velocity, problem) <= VISIBLE_FLOORS:
        return best
    for place, other in list_alternative_paths(done, lost=_is_dead_end(problem, done))[:1]:
        path = [*done[: place + 1], _next_round(done[place], other)]
        path = _continue_search(_on_another_path(data), path)
        likelier = compare_scores(best[-1].candidate, path[-1].candidate) >= EQUAL_SCORE
        if likelier and not is_wider(path[-1].gap, best[-1].gap):
            best = path
    return best


def list_alternative_paths(
    done: Sequence[SelectionRound], *, lost: bool
) -> list[tuple[int, WeighedCandidate]]:
    """Rounds in which another effect came close, and that effect.

    What is taken first masks what comes after it; later choices have their second thoughts. Where
    a path is lost, what was likeliest has led astray: the next one goes by the gap.

    Args:
        done: the path.
        lost: whether it leads nowhere.
    """
    gone = {frozenset(one.candidate.effect for one in done[: n + 1]) for n in range(len(done))}
    found = []
    for place, one in enumerate(done[:-1]):
        had = {before.candidate.effect for before in done[: place + 1]}
        admitted = [other for other in one.candidates if other.report.admitted]
        top = max((other.report.improvement for other in admitted), default=0.0)
        # an effect that resembles two others at once scores as much as both of them together
        near = [other for other in admitted if other.report.improvement >= COMPARABLE**2 * top]
        near.sort(key=lambda other: other.report.gap_ratio if lost else -other.report.improvement)
        for other in near:
            names = frozenset({*had, other.candidate.effect})
            if names not in gone:
                gone.add(names)
                found.append((place, other))
    return found


def _add_effects(data: SelectionData, done: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, with one more for each effect that narrows the gap."""
    done = list(done)
    while len(done) <= MOST_EFFECTS and not _is_dead_end(data.problem, done):
        data.progress(
            f"round {len(done)}: every suspect", 0.1 + 0.7 * len(done) / (MOST_EFFECTS + 1)
        )
        now = done[-1]
        weighed = weigh_candidates(data, now)
        seeds = {**now.seeds, **_collect_seeds(weighed)}
        done[-1] = now = replace(now, seeds=seeds, candidates=tuple(weighed))
        admitted = select_admissible(weighed)
        if not admitted:
            break
        chosen = choose_simplest(admitted)
        best, near = _finish_search(data, chosen), list_rivals(chosen, weighed)
        if best is not chosen:
            near = [one for one in near if _is_close(_finish_search(data, one), best)]
        rivals = tuple(one.candidate.effect for one in near)
        done.append(replace(_next_round(now, best), rivals=rivals))
    return done


def _next_round(now: SelectionRound, added: WeighedCandidate) -> SelectionRound:
    """The round that begins with a candidate of the one before."""
    return SelectionRound(added.candidate, added.gap, now.gap, seeds=now.seeds)


def _on_another_path(data: SelectionData) -> SelectionData:
    """The same data, with a progress that waits where the first path ended."""
    return replace(data, progress=lambda what, _: data.progress(what, SECOND_PATH))


def select_admissible(weighed: Sequence[WeighedCandidate]) -> list[WeighedCandidate]:
    """Candidates that may be added next.

    What any robot has a little of goes first, and alone, if it is nearly the likeliest: beside it
    the others are seen as they are. A limit of the current resembles a late command and a weak
    battery together more than each of them does alone.

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


def _is_dead_end(problem: PredictionErrorProblem, done: Sequence[SelectionRound]) -> bool:
    """Whether a model misses most of the motion, and its last effect hardly improved that.

    Nothing would be reported of such a model, and further effects would take minutes to try.
    """
    now = done[-1]
    share = compute_missed_motion(now.gap.velocity, problem)
    if share <= LOST:
        return False
    values = now.candidate.estimate.values
    if len(done) == 1:
        return values["kA"] > UNDRIVEN * values["kV"]
    return not now.gap.velocity <= MAJOR_UNEXPLAINED * now.gap_before.velocity


def _finish_search(data: SelectionData, best: WeighedCandidate) -> WeighedCandidate:
    """The same, as far as its search leads: candidates are only compared, the one taken goes on."""
    candidate, problem = best.candidate, data.problem
    point = minimize_fully(problem, candidate.estimate)
    for other in flip_duration(problem, point):
        settled = minimize(problem, other)
        if settled.cost < point.cost - EQUAL_SCORE:
            point = settled
    near = refine_onset(problem, point)
    if near is not point:
        point = minimize(problem, near)
    if abs(candidate.estimate.cost - point.cost) < ENOUGH:
        return best
    gap = compute_validation_gap(problem, point, data.folds)
    if is_wider(gap, best.gap):
        return best
    return replace(best, candidate=score_estimate(problem, point, candidate.effect), gap=gap)


def _is_close(other: WeighedCandidate, best: WeighedCandidate) -> bool:
    return other.candidate.bic - best.candidate.bic <= EQUAL_SCORE


def _collect_seeds(weighed: Sequence[WeighedCandidate]) -> Seeds:
    """What the candidates' parameters are, of those that explain something."""
    found = {}
    for one in weighed:
        if one.report.improvement >= LEAST_SCORE:
            name, values = one.candidate.effect, one.candidate.estimate.values
            found[name] = {f"{name}.{p}": values[f"{name}.{p}"] for p in EFFECTS[name].names}
    return found
