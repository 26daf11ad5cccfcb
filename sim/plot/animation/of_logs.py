"""Animations of the tests in a log: the recorded motion, or the log next to an adjustable model."""

from collections.abc import Mapping

import numpy as np

from sim.core.log import Log
from sim.plot.animation import (
    Animation,
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Scene,
    Score,
    animate_mechanism,
)

STEP = 0.005  # of a slider
# Gain -> its unit, and both ends of its slider: without a kV or a kA, no model moves.
SLIDERS = {"kS": ("V", 0.0, 0.6), "kV": ("V·s/m", STEP, 4.0), "kA": ("V·s²/m", STEP, 0.8)}


def animate_logs(
    kind: str,
    logs: Mapping[str, tuple[Log, Log]],
    *,
    tests: Mapping[str, str],
    label: str,
    alt: str,
    span: tuple[float, float] | None = None,
) -> Animation:
    """A mechanism in a test, and the place that its log gives as an outline.

    Args:
        kind: the drawing, as in ``animate_mechanism``.
        logs: name -> what the log says, and what really happened.
        tests: option of the second menu -> test.
        label: label of the menu of logs.
        alt: a description of the figure with numbers.
        span: lowest and highest position drawn.
    """

    def make_scene(name: str, test: str) -> Scene:
        said, real = (log.list_runs_of_test(test)[0] for log in logs[name])
        velocity, position, voltage = (
            np.interp(real.time, said.time, signal)
            for signal in (said.velocity, said.position, said.voltage)
        )
        robot = Motion("robot", real.velocity, real.position, real.voltage)
        written = Motion("log", velocity, position, voltage, ghost=True)
        return Scene(real.time - real.time[0], (robot, written))

    return animate_mechanism(
        kind,
        {(name, shown): make_scene(name, test) for name in logs for shown, test in tests.items()},
        choices=(Choice(label, tuple(logs)), Choice("test", tuple(tests))),
        panels=(Panel("voltage", "voltage [V]"), Panel("velocity", "velocity [m/s]")),
        span=span,
        alt=alt,
    )


def animate_model(
    log: Log, gains: Mapping[str, float], *, tests: Mapping[str, tuple[str, float]], alt: str
) -> Animation:
    """A drivetrain in a log, and a model with the same voltage whose gains the sliders set.

    Args:
        log: of a drivetrain.
        gains: kS, kV and kA where the sliders start.
        tests: option of the menu -> test, and how many seconds of it.
        alt: a description of the figure with numbers.
    """

    def make_scene(test: str, seconds: float) -> Scene:
        run = log.list_runs_of_test(test)[0]
        run = run.select(run.time - run.time[0] <= seconds)
        knobs = {name: Gain(name) for name in SLIDERS}
        model = Motion("model", gains=knobs, voltage=run.voltage, ghost=True)
        real = Motion("robot", velocity=run.velocity)
        return Scene(run.time - run.time[0], (real, model), target=run.velocity)

    return animate_mechanism(
        "drivetrain",
        {(name,): make_scene(*which) for name, which in tests.items()},
        choices=(Choice("test", tuple(tests)),),
        panels=(Panel("velocity", "velocity [m/s]", low=0.0, high=1.4),),
        knobs=[
            Knob(name, f"{name} [{unit}]", low, high, STEP, round(gains[name], 3))
            for name, (unit, low, high) in SLIDERS.items()
        ],
        score=Score("model"),
        alt=alt,
    )
