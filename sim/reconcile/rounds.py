"""Round by round: try every suspect, admit one that narrows the gap, refit everything, go on."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from sim.effects import EFFECTS
from sim.evidence import gather
from sim.log import Log
from sim.reconcile.descent import settle
from sim.reconcile.gates import Fold, Gap, outside
from sim.reconcile.problem import Point, Problem
from sim.reconcile.story import Tried
from sim.reconcile.suspects import Suspect, judged, suspects
from sim.reconcile.thresholds import CLOSE, MOST, NARROWER, NOT_WIDER, SIMPLER, SURE

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
    """

    suspect: Suspect
    gap: Gap
    before: Gap
    rivals: tuple[str, ...] = ()
    tried: tuple[Tried, ...] = ()


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
    while len(done) <= MOST:
        progress(f"round {len(done)}: every suspect", 0.1 + 0.7 * len(done) / (MOST + 1))
        now = done[-1]
        weighed = _weighed(problem, now, log, parts)
        done[-1] = replace(now, tried=tuple(one.tried for one in weighed))
        admitted = [one for one in weighed if one.tried.admitted]
        if not admitted:
            break
        best = _simplest(admitted)
        done.append(Round(best.suspect, best.gap, now.gap, _rivals(best, weighed)))
    return done


def _weighed(problem: Problem, now: Round, log: Log, parts: Sequence[Fold]) -> list[_Weighed]:
    """The suspects of a round, each against the gates; the likeliest first."""
    point = now.suspect.point
    model = point.hypothesis.model(point.values)
    evidence = gather(log, dict(model.gains), type=point.hypothesis.type)
    found = []
    for suspect in suspects(problem, point, evidence):
        score = now.suspect.score - suspect.score
        if score < SURE:
            tried = Tried(suspect.effect, score, 1.0, admitted=False, why="explains too little")
            found.append(_Weighed(suspect, now.gap, tried))
            continue
        gap = outside(problem, suspect.point, parts)
        why = _why_not(gap, now.gap)
        share = gap.velocity / now.gap.velocity
        tried = Tried(suspect.effect, score, share, admitted=not why, why=why)
        found.append(_Weighed(suspect, gap, tried))
    return found


def _why_not(gap: Gap, before: Gap) -> str:
    """The gate that a suspect does not pass; empty if it passes all."""
    velocity, position = gap.velocity / before.velocity, gap.position / before.position
    if velocity > NOT_WIDER and (velocity * position) ** 0.5 > NOT_WIDER:
        return "widens the gap"
    if (velocity * position) ** 0.5 > NARROWER and velocity > NARROWER:
        return "hardly narrows the gap"
    return ""


def _simplest(admitted: Sequence[_Weighed]) -> _Weighed:
    """The likeliest, or one about as likely with fewer parameters."""
    best = admitted[0]
    near = [one for one in admitted if best.tried.score - one.tried.score <= SIMPLER]
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
    return judged(problem, settle(problem, problem.at(hypothesis, values, point.starts, point.q)))


def apart(effect: str, other: str) -> str:
    """The test that tells two effects apart; empty where none is known."""
    return EFFECTS[effect].apart.get(other, "") or EFFECTS[other].apart.get(effect, "")
