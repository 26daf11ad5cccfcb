"""Reconcile: find where simulation and data disagree, name what is missing, add it, show the gap.

    story = reconcile(log, validation=other, held_out=third, type="arm")

Damage to the record is set aside first. Then the base model is fitted, every effect of the
catalogue is tried on top of it, one that narrows the gap on runs it was not fitted to is added, and
everything is refitted, until none does. The held-out log is only ever shown.

After the prediction-error method (Kristensen, Madsen and Jørgensen 2004) with a catalogue of
physical effects in place of a regression's library.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from sim.errors import NotIdentifiable
from sim.fit.start import first_guess, sensible
from sim.log import Log
from sim.reconcile.aside import Aside, judge_damage
from sim.reconcile.damage import Damaged
from sim.reconcile.descent import better, ended, scanned, settle
from sim.reconcile.gates import errors_of, folds, missed, rms
from sim.reconcile.glitch import glitches
from sim.reconcile.hypothesis import Hypothesis
from sim.reconcile.lanes import SetAside, ended_after, in_a_row, lanes
from sim.reconcile.left import Left
from sim.reconcile.naming import beside, findings_of
from sim.reconcile.outset import Outset
from sim.reconcile.problem import Point, Problem
from sim.reconcile.rounds import rounds
from sim.reconcile.showing import Shown
from sim.reconcile.story import Story
from sim.reconcile.thresholds import LOST, MAJOR, WANDERS
from sim.reconcile.usable import check_logs
from sim.reconcile.verdict import verdict_of
from sim.units import unit

__all__ = ["Damaged", "Story", "reconcile"]

TRAIN, VALIDATION = "log", "validation"


def reconcile(
    log: Log,
    *,
    validation: Log | None = None,
    held_out: Log | None = None,
    type: str,  # noqa: A002 - the field's own word
    travel: float | None = None,
    damages: Mapping[str, Sequence[Damaged]] | None = None,
    progress: Callable[[str, float], None] = lambda _, __: None,
) -> Story:
    """Hold logs of a mechanism against its model, and name what the model lacks.

    Args:
        log: runs to fit, the four tests at least.
        validation: other runs, by which an effect is admitted; None: each run is predicted by the
            others.
        held_out: runs on which the gap is shown, used for nothing else; None shows the validation,
            or the log itself.
        type: the base model: ``simple``, ``elevator`` or ``arm``.
        travel: [owner's unit] from stop to stop, if known.
        damages: ``log``, ``validation``, ``held_out`` -> what an inspection found there.
        progress: told what is done, and the share of it [1].

    Raises:
        BadRequest: a log of another mechanism, or positions beyond the travel.
        NotIdentifiable: nothing moves, or too little was recorded; the message says what to record.
    """
    check_logs(log, validation, held_out, type=type, travel=travel)
    aside = judge_damage(damages or {})
    both = log if validation is None else in_a_row(log, validation)
    problem = _problem(log, validation, aside)
    progress("base model", 0.05)
    problem, base = _based(problem, log, type=type)
    if not math.isfinite(base.cost):
        raise NotIdentifiable(
            "no gains follow what is left of it once its damage is set aside",
            where=log.source,
            advice="Inspect the log, and record it anew.",
        )
    problem, base, slipped = _unslipped(problem, base)
    done = rounds(problem, base, both, folds([one.session for one in problem.lanes]), progress)
    progress("what remains", 0.9)
    shown = Shown.of({"log": log, "validation": validation, "held_out": held_out}, aside)
    chapters = shown.chapters(done)
    seen = shown.notes(chapters[-1], done[-1].gap.velocity)
    last = done[-1].suspect.point
    left = Left.by(problem, last)
    findings = findings_of(
        problem, done, _once(slipped, aside.found), chapters, left=left, per=unit(log.units)
    )
    verdict, remainder, remains = verdict_of(
        findings, done, problem, left=left, per=unit(log.units)
    )
    return Story(
        verdict=verdict, findings=findings, remainder=remainder, remains=remains,
        noise_floor=shown.noise_floor,
        gap_before=chapters[0].gap, gap_after=chapters[-1].gap,
        where=shown.places(chapters[0]), chapters=chapters, shown=shown.log, how=shown.how,
        notes=(*beside(problem, done, findings, left), *seen),
        compared=shown.compared,
    )  # fmt: skip


def _problem(log: Log, validation: Log | None, aside: Aside) -> Problem:
    """All runs that may be fitted; the clock of the second log goes on where the first ended."""
    every = lanes(log, aside=aside.of(TRAIN))
    if validation is not None:
        since = ended_after(log)
        every += lanes(validation, session=1, since=since, aside=aside.of(VALIDATION))
    return Problem.of(every)


def _unslipped(problem: Problem, base: Point) -> tuple[Problem, Point, tuple[Damaged, ...]]:
    """The same without moments at which the encoder slipped, and one of those for the findings."""
    found = list(glitches(problem, base))
    if not found:
        return problem, base, ()
    runs = list(problem.lanes)
    for number, one in found:
        runs[number] = runs[number].without(SetAside(number, one.start, one.end))
    mended = replace(problem, lanes=tuple(runs))
    begin = mended.at(base.hypothesis, base.values, base.outset, base.q)
    return mended, settle(mended, scanned(mended, begin)), (found[0][1],)


def _once(*several: Sequence[Damaged]) -> tuple[Damaged, ...]:
    """One damage of each fault."""
    found: dict[str, Damaged] = {}
    for one in (damage for some in several for damage in some):
        found.setdefault(one.fault, one)
    return tuple(found.values())


def _based(problem: Problem, log: Log, *, type: str) -> tuple[Problem, Point]:  # noqa: A002 - as above
    """The best point without effects, and the problem in which it was found.

    Where much is missing, "it goes on as it did, and is pushed wherever it goes" may follow a
    smooth log better than any physics: then pushes are bounded.
    """
    base = _base(problem, log, type=type)
    if not math.isfinite(base.cost) or _lost(problem, base) < LOST:
        return problem, base
    bound = replace(problem, most_q=(WANDERS * problem.top) ** 2)
    other = _base(bound, log, type=type)
    if math.isfinite(other.cost) and _lost(bound, other) < MAJOR * _lost(problem, base):
        return bound, other
    return problem, base


def _lost(problem: Problem, base: Point) -> float:
    """[1] of the motion that a point misses."""
    gap = rms(errors_of(problem, base, base.outset)).velocity
    return missed(gap / problem.noise.velocity, problem)


def _base(problem: Problem, log: Log, *, type: str) -> Point:  # noqa: A002 - as above
    """The best point without effects."""
    guess = sensible(first_guess(log, type=type))
    hypothesis = Hypothesis(type)
    values = {name: guess[name] for name in hypothesis.names}
    begin = problem.at(
        hypothesis, values, Outset.seen(len(problem.lanes)), problem.noise.velocity**2
    )
    return ended(problem, scanned(problem, better(problem, begin, steps=8, enough=1.0)))
