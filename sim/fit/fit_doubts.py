"""Warnings about an output-error fit: lags, and a model that does not fit."""

import math
from collections.abc import Iterator, Mapping, Sequence

from sim.core.advice import Action
from sim.core.doubt import GAINS, Doubt
from sim.fit.open_loop_fallback import OpenLoopReplay
from sim.physics.effects import EFFECTS
from sim.physics.model import Part

FAR = 0.1  # [share of the top speed] error from which the gains cannot be right
NOTICED = 0.06  # [share of the top speed] error beyond noise that a controller has to correct
STRONG = 2.5  # [standard deviations of the prior] from which an effect is no longer small
LEAST_LAG = 0.004  # [s] a longer delay or average is mentioned
MISFIT = frozenset({"model-strays", "small-misfit", "strong-effect"})
"""Warnings that kS, kV, kA and kG alone do not describe the log; a model with effects may."""


def warn_of_lags(window: float, lag: float) -> Iterator[Doubt]:
    """Warnings about a filtered velocity and about a delay.

    Args:
        window: [s] time over which the velocity is averaged; 0 if it is not.
        lag: [s] delay from voltage to motion.
    """
    if window > LEAST_LAG:
        averaged, late = (float(f"{one * 1000:.2g}") for one in (window, window / 2))
        yield Doubt(
            "velocity-lag",
            f"The velocity is averaged over about {averaged:g} ms, so it is about {late:g} ms "
            "late. The gains account for this delay. Your feedback controller gets the same delay: "
            "shorten the filter of the motor controller.",
        )
    if lag > LEAST_LAG:
        yield Doubt(
            "late-answer",
            f"The mechanism reacts {lag * 1000:.0f} ms after the logged voltage. The gains "
            "account for this delay. Your feedback controller gets the same delay.",
        )


def warn_of_misfit(
    replay: OpenLoopReplay, gains_only: OpenLoopReplay, *, hint: Action | None = None
) -> Iterator[Doubt]:
    """A warning if a simulation differs from the log by more than its noise.

    It names no number: how large the error is, each surface shows at one place.

    Args:
        replay: replay of the fitted model, with its small effects.
        gains_only: replay without the small effects, which a feedforward does not have.
        hint: a better type, or None.
    """
    share = gains_only.excess / (gains_only.top_speed or math.inf)
    if share > NOTICED:
        yield Doubt(
            "model-strays",
            f"A simulation with these gains {'' if share > FAR else 'clearly '}misses the "
            f"velocity{' by far' if share > FAR else ''}. A controller would notice that. The "
            "errors above include it, but kS, kV and kA do not describe this log well.",
            grave=share > FAR,
            action=hint or Action("inspect-and-reconcile"),
            gains=GAINS,
        )
    elif replay.has_misfit:
        yield Doubt(
            "small-misfit",
            "A simulation with these gains misses the velocity by more than the sensor noise, but "
            f"by less than {NOTICED:.0%} of the top speed. The errors above include it.",
            action=Action("look-for-cause"),
        )


def warn_of_strong_effects(parts: Sequence[Part], priors: Mapping[str, float]) -> Iterator[Doubt]:
    """A warning if a small effect is larger than on a healthy robot.

    Args:
        parts: the small effects of a fit.
        priors: ``effect.parameter`` -> standard deviation of its prior.
    """
    strong = [
        EFFECTS[part.effect].summary
        for part in parts
        if any(
            abs(value) > STRONG * priors.get(f"{part.effect}.{name}", math.inf)
            for name, value in part.parameters.items()
            if EFFECTS[part.effect].neutral[name] == 0.0
        )
    ]
    if strong:
        yield Doubt(
            "strong-effect",
            "There is an effect in this log that kS, kV and kA do not describe: "
            f"{'; '.join(strong)}. It is larger than on a healthy robot. A feedforward with "
            "these gains does not correct it.",
            action=Action("look-for-cause"),
        )
