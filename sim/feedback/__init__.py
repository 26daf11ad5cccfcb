"""Feedback gains: WPILib SysId's suggestions, and the step response of a loop.

    gains = design_position_loop(kv=2.5, ka=0.19)
    response = simulate_step_response(plant, loop="position", feedback=gains, target=0.5)
    judge_step_response(response).description

Suggested gains are a start for tuning. A simulation shows beforehand whether the loop settles.
"""

from sim.feedback.regulator import (
    PRESETS,
    Feedback,
    Preset,
    compute_allowed_velocity_error,
    design_position_loop,
    design_velocity_loop,
)
from sim.feedback.response import Plant, StepResponse, simulate_step_response
from sim.feedback.verdict import Verdict, judge_step_response

__all__ = [
    "PRESETS",
    "Feedback",
    "Plant",
    "Preset",
    "StepResponse",
    "Verdict",
    "compute_allowed_velocity_error",
    "design_position_loop",
    "design_velocity_loop",
    "judge_step_response",
    "simulate_step_response",
]
