"""Round by round: try every suspect, admit one that narrows the gap, refit everything, go on."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from sim.effects import EFFECTS
from sim.log import Log
from sim.reconcile.descent import ENOUGH, ended, settle
from sim.reconcile.gates import Fold, missed, outside
from sim.reconcile.once import closer, otherwise
from sim.reconcile.problem import Point, Problem
from sim.reconcile.round import Round, Weighed
from sim.reconcile.second_thoughts import missed_by, reconsidered, simplified
from sim.reconcile.suspects import Seeds, judged
from sim.reconcile.thresholds import (
    CLOSE,
    FAR_MAJOR,
    LOST,
    MAJOR,
    MOST,
    MOST_QUIET,
    NEAR,
    PART,
    PATHS,
    STRAYS,
    SURE,
    SURER,
    UNDRIVEN,
    USUAL,
)
from sim.reconcile.weighing import (
    HARDLY,
    WIDENS,
    blocked,
    everyday,
    gained,
    rivals,
    simplest,
    weigh,
    why_not,
    worth_a_name,
)

SECOND_THOUGHTS = 2  # times that an earlier effect may give way to another
BESIDE = 0.85  # [1] of all that is to be done, while another path is gone
Progress = Callable[[str, float], None]


def rounds(
    problem: Problem, base: Point, log: Log, parts: Sequence[Fold], progress: Progress
) -> list[Round]:
    """The base, then a round for each effect that was added.

    Args:
        problem: the measurements of all that may be fitted.
        base: the best point without effects.
        log: the runs of the problem.
        parts: what predicts what.
        progress: told what is done.
    """
    gap = outside(problem, base, parts)
    done = _gone(problem, [Round(judged(problem, base), gap, gap)], log, parts, progress)
    done = paired(problem, done, log, parts, progress)
    done = best_path(problem, done, log, parts, progress)
    done = simplified(problem, done, log, parts)
    return missed_by(problem, done, parts)


def _gone(
    problem: Problem, done: list[Round], log: Log, parts: Sequence[Fold], progress: Progress
) -> list[Round]:
    """The same, gone on until nothing is to be added and no earlier effect gives way."""
    for _ in range(SECOND_THOUGHTS + 1):
        done = _added(problem, done, log, parts, progress)
        thought = reconsidered(problem, done, log, parts) if len(done) > 2 else done  # noqa: PLR2004 - two effects may have masked another
        if thought is done:
            break
        done = thought
    return done


def paired(
    problem: Problem, done: list[Round], log: Log, parts: Sequence[Fold], progress: Progress
) -> list[Round]:
    """The same; or with two effects of which one alone is far likelier, and yet widens the gap.

    What a spring gives back may be hidden by a limit that nobody has named, and misses more than no
    spring until that is there, too. Such a pair has to close much of the gap.
    """
    now = done[-1]
    found = blocked(now.weighed)
    if not found or len(done) >= MOST or not math.isfinite(found[0].gap.velocity):
        return done
    one = found[0]
    begun = Round(one.suspect, one.gap, now.gap, quiet=now.quiet, seeds=now.seeds)
    path = _gone(problem, [*done, begun], log, parts, lambda what, _: progress(what, BESIDE))
    closes = path[-1].gap.velocity <= MAJOR * now.gap.velocity
    narrows = closes and why_not(path[-1].gap, now.gap, SURER) != WIDENS
    new = {other.suspect.effect for other in path} - {other.suspect.effect for other in done}
    return path if narrows and len(new) > 1 else done  # what was there may have become needless


def best_path(
    problem: Problem, done: list[Round], log: Log, parts: Sequence[Fold], progress: Progress
) -> list[Round]:
    """The same; or, where that led astray, a path that turned off it and came nearer."""
    best = done
    if len(done) == 1 or done[-1].gap.velocity <= STRAYS * problem.noise.velocity:
        return best
    for place, other in turnings(done, lost=_leads_nowhere(problem, done))[:PATHS]:
        now = done[place]
        begun = Round(other.suspect, other.gap, now.gap, quiet=now.quiet, seeds=now.seeds)
        path = [*done[: place + 1], begun]
        path = _gone(problem, path, log, parts, lambda what, _: progress(what, BESIDE))
        likelier = gained(best[-1].suspect, path[-1].suspect) >= CLOSE
        if likelier and why_not(path[-1].gap, best[-1].gap, SURER) != WIDENS:
            best = path
    return best


def turnings(done: Sequence[Round], *, lost: bool) -> list[tuple[int, Weighed]]:
    """Rounds in which another effect came near, and that effect: the first ones first.

    What is taken first masks what comes after it; later choices have their second thoughts. Where
    a path is lost, what was likeliest has led astray: the next one goes by the gap.

    Args:
        done: the path.
        lost: whether it leads nowhere.
    """
    gone = {frozenset(one.suspect.effect for one in done[: n + 1]) for n in range(len(done))}
    found = []
    for place, one in enumerate(done[:-1]):
        had = {before.suspect.effect for before in done[: place + 1]}
        admitted = [other for other in one.weighed if other.tried.admitted]
        top = max((other.tried.score for other in admitted), default=0.0)
        near = [other for other in admitted if other.tried.score >= NEAR * top]
        near.sort(key=lambda other: other.tried.gap if lost else -other.tried.score)
        for other in near:
            names = frozenset({*had, other.suspect.effect})
            if names not in gone:
                gone.add(names)
                found.append((place, other))
    return found


def _added(
    problem: Problem, done: list[Round], log: Log, parts: Sequence[Fold], progress: Progress
) -> list[Round]:
    """The same, and a round for each effect that narrows the gap."""
    done = list(done)
    while len(done) <= MOST and not _leads_nowhere(problem, done):
        progress(f"round {len(done)}: every suspect", 0.1 + 0.7 * len(done) / (MOST + 1))
        now = done[-1]
        weighed = weigh(problem, now, log, parts)
        tried = tuple(one.tried for one in weighed)
        seeds = {**now.seeds, **_seeds(weighed)}
        done[-1] = now = replace(now, tried=tried, seeds=seeds, weighed=tuple(weighed))
        admitted, quiet = offered(weighed, most=MOST_QUIET - now.quiet)
        if quiet and not any(one.tried.score > PART * quiet[0].tried.score for one in admitted):
            one = quiet[0]
            if worth_a_name(one.suspect.effect, one.suspect.point.values, one.tried.score):
                done.append(Round(one.suspect, one.gap, now.gap, quiet=now.quiet, seeds=now.seeds))
            else:
                done[-1] = _with_quiet(now, one)
            continue
        if not admitted:
            break
        chosen = simplest(admitted)
        best, near = _ended(problem, chosen, parts), rivals(chosen, weighed)
        if best is not chosen:
            near = [one for one in near if _near(_ended(problem, one, parts), best)]
        done.append(
            Round(
                best.suspect,
                best.gap,
                now.gap,
                tuple(one.suspect.effect for one in near),
                quiet=now.quiet,
                seeds=now.seeds,
            )
        )
    return done


def offered(weighed: Sequence[Weighed], *, most: int) -> tuple[list[Weighed], list[Weighed]]:
    """What may be added: what is admitted, and what is likely and hardly narrows the gap.

    What any robot has a little of goes first, and alone, if it is nearly the likeliest: beside it
    the others are seen as they are. A limit of the current resembles a late command and a weak
    battery together more than each of them does alone.

    Args:
        weighed: the suspects of a round.
        most: how many may be added without a name.
    """
    admitted = [one for one in weighed if one.tried.admitted]
    quiet = [one for one in weighed if one.tried.why == HARDLY and one.tried.score >= SURER][:most]
    every = sorted([*admitted, *quiet], key=lambda one: -one.tried.score)
    usual = [one for one in every if everyday(one.suspect.effect, one.suspect.point.values)]
    if usual and usual[0].tried.score >= USUAL * every[0].tried.score:
        admitted = [one for one in admitted if one is usual[0]]
        quiet = [one for one in quiet if one is usual[0]]
    return admitted, quiet


def _leads_nowhere(problem: Problem, done: Sequence[Round]) -> bool:
    """Whether the model is lost, and has nothing to add to, or its last effect took little away.

    Of such a model nothing is told in the end, and it may take minutes to see four effects of it.
    """
    now = done[-1]
    share = missed(now.gap.velocity / problem.noise.velocity, problem)
    if share <= LOST:
        return False
    values = now.suspect.point.values
    if len(done) == 1:
        return values["kA"] > UNDRIVEN * values["kV"]
    return not now.gap.velocity <= FAR_MAJOR * now.before.velocity


def _ended(problem: Problem, best: Weighed, parts: Sequence[Fold]) -> Weighed:
    """The same, as far as its search leads: suspects are only compared, the one taken goes on."""
    suspect = best.suspect
    point = ended(problem, suspect.point)
    for other in otherwise(problem, point):
        settled = settle(problem, other)
        if settled.cost < point.cost - CLOSE:
            point = settled
    near = closer(problem, point)
    if near is not point:
        point = settle(problem, near)
    if abs(suspect.point.cost - point.cost) < ENOUGH:
        return best
    gap = outside(problem, point, parts)
    if why_not(gap, best.gap, SURER) == WIDENS:
        return best
    return replace(best, suspect=judged(problem, point, suspect.effect), gap=gap)


def _near(other: Weighed, best: Weighed) -> bool:
    return other.suspect.score - best.suspect.score <= CLOSE


def _seeds(weighed: Sequence[Weighed]) -> Seeds:
    """What the suspects' parameters are, of those that explain something."""
    found = {}
    for one in weighed:
        if one.tried.score >= SURE:
            name, values = one.suspect.effect, one.suspect.point.values
            found[name] = {f"{name}.{p}": values[f"{name}.{p}"] for p in EFFECTS[name].names}
    return found


def _with_quiet(now: Round, best: Weighed) -> Round:
    """A round whose model has one effect more, which nobody names."""
    suspect = replace(best.suspect, effect=now.suspect.effect)
    plain = now.plain or now.suspect
    return replace(now, suspect=suspect, gap=best.gap, quiet=now.quiet + 1, plain=plain)
