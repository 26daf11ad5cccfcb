"""Warnings about an output-error fit: opposed signs, lags, and a model that does not fit."""

from sim.core.doubt import Doubt
from sim.fit.open_loop_fallback import OpenLoopReplay

FAR = 0.1  # [share of the top speed] error from which the gains cannot be right
SOON = 0.004  # [s] a later answer is worth a word


def doubt_opposed_signs(way: float) -> tuple[Doubt, ...]:
    """A warning if positive voltage drives the mechanism backward."""
    if way > 0.0:
        return ()
    return (
        Doubt(
            "sign-opposed",
            "kV and kA are negative: a positive voltage makes a negative velocity in this log. "
            "Invert the encoder or the motor, so that plus is plus, and record again.",
            grave=True,
        ),
    )


def doubt_lags(window: float, lag: float) -> tuple[Doubt, ...]:
    """Warnings about a filtered velocity and about a delay [s]."""
    said = []
    if window > 0.0:
        said.append(
            Doubt(
                "velocity-lag",
                f"The velocity is averaged over {window * 1000:.0f} ms, so it comes "
                f"{window * 500:.0f} ms late. The gains allow for that; a feedback loop has to, "
                "too: shorten the filter of the motor controller.",
            )
        )
    if lag > SOON:
        said.append(
            Doubt(
                "late-answer",
                f"Everything answers {lag * 1000:.0f} ms after the voltage in the log. The gains "
                "allow for that; a feedback loop has to, too.",
            )
        )
    return tuple(said)


def doubt_misfit(followed: OpenLoopReplay, *, hint: str = "") -> tuple[Doubt, ...]:
    """A warning if the simulation differs from the log by more than noise.

    Args:
        followed: how it follows.
        hint: which type would do better, if one does.
    """
    if not followed.has_misfit:
        return ()
    times, share = followed.rmse / followed.noise, followed.rmse / followed.top_speed
    return (
        Doubt(
            "model-strays",
            f"The simulation leaves the log by {times:.1f} times the velocity's own noise, "
            f"{share:.1%} of its top speed: this mechanism does something that kS, kV and kA do "
            "not say. The gains are those that come closest, and the errors above do not cover "
            f"what is missing. {hint}{' Otherwise i' if hint else 'I'}nspect the log, then ask "
            "`sysid reconcile` what that is.",
            grave=share > FAR,
        ),
    )


def doubt_small_misfit(misfit: bool) -> tuple[Doubt, ...]:  # noqa: FBT001 - the one thing it tells
    """A warning if a small effect is hidden in the noise."""
    if not misfit:
        return ()
    return (
        Doubt(
            "small-misfit",
            "Beneath the noise this mechanism does something small that its gains do not say. The "
            "errors are widened by what shows of it; where that matters, ask `sysid reconcile` "
            "what it is.",
        ),
    )
