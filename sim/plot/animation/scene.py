"""What an animation shows: motions over time, knobs, menus and plots, as plain data."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array
from sim.physics.engine import State, Track, simulate_run
from sim.physics.model import Model


@dataclass(frozen=True)
class Gain:
    """A gain that a knob sets: ``plus + times · knob``.

    Args:
        knob: the name of the knob.
        times: [unit of the gain per unit of the knob].
        plus: [unit of the gain].
    """

    knob: str
    times: float = 1.0
    plus: float = 0.0

    def at(self, knobs: Mapping[str, float]) -> float:
        """The gain's value at these knob positions."""
        return self.plus + self.times * knobs[self.knob]


@dataclass(frozen=True)
class TestPlan:
    """The voltage of one test: ``step + ramp · time``, until it is over; then 0 V, in brake mode.

    Args:
        ramp: [V/s].
        step: [V].
        mark: [m] where a driver begins to react.
        reaction: [s] from the mark until the motors are off.
        timeout: [s] after which they are off in any case.
    """

    __test__ = False  # no test of pytest's

    ramp: float | Gain = 0.0
    step: float | Gain = 0.0
    mark: float | Gain = math.inf
    reaction: float = 0.0
    timeout: float = math.inf

    def voltage(
        self, time: Array, knobs: Mapping[str, float], move: Callable[[Array], Array]
    ) -> Array:
        """(n,) [V] voltage of the test.

        Args:
            time: (n,) [s].
            knobs: name -> value.
            move: simulates: (n,) [V] -> (n,) position.
        """
        volts = find_value(self.step, knobs) + find_value(self.ramp, knobs) * time
        volts = np.where(time < self.timeout, volts, 0.0)
        passed = move(volts) > find_value(self.mark, knobs)
        if not passed.any():
            return volts
        return np.where(time < time[int(np.argmax(passed))] + self.reaction, volts, 0.0)


@dataclass(frozen=True, eq=False)
class Motion:
    """One mechanism of a scene, with what it did, or with the gains that let the page simulate it.

    Args:
        name: beside its curve.
        velocity: (n,) [m/s or rad/s].
        position: (n,) [m or rad]; without it, the integral of the velocity.
        voltage: (n,) [V], each held until the next time; a gain is one voltage, set by its knob.
        heading: (n,) [rad] of a swerve drive.
        ghost: drawn as an outline over the others: a model beside the robot.
        asked: whether it is the target: an outline and a line in the color of the text.
        gains: kS [V], kV, kA and, where the type has it, kG [V]: the motion is simulated with them.
        program: the gains of a feedforward that follows the scene's target; None takes ``voltage``.
        plan: the test that is driven, in place of a voltage.
        type: ``simple``, ``elevator`` or ``arm``.
        start: [m or rad] where a simulated motion begins, at rest.
        turns: whether the wheels of a swerve drive stand for turning on the spot.
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
        """(n,) one signal of the motion, simulated if it has gains; None if it lacks the signal.

        Args:
            signal: ``position``, ``velocity``, ``voltage`` or ``error``.
            scene: which it is in.
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
        """(n,) position minus the target position."""
        asked = next((one for one in scene.motions if one.asked), None)
        if asked is None or asked is self:
            return None
        here, there = (one.curve("position", scene, knobs) for one in (self, asked))
        return None if here is None or there is None else here - there

    def _own_position(self, scene: "Scene") -> Array:
        """(n,) the positions given, or the integral of the velocities given."""
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
        """(n,) [V] of its plan, of its program along the target, or those it was given."""
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
    """(n,) [V] of a feedforward along a velocity, each held until the next time.

    Args:
        time: (n,) [s].
        target: (n,) [m/s or rad/s].
        gains: kS, kV, kA and, where there is one, kG.
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
        target: (n,) [m/s or rad/s] the velocity that programs follow; None where there are none.
        title: above the figure; may be empty.
    """

    time: Array
    motions: tuple[Motion, ...]
    target: Array | None = None
    title: str = ""


@dataclass(frozen=True)
class Knob:
    """A slider that sets gains.

    Args:
        name: by which gains refer to it.
        label: what is written beside it, with its unit.
        low: first value.
        high: last value.
        step: between two values.
        value: where it stands at first.
    """

    name: str
    label: str
    low: float
    high: float
    step: float
    value: float


@dataclass(frozen=True)
class Choice:
    """A menu that picks a scene.

    Args:
        label: what is written beside it.
        options: what can be picked.
        value: what is picked at first; empty is the first option.
    """

    label: str
    options: tuple[str, ...]
    value: str = ""


@dataclass(frozen=True)
class Panel:
    """A plot over time whose axes do not change when a slider moves.

    Args:
        signal: ``position``, ``velocity``, ``voltage``, or ``error``: how far a position is ahead
            of the target.
        label: of its axis, with the unit.
        low: lowest value in the label's unit; None fits the axis to the scenes as first shown.
        high: highest value; None as for ``low``.
        scale: factor from SI to the unit of the label: 100 for centimeters.
        terms: whether the voltage of the first motion is shared out among kS, kV and kA, as areas.
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
        motion: its name.
        unit: of the velocity.
        seconds: [s] from the first move of a knob until tries no longer count; 0 counts all.
    """

    motion: str
    unit: str = "m/s"
    seconds: float = 0.0


@dataclass(frozen=True)
class Rule:
    """A condition on a test plan, checked whenever a knob moves.

    Args:
        label: what is measured, with its unit.
        measure: ``farthest`` or ``fastest`` of all motions, ``moving`` [s] of one; or a
            knob's name.
        times: factor from the measure to what is shown.
        motion: whose; empty means all.
        at_most: upper bound, or a knob that sets it.
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
