"""The mechanism that was measured: a bench's, or one's own robot with a log and its parts."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType

from grader.answers.asked_number import AskedNumber, Band, ask_gains
from grader.answers.choice_answer import normalize_choice
from grader.answers.number_answer import read_answer_number
from grader.answers.wrong_number import AnswerKey, Lookalike, Scene, WrongNumber
from grader.checks.check import NotReachedError, WrongAnswer, shorten
from sim.core.errors import Refusal
from sim.core.units import find_unit
from sim.fit import Fit, fit
from sim.io import read
from sim.physics.motors import MOTORS, Motor

UNITS = {"Meters": "m", "Rotations": "rot", "Radians": "rad"}
ANALYSES = {"simple": "Simple", "elevator": "Elevator", "arm": "Arm"}
KP = Band(0.05, 0.15)
POSITION = WrongNumber(
    "position", "this is the kP of a position loop. Write the kP of the velocity loop"
)


@dataclass(frozen=True)
class Parts:
    """The built-in parts: motor, number of motors, gear ratio, diameter of the wheel [m]."""

    motor: Motor
    motors: int
    ratio: float
    diameter: float


@dataclass(frozen=True)
class Measured:
    """A mechanism's fit, the requested numbers, and its parts; ``why`` says what is missing."""

    fit: Fit
    key: AnswerKey
    units: str
    parts: Parts | None
    why: str = ""

    @property
    def symbol(self) -> str:
        """The symbol of its unit of position."""
        return UNITS[self.units]


def measure_bench(variant: object) -> Measured:
    """The mechanism of exercise 9, for learners without a robot."""
    built, fit = variant.mechanism, variant.fit  # type: ignore[attr-defined]  # loaded by path
    turns = built.radius == 1.0
    parts = Parts(built.motor, built.motor_count, built.ratio, 0.0 if turns else 2 * built.radius)
    return _make_measured(fit, "Rotations" if turns else "Meters", parts, "")


def measure_robot(path: Path, given: Mapping[str, object]) -> Measured:
    """A mechanism of the learner's own, from its log.

    Raises:
        NotReachedError: the log cannot be read or fitted.
    """
    if not _is_file(path):
        raise NotReachedError(f"there is no {shorten(path.name)} next to your answers.toml")
    try:
        log = read(path)
        kind = log.type or "simple"
        units = "Meters" if not find_unit(log.units).angular else "Rotations"
        units = "Radians" if kind == "arm" else units
        found = fit(log, type=kind, method="sysid").in_units(units.lower())
    except Refusal as refusal:
        raise NotReachedError(str(refusal)) from None
    try:
        return _make_measured(found, units, _read_parts(given, units), "")
    except WrongAnswer as wrong:
        return _make_measured(found, units, None, f"{wrong.seen}. {wrong.hint}")


def _is_file(path: Path) -> bool:
    """Whether a file of this name is there; False if no system allows the name."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def _make_measured(found: Fit, units: str, parts: Parts | None, why: str) -> Measured:
    symbol = UNITS[units]
    names = [name for name in ("kS", "kV", "kA", "kG") if name in found.gains]
    asked = ask_gains({name: found.gains[name] for name in names}, position=symbol)
    loops = found.feedback()
    if "velocity" in loops:
        asked["kP"] = AskedNumber("kP", loops["velocity"].kp, f"V·s/{symbol}", KP)
    other = (Lookalike(loops["position"].kp, POSITION),) if "position" in loops else ()
    lookalikes = {"kP": other}
    if parts is not None and parts.diameter:
        turn = math.pi * parts.diameter  # [m]
        turns = (("wheel", turn), ("motor", turn / parts.ratio))
        for name in ("kV", "kA"):
            lookalikes[name] = tuple(
                Lookalike(found.gains[name] * way, _explain_rotation(what)) for what, way in turns
            )
    scene = Scene(angular=units != "Meters", lookalikes=lookalikes)
    if parts is not None:
        scene = replace(scene, ratio=parts.ratio, motors=parts.motors)
    return Measured(found, AnswerKey(asked, scene), units, parts, why)


def _explain_rotation(what: str) -> WrongNumber:
    says = (
        f"is this per rotation of the {what}, not per meter? In one rotation, a wheel or drum goes "
        "π times its diameter"
    )
    return WrongNumber(f"per-{what}", says, "M-UNITS")


def _read_parts(given: Mapping[str, object], units: str) -> Parts:
    named = given.get("motor")
    known = {normalize_choice(name): motor for name, motor in MOTORS.items()}
    motor = known.get(normalize_choice(named)) if isinstance(named, str) else None
    if motor is None:
        raise WrongAnswer("an unknown motor", hint=f"Write motor = one of: {', '.join(MOTORS)}.")
    free = Band(0.0, 0.0)
    ratio = read_answer_number(given.get("ratio"), AskedNumber("ratio", 1.0, "", free))
    size = AskedNumber("wheel_diameter", 1.0, "m", free)
    diameter = read_answer_number(given.get("wheel_diameter"), size) if units == "Meters" else 0.0
    if ratio <= 0.0 or diameter < 0.0 or (units == "Meters" and not diameter):
        raise WrongAnswer(
            "a ratio or a diameter that is not larger than zero",
            hint="Write the gear ratio, and the diameter of the wheel in meters.",
        )
    return Parts(motor, 1, ratio, diameter)


def make_team(measured: Measured, given: Mapping[str, object], team: ModuleType) -> object:
    """The mechanism as a variant of exercise 2, which compares its kV with theory.

    Args:
        measured: the mechanism.
        given: the answers.
        team: the module of exercise 2 that says what a team's mechanism is.

    Raises:
        NotReachedError: it takes the parts first.
    """
    if measured.parts is None:
        raise NotReachedError(measured.why)
    one = measured.parts
    kv = read_right_gain_or_fitted("kV", given, measured) * (
        2.0 * math.pi if measured.units == "Radians" else 1.0
    )
    rpm = one.motor.free_speed * 30.0 / math.pi
    built = team.Parts(one.motor.name, rpm, one.motor.back_emf, one.motors, one.ratio, one.diameter)
    told = {"code": {"ratio": repr(one.ratio)}}
    return team.Variant("own", built, kv, measured.fit.gains["kS"], 0.0, (), told)


def read_right_gain_or_fitted(name: str, given: Mapping[str, object], measured: Measured) -> float:
    """The gain that the learner wrote down if it is right, else the fitted gain."""
    asked = measured.key.asked[name]
    try:
        value = read_answer_number(given.get(name), asked)
    except WrongAnswer:
        return asked.expected
    return value if asked.is_right(value) else asked.expected
