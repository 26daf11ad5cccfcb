"""One test on a floor with a stop mark: release of the button, braking, and final position.

The voltage of the routine is on until the robot has passed the mark and the driver has reacted, or
until the timeout. Then the motors brake, limited by back-EMF and grip:

    v' = -min((kV·v + kS)/kA, grip·g)

A robot that reaches the wall is not simulated further.
"""

import math
from dataclasses import dataclass

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import make_power_path_array
from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.core.units import GRAVITY
from sim.physics.engine import State, simulate_run

PERIOD = 0.02  # [s] loop period of the robot program
STANDSTILL = 0.01  # [m/s] slower counts as standing
GRIP = 1.1  # [1] coefficient of friction of wheels on carpet, roughly
FINE = 20  # integration steps per loop while it brakes
THUMB = 0.3  # [s] reaction time of a driver who waits for the mark


@dataclass(frozen=True)
class Floor:
    """A floor with a start, a stop mark and a wall.

    Args:
        wall: distance from the start to the wall [m].
        tape: distance from the start to the mark [m]; None is no mark.
        thumb: time from the mark to the release of the button [s].
        watched: time after which somebody ends the test in any case [s]; infinite is never.
        grip: coefficient of friction of the wheels [1].

    Raises:
        BadRequest: a number is not above zero.
    """

    wall: float
    tape: float | None = None
    thumb: float = THUMB
    watched: float = math.inf
    grip: float = GRIP

    def __post_init__(self) -> None:
        for name in ("wall", "tape", "thumb", "watched", "grip"):
            value = getattr(self, name)
            if value is not None and not value > 0.0:
                raise BadRequest(f"a {name} of {value:g}", advice="Choose a number above zero.")


@dataclass(frozen=True, eq=False)
class FloorTest:
    """The result of a simulated test on a floor.

    Args:
        floor: the floor of the test.
        time: (n,) time since the button was pressed [s].
        position: (n,) distance from the start [m].
        velocity: (n,) [m/s].
        battery: (n,) battery voltage [V].
        released: time when the motors were turned off [s].
        hit_wall: time when it hit the wall, the last sample [s]; None if it did not.
    """

    floor: Floor
    time: Array
    position: Array
    velocity: Array
    battery: Array
    released: float
    hit_wall: float | None

    @property
    def final_position(self) -> float:
        """The position at the end of the test, or at the wall [m]."""
        return float(self.position[-1])


def drive_test(mechanism: Mechanism, routine: Routine, *, test: str, floor: Floor) -> FloorTest:
    """Simulate one forward test on a floor.

    Args:
        mechanism: a drivetrain, without hard stops of its own.
        routine: the voltages of the tests.
        test: ``quasistatic-forward`` or ``dynamic-forward``.
        floor: start, mark and wall.

    Raises:
        BadRequest: the routine has no such test, or it does not go forward.
    """
    if test not in routine.tests or not test.endswith("-forward"):
        forward = ", ".join(one for one in routine.tests if one.endswith("-forward"))
        raise BadRequest(f"{test!r} on a runway", advice=f"Choose one of: {forward}.")
    asked = np.arange(0.0, min(routine.timeout, floor.watched) + PERIOD / 2, PERIOD)
    track = simulate_run(
        mechanism.model,
        time=asked,
        voltage=np.array([routine.command_voltage(test, t) for t in asked.tolist()]),
        state=State(),
        wires=make_power_path_array(mechanism),
    )
    on = _count_samples_until_off(track.position, floor)
    way, speed = _simulate_braking(
        float(track.position[on - 1]), float(track.velocity[on - 1]), mechanism, floor
    )
    position = np.concatenate([track.position[:on], way])
    velocity = np.concatenate([track.velocity[:on], speed])
    battery = np.concatenate([track.bus[:on], np.full(way.size, mechanism.battery.rest)])
    time = np.arange(position.size, dtype=np.float64) * PERIOD
    beyond = np.flatnonzero(position >= floor.wall)
    end = int(beyond[0]) + 1 if beyond.size else time.size
    return FloorTest(
        floor,
        time[:end],
        np.minimum(position[:end], floor.wall),
        velocity[:end],
        battery[:end],
        released=PERIOD * (on - 1),
        hit_wall=float(time[end - 1]) if beyond.size else None,
    )


def _count_samples_until_off(position: Array, floor: Floor) -> int:
    """The number of samples up to the moment when the motors are turned off, inclusive."""
    passed = np.flatnonzero(position >= floor.tape) if floor.tape is not None else np.array([])
    if not passed.size:
        return position.size
    return min(int(passed[0]) + round(floor.thumb / PERIOD) + 1, position.size)


def _simulate_braking(
    position: float, velocity: float, mechanism: Mechanism, floor: Floor
) -> tuple[Array, Array]:
    """Position [m] and velocity [m/s], (n,) each, after the motors are off until it stands."""
    gains, step = mechanism.gains, PERIOD / FINE
    way, speed = [position], [velocity]
    while velocity > STANDSTILL:
        for _ in range(FINE):
            slows = (gains["kV"] * velocity + gains["kS"]) / gains["kA"]
            velocity = max(velocity - step * min(slows, floor.grip * GRAVITY), 0.0)
            position += step * velocity
        way.append(position)
        speed.append(velocity)
    return np.array(way[1:]), np.array(speed[1:])
