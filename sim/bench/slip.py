"""Wheels that slip on the floor: they spin ahead of the robot until it has caught up.

    wheels:  kA_w·w' = u - kS·sgn(w) - kV·w - F        robot:  kA_r·v' = F

with w the speed of the wheels, v that of the robot and F [V] what the floor passes on. While the
wheels grip, w = v. They begin to slip where |v'| would exceed the mechanism's ``grip``; from then
on F = ±kA_r·grip, until both speeds are the same again. The share ``spin`` of the inertia belongs
to wheels and rotors: kA_w = kA·spin/(1 + spin), kA_r = kA/(1 + spin).

All friction counts as the gears' own, and a brownout is not simulated while the wheels slip. A
sensor in the motor sees w. Hidden effects are not simulated together with slip.
"""

import math

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.core.log import Array
from sim.physics.engine import Track
from sim.physics.engine.power_path import EMF, OHM, bus_voltage, limit_voltage

FINE = 20  # steps between two samples; the wheels' own time constant is some milliseconds


def wheels_slip(mechanism: Mechanism, track: Track) -> bool:
    """Whether the wheels slip in a motion, because it needs more than the traction limit.

    Args:
        mechanism: what moves.
        track: its motion as if the wheels could not slip.
    """
    if mechanism.grip is None:
        return False
    gains = mechanism.gains
    way = np.sign(np.where(track.velocity == 0.0, track.applied, track.velocity))
    push = np.abs(track.applied - gains["kV"] * track.velocity - gains["kS"] * way)
    return bool(np.any(push > gains["kA"] * mechanism.grip))


def slip_voltage(mechanism: Mechanism) -> float:
    """[V] the smallest step from rest at which the wheels slip; infinite if they cannot."""
    if mechanism.grip is None:
        return math.inf
    return mechanism.gains["kS"] + mechanism.gains["kA"] * mechanism.grip


def spin_wheels(
    mechanism: Mechanism, *, time: Array, command: Array, wires: Array, track: Track
) -> Track:
    """Move a robot whose wheels may slip.

    Args:
        mechanism: what moves, without hidden effects; its ``grip`` is not None.
        time: (n,) [s].
        command: (n,) [V] asked for, each held until the next sample.
        wires: (9,) as ``sim.bench.simulate.power_path_arrays`` gives it.
        track: the same motion without slip, for where it begins.

    Returns:
        The motion: position and velocity are the wheels', the load's position is the robot's.
    """
    path = tuple(wires.tolist())
    robot = _Robot(mechanism, path)
    rows = np.empty((time.size, 8))
    place = load = float(track.position[0])
    steps = np.append(np.diff(time), 0.0).tolist()
    for row, asked, step in zip(rows, command.tolist(), steps, strict=True):
        u = limit_voltage(path, asked, robot.wheel)
        current = (u - path[EMF] * robot.wheel) / path[OHM]
        bus = bus_voltage(path, u, current)
        row[:] = place, robot.wheel, load, u, bus, current, place, robot.wheel
        for _ in range(FINE):
            wheel, speed = robot.wheel, robot.speed
            robot.advance(asked, step / FINE)
            place += 0.5 * (wheel + robot.wheel) * step / FINE
            load += 0.5 * (speed + robot.speed) * step / FINE
    return Track.from_array(rows)


class _Robot:
    """Wheels and robot, from rest."""

    def __init__(self, mechanism: Mechanism, wires: tuple[float, ...]) -> None:
        gains = mechanism.gains
        self.wheel = self.speed = 0.0
        self._slips = 0.0  # the sign of wheel minus robot while the wheels slip
        self._wires = wires
        self._ks, self._kv, self._ka = gains["kS"], gains["kV"], gains["kA"]
        self._wheel_share = mechanism.spin / (1.0 + mechanism.spin)
        self._grip = mechanism.grip or 0.0

    def advance(self, asked: float, step: float) -> None:
        """Move on by ``step`` [s] under the voltage asked for [V]."""
        push = limit_voltage(self._wires, asked, self.wheel)
        way = math.copysign(1.0, self.wheel or push)
        if self.wheel == 0.0 and abs(push) <= self._ks:
            return
        push -= self._ks * way
        wanted = (push - self._kv * self.wheel) / self._ka
        if not self._slips and abs(wanted) > self._grip:
            self._slips = math.copysign(1.0, wanted)
        if not self._slips:
            self.speed = self.wheel = self._stopped(push / self._kv, self._ka, step)
            return
        held = self._ka * (1.0 - self._wheel_share) * self._grip * self._slips
        wheel = self._stopped((push - held) / self._kv, self._ka * self._wheel_share, step)
        speed = self.speed + self._grip * self._slips * step
        if (wheel - speed) * self._slips <= 0.0:
            self._slips, wheel = 0.0, speed  # the robot has caught up
        self.wheel, self.speed = wheel, speed

    def _stopped(self, toward: float, inertia: float, step: float) -> float:
        """The wheels' speed after a step toward another; friction stops what changes its sign."""
        keep = math.exp(-step * self._kv / inertia) if inertia else 0.0
        moved = toward + (self.wheel - toward) * keep
        return 0.0 if moved * self.wheel < 0.0 else moved
