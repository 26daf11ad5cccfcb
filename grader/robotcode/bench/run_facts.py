"""What running a learner's SysIdRoutine showed."""

from dataclasses import dataclass
from enum import Enum


class RunOutcome(Enum):
    """How a run ended."""

    RAN = "ran"  # all four tests
    CRASHED = "crashed"  # the learner's code stopped with an error
    ENDLESS = "endless"  # it did not come to an end within the limit
    CANNOT = "cannot"  # the simulation has no hold on it: vendors' devices, another season


@dataclass(frozen=True)
class DrivenMotor:
    """The voltage and motion of one motor in a run.

    Args:
        name: the field that holds it, ``left``, or ``PWM 2`` where none does.
        own: whether a field holds it; else what it got is known within some percent only.
        share: what it got, as a share of what the tests asked for; 1 is right, minus one is right
            for a motor that is mounted the other way round; 0 for a motor that never got anything;
            None where the tests asked for too little, or too much, to tell.
        got, asked: [V] an example of it, late in the first test.
    """

    name: str
    own: bool
    share: float | None
    got: float
    asked: float


@dataclass(frozen=True)
class LoggedMotor:
    """One motor's entries in the log, compared with the simulation.

    Args:
        name: as in ``log.motor(...)``.
        voltage: the logged voltage as a share of the motor's; None where nothing tells.
        as_asked: whether it is exactly the commanded voltage although the motor got another.
        kept: [V] logged voltage while the battery is low; 0 if no dynamic test lasts until then.
        lowered: [V] voltage of the motor at that time; 0 likewise.
        rate: the logged velocity as a share of the slope of the logged position; 1 is right. None
            where nothing moved.
        forward: whether a positive voltage goes with a positive velocity; None where nothing moved.
        scale: the logged position in the entry's own unit, as a multiple of what the bench's
            encoder said; None where it follows none.
        encoder: which encoder that is, from 0; None where it follows none.
        angular: whether the entry is an angle.
    """

    name: str
    voltage: float | None
    as_asked: bool
    kept: float
    lowered: float
    rate: float | None
    forward: bool | None
    scale: float | None
    encoder: int | None
    angular: bool


@dataclass(frozen=True)
class ButtonPress:
    """What happened when a button was held for a moment.

    Args:
        test_mode: whether the robot was in test mode; else it was driven by a person.
        port: of the controller.
        button: its number, or the angle of its hat: ``3``, ``90 deg``.
        tests: the tests that ran meanwhile, in SysId's words: ``dynamic-forward``.
        stayed: whether one went on when the button was let go.
    """

    test_mode: bool
    port: int
    button: str
    tests: tuple[str, ...]
    stayed: bool


@dataclass(frozen=True)
class RunFacts:
    """The facts that a run showed; without a run only ``outcome``, ``said`` and ``where``.

    Args:
        outcome: how it ended.
        said: in one line why it did not run; empty if it did.
        line: where in the learner's code, from 1; 0 if unknown.
        where: the callback in which that was, ``drive`` or ``log``; empty otherwise.
        ramp: [V/s] of the quasistatic test.
        step: [V] of the dynamic test.
        timeout: [s] after which a test that is left alone ends; infinite if it goes on and on.
        tests: those that the log names; none where the program keeps their names elsewhere.
        motors: what every motor did.
        recorded: what is in the log of every motor that has voltage, position and velocity there.
        required: whether the tests require the subsystem.
        per_pulse: what the encoders count per pulse, in the program's own unit.
        lacking: why the log cannot be read; empty if it can.
        presses: the buttons that started a test, where buttons were pressed.
        aware: where the program asks whether it is simulated, so that it may do something else on a
            robot and the run shows nothing to be right; empty if nowhere.
    """

    outcome: RunOutcome
    said: str = ""
    line: int = 0
    where: str = ""
    ramp: float = 0.0
    step: float = 0.0
    timeout: float = 0.0
    tests: tuple[str, ...] = ()
    motors: tuple[DrivenMotor, ...] = ()
    recorded: tuple[LoggedMotor, ...] = ()
    required: bool = True
    per_pulse: tuple[float, ...] = ()
    lacking: str = ""
    presses: tuple[ButtonPress, ...] = ()
    aware: str = ""
