"""What an animation shows: motions over time, knobs, menus and plots, as plain data."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array
from sim.physics.engine import State, simulate_run
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
        """Its value with the knobs as they stand."""
        return self.plus + self.times * knobs[self.knob]


@dataclass(frozen=True, eq=False)
class Motion:
    """One mechanism of a scene, with what it did, or with the gains that let the page simulate it.

    Args:
        name: beside its curve.
        velocity: (n,) [m/s or rad/s].
        position: (n,) [m or rad]; without it, the integral of the velocity.
        voltage: (n,) [V], each held until the next time.
        heading: (n,) [rad] of a swerve drive.
        ghost: drawn as an outline over the others: a model beside the robot.
        asked: what was asked for: an outline and a line in the color of the text.
        gains: kS [V], kV, kA and, where the type has it, kG [V]: the motion is simulated with them.
        program: the gains of a feedforward that follows the scene's target; None takes ``voltage``.
        type: ``simple``, ``elevator`` or ``arm``.
        start: [m or rad] where a simulated motion begins, at rest.
        turns: whether the wheels of a swerve drive stand for turning on the spot.
    """

    name: str
    velocity: Array | None = None
    position: Array | None = None
    voltage: Array | None = None
    heading: Array | None = None
    ghost: bool = False
    asked: bool = False
    gains: Mapping[str, float | Gain] | None = None
    program: Mapping[str, float | Gain] | None = None
    type: str = "simple"
    start: float = 0.0
    turns: bool = False

    def curve(self, signal: str, scene: "Scene", knobs: Mapping[str, float]) -> Array | None:
        """(n,) its ``position``, ``velocity`` or ``voltage``, simulated where it has gains."""
        if self.gains is None:
            return find_position(self, scene, knobs) if signal == "position" else self._own(signal)
        voltage = self._volts(scene, knobs)
        if signal == "voltage":
            return voltage
        gains = {name: _value(gain, knobs) for name, gain in self.gains.items()}
        moved = simulate_run(
            Model(self.type, gains),
            time=scene.time,
            voltage=voltage,
            state=State.cold_at(self.start),
        )
        return moved.position if signal == "position" else moved.velocity

    def _own(self, signal: str) -> Array | None:
        return {"velocity": self.velocity, "voltage": self.voltage}[signal]

    def _volts(self, scene: "Scene", knobs: Mapping[str, float]) -> Array:
        """(n,) [V] of its program along the target, or those it was given."""
        if self.program is None or scene.target is None:
            return np.zeros(scene.time.size) if self.voltage is None else np.asarray(self.voltage)
        gains = {name: _value(gain, knobs) for name, gain in self.program.items()}
        velocity = (scene.target[:-1] + scene.target[1:]) / 2
        acceleration = np.diff(scene.target) / np.diff(scene.time)
        volts = gains["kS"] * np.sign(velocity) + gains["kV"] * velocity
        return np.append(volts + gains["kA"] * acceleration + gains.get("kG", 0.0), 0.0)


@dataclass(frozen=True, eq=False)
class Scene:
    """What happens in one animation.

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
    """A plot over time; its axes stay as they are whatever a knob does.

    Args:
        signal: ``position``, ``velocity`` or ``voltage``.
        label: of its axis, with the unit.
        low: lowest value; None holds what the scenes hold at first.
        high: highest value; None the same.
        terms: whether the voltage of the first motion is shared out among kS, kV and kA, as areas.
    """

    signal: str
    label: str
    low: float | None = None
    high: float | None = None
    terms: bool = False


@dataclass(frozen=True)
class Score:
    """How far one motion's velocity is from the target: the root mean square, always in sight.

    Args:
        motion: its name.
        unit: of the velocity.
        seconds: [s] from the first move of a knob until tries no longer count; 0 counts all.
    """

    motion: str
    unit: str = "m/s"
    seconds: float = 0.0


def find_position(motion: Motion, scene: Scene, knobs: Mapping[str, float]) -> Array:
    """(n,) [m or rad] where a motion is: given, simulated, or the integral of its velocity."""
    if motion.gains is not None:
        found = motion.curve("position", scene, knobs)
        return np.zeros(scene.time.size) if found is None else found
    if motion.position is not None:
        return np.asarray(motion.position)
    if motion.velocity is None:
        return np.zeros(scene.time.size)
    velocity = np.asarray(motion.velocity)
    ways = np.diff(scene.time) * (velocity[:-1] + velocity[1:]) / 2
    return np.asarray(motion.start + np.concatenate([[0.0], np.cumsum(ways)]))


def _value(gain: float | Gain, knobs: Mapping[str, float]) -> float:
    return gain.at(knobs) if isinstance(gain, Gain) else float(gain)
