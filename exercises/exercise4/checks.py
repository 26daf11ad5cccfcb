"""Exercise 4: is this SysIdRoutine wired the way SysId needs it? Run on a simulated robot."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from grader.checks.check import check
from grader.robotcode.bench.facts import RoutineFacts
from grader.robotcode.bench.simulation import Mount
from grader.robotcode.checks.log import check_logged, check_units
from grader.robotcode.checks.routine import (
    ConfigSetting,
    check_assembled,
    check_driven,
    check_open_loop,
    check_routine_found,
)
from grader.robotcode.running import Runs, judge_runs, run_routine

FILES = ("ExampleSubsystem.java", "example_subsystem.py")

DEFAULTS = (1.0, 7.0, 10.0)  # WPILib's ramp [V/s], step [V] and timeout [s]
RAMP = ConfigSetting("ramp", 0.5, "V/s", DEFAULTS[0], "Volts.of(0.5).per(Second)", "rampRate=0.5")
STEP = ConfigSetting("step voltage", 3.5, "V", DEFAULTS[1], "Volts.of(3.5)", "stepVoltage=3.5")
TIMEOUT = ConfigSetting("timeout", 10.0, "s", DEFAULTS[2], "Seconds.of(10)", "timeout=10.0")
TASK = "ExampleSubsystem"  # the class of the exercise's own drivetrain, one motor on each side
SIDES = 2
PULSES = 2048  # of an encoder for one rotation of its shaft on the bench
METERS = {"TalonFX": 0.0472, "Encoder": 0.000156 * PULSES}  # [m] of one rotation, by the files
MOUNTS = {  # how the drivetrain's motors are built in: plus is forward on both sides
    "java": {1: Mount(), 2: Mount(backward=True, inverted=True)},
    "python": {0: Mount(), 1: Mount(backward=True)},
}
LESSON_STEP = 3.0  # [V] in the source lesson's example
FULL_BATTERY = 13.0  # [V] more than any battery of a robot has


def read(path: Path, *, student: str, run: bool = True) -> Runs:  # noqa: ARG001 - one task for all
    """The facts about the program's routine.

    Args:
        path: the file.
        student: whose it is.
        run: whether a learner's Python may be run; Java is interpreted by ourselves in any case.

    Raises:
        UnreadableFile: it cannot be read, or does not parse.
        NotRunError: it is Python, which may not be run.
    """
    return run_routine(path, mounts=MOUNTS, task=TASK, run=run)


def _judge_both_runs(runs: Runs, judge: Callable[[RoutineFacts], str | None]) -> str | None:
    """Judge the program under both values of each condition that is not known."""
    return judge_runs(runs, judge)


@check(points=1)
def routine(runs: Runs) -> str | None:
    """Your subsystem makes a SysIdRoutine."""
    return _judge_both_runs(runs, check_routine_found)


def _check_setting(
    runs: Runs, wanted: ConfigSetting, advice: Callable[..., tuple[str, str]]
) -> str | None:
    name = wanted.name.split()[0]

    def look(facts: RoutineFacts) -> str | None:
        return wanted.check(facts, getattr(facts, name), advice=partial(advice, facts))

    return _judge_both_runs(runs, look)


@check(points=1, after=routine)
def ramp(runs: Runs) -> str | None:
    """The quasistatic test raises the voltage by 0.5 V every second."""
    return _check_setting(runs, RAMP, _explain_ramp)


def _explain_ramp(facts: RoutineFacts, value: float) -> tuple[str, str]:
    if (value, facts.step.value) == (STEP.value, RAMP.value):
        return "The numbers of ramp and step are swapped.", "M-ARGORDER"
    if 0 < value < RAMP.value:
        return "Slower is not safer.", "M-SLOW-SAFE"
    return "", ""


@check(points=1, after=routine)
def step(runs: Runs) -> str | None:
    """The dynamic test applies a step of 3.5 V."""
    return _check_setting(runs, STEP, _explain_step)


def _explain_step(_facts: RoutineFacts, value: float) -> tuple[str, str]:
    if value == LESSON_STEP:
        return "3 V is an example in many lessons, and fine on many robots.", ""
    if value > FULL_BATTERY:
        return f"No battery of a robot has {value:g} V.", "M-BIG-STEP"
    if value >= STEP.default:
        return f"{STEP.default:g} V, WPILib's default, is almost always too much.", "M-BIG-STEP"
    return "", ""


@check(points=1, after=routine)
def timeout(runs: Runs) -> str | None:
    """A test ends by itself after 10 s."""
    return _check_setting(runs, TIMEOUT, lambda *_: ("", ""))


@check(points=3, after=routine)
def drive(runs: Runs) -> str | None:
    """The drive callback sends its voltage to every motor, as a voltage."""
    return _judge_both_runs(
        runs, lambda one: check_driven(one, points=3, mirrored=one.name != TASK)
    )


@check(points=3, after=routine)
def log(runs: Runs) -> str | None:
    """The log callback records the motor's name, position, velocity and applied voltage."""
    return _judge_both_runs(
        runs, lambda one: check_logged(one, points=3, demanded=SIDES if one.name == TASK else 0)
    )


@check(points=2, after=routine)
def units(runs: Runs) -> str | None:
    """Position and velocity are in units that fit each other and the mechanism."""

    def look(one: RoutineFacts) -> None:
        task = one.name == TASK
        check_units(
            one, mechanism="Drivetrain" if task else one.name, scales=METERS if task else {}
        )

    return _judge_both_runs(runs, look)


@check(points=1, after=routine)
def assembled(runs: Runs) -> str | None:
    """The parts are in their places: Config, Mechanism, and the subsystem itself."""
    return _judge_both_runs(runs, check_assembled)


@check(points=2, after=routine)
def open_loop(runs: Runs) -> str | None:
    """The drive callback uses no closed loop and no duty cycle."""
    return _judge_both_runs(runs, check_open_loop)
