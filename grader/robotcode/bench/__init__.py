"""Robot code run for real: RobotPy in WPILib's own simulation, against motors of ours.

    file ──sandboxed_run──▶ a process of its own ──▶ robot.wpilog, seen.json ──log_facts──▶ RunFacts

``run_routine_child`` lets the real scheduler run the four tests of the learner's SysIdRoutine on a
tired battery, while what the motor controllers put out moves a model that the encoders see (and
``run_buttons_child`` presses every button of a whole robot, in test mode and out of it).
``log_facts`` holds the log that the robot wrote against what the bench saw. ``season`` knows when a
program is written for another year than the RobotPy that is installed, ``findings`` puts what the
run showed into words.

A learner's code shares its process with the bench. What keeps it from forging a run: the bench
proves with a nonce that it came to its end (``sandboxed_run``), and code that could find the nonce
or change WPILib is refused before it is run (``tampering``).

A run takes about a second, needs the extra ``robot``, and executes what the learner wrote: a copy
of it (``sandbox_files``), shut in as far as the system can. Whoever only wants to read never comes
here.
"""

from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

from grader.isolation import scratch_folder
from grader.robotcode.bench.run_facts import (
    ButtonPress,
    DrivenMotor,
    LoggedMotor,
    RunFacts,
    RunOutcome,
)
from grader.robotcode.bench.sandbox_files import copy_program
from grader.robotcode.bench.sandboxed_run import (
    BENCH,
    BUTTONS,
    GIVEN,
    GRACE,
    Start,
    make_child_command,
    run_confined,
)
from grader.robotcode.bench.tampering import find_simulation_check, refuse_tampering

__all__ = [
    "SECONDS",
    "ButtonPress",
    "DrivenMotor",
    "LoggedMotor",
    "RunFacts",
    "RunOutcome",
    "is_robotpy_installed",
    "press_buttons",
    "refuse_tampering",
    "run_sysid_routine",
]

SECONDS = 10.0  # [s] a run takes 0.5 s alone on a machine, and several on one that is busy


def is_robotpy_installed() -> bool:
    """Whether RobotPy is installed."""
    return all(find_spec(name) is not None for name in ("wpilib", "commands2"))


def run_sysid_routine(
    path: Path, name: str, *, start: Start = run_confined, seconds: float = SECONDS
) -> RunFacts:
    """Run the SysIdRoutine of one subsystem of a RobotPy file.

    Args:
        path: the learner's file.
        name: the class of its subsystem.
        start: starts the child.
        seconds: after which a program that does not end is given up.

    Returns:
        What happened; whatever the learner's code does is an answer.
    """
    return _run(path, name, BENCH, start=start, seconds=seconds)


def press_buttons(
    path: Path, name: str, *, start: Start = run_confined, seconds: float = SECONDS
) -> RunFacts:
    """Press every button of a RobotPy robot, in test mode and out of it.

    Args:
        path: the learner's file.
        name: the class of its container.
        start: starts the child.
        seconds: after which a program that does not end is given up.

    Returns:
        What happened, in ``presses`` which button started a test.
    """
    return _run(path, name, BUTTONS, start=start, seconds=seconds)


def _run(path: Path, name: str, script: Path, *, start: Start, seconds: float) -> RunFacts:
    if not is_robotpy_installed():
        return RunFacts(RunOutcome.CANNOT, "RobotPy is not installed here")
    from grader.robotcode.bench.log_facts import read_facts  # noqa: PLC0415 - needs NumPy

    with scratch_folder() as place:
        folder = place / "left"
        folder.mkdir()
        copy = copy_program(path, folder.with_name(GIVEN))
        ended = start(
            make_child_command(copy, name, folder, seconds=seconds, script=script),
            folder,
            seconds + GRACE,
        )
        found = read_facts(folder, path, ended=ended, seconds=seconds)
        return replace(found, aware=find_simulation_check(path))
