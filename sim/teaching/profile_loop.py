"""A motion profile that a mechanism follows in closed loop, with the controllers of WPILib.

    volts = ff.calculateWithVelocities(now.velocity, after.velocity)
            + pid.calculate(position, now.position)

The controllers have the names, the order of arguments and the arithmetic of WPILib 2026.2.2
(``ElevatorFeedforward``, ``PIDController``, ``TrapezoidProfile``), so that a learner's loop is the
robot's loop. The mechanism is the bench's, with its hidden effects, battery and stops.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.simulate import make_power_path_array
from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.physics.engine import State as Body
from sim.physics.engine import simulate_run

LOOP = 0.02  # [s] of the robot program
ONBOARD = 0.001  # [s] of a loop inside Phoenix 6's motor controllers
BATTERY = 12.0  # [V] the most that a controller asks for
STILL = 0.5  # [s] that a move is watched after its profile has ended
MASSLESS = 1e-9  # [V·s²/unit] below this kA WPILib takes the next velocity alone


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
    """A move from rest to rest: speed up, hold the speed, slow down.

    Args:
        start: [m or rad].
        goal: [m or rad].
        max_velocity: [m/s or rad/s].
        max_acceleration: [m/s² or rad/s²].

    Raises:
        BadRequest: a limit that is not above zero, or no way to go.
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
        """[m/s or rad/s] reached on the way; less than allowed where the way is short."""
        way = abs(self.goal - self.start)
        return min(self.max_velocity, math.sqrt(way * self.max_acceleration))

    @property
    def duration(self) -> float:
        """[s] duration of the move."""
        return abs(self.goal - self.start) / self.top_speed + self.top_speed / self.max_acceleration

    def calculate(self, time: float) -> Setpoint:
        """The setpoint at a time [s] since the start."""
        sign = math.copysign(1.0, self.goal - self.start)
        if time >= self.duration:
            return Setpoint(self.goal, 0.0)
        rising = self.top_speed / self.max_acceleration
        time, left = max(time, 0.0), self.duration - max(time, 0.0)
        if left < rising:  # slowing down is speeding up, seen from the end
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
        period: [s] between the two velocities.
    """

    kS: float  # noqa: N815 - WPILib's name
    kG: float  # noqa: N815 - the same
    kV: float  # noqa: N815 - the same
    kA: float  # noqa: N815 - the same
    period: float = LOOP

    def calculateWithVelocities(self, current: float, following: float) -> float:  # noqa: N802 - WPILib's name
        """[V] voltage that takes the mechanism from one velocity to the next in a period.

        kS gets the sign of the current velocity: from rest there is none in the first loop.

        Args:
            current: [m/s or rad/s] velocity now.
            following: [m/s or rad/s] velocity after one period.
        """
        if self.kA < MASSLESS:
            return self.kS * _sign(following) + self.kG + self.kV * following
        kept = math.exp(-self.kV / self.kA * self.period)
        per_volt = (1.0 - kept) / self.kV if self.kV > 0.0 else self.period / self.kA
        needed = (following - kept * current) / per_volt
        return self.kS * _sign(current) + self.kG + needed


@dataclass
class PIDController:
    """WPILib's class of that name.

    Args:
        kP: [V per unit of error].
        kI: [V per unit of error and second].
        kD: [V·s per unit of error].
        period: [s] of the loop.
    """

    kP: float  # noqa: N815 - WPILib's name
    kI: float = 0.0  # noqa: N815 - the same
    kD: float = 0.0  # noqa: N815 - the same
    period: float = LOOP

    def __post_init__(self) -> None:
        self._total, self._last = 0.0, 0.0

    def calculate(self, measurement: float, setpoint: float) -> float:
        """[V] output of the controller in one loop.

        Args:
            measurement: [m or rad] measured position.
            setpoint: [m or rad] wanted position.
        """
        error = setpoint - measurement
        change = (error - self._last) / self.period  # in the first loop from zero, as WPILib's
        self._last = error
        if self.kI:
            most = 1.0 / abs(self.kI)  # WPILib's limit: the integral adds at most one volt
            self._total = min(max(self._total + error * self.period, -most), most)
        return self.kP * error + self.kI * self._total + self.kD * change


@dataclass(frozen=True)
class LoopInput:
    """The values that a controller knows in one loop.

    Args:
        now: what the profile asks for now.
        after: what it asks for in the next loop.
        position: [m or rad] measured.
        velocity: [m/s or rad/s] measured.
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
        target: (n,) [m or rad] target position.
        position: (n,) [m or rad] reached.
        voltage: (n,) [V] command from each time on.
    """

    time: Array
    target: Array
    position: Array
    voltage: Array

    @property
    def error(self) -> Array:
        """(n,) [m or rad] target minus position: above zero where it is late on the way up."""
        return self.target - self.position

    @property
    def worst_error(self) -> float:
        """[m or rad] the largest error, without its sign."""
        return float(np.abs(self.error).max())


def follow_in_closed_loop(
    mechanism: Mechanism,
    profile: TrapezoidProfile,
    volts: Callable[[LoopInput], object],
    *,
    period: float = LOOP,
) -> FollowedMove:
    """Let a mechanism follow a profile, from rest, and watch it for half a second more.

    Args:
        mechanism: the bench's, with its hidden effects, between its stops.
        profile: the desired motion.
        volts: the controller, called once each loop; its answer is held until the next.
        period: [s] of the loop: ``LOOP`` in a robot program, ``ONBOARD`` in a motor controller.

    Raises:
        BadRequest: the controller answers with no finite number.
    """
    model, wires = mechanism.model, make_power_path_array(mechanism)
    body = Body.cold_at(profile.start)
    count = math.ceil((profile.duration + STILL) / period)
    position, velocity, asked = [profile.start], [0.0], []
    for loop in range(count):
        now, after = profile.calculate(loop * period), profile.calculate((loop + 1) * period)
        answer = volts(LoopInput(now, after, position[-1], velocity[-1]))
        if not isinstance(answer, int | float | np.number) or not math.isfinite(answer):
            raise BadRequest(
                f"the loop answers {answer!r} instead of volts", advice="Return one number."
            )
        asked.append(min(max(float(answer), -BATTERY), BATTERY))
        track = simulate_run(
            model,
            time=period * np.array([loop, loop + 1.0]),
            voltage=np.full(2, asked[-1]),
            state=body,
            wires=wires,
        )
        position.append(float(track.position[-1]))
        velocity.append(float(track.seen[-1]))
    time = period * np.arange(count, dtype=np.float64)
    target = np.array([profile.calculate(t).position for t in time.tolist()])
    return FollowedMove(time, target, np.array(position[:-1]), np.array(asked))


Loop = Callable[[ElevatorFeedforward, PIDController, LoopInput], float]

EXAMPLE = LoopInput(Setpoint(0.4, 0.8), Setpoint(0.418, 0.92), 0.37, 0.74)  # no two numbers alike
CLOSE = 1e-9  # [share] what rounding may change
RIGHT = "Your loop: right."
OURS = " The next cells use our loop until then."


@dataclass(frozen=True)
class CheckedLoop:
    """A learner's loop, and the feedback to it.

    Args:
        loop: the learner's feedback function if it is right, else ours.
        report: the feedback to it, one line.
    """

    loop: Loop
    report: str


def compute_loop_voltage(ff: ElevatorFeedforward, pid: PIDController, one: LoopInput) -> float:
    """[V] output of the loop that lesson 8 asks for: feedforward plus feedback."""
    forward = ff.calculateWithVelocities(one.now.velocity, one.after.velocity)
    return forward + pid.calculate(one.position, one.now.position)


def check_loop(mine: Callable[..., object]) -> CheckedLoop:
    """Check a learner's loop at one time step of a profile; ``...`` is an unfilled blank.

    Args:
        mine: feedforward, feedback and what is known in a loop -> [V].
    """
    try:
        answer = mine(*_controllers(), EXAMPLE)
        if answer is ... or answer is None:
            said = "Your loop: still empty. Put your answer in place of the three dots."
            return CheckedLoop(compute_loop_voltage, said + OURS)
        found = float(answer)  # type: ignore[arg-type]  # whatever it is, the next lines say so
    except Exception as error:  # noqa: BLE001 - a learner's line may fail in any way
        said = f"Your loop: it stops with an error: {error}."
        return CheckedLoop(compute_loop_voltage, said + OURS)
    wanted = compute_loop_voltage(*_controllers(), EXAMPLE)
    if math.isclose(found, wanted, rel_tol=CLOSE):
        return CheckedLoop(mine, RIGHT)  # type: ignore[arg-type]  # judged to answer with a number
    hint = next(
        (says for value, says in _wrong_loops() if math.isclose(found, value, rel_tol=CLOSE)),
        "Add two things: ff.calculateWithVelocities(…) and pid.calculate(…).",
    )
    return CheckedLoop(compute_loop_voltage, f"Your loop: not yet. {hint}{OURS}")


def _controllers() -> tuple[ElevatorFeedforward, PIDController]:
    """A feedforward and a feedback, both new: a PID controller remembers the last error."""
    return ElevatorFeedforward(0.25, 2.0, 4.5, 0.2), PIDController(7.0)


def _wrong_loops() -> list[tuple[float, str]]:
    """[V] of loops that learners write, and what to say to each."""
    ff, pid = _controllers()
    now, after, measured = EXAMPLE.now, EXAMPLE.after, EXAMPLE.position
    forward = ff.calculateWithVelocities(now.velocity, after.velocity)
    feedback = pid.calculate(measured, now.position)
    acceleration = (after.velocity - now.velocity) / ff.period
    return [
        (forward, "The feedback is missing: add pid.calculate(measured, wanted)."),
        (feedback, "The feedforward is missing: add ff.calculateWithVelocities(…)."),
        (
            forward - feedback,
            (
                "pid.calculate takes the measurement first, then what is wanted. Turned around, "
                "it pushes away from the target."
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
            ff.calculateWithVelocities(now.velocity, acceleration) + feedback,
            "The second argument is a velocity, not an acceleration.",
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
    ]


def compute_phoenix_voltage(
    gains: Mapping[str, float], one: LoopInput, *, meters_per_rotation: float
) -> float:
    """[V] output of Motion Magic with the gains of ``Slot0Configs``, in a loop of ``ONBOARD``.

    Args:
        gains: kS and kG [V], kV [V per rot/s], kA [V per rot/s²], kP [V per rot], all per rotation
            of the mechanism.
        one: the profile and the measurement, in meters.
        meters_per_rotation: [m] that one rotation of the mechanism moves.
    """
    velocity = one.now.velocity / meters_per_rotation
    acceleration = (one.after.velocity - one.now.velocity) / ONBOARD / meters_per_rotation
    error = (one.now.position - one.position) / meters_per_rotation
    forward = gains["kS"] * _sign(velocity) + gains["kV"] * velocity + gains["kA"] * acceleration
    return forward + gains["kG"] + gains["kP"] * error


def _sign(value: float) -> float:
    """Java's ``Math.signum``."""
    return float((value > 0.0) - (value < 0.0))
