"""Step responses of the suggested feedback gains and of the learner's own.

SysId's recipe compensates a delay by predicting the state: K ← K (A - BK)^(delay/period). If the
delay is longer than the closed loop's time constant, the predicted state can have the other sign,
and so can kP. The suggestions are SysId's, unchanged. But gains of a wrong sign, or whose step
response does not settle, come with a warning and, if possible, with better gains.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain

from sim.core.doubt import Doubt
from sim.core.units import find_unit
from sim.feedback import (
    Feedback,
    Plant,
    Preset,
    StepResponse,
    Verdict,
    compute_allowed_velocity_error,
    judge_step_response,
    simulate_step_response,
)
from sim.feedback.regulator import POSITION_ERROR
from sim.fit import Fit

SUGGESTED, OWN = "suggested", "your own"
GENTLER = tuple(2.0**k for k in range(1, 11))  # factors on SysId's allowed errors, for lower gains
STIFFER = tuple(2.0**-k for k in range(1, 7))  # the same, for higher gains
WEAK = ("slow", "stays-short")
NO_START = (
    "No setting of the allowed error gives gains that settle. Move the target along a profile, so "
    "that the feedforward does the work, and use a signal with less delay."
)
LEAST_DELAY = 5e-4  # [s] a shorter one is not mentioned


@dataclass(frozen=True)
class OwnGains:
    """The learner's gains of one loop, in the output units of the preset.

    Args:
        loop: ``velocity`` or ``position``.
        gains: kP and kD.
    """

    loop: str
    gains: Feedback


@dataclass(frozen=True, eq=False)
class FeedbackTrial:
    """Feedback gains and the step response that they give.

    Args:
        owner: ``suggested`` or ``your own``.
        loop: ``velocity`` or ``position``.
        gains: in the output units of the preset.
        preset: the motor controller.
        delay: [s] delay of its measurement: the log's, or the motor controller's if larger.
        response: the step response, in the fit's unit.
        verdict: the verdict on that response.
    """

    owner: str
    loop: str
    gains: Feedback
    preset: Preset
    delay: float
    response: StepResponse
    verdict: Verdict

    @property
    def is_good(self) -> bool:
        """Whether these gains are a good start: not negative, with a response that settles."""
        return self.verdict.is_good and min(self.gains.kp, self.gains.kd) >= 0.0


def try_feedback_gains(
    found: Fit,
    preset: Preset,
    *,
    own: OwnGains | None = None,
    allowed: Mapping[str, float] | None = None,
) -> tuple[FeedbackTrial, ...]:
    """Simulate a fit's suggested gains and the learner's own; none if nothing can be suggested.

    Args:
        found: the fit, in the unit of position of the gains.
        preset: the motor controller.
        own: the learner's gains, to try as well.
        allowed: the regulator's weights, as ``Fit.feedback`` takes them.
    """
    suggested = found.feedback(preset, **(allowed or {}))
    tried = [(SUGGESTED, loop, gains) for loop, gains in suggested.items()]
    if own is not None and tried:
        tried.append((OWN, own.loop, own.gains))
    done = (
        _try_loop(found, preset, whose=whose, loop=loop, gains=gains)
        for whose, loop, gains in tried
    )
    return tuple(trial for trial in done if trial is not None)


def _try_loop(
    found: Fit, preset: Preset, *, whose: str, loop: str, gains: Feedback
) -> FeedbackTrial | None:
    """The trial of gains of one loop; None if no step of it can be simulated."""
    gains_of_plant = {**found.gains, "kS": max(found.gains["kS"], 0.0)}  # no negative friction
    plant = Plant(found.type, gains_of_plant, angle=find_unit(found.units).si)
    target = plant.choose_target_step(loop)
    # A sensor that is late in the log is as late for the motor controller.
    measured = found.velocity_delay if loop == "velocity" else found.position_delay
    delay = max(found.choose_feedback_delay(preset, loop=loop), measured)
    if not target > 0.0:
        return None
    response = simulate_step_response(
        plant, loop=loop, feedback=gains, target=target, preset=preset, delay=delay
    )
    return FeedbackTrial(whose, loop, gains, preset, delay, response, judge_step_response(response))


def warn_of_bad_suggestions(found: Fit, tried: tuple[FeedbackTrial, ...]) -> tuple[Doubt, ...]:
    """Warnings about suggested gains that are no good start, with better ones if any.

    Args:
        found: the fit, in the unit of position of the gains.
        tried: its trials, from ``try_feedback_gains``.
    """
    return tuple(
        _doubt_suggestion(found, trial)
        for trial in tried
        if trial.owner == SUGGESTED and not trial.is_good
    )


def _doubt_suggestion(found: Fit, trial: FeedbackTrial) -> Doubt:
    """A warning about one suggestion, with the first better one."""
    late = f" with {1000 * trial.delay:.3g} ms of delay" if trial.delay > LEAST_DELAY else ""
    symbol, other = find_unit(found.units).symbol, find_better_gains(found, trial)
    cure = (
        f"Start the {trial.loop} loop with {format_gain_pair(other, symbol)}: in "
        f"simulation{late}, it {other.verdict.description}."
        if other
        else f"There is no good start for the {trial.loop} loop. {NO_START}"
    )
    return Doubt(
        "unsettled-feedback",
        f"{cure} (Do not use SysId's own suggestion, {format_gain_pair(trial, symbol)} for "
        f"{trial.preset.name}: in simulation, it {trial.verdict.description}.)",
    )


def find_better_gains(found: Fit, trial: FeedbackTrial) -> FeedbackTrial | None:
    """The trial itself if it is good, else that of the first better gains; None without any.

    Args:
        found: the fit, in the unit of position of the gains.
        trial: the trial of a suggestion.
    """
    return next((one for one in chain([trial], _suggest_others(found, trial)) if one.is_good), None)


def _suggest_others(found: Fit, trial: FeedbackTrial) -> Iterator[FeedbackTrial]:
    """Suggestions for larger allowed errors, or for smaller ones if the gains are too weak."""
    loop, preset = trial.loop, trial.preset
    allowed = compute_allowed_velocity_error(ks=found.gains["kS"], kv=found.gains["kV"])
    weak = trial.verdict.kind in WEAK and trial.gains.kp > 0.0
    for times in STIFFER if weak else GENTLER:
        speed = allowed * (times if loop == "velocity" else max(times, 1.0))
        gains = found.feedback(preset, position_error=times * POSITION_ERROR, velocity_error=speed)
        other = _try_loop(found, preset, whose=trial.owner, loop=loop, gains=gains[loop])
        if other is not None:
            yield other


def format_gain_pair(trial: FeedbackTrial, symbol: str) -> str:
    """The gains kP and kD with four digits and units; a kD of zero is left out.

    Args:
        trial: a trial of the gains.
        symbol: symbol of the unit of position.
    """
    of_kp, of_kd = trial.preset.format_units(trial.loop, symbol)
    kd = f", kD {trial.gains.kd:.4g} {of_kd}" if trial.gains.kd else ""
    return f"kP {trial.gains.kp:.4g} {of_kp}{kd}"
