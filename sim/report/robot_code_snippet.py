"""Robot code with a fit's gains: WPILib's feedforward, or the settings of a motor controller.

    from sim.report.robot_code_snippet import write_robot_code
    print(write_robot_code(found.in_log_units(), target="java", name="left drive"))
    print(write_robot_code(found, target="phoenix6", radius=0.0508))

Each target has a template in ``robot_code/`` and a row in ``TARGETS``. It has its own unit of
position, so the code converts kV and kA: a gain is written as in the fit, times a constant. WPILib
takes the cosine of an arm's angle, which must be in radians.

Sources: the documentation of ``Slot0Configs`` in Phoenix 6 26.3 and of ``FeedForwardConfig`` in
REVLib 2026.0; for YAGSL, ``SwerveDrive.replaceSwerveModuleFeedforward``, which takes WPILib's
class. WPILib 2026.2.2: Java's calculate(velocity, acceleration) is deprecated there, and Python's
calculate has always taken the next velocity. WPILib 2027: allwpilib's development branch, where
Java's calculate takes the next velocity and calculateWithVelocities no longer exists, and where
RobotPy's own tests and examples import from wpimath itself. Its early alphas still had
wpimath.controller. Neither was tested, because 2027 is not released.
"""

import math
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from sim.core.advice import Action
from sim.core.doubt import sort_doubts
from sim.core.errors import BadRequest, refuse_unknown
from sim.core.leave_out import LeftOutPart
from sim.core.units import TURN, compute_unit_ratio, find_unit
from sim.feedback import PRESETS, Preset
from sim.fit import Fit
from sim.fit.feedback_trial import try_feedback_gains
from sim.report.gain_verdicts import write_gain_verdict
from sim.report.page_file import load_templates

MOST_DIGITS = 5  # significant digits: errors of the model are larger than the next digit
LEAST_DIGITS = 3  # significant digits: a kA rounded to zero would be another model
LINE = 92  # [characters] of a comment
LEAST_ERROR = 1e-3  # [1] relative error; no gain is really known better than this

ORDER = {  # order of the constructor's arguments
    "simple": ("kS", "kV", "kA"),
    "elevator": ("kS", "kG", "kV", "kA"),
    "arm": ("kS", "kG", "kV", "kA"),
}


class Spelling(NamedTuple):
    """The names in one season's WPILib.

    Args:
        module: package or module of the feedforward classes.
        method: method with the velocity now and a period later; for an arm, the angle comes first.
        notes: comment lines about what is not certain.
    """

    module: str
    method: str
    notes: tuple[str, ...] = ()


ALPHA = "WPILib 2027 is not released: names as on its development branch."
SPELLINGS = {
    ("java", 2026): Spelling("edu.wpi.first.math.controller", "calculateWithVelocities"),
    ("java", 2027): Spelling(
        "org.wpilib.math.controller",
        "calculate",
        (ALPHA, "Make sure that calculate's last argument is the next velocity."),
    ),
    ("python", 2026): Spelling("wpimath.controller", "calculate"),
    ("python", 2027): Spelling(
        "wpimath", "calculate", (ALPHA, "Its early alphas import from wpimath.controller.")
    ),
}
SEASONS = tuple(sorted({season for _, season in SPELLINGS}))
CLASSES = {"elevator": "ElevatorFeedforward", "arm": "ArmFeedforward"}
SIMPLE = "SimpleMotorFeedforward"


@dataclass(frozen=True)
class Target:
    """WPILib in a language, a motor controller, or a library that takes gains.

    Args:
        name: its name, with the release it was checked against.
        units: type of mechanism -> its unit of position; empty takes the fit's. It has no gains
            for a type that is missing.
        preset: loop times and units of its own feedback; None where it has no loop.
        output: what one unit of its output is: ``V``, or ``1`` for a duty cycle.
        language: the language of its code.
        suffix: of WPILib's class for a simple mechanism that moves by a length, and by an angle.
    """

    name: str
    units: Mapping[str, str]
    preset: Preset | None = None
    output: str = "V"
    language: str = "java"
    suffix: tuple[str, str] = ("", "")

    @property
    def is_wpilib(self) -> bool:
        """Whether it is WPILib, where each loop has a controller of its own."""
        return self.preset is PRESETS["default"]

    def list_loops(self, type_: str) -> tuple[str, ...]:
        """The loops that it has: a controller has one, of the position where a mechanism stays."""
        if self.is_wpilib:
            return "velocity", "position"
        return ("velocity" if type_ == "simple" else "position",) if self.preset else ()


# SysId's preset counts velocity per minute, as a Spark without conversion factors does. The code
# asks for factors that make it count per second.
SPARK = replace(PRESETS["rev-brushless"], velocity_time=1.0)
WPILIB = {"simple": "", "elevator": "", "arm": "radians"}
TARGETS = {
    "java": Target("WPILib {season}", WPILIB, PRESETS["default"]),
    "python": Target(
        "WPILib {season}", WPILIB, PRESETS["default"],
        language="python", suffix=("Meters", "Radians"),
    ),
    "phoenix6": Target(
        "Phoenix 6 (26.3)", dict.fromkeys(ORDER, "rotations"), PRESETS["ctre-phoenix6"]
    ),
    "revlib": Target("REVLib (2026)", dict.fromkeys(ORDER, ""), SPARK, output="1"),
    "yagsl": Target("YAGSL", {"simple": "meters"}),
}  # fmt: skip


class Conversion(NamedTuple):
    """The factor from units of the fit to units of the target.

    Args:
        name: the constant that holds it.
        factor: its value; 1 needs no constant.
        unit: its unit.
        per: symbol of the target's unit of position.
    """

    name: str
    factor: float
    unit: str
    per: str

    @property
    def times(self) -> str:
        """The end of a product that converts; empty if there is nothing to convert."""
        return f" * {self.name}" if self.factor != 1.0 else ""


class Constant(NamedTuple):
    """A constant of the code; its comment begins with its unit."""

    name: str
    value: str
    comment: str


def write_robot_code(
    found: Fit, *, target: str, season: int = 2026, radius: float | None = None, name: str = "",
    left_out: Sequence[LeftOutPart] = (), moved: Sequence[str] = (),
) -> str:  # fmt: skip
    """Robot code with the gains of a fit, rounded to the precision that their errors allow.

    Args:
        found: the fit, in the unit of its log.
        target: one of ``TARGETS``: ``java`` and ``python`` are WPILib's feedforward.
        season: 2026 or 2027, where the code names a class of WPILib.
        radius: radius of wheel or drum [m], to convert between a length and a rotation.
        name: name of the mechanism; empty takes its type.
        left_out: parts of the log that were not used.
        moved: gains that the user set.

    Returns:
        The text, with a line break at its end.

    Raises:
        BadRequest: an unknown target or season, a name that does not begin with a letter, a
            missing radius, a mechanism that the target has no gains for, or gains that are
            physically impossible.
    """
    refuse_unknown("target", target, TARGETS)
    refuse_unknown("season", season, SEASONS)
    _refuse_impossible_gains(found)
    chosen = TARGETS[target]
    if found.type not in chosen.units:
        raise BadRequest(
            f"an {found.type} for {chosen.name}, which holds the gains of a drive motor",
            advice=Action("drive-type"),
        )
    converted = convert_units(found, chosen.units[found.type], radius=radius)
    feedback = tuple(_list_feedback(found, chosen, converted))
    loops = [one for one in chosen.list_loops(found.type) if all(one != at for at, _ in feedback)]
    simple = SIMPLE + chosen.suffix[find_unit(found.units).angular]
    template = load_templates().overlay(autoescape=False).get_template(f"robot_code/{target}.jinja")
    text = template.render(
        heading=f"Measured gains of {'an' if found.type[0] in 'ae' else 'a'} {found.type} "
        f"mechanism, for {chosen.name.format(season=season)}; ± is one standard error.",
        facts=_list_facts(found, left_out, moved),
        warnings=list(_list_warnings(found)),
        class_name=make_class_name(name or found.type),
        type=found.type,
        gains=ORDER[found.type],
        feedback=tuple(constant.name for _, constant in feedback),
        loops_without_gains=loops,
        constants=[
            *_list_gains(found, converted),
            *_list_offset(found, chosen, converted),
            *(constant for _, constant in feedback),
        ],
        unit=converted.per,
        rotations_per_unit=find_unit(found.units).si / TURN,
        measured="measured" + converted.times.replace("*", "/"),
        wpilib=SPELLINGS[chosen.language, season],
        wpilib_class=CLASSES.get(found.type, simple),
        period=f"{1e3 * PRESETS['default'].period:.0f}",  # between the two velocities
    )
    return f"{text}\n"


def _list_facts(
    found: Fit, left_out: Sequence[LeftOutPart], moved: Sequence[str]
) -> tuple[str, ...]:
    """A line for each effect in the model, each part left out, and each gain set by hand."""
    return (
        *(f"Effect in the model: {part.effect}" for part in found.parts),
        *(f"Left out: {part}" for part in left_out),
        *(f"Moved by hand, not measured: {gain}" for gain in moved),
    )


def _list_warnings(found: Fit) -> Iterator[str]:
    """The lines of a list: the verdict on the gains, and the first sentence of each doubt."""
    if not found.doubts:
        return
    doubts = [doubt.message for doubt in sort_doubts(found.doubts)]
    for message in (f"Verdict: {write_gain_verdict(found)}", *doubts):
        first = re.split(r"(?<=[.!?])\s+(?=[A-Z`])", message, maxsplit=1)[0]
        yield from textwrap.wrap(
            first, LINE, initial_indent="- ", subsequent_indent="  ", break_long_words=False
        )


def _list_gains(found: Fit, converted: Conversion) -> Iterator[Constant]:
    """The conversion, if one is needed, and the gains with their units and standard errors."""
    if converted.times:
        yield Constant(converted.name, f"{converted.factor:.6g}", f"[{converted.unit}]")
    units = {"kV": f"V·s/{converted.per}", "kA": f"V·s²/{converted.per}"}
    for gain in ORDER[found.type]:
        value, error = found.gains[gain], found.errors.get(gain, math.nan)
        times, factor = (converted.times, converted.factor) if gain in units else ("", 1.0)
        known = _format_error(value * factor, error * factor)
        yield Constant(
            gain, round_to_error(value, error) + times, f"[{units.get(gain, 'V')}]{known}"
        )


def _list_offset(found: Fit, chosen: Target, converted: Conversion) -> Iterator[Constant]:
    """Where an arm is level: an angle for WPILib, the sensor's reading for a motor controller."""
    if found.type != "arm":
        return
    offset, error = found.gains["offset_rad"], found.errors.get("offset_rad", math.nan)
    if chosen.is_wpilib:
        known = _format_error(offset, error)
        yield Constant("kAngleOffset", round_to_error(offset, error), f"[rad]{known}")
    else:
        unit = TURN if converted.per == "rot" else find_unit(found.units).si
        known = f"[{converted.per}] of the sensor when the arm is level"
        yield Constant("kLevelReading", f"{-offset / unit:.6f}", known)


def _list_feedback(
    found: Fit, chosen: Target, converted: Conversion
) -> Iterator[tuple[str, Constant]]:
    """The loop and the constant of each suggested gain that is a good start and not zero."""
    per = converted.per
    for trial in try_feedback_gains(found, chosen.preset) if chosen.preset else ():
        if not trial.is_good or trial.loop not in chosen.list_loops(found.type):
            continue
        held = per if trial.loop == "position" else f"({per}/s)"
        rate = f"({per}/s)" if trial.preset.normalized else f"({per}/ms)"
        prefix = f"k{trial.loop.capitalize() if chosen.is_wpilib else ''}"
        for letter, value, unit in (("P", trial.gains.kp, held), ("D", trial.gains.kd, rate)):
            if value:
                start = round_to_error(float(f"{value:.{LEAST_DIGITS}g}"), math.nan)
                comment = f"[{chosen.output}/{unit}] of the {trial.loop} loop, to start from"
                comment += trial.verdict.past_target
                yield trial.loop, Constant(prefix + letter, start + converted.times, comment)


def round_to_error(value: float, error: float) -> str:
    """A number as code, rounded to the second digit of its error, with three to five digits."""
    if not value:
        return "0.0"
    first = math.floor(math.log10(abs(value)))
    places = MOST_DIGITS - 1 - first
    if math.isfinite(error) and error > 0.0:
        second = 1 - math.floor(math.log10(error))
        places = min(places, max(second, LEAST_DIGITS - 1 - first))
    text = f"{round(value, places):.{max(places, 1)}f}"
    whole, _, fraction = text.partition(".")
    return f"{whole}.{fraction.rstrip('0') or '0'}"


def _format_error(value: float, error: float) -> str:
    """One standard error as the end of a comment: `` ± 0.01``; empty if it is not known."""
    if not math.isfinite(error):
        return ""
    small = error < LEAST_ERROR * abs(value)
    return f" ± less than {LEAST_ERROR:.1%}" if small else f" ± {error:.2g}"


def _refuse_impossible_gains(found: Fit) -> None:
    """Refuse gains that no robot should use.

    Raises:
        BadRequest: a grave doubt, a gain that is not finite, or a negative kV or kA.
    """
    for doubt in found.doubts:
        if doubt.grave:
            raise BadRequest(
                f"no code is written, because the gains are wrong: {doubt.message}",
                advice=doubt.action or "Fix this first, then fit again.",
            )
    for gain, value in found.gains.items():
        if not math.isfinite(value) or (gain in {"kV", "kA"} and value < 0.0):
            raise BadRequest(
                f"no code is written for {gain} = {value:.4g}",
                advice="Record the four tests again: WPILib refuses such a gain on the robot.",
            )


def make_class_name(name: str) -> str:
    """The class name for a mechanism's gains: ``LeftDriveGains`` for ``left drive``.

    Raises:
        BadRequest: the name does not begin with a letter.
    """
    words = re.findall(r"[^\W_]+", name)
    joined = "".join(word[0].upper() + word[1:] for word in words) + "Gains"
    if not words or not joined.isidentifier():
        raise BadRequest(
            f"{name!r} cannot be the name of a class", advice="Begin the name with a letter."
        )
    return joined


def convert_units(found: Fit, unit: str, *, radius: float | None) -> Conversion:
    """The constant by which kV and kA of a fit are multiplied.

    Args:
        found: the fit.
        unit: name of the target's unit of position, or empty for that of the fit.
        radius: radius of wheel or drum [m], or None.

    Raises:
        BadRequest: a radius is needed, and is missing or not a positive number.
    """
    given = find_unit(found.units)
    wanted = find_unit(unit or found.units)
    name = f"k{given.name.capitalize()}Per{wanted.name.capitalize().removesuffix('s')}"
    factor = compute_unit_ratio(wanted, given, radius=radius)
    if math.isnan(factor):
        raise BadRequest(
            f"{given.name} become {wanted.name} only with a radius", advice=Action("radius")
        )
    return Conversion(name, factor, f"{given.symbol}/{wanted.symbol}", wanted.symbol)
