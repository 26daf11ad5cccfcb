"""Delay: commands arrive late.

    u(t) = V(t - lag)

The causes are the CAN bus, the loop of the controller, and filters on the command.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def command_delay(lag: float) -> float:
    """[s] delay of a command: the parameter ``lag`` itself."""
    return lag


def ordinary_parameters(_: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is one and a half loops of the robot program."""
    return {"lag": 0.03 * size}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: the time from a step to the motion, less that of the model, and a few more."""
    steps = []
    for run in residual.log.runs:
        moving = np.abs(run.velocity) > 0.05 * residual.top_speed
        if run.kind == "dynamic" and moving.any():
            steps.append(float(run.time[np.argmax(moving)] - run.time[0]))
    if steps:
        expected = 0.05 * residual.gains["kA"] / max(residual.gains["kV"], 1e-9)
        yield {"lag": float(np.clip(np.median(steps) - expected, 0.002, 0.2))}
    for lag in (0.01, 0.03, 0.06):
        yield {"lag": lag}


EFFECT = Effect(
    name="delay",
    kind="path",
    summary="a delay between command and motor",
    formula="u(t) = V(t - lag)",
    # a CAN bus and a loop of 200 Hz cause as much
    parameters=(Parameter("lag", "time from command to motor", "s", most=0.5, everyday=0.006),),
    fingerprint="Nothing happens for a moment after every change of voltage.",
    inspect="Check whether the log is written in a different loop than the motor output, whether "
    "the CAN bus is busy, and whether a slew-rate limit is set.",
    apart={
        "velocity-filter": (
            "Look at the position. A delay also shifts the position, a filter does not."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"command_delay": command_delay},
)
