"""Exercise 13: a swerve drive, from its logs to the settings of a path planner."""

import math
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from grader.answers.answer_key import load_answer_key
from grader.answers.choice_answer import check_choice
from grader.answers.number_answer import judge_number, make_number_check, read_answer_number
from grader.answers.submission import StudentAnswers
from grader.answers.wrong_number import ALIKE, AnswerKey, Scene
from grader.checks.check import Check, WrongAnswer, check, make_check
from grader.student_data.student_files import Made
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.bench.swerve_logs import (
    record_modules,
    record_spin,
    record_wall_push,
    write_modules,
    write_rotation,
)

from .drawn import draw
from .drive import BATTERY, MODULES, Variant
from .slips import list_lookalikes, list_rarer_slips

FILES = ("answers.toml",)
ANSWER_NAMES = (
    "kS", "kV", "kA", "worn", "worn_radius", "lever", "rate_unit", "kA_turning", "inertia",
    "slip_current", "top_speed", "max_torque",
)  # fmt: skip
RAMP, TIMEOUT = 0.5, 8.0  # [V/s], [s] of both routines


class Answers(StudentAnswers):
    """The object that the checks read: the answers, and the learner's drive."""

    @cached_property
    def key(self) -> AnswerKey:
        """The right numbers, and what slips make of them."""
        variant: Variant = self.variant
        scene = Scene(
            ratio=variant.ratio,
            motors=4,
            ramp=RAMP,
            lookalikes=list_lookalikes(variant),
            rarer=list_rarer_slips(variant),
        )
        return AnswerKey(variant.asked, scene)


def make_files(student: str) -> dict[str, Made]:
    """The learner's files; all noise comes from the variant's own seed."""
    variant = draw(student)
    return {
        "given.toml": _describe(variant),
        "straight.wpilog": partial(_record_straight, variant),
        "turning.wpilog": partial(_record_turning, variant),
        "push.csv": partial(_record_push, variant),
    }


def _record_straight(variant: Variant, path: Path) -> None:
    routine = Routine(ramp=RAMP, step=variant.step, timeout=TIMEOUT)
    rng = np.random.default_rng([variant.seed, 1])
    logs = record_modules(variant.drive, routine, rng=rng, radii=variant.radii)
    write_modules(logs, path)


def _record_turning(variant: Variant, path: Path) -> None:
    routine = Routine(ramp=RAMP, step=variant.step, timeout=TIMEOUT)
    log = simulate(variant.drive.rotation, routine, rng=np.random.default_rng([variant.seed, 2]))
    write_rotation(log, path, volts_per_rate=variant.volts_per_angular_speed)


def _record_push(variant: Variant, path: Path) -> None:
    one = record_wall_push(variant.drive, rng=np.random.default_rng([variant.seed, 3]))
    rows = zip(one.time, one.voltage, one.current, one.velocity, strict=True)
    head = "time_s,compute_motor_voltage,stator_current,wheel_velocity\n"
    text = "".join(f"{t:.2f},{u:.3f},{i:.1f},{v:.3f}\n" for t, u, i, v in rows)
    path.write_bytes((head + text).encode())


def _describe(variant: Variant) -> str:
    """The facts that a learner reads: the robot, and the readings after the slow spin."""
    drive, rng = variant.drive, np.random.default_rng([variant.seed, 4])
    spin = record_spin(drive, turns=variant.turns, rng=rng, radii=variant.radii)
    motor = drive.motor
    stall = 12.0 / motor.resistance
    lines = [
        "# Your own swerve drive for exercise 13. Only read here; answers go into answers.toml.",
        "# straight.wpilog, turning.wpilog and push.csv are in the same folder as this file.",
        "",
        "[robot]",
        f"mass = {variant.mass:g}  # [kg] with battery and bumpers",
        f"trackwidth = {variant.trackwidth:g}  # [m] between two neighboring wheels; it is square",
        f'motor = "{motor.name}"  # one in each of the four modules',
        f"stall_current = {stall:.4g}  # [A] of one motor at 12 V, by its data sheet",
        f"stall_torque = {motor.torque_constant * stall:.4g}  # [N·m] of one motor at 12 V",
        f"ratio = {variant.ratio:g}  # turns of the motor for one turn of the wheel",
        f"wheel_radius = {variant.radius:g}  # [m] in the code, for all four wheels",
        "",
        "[spin]  # slowly, on the spot",
        f"gyro = {math.degrees(spin.turned):.1f}  # [deg] the robot turned",
        "",
        "[spin.motor_turns]  # [rot] of each drive motor during the spin",
        *(f"{module} = {turns:.2f}" for module, turns in spin.motor_turns.items()),
    ]
    return "\n".join(lines) + "\n"


ks = make_number_check("kS", "The kS of going straight, the voltage that friction takes.", points=1)
kv = make_number_check("kV", "The kV of going straight, in V·s/m.", points=1)
ka = make_number_check("kA", "The kA of going straight, in V·s²/m.", points=1)


@check(points=2)
def worn(answers: Answers) -> None:
    """The module whose wheel is worn."""

    def why(found: str) -> tuple[str, str]:
        return (
            "a smaller wheel turns more often over the same distance. Compare the kV of "
            f"{found} with the other three: fit each with --motor"
        ), ""

    check_choice(answers.given.get("worn"), answers.variant.worn, MODULES, why=why)


worn_radius = make_number_check(
    "worn_radius", "The radius of the worn wheel, from the slow spin.", points=2
)
lever = make_number_check(
    "lever",
    "The lever: from the middle of the robot to the line along which a wheel pushes.",
    points=1,
)


@check(points=1)
def rate_unit(answers: Answers) -> None:
    """The unit of the entry Rotational_Rate."""
    load_answer_key(__name__).judge_rate_unit(answers.given.get("rate_unit"))


ka_turning = make_number_check(
    "kA_turning", "The kA of turning on the spot, in V·s²/rad.", points=2
)


def _make_computed_check(name: str, description: str, *, points: float) -> Check[Answers]:
    """Make a check of a number that is computed from others."""
    return make_check(name, description, partial(_judge_computed, name, points), points=points)


def _judge_computed(name: str, points: float, answers: Answers) -> str | None:
    """Judge a number that is computed from others; say so where only those are wrong."""
    try:
        return judge_number(name, answers.given, answers.key, points=points)
    except WrongAnswer as wrong:
        if of := _find_wrong_source(name, answers):
            wrong.hint = f"it fits your {of}, and that is not right yet"
            wrong.misconception = ""
        raise


def _find_wrong_source(name: str, answers: Answers) -> str:
    """The wrong answer that a wrong number follows from; empty if it follows from none."""
    variant = answers.variant
    ways = {
        "inertia": (
            ("lever", "kA_turning", "kA"),
            lambda lever, turning, straight: variant.mass * lever * turning / straight,
        ),
        "top_speed": (("kV", "kS"), lambda kv, ks: (BATTERY - ks) / kv),
        "max_torque": (
            ("slip_current",),
            lambda current: variant.drive.motor.torque_constant * current,
        ),
    }
    sources, compute = ways[name]
    try:
        value, *theirs = (
            read_answer_number(answers.given.get(one), variant.asked[one])
            for one in (name, *sources)
        )
        follows = compute(*theirs)
    except (WrongAnswer, ZeroDivisionError, OverflowError):
        return ""
    if not abs(value - follows) <= ALIKE * abs(follows):
        return ""
    pairs = zip(sources, theirs, strict=True)
    return next((one for one, given in pairs if not variant.asked[one].is_right(given)), "")


inertia = _make_computed_check("inertia", "The moment of inertia.", points=2)
slip_current = make_number_check(
    "slip_current", "The current of one motor at which the wheels begin to slip.", points=1
)


top_speed = _make_computed_check(
    "top_speed", "PathPlanner's true max drive speed, at 12 V.", points=1
)
max_torque = _make_computed_check(
    "max_torque", "Choreo's motor max torque: what one motor gives at the slip current.", points=1
)
