"""A motion profile that a mechanism follows in closed loop, with the controllers of WPILib.

    volts = ff.calculateWithVelocities(now.velocity, after.velocity)
            + pid.calculate(position, now.position)

The controllers have the names, the order of arguments and the arithmetic of WPILib 2026.2.2
(``ElevatorFeedforward``, ``PIDController``, ``TrapezoidProfile``), so that a student's loop works
on a robot. The mechanism is a simulated one, with its hidden effects, battery and stops.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from textwrap import fill

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.simulate import make_power_path_array
from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.core.units import BATTERY
from sim.physics.engine import NO_WIRES, simulate_run
from sim.physics.engine import State as Body
from sim.physics.model import Model
from sim.teaching.fit_gaps import CLOSE, RIGHT, WIDTH, judge_gap

LOOP = 0.02  # [s] loop period of the robot program
SETTLING = 0.5  # [s] simulated after the end of the profile
MASSLESS = 1e-9  # [V·s²/unit] with a smaller kA, WPILib uses the next velocity alone


@dataclass(frozen=True)
class Setpoint:
    """Target position and velocity at one moment.

    Args:
        position: [m or rad].
        velocity: [m/s or rad/s].
    """

    position: float
    velocity: float


@dataclass(frozen=True)
class TrapezoidProfile:
    """A move from rest to rest: constant acceleration, constant velocity, constant deceleration.

    Args:
        start: initial position [m or rad].
        goal: final position [m or rad].
        max_velocity: limit of the speed [m/s or rad/s].
        max_acceleration: limit of the acceleration [m/s² or rad/s²].

    Raises:
        BadRequest: a limit is not above zero, or start and goal are equal or not finite.
    """

    start: float
    goal: float
    max_velocity: float
    max_acceleration: float

    def __post_init__(self) -> None:
        limits = (self.max_velocity, self.max_acceleration)
        if not all(math.isfinite(one) and one > 0.0 for one in limits):
            raise BadRequest("a limit of the profile is not above zero", advice="Choose another.")
        if not math.isfinite(self.goal - self.start) or self.goal == self.start:
            raise BadRequest("a profile that goes nowhere", advice="Choose another goal.")

    @property
    def top_speed(self) -> float:
        """The highest speed [m/s or rad/s]; below the limit if the distance is short."""
        way = abs(self.goal - self.start)
        return min(self.max_velocity, math.sqrt(way * self.max_acceleration))

    @property
    def duration(self) -> float:
        """The duration of the move [s]."""
        return abs(self.goal - self.start) / self.top_speed + self.top_speed / self.max_acceleration

    def calculate(self, time: float) -> Setpoint:
        """The setpoint at a time [s] since the start."""
        sign = math.copysign(1.0, self.goal - self.start)
        if time >= self.duration:
            return Setpoint(self.goal, 0.0)
        rising = self.top_speed / self.max_acceleration
        time, left = max(time, 0.0), self.duration - max(time, 0.0)
        if left < rising:  # the deceleration is the acceleration reversed in time
            way = self.max_acceleration * left * left / 2.0
            return Setpoint(self.goal - sign * way, sign * self.max_acceleration * left)
        fast = max(time - rising, 0.0)
        slow = min(time, rising)
        way = self.max_acceleration * slow * slow / 2.0 + self.top_speed * fast
        return Setpoint(self.start + sign * way, sign * self.max_acceleration * slow)


@dataclass(frozen=True)
class ElevatorFeedforward:
    """WPILib's class of that name; with kG = 0 it is ``SimpleMotorFeedforward``.

    Args:
        kS: [V].
        kG: [V].
        kV: [V·s/unit].
        kA: [V·s²/unit].
        period: time between the two velocities [s].
    """

    kS: float  # noqa: N815 - WPILib's name
    kG: float  # noqa: N815 - the same
    kV: float  # noqa: N815 - the same
    kA: float  # noqa: N815 - the same
    period: float = LOOP

    def calculateWithVelocities(self, current: float, following: float) -> float:  # noqa: N802 - WPILib's name
        """The voltage [V] that brings the mechanism from one velocity to the next in a period.

        kS gets the sign of the current velocity, so it is left out in the first loop from rest. If
        kA is negligible, it gets the sign of the next velocity.

        Args:
            current: velocity now [m/s or rad/s].
            following: velocity after one period [m/s or rad/s].
        """
        if self.kA < MASSLESS:
            return self.kS * _sign(following) + self.kG + self.kV * following
        kept = math.exp(-self.kV / self.kA * self.period)
        per_volt = (1.0 - kept) / self.kV if self.kV > 0.0 else self.period / self.kA
        needed = (following - kept * current) / per_volt
        return self.kS * _sign(current) + self.kG + needed

    calculate = calculateWithVelocities  # WPILib's name in Python


@dataclass
class PIDController:
    """WPILib's class of that name.

    Args:
        kP: proportional gain [V/unit].
        kI: integral gain [V/(unit·s)].
        kD: derivative gain [V·s/unit].
        period: loop period [s].
    """

    kP: float  # noqa: N815 - WPILib's name
    kI: float = 0.0  # noqa: N815 - the same
    kD: float = 0.0  # noqa: N815 - the same
    period: float = LOOP

    def __post_init__(self) -> None:
        self._total, self._last = 0.0, 0.0

    def calculate(self, measurement: float, setpoint: float) -> float:
        """The output [V] of the controller in one loop.

        Args:
            measurement: measured position [m or rad].
            setpoint: target position [m or rad].
        """
        error = setpoint - measurement
        # In the first loop, the last error is 0, as in WPILib
        change = (error - self._last) / self.period
        self._last = error
        if self.kI:
            most = 1.0 / abs(self.kI)  # WPILib's limit: the integral adds at most one volt
            self._total = min(max(self._total + error * self.period, -most), most)
        return self.kP * error + self.kI * self._total + self.kD * change


@dataclass(frozen=True)
class LoopInput:
    """The values that a controller knows in one loop.

    Args:
        now: setpoint of the profile now.
        after: setpoint in the next loop.
        position: measured position [m or rad].
        velocity: measured velocity [m/s or rad/s].
    """

    now: Setpoint
    after: Setpoint
    position: float
    velocity: float


@dataclass(frozen=True, eq=False)
class FollowedMove:
    """A simulated move, loop by loop.

    Args:
        time: (n,) [s].
        target: (n,) target position [m or rad].
        position: (n,) position [m or rad].
        voltage: (n,) voltage commanded from each time on [V].
    """

    time: Array
    target: Array
    position: Array
    voltage: Array

    @property
    def error(self) -> Array:
        """Target minus position, (n,) [m or rad]; positive if it lags behind on the way up."""
        return self.target - self.position

    @property
    def worst_error(self) -> float:
        """The largest absolute error [m or rad]."""
        return float(np.abs(self.error).max())


def simulate_loop(
    model: Model,
    volts: Callable[[int, list[float], list[float]], float],
    *,
    loops: int,
    start: float = 0.0,
    wires: Array = NO_WIRES,
) -> Array:
    """Position, velocity and voltage of a mechanism in a loop, from rest: (3, loops).

    Args:
        model: the mechanism.
        volts: the program: number of the loop, positions and velocities until now -> voltage [V].
        loops: how many loops of ``LOOP`` seconds.
        start: initial position.
        wires: battery and limits of the motors; by default, every voltage is there.
    """
    body, position, velocity = Body.cold_at(start), [start], [0.0]
    asked: list[float] = []
    for loop in range(loops):
        asked.append(min(max(volts(loop, position, velocity), -BATTERY), BATTERY))
        track = simulate_run(
            model,
            time=LOOP * np.array([loop, loop + 1.0]),
            voltage=np.full(2, asked[-1]),
            state=body,
            wires=wires,
        )
        position.append(float(track.position[-1]))
        velocity.append(float(track.seen[-1]))
    return np.array([position[:-1], velocity[:-1], asked])


def follow_in_closed_loop(
    mechanism: Mechanism, profile: TrapezoidProfile, volts: Callable[[LoopInput], object]
) -> FollowedMove:
    """Simulate a mechanism that follows a profile from rest, and half a second more.

    Args:
        mechanism: a simulated mechanism, with its hidden effects.
        profile: the target motion.
        volts: the controller, called once each loop; its voltage [V] holds until the next.

    Raises:
        BadRequest: the controller does not return a finite number.
    """

    def answer(loop: int, position: list[float], velocity: list[float]) -> float:
        now, after = profile.calculate(loop * LOOP), profile.calculate((loop + 1) * LOOP)
        found = volts(LoopInput(now, after, position[-1], velocity[-1]))
        if not isinstance(found, int | float | np.number) or not math.isfinite(found):
            raise BadRequest(
                f"the loop answers {found!r} instead of volts", advice="Return one number."
            )
        return float(found)

    count = math.ceil((profile.duration + SETTLING) / LOOP)
    position, _, asked = simulate_loop(
        mechanism.model,
        answer,
        loops=count,
        start=profile.start,
        wires=make_power_path_array(mechanism),
    )
    time = LOOP * np.arange(count, dtype=np.float64)
    target = np.array([profile.calculate(t).position for t in time.tolist()])
    return FollowedMove(time, target, position, asked)


Loop = Callable[[ElevatorFeedforward, PIDController, LoopInput], float]

# All numbers differ, so that mistakes can be told apart
EXAMPLE = LoopInput(Setpoint(0.4, 0.8), Setpoint(0.418, 0.92), 0.37, 0.74)
OURS = "The next cells use our loop until then."


@dataclass(frozen=True)
class CheckedLoop:
    """A student's loop, and the feedback to it.

    Args:
        loop: the student's function if it is right, else ``compute_loop_voltage``.
        report: the feedback to it, one line.
    """

    loop: Loop
    report: str


def compute_loop_voltage(ff: ElevatorFeedforward, pid: PIDController, one: LoopInput) -> float:
    """The output [V] of the loop in lesson 8: feedforward plus feedback."""
    forward = ff.calculateWithVelocities(one.now.velocity, one.after.velocity)
    return forward + pid.calculate(one.position, one.now.position)


def check_loop(mine: Callable[..., object]) -> CheckedLoop:
    """Check a student's loop at one time step of a profile; ``...`` is an empty blank.

    Args:
        mine: the student's function of feedforward, PID controller and ``LoopInput``; returns [V].
    """
    wanted = compute_loop_voltage(*_make_controllers(), EXAMPLE)
    said = judge_gap(lambda: mine(*_make_controllers(), EXAMPLE), wanted, _choose_hint)
    if said == RIGHT:
        return CheckedLoop(mine, f"Your loop: {said}")  # type: ignore[arg-type]  # judged to answer with a number
    return CheckedLoop(compute_loop_voltage, fill(f"Your loop: {said} {OURS}", WIDTH))


def _choose_hint(found: float) -> str:
    """The hint for a wrong output [V]."""
    return next(
        (says for value, says in _list_wrong_loops() if math.isclose(found, value, rel_tol=CLOSE)),
        "Add two things: ff.calculateWithVelocities(…) and pid.calculate(…).",
    )


def _make_controllers() -> tuple[ElevatorFeedforward, PIDController]:
    """A new feedforward and a new PID controller, which stores the last error."""
    return ElevatorFeedforward(0.25, 2.0, 4.5, 0.2), PIDController(7.0)


def _list_wrong_loops() -> list[tuple[float, str]]:
    """Outputs [V] of common wrong loops, each with its hint."""
    ff, pid = _make_controllers()
    now, after, measured = EXAMPLE.now, EXAMPLE.after, EXAMPLE.position
    forward = ff.calculateWithVelocities(now.velocity, after.velocity)
    feedback = pid.calculate(measured, now.position)
    acceleration = (after.velocity - now.velocity) / ff.period
    return [
        (forward, "The feedback adds nothing. Is it pid.calculate(measured, wanted)?"),
        (feedback, "The feedforward adds nothing. Is it ff.calculateWithVelocities(…)?"),
        (
            forward - feedback,
            (
                "Your feedback pushes away from the target. pid.calculate takes the measurement "
                "first, then the target, and its result is added."
            ),
        ),
        (
            ff.calculateWithVelocities(now.velocity, now.velocity) + feedback,
            (
                "The same velocity twice means no acceleration, so kA does nothing. The second one "
                "is the velocity of the next loop."
            ),
        ),
        (
            ff.calculateWithVelocities(after.velocity, now.velocity) + feedback,
            "The two velocities are swapped: first that of now, then that of the next loop.",
        ),
        (
            forward + pid.kP * (after.position - measured),
            "The feedback must compare the position with the setpoint of now, not the next one.",
        ),
        (
            ff.calculateWithVelocities(now.velocity, acceleration) + feedback,
            "The second argument must be a velocity, not an acceleration.",
        ),
        (
            ff.calculateWithVelocities(now.position, after.position) + feedback,
            "The feedforward needs velocities, not positions.",
        ),
        (
            ff.calculateWithVelocities(EXAMPLE.velocity, after.velocity) + feedback,
            "The feedforward looks at what you want, never at what is measured.",
        ),
        (
            forward + pid.kP * (now.velocity - EXAMPLE.velocity),
            "This loop controls a position: pid.calculate needs positions.",
        ),
        (
            forward + pid.kP * (now.velocity - measured),
            "The target of pid.calculate is a position here, not a velocity.",
        ),
    ]


def _sign(value: float) -> float:
    """The sign of a number, as Java's ``Math.signum``."""
    return float((value > 0.0) - (value < 0.0))
