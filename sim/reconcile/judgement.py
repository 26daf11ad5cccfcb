"""How likely each effect of the last model is real.

The evidence of an effect is measured here; ``probability.py`` turns it into a probability.
"""

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.measurements import find_sensor_step
from sim.physics.effect import ONSET, UNTIL
from sim.physics.effects import EFFECTS
from sim.reconcile.cross_validation import compute_missed_motion
from sim.reconcile.model_selection import is_ordinary_size
from sim.reconcile.probability import (
    Evidence,
    JudgedEffect,
    compute_log_ratio,
    compute_log_size,
    compute_probability,
    compute_rival_share,
)
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.thresholds import LATEST, LOST, NARROWER, SOONEST, STRUCTURE


def judge_effects(
    problem: PredictionErrorProblem,
    rounds: Sequence[SelectionRound],
    residuals: ResidualSummary,
    *,
    damaged: bool,
) -> tuple[JudgedEffect, ...]:
    """The effects of the last model that may be findings, each with its probability.

    Args:
        problem: the measurements.
        rounds: the base model and the selection rounds.
        residuals: residual tests of the last model.
        damaged: whether damaged intervals were excluded.
    """
    last = rounds[-1].candidate.estimate
    missed = compute_missed_motion(rounds[-1].gap.velocity, problem)
    if not missed <= LOST:  # also true for nan
        return ()
    possible = [
        (before, now)
        for before, now in pairwise(rounds)
        if not is_ordinary_size(now.candidate.effect, last.values)
        and not is_contradicted(now.candidate.effect, problem, last, residuals)
        and is_observable(now.candidate.effect, problem, last.values)
    ]
    found = []
    for place, (before, now) in enumerate(possible):
        name = now.candidate.effect
        with_, bare = rounds[-1].gap, now.gap_without
        velocity = compute_log_ratio(with_.velocity, bare.velocity)
        position = compute_log_ratio(with_.position, bare.position)
        score = before.candidate.bic - now.candidate.bic
        # other effects of the last model are no rivals: it needs them as well
        others = {*last.structure.effects} - {name}
        rivals = {one.effect: one.improvement for one in before.tried if one.effect not in others}
        evidence = Evidence(
            likelihood=math.log(max(now.without.bic - rounds[-1].candidate.bic, 1.0)),
            gap=0.5 * (velocity + position),
            size=compute_log_size(name, last.values),
            rival=compute_rival_share(name, score, rivals),
            later=float(place > 0),
            structure=min(max(residuals.largest_ratio, STRUCTURE[0]), STRUCTURE[1]),
            once=float(EFFECTS[name].has_onset),
            damaged=float(damaged and EFFECTS[name].has_onset),
        )
        found.append(JudgedEffect(name, now.rivals, evidence, compute_probability(evidence)))
    return tuple(found)


def is_observable(
    effect: str, problem: PredictionErrorProblem, values: Mapping[str, float]
) -> bool:
    """Whether these samples can show an effect at all.

    They do not show a soft joint that oscillates at least once between two samples, with the
    angular frequency 1/√(softness·share·(1 - share)·kA) [rad/s], nor a velocity scale that changes
    even the top speed by less than a step of the sensor. An effect with an onset that acts on no
    sample in motion, or on all of them, cannot be told from the model without it.

    Args:
        effect: name of the effect.
        problem: the measurements.
        values: parameter values of the model, in SI.
    """
    if "joint_compliance" in EFFECTS[effect].hooks:
        share, soft = values[f"{effect}.share"], values[f"{effect}.softness"]
        reduced = share * (1.0 - share) * values["kA"]
        return 2.0 * math.pi * math.sqrt(max(soft * reduced, 0.0)) >= problem.period
    if effect == "velocity-scale":
        velocities = problem.measured[problem.moving, 1]
        step = find_sensor_step([velocities[~np.isnan(velocities)]])
        return abs(values["velocity-scale.scale"] - 1.0) * problem.top_speed >= step
    if not EFFECTS[effect].has_onset:
        return True
    clocks = [
        one.clock + one.measurements.time - one.measurements.time[0] for one in problem.records
    ]
    clock = np.concatenate(clocks)[problem.moving]
    acts = (values[f"{effect}.{ONSET}"] <= clock) & (clock < values[f"{effect}.{UNTIL}"])
    return bool(acts.any() and not acts.all())


def is_contradicted(
    effect: str, problem: PredictionErrorProblem, last: Estimate, residuals: ResidualSummary
) -> bool:
    """Whether the largest unexplained residual follows this effect's onset.

    A slipping sensor or a bumped robot loses speed like one that takes up a load, but regains it at
    another rate. The samples of the impact itself do not count: no model explains them exactly.
    """
    window = residuals.worst_window
    if not (EFFECTS[effect].has_onset and residuals.has_unlikely_window):
        return False
    record = problem.records[window.record]
    onset = last.values[f"{effect}.{ONSET}"] - record.clock + float(record.measurements.time[0])
    return onset + SOONEST * problem.period < window.start < onset + LATEST


def is_narrower_with(added: SelectionRound, end: SelectionRound) -> bool:
    """Whether the last model's gap, of velocity and position, is narrower with an effect."""
    with_, bare = end.gap, added.gap_without
    return with_.velocity * with_.position <= NARROWER**2 * bare.velocity * bare.position
