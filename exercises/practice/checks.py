"""Practice: the five steps of the lesson on one mechanism, by the checks of their exercises."""

import math
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from grader.answers.asked_number import AskedNumber, Band
from grader.answers.choice_answer import read_choice
from grader.answers.number_answer import judge_number, read_answer_number
from grader.answers.submission import NamedAnswers, StudentAnswers, read_answers, read_text
from grader.checks.check import Check, NotReachedError, WrongAnswer, check, make_check
from grader.course.progress import find_course
from grader.exercise.exercise import Exercise, find_checks
from grader.robotcode.bench.facts import RoutineFacts
from grader.student_data.student_files import Made, format_log
from grader.student_data.variant import cache_draws, choose
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.core.errors import Refusal
from sim.inspect.faults import FAULTS
from sim.physics.motors import find_motor

from .measured import (
    ANALYSES,
    Measured,
    make_team,
    measure_bench,
    measure_robot,
    read_right_gain_or_fitted,
)

HERE = Path(__file__).resolve().parent
FILES = ("answers.toml",)
BESIDE = (
    "ExampleSubsystem.java", "RobotContainer.java", "example_subsystem.py", "robotcontainer.py",
)  # fmt: skip
ANSWER_NAMES = (
    "language", "subsystem", "container", "constants",
    "log", "motor", "ratio", "wheel_diameter", "kS", "kV", "kA", "kG", "kP",
    "simulated_velocity_r2", "hypothesis", "first_check", "kV_theory", "difference", "verdict",
)  # fmt: skip
LOG_ENDINGS = (".wpilog", ".csv", ".json")  # of the learner's own robot, named in the answers
LANGUAGES = {"java": BESIDE[:2], "python": BESIDE[2:]}
PLACES = {"subsystem": 0, "container": 1, "constants": 0}  # which of its language's files is usual
STEP, SIDES = 3.5, 2  # [V] of the dynamic tests, and motors, as the files to fill in have them
METERS_PER_ROTATION = 0.0472  # of the motor, the same
MOTORS = ("krakenX60", "falcon500", "krakenX44")  # a TalonFX drives each of them
SPREAD = {"load": (30.0, 65.0), "friction": (0.10, 0.45)}  # [kg], [V] light to heavy, new to worn
GOOD = 0.9  # simulated velocity R² below which something is wrong with the data
COMMENT = re.compile(r"//[^\n]*|#[^\n]*|/\*.*?\*/", re.DOTALL)
LITTLE = 12  # [characters] shorter than which nothing is said
NEAR_BOUND = 1.5  # [%] that a verdict's bound is known to
OWN_LOG = (
    "Your routine has no log callback, and your own logger records its state. So the grader did "
    "not check the logging code. Your log, which is fitted below, shows whether it works."
)
BELOW = -3.0  # [%] under theory that a good motor may still be


def _load_checks(name: str) -> ModuleType:
    """The checks of another exercise: the one beside this, else the installed course's."""
    beside = HERE.parent / name
    folder = beside if beside.is_dir() else find_course(HERE) / "exercises" / name
    return Exercise(name, folder).module


FOURTH, FIFTH, NINTH, TENTH, SECOND = (
    _load_checks(f"exercise{number}") for number in (4, 5, 9, 10, 2)
)
TEAM = sys.modules[f"{SECOND.__name__}.team"]


@dataclass(frozen=True)
class Answers:
    """The object that the checks read: the answers, and the folder of the project."""

    given: Mapping[str, object]
    folder: Path
    student: str
    run: bool = True

    def find_file(self, place: str) -> Path:
        """A file of the learner's language, or one that they named."""
        tongue = read_choice(self.given.get("language"), tuple(LANGUAGES))
        named = self.given.get(place)
        usual = LANGUAGES[tongue][PLACES[place]]
        name = Path(named.replace("\\", "/")).name if isinstance(named, str) and named else usual
        return self.folder / name

    def _read(self, place: str, checks: ModuleType) -> object:
        """A file of the answers, read by the checks of the exercise that it belongs to."""
        try:
            return checks.read(self.find_file(place), student=self.student, run=self.run)
        except Refusal as refusal:
            raise NotReachedError(str(refusal)) from None
        except WrongAnswer as wrong:
            raise NotReachedError(f"language: {wrong.seen}. {wrong.hint}") from None

    @cached_property
    def routine(self) -> Any:  # noqa: ANN401 - of a module that is loaded by path
        """The run of the routine, made as in exercise 4."""
        return self._read("subsystem", FOURTH)

    @cached_property
    def bindings(self) -> object:
        """The run of the buttons, made as in exercise 5."""
        return self._read("container", FIFTH)

    @property
    def log(self) -> str:
        """The log of the learner's own robot, if they name one."""
        log = self.given.get("log")
        return log.strip() if isinstance(log, str) else ""

    @cached_property
    def measured(self) -> Measured:
        """The mechanism: with a robot, that of its log; without, the bench's drivetrain."""
        if self.log:
            return measure_robot(self.folder / Path(self.log.replace("\\", "/")).name, self.given)
        return measure_bench(draw(self.student))

    @cached_property
    def constants(self) -> Any:  # noqa: ANN401 - of a module that is loaded by path
        """Exercise 10's reading of the constants, compared with the gains of this mechanism.

        A constant may be the gain of the log's fit, or as the learner wrote it down.
        """
        code = self._read("constants", TENTH)
        one = self.measured
        kind = ANALYSES[one.fit.type]
        parts = (
            {}
            if one.parts is None
            else {"ratio": one.parts.ratio, "radius": one.parts.diameter / 2}
        )
        fitted = {name: asked.expected for name, asked in one.key.asked.items()}
        variant = TENTH.Variant("own", kind, fitted, one.units, one.units, duty=False, **parts)
        held = {each.gain: each.value for facts in code.runs for each in facts.constants}
        shown = {
            name: value
            if isinstance(held.get(name), int | float) and variant.accepts(name, held[name])
            else read_right_gain_or_fitted(name, self.given, one)
            for name, value in fitted.items()
        }
        return replace(code, variant=replace(variant, shown=shown))

    @cached_property
    def theory(self) -> Any:  # noqa: ANN401 - of a module that is loaded by path
        """The comparison with theory, made as in exercise 2."""
        return StudentAnswers(self.given, make_team(self.measured, self.given, TEAM), self.student)


@cache_draws
def draw(student: str) -> Any:  # noqa: ANN401 - of a module that is loaded by path
    """A learner's drivetrain, always the same one: its code is the file to fill in."""
    return NINTH.draw_solvable(student, "practice", _draw_drivetrain, step=STEP)


def _draw_drivetrain(rng: np.random.Generator) -> Mechanism:
    """A drivetrain with one motor on each side, and the gears and wheels of the file to fill in.

    The file fixes what one turn of the motor is in meters, so the motor makes kV differ.
    """
    plain = MECHANISMS["drivetrain"]
    motor = find_motor(choose(MOTORS, rng))
    drawn = replace(plain, motor=motor, spread={**plain.spread, **SPREAD}).draw(rng)
    ratio = 2.0 * math.pi * drawn.radius / METERS_PER_ROTATION
    return replace(drawn, motor_count=SIDES, ratio=ratio)


def make_files(student: str) -> dict[str, Made]:
    """The log of a drivetrain, and its parts."""
    variant = draw(student)
    parts = measure_bench(variant).parts
    if parts is None:
        raise RuntimeError("the bench's own mechanism has parts")
    rpm = parts.motor.free_speed * 30.0 / math.pi
    wheel = f"wheel_diameter = {parts.diameter:g}  # [m]\n" if parts.diameter else ""
    told = f"""\
# The drivetrain of log.wpilog, if you have no robot at hand. ExampleSubsystem is its code.
mechanism = "{variant.mechanism.name}"
motor = "{parts.motor.name}"
free_speed = {rpm:.0f}  # [rpm] of the motor at 12 V, by its data sheet
ratio = {parts.ratio:.6g}  # turns of the motor for one of the mechanism
{wheel}"""
    return {"given.toml": told, "log.wpilog": format_log(variant.log)}


def read(path: Path, *, student: str, run: bool = True) -> Answers:
    """The answers, and where the rest of them stands.

    Args:
        path: the file with the answers.
        student: whose they are.
        run: whether robot code may be run, where it can be.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    return Answers(NamedAnswers(read_answers(path)), path.resolve().parent, student, run)


def _borrow_checks(
    checks: ModuleType, part: str, *, step: str, leave: tuple[str, ...] = ()
) -> tuple[Check[Answers], ...]:
    """Let the checks of another exercise look at a part of the answers."""
    ours: dict[str, Check[Answers]] = {}
    for one in find_checks(checks):
        if one.id in leave:
            continue

        def judge_part(answers: Answers, theirs: Check[Any] = one) -> str | None:
            if checks is FOURTH and theirs.id in {"log", "units"} and _logs_by_itself(answers):
                return OWN_LOG
            return theirs.judge(getattr(answers, part))

        before = tuple(ours[first.id] for first in one.after)
        ours[one.id] = make_check(
            f"{step}-{one.id}", one.description, judge_part, points=one.points, after=before
        )
    return tuple(ours.values())


def _logs_by_itself(answers: Answers) -> bool:
    """Whether a logger such as AdvantageKit's writes the log, which the learner hands in."""
    return bool(answers.log) and all(one.own_log and not one.log for one in answers.routine)


routine_checks = _borrow_checks(FOURTH, "routine", step="routine")
button_checks = _borrow_checks(FIFTH, "bindings", step="buttons")


def _make_gain_check(name: str, *, points: float) -> Check[Answers]:
    """A check of a gain that was written down."""

    def look(answers: Answers) -> str | None:
        key = answers.measured.key
        if name not in key.asked:
            raise NotReachedError(f"your fit suggests no {name}")
        return judge_number(name, answers.given, key, points=points)

    return make_check(f"gains_{name}", f"{name}, as your log has it.", look, points=points)


gain_checks = tuple(_make_gain_check(name, points=1.0) for name in ("kS", "kV", "kA", "kP"))


@check(points=1)
def r2(answers: Answers) -> None:
    """The simulated velocity R² of your fit."""
    found = float(answers.measured.fit.simulated_velocity_r2)
    asked = AskedNumber("simulated_velocity_r2", found, "", Band(0.0, 0.0, 0.02, 0.02))
    value = read_answer_number(answers.given.get("simulated_velocity_r2"), asked)
    if hint := NINTH.explain_r2(value, asked):
        raise WrongAnswer(f"{value:.4g}", hint=hint, misconception="M-R2")


@check(points=1, after=r2)
def hypothesis(answers: Answers) -> str | None:
    """What you suspect if R² is below 0.9, and what you would check first."""
    if float(answers.measured.fit.simulated_velocity_r2) >= GOOD:
        return "Your R² is at least 0.9, so you need no suspicion."
    read_choice(answers.given.get("hypothesis"), tuple(FAULTS))
    first = answers.given.get("first_check")
    if not isinstance(first, str) or len(first.strip()) < LITTLE:
        raise WrongAnswer("no first_check", hint="Write a sentence: what would you check first?")
    return None


constant_checks = _borrow_checks(TENTH, "constants", step="constants")


@check(points=2)
def one_mechanism(answers: Answers) -> None:
    """Your files and your log are about one mechanism."""
    facts: RoutineFacts = answers.routine[0]
    if not facts.line:
        raise NotReachedError("checked after your subsystem makes a SysIdRoutine")
    _check_one_routine(answers, facts)
    _check_same_motion(answers.measured, facts)


def _check_one_routine(answers: Answers, facts: RoutineFacts) -> None:
    """Whether the buttons start the routine of the subsystem's own file."""
    subsystem, container = (answers.find_file(place) for place in ("subsystem", "container"))
    try:
        text = COMMENT.sub("", read_text(container))
    except Refusal as refusal:
        raise NotReachedError(str(refusal)) from None
    if subsystem == container:
        return
    own = f"the class {facts.name}"
    if re.search(r"\bSysIdRoutine\s*\(", text):
        raise WrongAnswer(
            f"{subsystem.name} has a SysIdRoutine, and {container.name} has another one",
            hint=f"The buttons start the routine in {container.name}, so nobody runs the one in "
            f"{subsystem.name}. Delete the class with the second routine, and use {own}.",
        )
    if not re.search(rf"\b{re.escape(facts.name)}\b", text):
        raise WrongAnswer(
            f"{container.name} does not use {own}",
            hint="The buttons must start the tests of the subsystem that has your SysIdRoutine.",
        )


def _check_same_motion(measured: Measured, facts: RoutineFacts) -> None:
    """Check that the code records the same quantity as the log: meters or rotations."""
    signals = [one for test in facts.tests.values() for one in test.signals.values()]
    families = {one.family for several in signals for one in several.values() if one.family}
    expected = "linear" if measured.units == "Meters" else "angular"
    if families and expected not in families:
        found, held = ("turns", "meters") if expected == "linear" else ("meters", "turns")
        raise WrongAnswer(
            f"your code records {found}, and your log has {held}",
            hint="They are two different mechanisms. Use the code of the mechanism that recorded "
            "the log: then its unit is also the unit of your gains and of your feedforward.",
            misconception="M-UNITS",
            earned=1.0,
        )


theory_checks = _borrow_checks(
    SECOND, "theory", step="theory", leave=("verdict", "inspection", "ks-flag")
)


@check(points=2)
def theory_verdict(answers: Answers) -> None:
    """Your kV, compared with theory."""
    variant = answers.theory.variant
    percents = [variant.compute_percent_above(one) for one in variant.theories]
    right = {TEAM.find_verdict(one + off) for one in percents for off in (-NEAR_BOUND, NEAR_BOUND)}
    if BELOW < max(percents) <= 0.0:
        right.add("ok")
    found = read_choice(answers.given.get("verdict"), TEAM.VERDICTS)
    if found not in right:
        hint = "find your difference, with its sign, in the table of exercise 2"
        raise WrongAnswer(f'"{found}"', hint=hint)
