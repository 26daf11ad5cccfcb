"""The content of an animation as plain data: motions over time, sliders, menus and plots."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array
from sim.physics.engine import State, Track, simulate_run
from sim.physics.model import Model


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

    def at(self, knobs: Mapping[str, float]) -> float:
        """The gain's value at these knob positions."""
        return self.plus + self.times * knobs[self.knob]


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

    def voltage(
        self, time: Array, knobs: Mapping[str, float], move: Callable[[Array], Array]
    ) -> Array:
        """The voltage of the test, (n,) [V].

        Args:
            time: (n,) [s].
            knobs: name -> value.
            move: simulates the position (n,) under a voltage (n,) [V].
        """
        volts = find_value(self.step, knobs) + find_value(self.ramp, knobs) * time
        volts = np.where(time < self.timeout, volts, 0.0)
        passed = move(volts) > find_value(self.mark, knobs)
        if not passed.any():
            return volts
        reaction = find_value(self.reaction, knobs)
        return np.where(time < time[int(np.argmax(passed))] + reaction, volts, 0.0)


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

    def curve(self, signal: str, scene: "Scene", knobs: Mapping[str, float]) -> Array | None:
        """One signal of the motion (n,), simulated if it has gains; None if it lacks the signal.

        Args:
            signal: ``position``, ``velocity``, ``voltage`` or ``error``.
            scene: the scene that the motion belongs to.
            knobs: name -> value.
        """
        if signal == "error":
            return self._error(scene, knobs)
        if self.gains is None:
            own = {"position": self._own_position(scene), "velocity": self.velocity}
            return own.get(signal, None if isinstance(self.voltage, Gain) else self.voltage)
        voltage = self._volts(scene, knobs)
        if signal == "voltage":
            return voltage
        moved = self._move(scene.time, voltage, knobs)
        return moved.position if signal == "position" else moved.velocity

    def _error(self, scene: "Scene", knobs: Mapping[str, float]) -> Array | None:
        """Position minus target position, (n,) [m or rad]; None for the target, or without one."""
        asked = next((one for one in scene.motions if one.asked), None)
        if asked is None or asked is self:
            return None
        here, there = (one.curve("position", scene, knobs) for one in (self, asked))
        return None if here is None or there is None else here - there

    def _own_position(self, scene: "Scene") -> Array:
        """The positions given, or the integral of the velocities given, (n,) [m or rad]."""
        if self.position is not None:
            return np.asarray(self.position)
        velocity = np.zeros(scene.time.size) if self.velocity is None else np.asarray(self.velocity)
        ways = np.diff(scene.time) * (velocity[:-1] + velocity[1:]) / 2
        return np.asarray(self.start + np.concatenate([[0.0], np.cumsum(ways)]))

    def _move(self, time: Array, voltage: Array, knobs: Mapping[str, float]) -> Track:
        gains = {name: find_value(gain, knobs) for name, gain in (self.gains or {}).items()}
        return simulate_run(
            Model(self.type, gains), time=time, voltage=voltage, state=State.cold_at(self.start)
        )

    def _volts(self, scene: "Scene", knobs: Mapping[str, float]) -> Array:
        """The voltage (n,) [V] of its plan, of its program, or the one given, in this order."""
        if self.plan is not None:
            return self.plan.voltage(
                scene.time, knobs, lambda volts: self._move(scene.time, volts, knobs).position
            )
        if self.program is not None and scene.target is not None:
            gains = {name: find_value(gain, knobs) for name, gain in self.program.items()}
            return follow_target(scene.time, scene.target, gains)
        if self.voltage is None or isinstance(self.voltage, Gain):
            held = 0.0 if self.voltage is None else self.voltage.at(knobs)
            return np.full(scene.time.size, held)
        return np.asarray(self.voltage)


def follow_target(time: Array, target: Array, gains: Mapping[str, float]) -> Array:
    """The voltage (n,) [V] of a feedforward for a target velocity, each held until the next time.

    Args:
        time: (n,) [s].
        target: (n,) target velocity [m/s or rad/s].
        gains: kS, kV, kA and, if there is one, kG.
    """
    velocity = (target[:-1] + target[1:]) / 2
    acceleration = np.diff(target) / np.diff(time)
    volts = gains["kS"] * np.sign(velocity) + gains["kV"] * velocity
    return np.append(volts + gains["kA"] * acceleration + gains.get("kG", 0.0), 0.0)


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


def find_value(value: float | Gain, knobs: Mapping[str, float]) -> float:
    """The value of a number or of a gain, at the knobs' positions."""
    return value.at(knobs) if isinstance(value, Gain) else float(value)
