"""Exercise 13: a swerve drive, from its logs to the settings of a path planner."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.answers.answer_key import load_answer_key
from grader.answers.choice_answer import check_choice
from grader.answers.number_answer import (
    AnswerKey,
    judge_number,
    make_number_check,
    read_answer_number,
)
from grader.answers.submission import read_answers
from grader.answers.wrong_number import ALIKE, Scene
from grader.check import WrongAnswer, check
from grader.student_data.student_files import Made, write_student_files

from .drawn import draw
from .drive import BATTERY, MODULES, Variant
from .slips import lookalikes, rarer

FILES = ("answers.toml",)
ANSWER_NAMES = (
    "kS", "kV", "kA", "worn", "worn_radius", "lever", "rate_unit", "kA_turning", "inertia",
    "slip_current", "top_speed", "max_torque",
)  # fmt: skip
HERE = Path(__file__).resolve().parent
RAMP, TIMEOUT = 0.5, 8.0  # [V/s], [s] of both routines


@dataclass(frozen=True)
class Answers:
    """What the checks look at."""

    given: Mapping[str, object]
    key: AnswerKey
    variant: Variant


def prepare(student: str, *, say: Callable[[str], None]) -> None:
    """Make the learner's files, where they are not there as they were made."""
    files = made(draw(student))
    write_student_files(files, exercise=HERE, student=student, what="files", say=say)


def made(variant: Variant) -> dict[str, Made]:
    """File -> what makes it; all noise comes from the variant's own seed."""

    def straight(path: Path) -> None:
        import numpy as np  # noqa: PLC0415 - not where the file is there already

        from sim.bench.routine import Routine  # noqa: PLC0415 - the same
        from sim.bench.swerve_logs import record_modules, write_modules  # noqa: PLC0415 - the same

        routine = Routine(ramp=RAMP, step=variant.step, timeout=TIMEOUT)
        rng = np.random.default_rng([variant.seed, 1])
        logs = record_modules(variant.drive, routine, rng=rng, radii=variant.radii)
        write_modules(logs, path)

    def turning(path: Path) -> None:
        import numpy as np  # noqa: PLC0415 - the same

        from sim.bench.routine import Routine  # noqa: PLC0415 - the same
        from sim.bench.simulate import simulate  # noqa: PLC0415 - the same
        from sim.bench.swerve_logs import write_rotation  # noqa: PLC0415 - the same

        routine = Routine(ramp=RAMP, step=variant.step, timeout=TIMEOUT)
        rng = np.random.default_rng([variant.seed, 2])
        log = simulate(variant.drive.rotation, routine, rng=rng)
        write_rotation(log, path, volts_per_rate=variant.volts_per_angular_speed)

    def push(path: Path) -> None:
        import numpy as np  # noqa: PLC0415 - the same

        from sim.bench.swerve_logs import record_wall_push  # noqa: PLC0415 - the same

        one = record_wall_push(variant.drive, rng=np.random.default_rng([variant.seed, 3]))
        rows = zip(one.time, one.voltage, one.current, one.velocity, strict=True)
        head = "time_s,compute_motor_voltage,stator_current,wheel_velocity\n"
        text = "".join(f"{t:.2f},{u:.3f},{i:.1f},{v:.3f}\n" for t, u, i, v in rows)
        path.write_bytes((head + text).encode())

    return {
        "given.toml": _told(variant),
        "straight.wpilog": straight,
        "turning.wpilog": turning,
        "push.csv": push,
    }


def _told(variant: Variant) -> str:
    """What a learner gets to know about the robot, and what was read after the slow spin."""
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed

    from sim.bench.swerve_logs import record_spin  # noqa: PLC0415 - the same

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


def read(path: Path, *, student: str) -> Answers:
    """The answers, and what they are held against.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    given = {name.lower(): value for name, value in read_answers(path).items()}
    variant = draw(student)
    named = {name: given.get(name.lower()) for name in variant.asked}
    scene = Scene(
        ratio=variant.ratio,
        motors=4,
        ramp=RAMP,
        lookalikes=lookalikes(variant),
        rarer=rarer(variant),
    )
    return Answers({**given, **named}, AnswerKey(variant.asked, scene), variant)


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
    """What the entry Rotational_Rate is measured in."""
    load_answer_key(__name__).judge_rate_unit(answers.given.get("rate_unit"))


ka_turning = make_number_check(
    "kA_turning", "The kA of turning on the spot, in V·s²/rad.", points=2
)


@check(points=2)
def inertia(answers: Answers) -> str | None:
    """The moment of inertia."""
    return _computed("inertia", answers, points=2)


slip_current = make_number_check(
    "slip_current", "The current of one motor at which the wheels begin to slip.", points=1
)


@check(points=1)
def top_speed(answers: Answers) -> str | None:
    """PathPlanner's true max drive speed, at 12 V."""
    return _computed("top_speed", answers, points=1)


@check(points=1)
def max_torque(answers: Answers) -> str | None:
    """Choreo's motor max torque: what one motor gives at the slip current."""
    return _computed("max_torque", answers, points=1)


def _computed(name: str, answers: Answers, *, points: float) -> str | None:
    """Judge a number that is computed from others; say so where only those are wrong."""
    try:
        return judge_number(name, answers.given, answers.key, points=points)
    except WrongAnswer as wrong:
        if of := _cause(name, answers):
            wrong.hint = f"it follows from your {of}, and that is not right yet"
            wrong.misconception = ""
        raise


def _cause(name: str, answers: Answers) -> str:
    """The wrong answer that a wrong number follows from; empty if it follows from none."""
    variant = answers.variant
    ways: dict[str, tuple[tuple[str, ...], Callable[..., float]]] = {
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
