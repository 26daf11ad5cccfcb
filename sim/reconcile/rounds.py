"""Round by round: try every suspect, admit one that narrows the gap, refit everything, go on."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from sim.effects import EFFECTS
from sim.evidence import gather
from sim.log import Log
from sim.reconcile.descent import settle
from sim.reconcile.gates import Fold, Gap, outside
from sim.reconcile.problem import Point, Problem
from sim.reconcile.story import Tried
from sim.reconcile.suspects import Seeds, Suspect, judged, suspects
from sim.reconcile.thresholds import (
    AS_GOOD,
    CLOSE,
    MOST,
    MOST_QUIET,
    NARROWER,
    NOT_WIDER,
    SIMPLER,
    SURE,
    SURER,
)

HARDLY = "hardly narrows the gap"
PART = 0.5  # [1] of the score of a quiet effect, which an admitted one must have to go before it
SECOND_THOUGHTS = 2  # times that an earlier effect may give way to another
TINY = 1e-300  # no gap at all
ALIKE = 0.3  # [of the best score in its round] from which an effect looked alike
Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Round:
    """A model, and what was tried on top of it.

    Args:
        suspect: the model, and the effect that made it of the one before; empty for the base.
        gap: outside of what was fitted.
        before: the gap without that effect; the same for the base.
        rivals: effects that would have explained as much.
        tried: the suspects of the next round.
        quiet: effects of the model that make the log likelier and hardly narrow the gap.
        plain: the model before the first of those; None if there are none.
        seeds: parameters of the suspects that were likelier than nothing, of all rounds so far.
        lost: [of -2 log L] what the last model would lose without this effect; nan if not asked.
        bare: the gap of the last model without this effect; None if not asked.
    """

    suspect: Suspect
    gap: Gap
    before: Gap
    rivals: tuple[str, ...] = ()
    tried: tuple[Tried, ...] = ()
    quiet: int = 0
    plain: Suspect | None = None
    seeds: Seeds = field(default_factory=dict)
    lost: float = math.nan
    bare: Gap | None = None


@dataclass(frozen=True, eq=False)
class _Weighed:
    suspect: Suspect
    gap: Gap
    tried: Tried


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
    done = [Round(judged(problem, base), gap, gap)]
    for _ in range(SECOND_THOUGHTS + 1):
        done = _added(problem, done, log, parts, progress)
        thought = _reconsidered(problem, done, log, parts) if len(done) > 2 else done  # noqa: PLR2004 - two effects may have masked another
        if thought is done:
            break
        done = thought
    return _missed(problem, done, parts)


def _added(
    problem: Problem, done: list[Round], log: Log, parts: Sequence[Fold], progress: Progress
) -> list[Round]:
    """The same, and a round for each effect that narrows the gap."""
    done = list(done)
    while len(done) <= MOST:
        progress(f"round {len(done)}: every suspect", 0.1 + 0.7 * len(done) / (MOST + 1))
        now = done[-1]
        weighed = _weighed(problem, now, log, parts)
        tried = tuple(one.tried for one in weighed)
        done[-1] = now = replace(now, tried=tried, seeds={**now.seeds, **_seeds(weighed)})
        admitted = [one for one in weighed if one.tried.admitted]
        quiet = [one for one in weighed if one.tried.why == HARDLY][: MOST_QUIET - now.quiet]
        if quiet and not any(one.tried.score > PART * quiet[0].tried.score for one in admitted):
            done[-1] = _with_quiet(now, quiet[0])
            continue
        if not admitted:
            break
        best = _simplest(admitted)
        rivals = _rivals(best, weighed)
        done.append(
            Round(best.suspect, best.gap, now.gap, rivals, quiet=now.quiet, seeds=now.seeds)
        )
    return done


def _seeds(weighed: Sequence["_Weighed"]) -> Seeds:
    """What the suspects' parameters are, of those that explain something."""
    found = {}
    for one in weighed:
        if one.tried.score >= SURE:
            name, values = one.suspect.effect, one.suspect.point.values
            found[name] = {f"{name}.{p}": values[f"{name}.{p}"] for p in EFFECTS[name].names}
    return found


def _with_quiet(now: Round, best: "_Weighed") -> Round:
    """A round whose model has one effect more, which nobody names."""
    suspect = replace(best.suspect, effect=now.suspect.effect)
    plain = now.plain or now.suspect
    return replace(now, suspect=suspect, gap=best.gap, quiet=now.quiet + 1, plain=plain)


def shown_of(one: Round) -> Point:
    """The model of a round that is shown: of the base, the one without quiet effects."""
    plain = one.plain if one.plain and not one.plain.effect else None
    return (plain or one.suspect).point


def _missed(problem: Problem, done: list[Round], parts: Sequence[Fold]) -> list[Round]:
    """The same, each with what the last model would be without its effect."""
    if len(done) <= 2:  # noqa: PLR2004 - one effect: what it brought is what it is worth
        return done
    last = done[-1].suspect
    told = [done[0]]
    for one in done[1:]:
        reduced = without(problem, last, one.suspect.effect)
        gap = outside(problem, reduced.point, parts)
        told.append(replace(one, lost=reduced.score - last.score, bare=gap))
    return told


def _reconsidered(
    problem: Problem, done: list[Round], log: Log, parts: Sequence[Fold]
) -> list[Round]:
    """The same, with an earlier effect in another's place where that is likelier by now."""
    last = done[-1]
    for place in range(1, len(done) - 1):
        effect = done[place].suspect.effect
        others = _others(done, place)
        if not others:
            continue
        reduced = without(problem, last.suspect, effect)
        if reduced.score - last.suspect.score < SURE:  # it has become needless
            gap = outside(problem, reduced.point, parts)
            rest = [*done[:place], *done[place + 1 : -1]]
            return [
                *rest,
                replace(last, suspect=replace(reduced, effect=last.suspect.effect), gap=gap),
            ]
        model = reduced.point.hypothesis.model(reduced.point.values)
        evidence = gather(log, dict(model.gains), type=reduced.point.hypothesis.type)
        found = suspects(problem, reduced.point, evidence, only=others, seeds=last.seeds)
        if not found or _gained(last.suspect, found[0]) < CLOSE:
            continue
        gap = outside(problem, found[0].point, parts)
        if _why_not(gap, last.gap, SURER) == "widens the gap":
            continue
        return _replaced(done, place, found[0], gap)
    return done


def _gained(now: Suspect, other: Suspect) -> float:
    """[of -2 log L] by which another model is likelier; one with fewer values wins when close."""
    fewer = now.point.hypothesis.free - other.point.hypothesis.free
    return now.score - other.score + (SIMPLER + CLOSE if fewer > 0 else 0.0)


def _others(done: Sequence[Round], place: int) -> list[str]:
    """Effects that looked like one that was added, or are known to."""
    effect = done[place].suspect.effect
    had = {one.suspect.effect for one in done}
    tried = done[place - 1].tried
    best = max((one.score for one in tried), default=0.0)
    alike = [one.effect for one in tried if one.score > ALIKE * best]
    return [name for name in dict.fromkeys([*alike, *EFFECTS[effect].apart]) if name not in had]


def _replaced(done: Sequence[Round], place: int, found: Suspect, gap: Gap) -> list[Round]:
    """The rounds with another effect in the place of one."""
    last = done[-1]
    old = done[place]
    swapped = replace(old.suspect, effect=found.effect)
    middle = [*done[:place], replace(old, suspect=swapped, rivals=()), *done[place + 1 : -1]]
    end = replace(found, effect=last.suspect.effect)
    return [*middle, replace(last, suspect=end, gap=gap, rivals=())]


def _weighed(problem: Problem, now: Round, log: Log, parts: Sequence[Fold]) -> list[_Weighed]:
    """The suspects of a round, each against the gates; the likeliest first."""
    point = now.suspect.point
    model = point.hypothesis.model(point.values)
    evidence = gather(log, dict(model.gains), type=point.hypothesis.type)
    found = []
    for suspect in suspects(problem, point, evidence, seeds=now.seeds):
        score = now.suspect.score - suspect.score
        if score < SURE:
            tried = Tried(suspect.effect, score, 1.0, admitted=False, why="explains too little")
            found.append(_Weighed(suspect, now.gap, tried))
            continue
        gap = outside(problem, suspect.point, parts)
        why = _why_not(gap, now.gap, score)
        share = gap.velocity / max(now.gap.velocity, TINY)
        tried = Tried(suspect.effect, score, share, admitted=not why, why=why)
        found.append(_Weighed(suspect, gap, tried))
    return found


def _why_not(gap: Gap, before: Gap, score: float) -> str:
    """The gate that a suspect does not pass; empty if it passes all."""
    velocity = gap.velocity / max(before.velocity, TINY)
    position = gap.position / max(before.position, TINY)
    if velocity > NOT_WIDER and (velocity * position) ** 0.5 > NOT_WIDER:
        return "widens the gap"
    if velocity > NARROWER and ((velocity * position) ** 0.5 > NARROWER or score < SURER):
        return HARDLY
    return ""


def _simplest(admitted: Sequence[_Weighed]) -> _Weighed:
    """The likeliest, or one about as likely with fewer parameters."""
    best = admitted[0]
    top = best.tried.score
    simpler = EFFECTS[best.suspect.effect].simpler
    near = [
        one
        for one in admitted
        if top - one.tried.score <= SIMPLER
        or (one.suspect.effect == simpler and one.tried.score > AS_GOOD * top)
    ]
    return min(near, key=lambda one: (one.suspect.point.hypothesis.free, -one.tried.score))


def _rivals(best: _Weighed, weighed: Sequence[_Weighed]) -> tuple[str, ...]:
    """The effects that explain about as much as the one that was taken."""
    return tuple(
        one.suspect.effect
        for one in weighed
        if one is not best and one.tried.admitted and best.tried.score - one.tried.score <= CLOSE
    )


def without(problem: Problem, suspect: Suspect, effect: str) -> Suspect:
    """A model without one of its effects, fitted anew."""
    point = suspect.point
    hypothesis = point.hypothesis - effect
    values = {name: point.values[name] for name in hypothesis.names}
    begin = problem.at(hypothesis, values, point.starts, point.q)
    return judged(problem, settle(problem, begin))


def apart(effect: str, other: str) -> str:
    """The test that tells two effects apart; empty where none is known."""
    return EFFECTS[effect].apart.get(other, "") or EFFECTS[other].apart.get(effect, "")
