"""One test on a floor with a stop mark: when the driver lets go, and where the robot stops.

The voltage of the routine is on until the mark has passed and a thumb has reacted, or until the
timeout. Then the motors brake, as hard as their own back-EMF and the carpet allow:

    v' = -min((kV·v + kS)/kA, grip·g)

What comes to the wall before that is not followed any further.
"""

import math
from dataclasses import dataclass

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import make_power_path_array
from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.physics.engine import State, simulate_run

PERIOD = 0.02  # [s] of the robot program's loop
STANDS = 0.01  # [m/s] slower is standing
GRAVITY = 9.81  # [m/s²]
GRIP = 1.1  # [1] of wheels on carpet, roughly
FINE = 20  # steps to a loop while it brakes
THUMB = 0.3  # [s] from seeing the mark to having let go: a person who waits for it


@dataclass(frozen=True)
class Floor:
    """A floor with a start, a stop mark and a wall.

    Args:
        wall: [m] from the start to what must not be hit.
        tape: [m] from the start to the mark; None has none.
        thumb: [s] from the mark to the button's release.
        watched: [s] after which somebody ends the test in any case; infinite is nobody.
        grip: [1] of the wheels.

    Raises:
        BadRequest: a length or a time that is not above zero.
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
        floor: where.
        time: (n,) [s] since the button was pressed.
        position: (n,) [m] from the start.
        velocity: (n,) [m/s].
        battery: (n,) [V].
        released: [s] when the motors were off.
        hit_wall: [s] when it came to the wall, which is the last sample; None if it did not.
        brownout: [V] below which the robot controller takes the motors off.
    """

    floor: Floor
    time: Array
    position: Array
    velocity: Array
    battery: Array
    released: float
    hit_wall: float | None
    brownout: float

    @property
    def final_position(self) -> float:
        """[m] where it stands in the end, or hits the wall."""
        return float(self.position[-1])

    @property
    def browned_out(self) -> bool:
        """Whether the battery sank below the threshold."""
        return float(self.battery.min()) < self.brownout


def drive_test(mechanism: Mechanism, routine: Routine, *, test: str, floor: Floor) -> FloorTest:
    """Run one forward test.

    Args:
        mechanism: without stops of its own.
        routine: which voltages.
        test: ``quasistatic-forward`` or ``dynamic-forward``.
        floor: where.

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
    on = _until_released(track.position, floor)
    way, speed = _braked(
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
        brownout=mechanism.brownout,
    )


def _until_released(position: Array, floor: Floor) -> int:
    """How many samples there are until the motors are off, that moment among them."""
    passed = np.flatnonzero(position >= floor.tape) if floor.tape is not None else np.array([])
    if not passed.size:
        return position.size
    return min(int(passed[0]) + round(floor.thumb / PERIOD) + 1, position.size)


def _braked(
    position: float, velocity: float, mechanism: Mechanism, floor: Floor
) -> tuple[Array, Array]:
    """Position and velocity, (n,) each, from the loop after the motors are off until it stands."""
    gains, step = mechanism.gains, PERIOD / FINE
    way, speed = [position], [velocity]
    while velocity > STANDS:
        for _ in range(FINE):
            slows = (gains["kV"] * velocity + gains["kS"]) / gains["kA"]
            velocity = max(velocity - step * min(slows, floor.grip * GRAVITY), 0.0)
            position += step * velocity
        way.append(position)
        speed.append(velocity)
    return np.array(way[1:]), np.array(speed[1:])
