"""How likely it is that an effect of the last model is missing in the base model.

A logistic regression (Hastie, Tibshirani and Friedman, The Elements of Statistical Learning,
section 4.4) of eight features. Its coefficients stand in ``probability.json``, which
``tests/benchmarks/learn_probability.py`` makes from logs in which the truth is known.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path

from sim.physics.effects import EFFECTS, find_motion_class
from sim.reconcile.thresholds import FARTHEST, LARGEST_SIZE

FILE = Path(__file__).with_name("probability.json")


@dataclass(frozen=True)
class Evidence:
    """The measurements of one effect from which its probability is computed.

    Args:
        likelihood: ln of the increase of the last model's BIC without it, at least 0.
        gap: ln of the cross-validated gap with it over that without it, mean of velocity and
            position.
        size: ln of its size over the largest everyday size, see ``compute_log_size``.
        rival: score of the best other effect over its own, see ``compute_rival_share``.
        later: 1 if another effect that may be a finding was added before it, else 0. It may then
            only correct that effect's form.
        structure: largest result of the residual tests of the last model over its threshold,
            clipped to ``STRUCTURE``.
        once: 1 if it has an onset, else 0.
        damaged: 1 if it has an onset and the log is damaged, else 0.
    """

    likelihood: float
    gap: float
    size: float
    rival: float
    later: float
    structure: float
    once: float
    damaged: float


FEATURES = tuple(one.name for one in fields(Evidence))


@dataclass(frozen=True)
class JudgedEffect:
    """An effect of the last model, and the probability that it is real.

    Args:
        effect: its name.
        ambiguous_with: other effects that would explain as much.
        evidence: features from which the probability is computed.
        probability: [1] that it, or one of the others, is missing in the base model.
    """

    effect: str
    ambiguous_with: tuple[str, ...]
    evidence: Evidence
    probability: float


def compute_probability(evidence: Evidence) -> float:
    """[1] probability that an effect is real, given its evidence."""
    weights = _read_coefficients()
    odds = weights["intercept"] + sum(weights[name] * getattr(evidence, name) for name in FEATURES)
    return 0.5 * (1.0 + math.tanh(0.5 * odds))  # the logistic function, which cannot overflow


def compute_log_ratio(with_: float, without: float) -> float:
    """Ln of a ratio of gaps, clipped to ±``FARTHEST``; 0 without two finite gaps and a divisor."""
    if not (math.isfinite(with_) and math.isfinite(without) and without > 0.0):
        return 0.0
    ratio = math.log(with_ / without) if with_ > 0.0 else -FARTHEST
    return min(max(ratio, -FARTHEST), FARTHEST)


def compute_log_size(effect: str, values: Mapping[str, float]) -> float:
    """Ln of an effect's size over the largest ordinary size, -``FARTHEST`` to ``LARGEST_SIZE``.

    It is ``LARGEST_SIZE`` for an effect without an ordinary size.

    Args:
        effect: name of the effect.
        values: the model's gains, and ``effect.parameter`` -> value.
    """
    size = EFFECTS[effect].compute_everyday_size(values)
    return min(max(math.log(size), -FARTHEST), LARGEST_SIZE) if size > 0.0 else -FARTHEST


def compute_rival_share(effect: str, score: float, tried: Mapping[str, float]) -> float:
    """[1] Score of the best other effect divided by this effect's, clamped to 0..1.

    Effects that have the same effect on the motion do not count as others, nor do effects with an
    onset if this one has none.

    Args:
        effect: name of the effect that was added.
        score: decrease of the BIC by it at its local minimum.
        tried: candidate of its round -> the same decrease, after a shortened search.
    """
    own = max(tried.get(effect, score), score)
    others = [
        other
        for name, other in tried.items()
        if find_motion_class(name) != find_motion_class(effect)
        and (EFFECTS[effect].has_onset or not EFFECTS[name].has_onset)
    ]
    return min(max(max(others, default=0.0) / max(own, 1.0), 0.0), 1.0)


@cache
def _read_coefficients() -> Mapping[str, float]:
    found: dict[str, float] = json.loads(FILE.read_text(encoding="utf-8"))["coefficients"]
    return found
