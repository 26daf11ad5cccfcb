"""The content of an animation as plain data: motions over time, sliders, menus and plots."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array


@dataclass(frozen=True)
class Gain:
    """A gain that a slider sets: ``plus + times · knob``.

    Args:
        knob: the name of the knob.
        times: factor [unit of the gain per unit of the knob].
        plus: offset [unit of the gain].
    """

    knob: str
    times: float = 1.0
    plus: float = 0.0


@dataclass(frozen=True)
class TestPlan:
    """The voltage of one test: ``step + ramp · time`` until it ends; then 0 V, in brake mode.

    Args:
        ramp: slope of the voltage [V/s].
        step: voltage at the start [V].
        mark: position at which the driver begins to react [m].
        reaction: time from the mark until the motors are off [s].
        timeout: time after which they are off in any case [s].
    """

    __test__ = False  # tells pytest that this is not a test class

    ramp: float | Gain = 0.0
    step: float | Gain = 0.0
    mark: float | Gain = math.inf
    reaction: float | Gain = 0.0
    timeout: float = math.inf


@dataclass(frozen=True, eq=False)
class Motion:
    """One mechanism of a scene, with recorded signals or with gains with which it is simulated.

    Args:
        name: the label of its curve.
        velocity: (n,) [m/s or rad/s].
        position: (n,) [m or rad]; without it, the integral of the velocity.
        voltage: (n,) [V], each held until the next time; a gain is one voltage, set by its knob.
        heading: (n,) [rad] of a swerve drive.
        ghost: whether it is drawn as an outline over the others, as a model over the robot.
        asked: whether it is the target: an outline, and a line in the color of the text.
        gains: kS [V], kV, kA and, where the type has it, kG [V]: the motion is simulated with them.
        program: gains of a feedforward that follows the scene's target; None uses ``voltage``.
        plan: the test plan that sets the voltage; it has priority over ``program``.
        type: ``simple``, ``elevator`` or ``arm``.
        start: initial position of a motion at rest [m or rad].
        turns: whether the wheels of a swerve drive are set for turning on the spot.
    """

    name: str
    velocity: Array | None = None
    position: Array | None = None
    voltage: Array | Gain | None = None
    heading: Array | None = None
    ghost: bool = False
    asked: bool = False
    gains: Mapping[str, float | Gain] | None = None
    program: Mapping[str, float | Gain] | None = None
    plan: TestPlan | None = None
    type: str = "simple"
    start: float = 0.0
    turns: bool = False

    def find_position(self, scene: "Scene") -> Array:
        """The positions given, or the integral of the velocities given, (n,) [m or rad]."""
        if self.position is not None:
            return np.asarray(self.position)
        velocity = np.zeros(scene.time.size) if self.velocity is None else np.asarray(self.velocity)
        ways = np.diff(scene.time) * (velocity[:-1] + velocity[1:]) / 2
        return np.asarray(self.start + np.concatenate([[0.0], np.cumsum(ways)]))


@dataclass(frozen=True, eq=False)
class Scene:
    """One scene of an animation: its times, motions and target.

    Args:
        time: (n,) [s], rising.
        motions: the mechanisms, the first one in front.
        target: (n,) velocity that programs follow [m/s or rad/s]; None without programs.
        title: title above the figure; may be empty.
    """

    time: Array
    motions: tuple[Motion, ...]
    target: Array | None = None
    title: str = ""


@dataclass(frozen=True)
class Knob:
    """A slider that sets gains.

    Args:
        name: its name, to which a ``Gain`` refers.
        label: its label, with the unit.
        low: lowest value.
        high: highest value.
        step: distance of two values.
        value: initial value.
    """

    name: str
    label: str
    low: float
    high: float
    step: float
    value: float


@dataclass(frozen=True)
class Choice:
    """A menu that selects a scene.

    Args:
        label: its label.
        options: the options to choose from.
        value: option selected at first; empty selects the first.
    """

    label: str
    options: tuple[str, ...]
    value: str = ""


@dataclass(frozen=True)
class Panel:
    """A plot over time whose axes do not change when a slider moves.

    Args:
        signal: ``position``, ``velocity``, ``voltage``, or ``error``: position minus target
            position.
        label: label of its axis, with the unit.
        low: lowest value in the label's unit; None fits the axis to the scenes as first shown.
        high: highest value; None as for ``low``.
        scale: factor from SI to the unit of the label: 100 for centimeters.
        terms: whether the shares of kS, kV and kA in the voltage of the first motion are drawn as
            areas.
    """

    signal: str
    label: str
    low: float | None = None
    high: float | None = None
    scale: float = 1.0
    terms: bool = False


@dataclass(frozen=True)
class Score:
    """A displayed score: the RMS difference of a motion's velocity from the target.

    Args:
        motion: name of the motion.
        unit: unit of the velocity.
        seconds: time limit for tries, from the first move of a slider [s]; 0 is no limit.
    """

    motion: str
    unit: str = "m/s"
    seconds: float = 0.0


@dataclass(frozen=True)
class Rule:
    """A condition on a test plan, checked whenever a slider moves.

    Args:
        label: what is measured, with its unit.
        measure: ``farthest`` or ``fastest`` of all motions, ``moving`` [s] of one; or a
            slider's name.
        times: factor from the measure to the number shown.
        motion: name of the motion; empty takes all.
        at_most: upper bound, or the slider that sets it.
        at_least: lower bound.
    """

    label: str
    measure: str
    times: float = 1.0
    motion: str = ""
    at_most: float | Gain | None = None
    at_least: float | None = None
