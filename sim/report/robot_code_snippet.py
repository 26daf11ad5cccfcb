"""Robot code for a fit's gains: constants, and WPILib's feedforward object.

    from sim.report.robot_code_snippet import write_robot_code
    print(write_robot_code(found.in_log_units(), language="java", season=2026, name="left drive"))

Differences between languages and seasons are data below; one function assembles the text.
An arm's numbers are always per radian, because WPILib takes the cosine of the angle it is given.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from sim.core.errors import BadRequest
from sim.core.units import Unit, find_unit
from sim.feedback import PRESETS
from sim.fit import Fit
from sim.fit.feedback_trial import try_feedback_gains

DIGITS = 5  # significant digits at most: errors of the model are larger than the next digit
FINEST = 1e-3  # [1] relative error; no gain is really known better than this
FEWEST = 3  # significant digits at least: a kA rounded to zero would be another model
PERIOD = 1e3 * PRESETS["default"].period  # [ms] between the two velocities, WPILib's default


@dataclass(frozen=True)
class Language:
    """Templates of one language; names in braces are replaced."""

    comment: str
    indent: str
    imports: str
    opens: str
    constant: str
    build: str
    closes: str
    linear: str  # feedforward class of a simple mechanism in units of length
    angular: str  # feedforward class of a simple mechanism in units of angle


@dataclass(frozen=True)
class Spelling:
    """The names in one season's WPILib.

    Args:
        module: package or module of the feedforward classes.
        method: method with the velocity now and a period later; for an arm, the angle comes first.
        notes: comment lines about what is not certain.
    """

    module: str
    method: str
    notes: tuple[str, ...] = ()


LANGUAGES = {
    "java": Language(
        comment="//",
        indent="  ",
        imports="import {module}.{cls};",
        opens="public final class {name} {{\n  private {name}() {{}}",
        constant="public static final double {name} = {value};",
        build="public static final {cls} FEEDFORWARD = new {cls}({gains});",
        closes="}\n",
        linear="SimpleMotorFeedforward",
        angular="SimpleMotorFeedforward",
    ),
    "python": Language(
        comment="#",
        indent="    ",
        imports="from {module} import {cls}",
        opens="class {name}:",
        constant="{name} = {value}",
        build="FEEDFORWARD = {cls}({gains})",
        closes="",
        linear="SimpleMotorFeedforwardMeters",
        angular="SimpleMotorFeedforwardRadians",
    ),
}

# Sources. 2026: WPILib 2026.2.2; Java's calculate(velocity, acceleration) is deprecated there, and
# Python's calculate has always taken the next velocity. 2027: allwpilib's development branch, where
# Java's calculate takes the next velocity and calculateWithVelocities no longer exists, and where
# RobotPy's own tests and examples import from wpimath itself. Its early alphas still had
# wpimath.controller. Neither was tested, because 2027 is not released.
_ALPHA = "WPILib 2027 is not released: names as on its development branch."
SPELLINGS = {
    ("java", 2026): Spelling("edu.wpi.first.math.controller", "calculateWithVelocities"),
    ("java", 2027): Spelling(
        "org.wpilib.math.controller",
        "calculate",
        notes=(_ALPHA, "Make sure that calculate's last argument is the next velocity."),
    ),
    ("python", 2026): Spelling("wpimath.controller", "calculate"),
    ("python", 2027): Spelling(
        "wpimath",
        "calculate",
        notes=(_ALPHA, "Its early alphas import from wpimath.controller."),
    ),
}
SEASONS = tuple(sorted({season for _, season in SPELLINGS}))

ORDER = {  # order of the constructor's arguments
    "simple": ("kS", "kV", "kA"),
    "elevator": ("kS", "kG", "kV", "kA"),
    "arm": ("kS", "kG", "kV", "kA"),
}
CLASSES = {"elevator": "ElevatorFeedforward", "arm": "ArmFeedforward"}


def write_robot_code(found: Fit, *, language: str, season: int = 2026, name: str = "") -> str:
    """Robot code with the gains of a fit, rounded to the precision that their errors allow.

    Args:
        found: the fit, in the unit for the code; gains of an arm are converted to radians.
        language: ``java`` or ``python``.
        season: 2026 or 2027.
        name: name of the mechanism; empty takes its type.

    Returns:
        The text, with a line break at its end.

    Raises:
        BadRequest: an unknown language or season, a name that does not begin with a letter, or
            gains that are physically impossible.
    """
    spelling = _find_spelling(language, season)
    refuse_impossible_gains(found)
    write = LANGUAGES[language]
    class_ = make_class_name(name or found.type)
    cls = CLASSES.get(found.type) or (
        write.angular if find_unit(found.units).angular else write.linear
    )
    inside = (
        *_constants(found, write),
        *_feedforward(found, write, spelling, cls=cls),
        *_feedback(found, write),
    )
    return "\n".join(
        (
            write.imports.format(module=spelling.module, cls=cls),
            "",
            *(f"{write.comment} {line}" for line in _heading(found, spelling, season=season)),
            write.opens.format(name=class_),
            *((write.indent + line).rstrip() for line in inside),
            write.closes,
        )
    )


def round_to_error(value: float, error: float) -> str:
    """A number as code, rounded to the second digit of its error, with three to five digits."""
    if not value:
        return "0.0"
    first = math.floor(math.log10(abs(value)))
    places = DIGITS - 1 - first
    if math.isfinite(error) and error > 0.0:
        second = 1 - math.floor(math.log10(error))
        places = min(places, max(second, FEWEST - 1 - first))
    text = f"{round(value, places):.{max(places, 1)}f}"
    whole, _, fraction = text.partition(".")
    return f"{whole}.{fraction.rstrip('0') or '0'}"


def _find_spelling(language: str, season: int) -> Spelling:
    if language not in LANGUAGES:
        raise BadRequest(
            f"unknown language {language!r}", advice=f"Choose one of: {', '.join(LANGUAGES)}."
        )
    if (language, season) not in SPELLINGS:
        seasons = ", ".join(str(known) for known in SEASONS)
        raise BadRequest(f"unknown season {season!r}", advice=f"Choose one of: {seasons}.")
    return SPELLINGS[language, season]


def refuse_impossible_gains(found: Fit) -> None:
    """Refuse gains that no robot should use.

    Raises:
        BadRequest: a grave doubt, a gain that is not finite, or a negative kV or kA.
    """
    for doubt in found.doubts:
        if doubt.grave:
            raise BadRequest(
                f"no code is printed, because the gains cannot be right: {doubt.text}",
                advice="Fix this first, then fit again.",
            )
    for gain, value in found.gains.items():
        if not math.isfinite(value) or (gain in {"kV", "kA"} and value < 0.0):
            raise BadRequest(
                f"no code is printed for {gain} = {value:.4g}",
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


def _heading(found: Fit, spelling: Spelling, *, season: int) -> Iterator[str]:
    yield (
        f"Measured gains of {'an' if found.type[0] in 'ae' else 'a'} {found.type} mechanism, for "
        f"WPILib {season}; ± is one standard error."
    )
    yield from spelling.notes
    if found.doubts:
        yield f"Warnings of the fit, to be read first: {len(found.doubts)}."


def _constants(found: Fit, write: Language) -> Iterator[str]:
    """The lines of the gains, and for an arm the offset from the sensor to the horizontal."""
    given = find_unit(found.units)
    converted = found.type == "arm" and given.name != "radians"
    if converted:
        yield f"{write.comment} Gains per {given.symbol} in the fit, per radian here."
    shown = found.in_units("radians") if found.type == "arm" else found
    for gain in ORDER[found.type]:
        error = shown.errors.get(gain, math.nan)
        yield _line(write, gain, shown.gains[gain], error, shown.format_gain_unit(gain))
    if found.type != "arm":
        return
    reading = "measured"
    if converted:
        yield write.constant.format(name="kRadiansPerUnit", value=repr(given.si)) + (
            f"  {write.comment} [rad/{given.symbol}]"
        )
        reading = "measured * kRadiansPerUnit"
    yield f"{write.comment} angle from horizontal [rad] = {reading} + kAngleOffset"
    offset, error = shown.gains["offset_rad"], shown.errors.get("offset_rad", math.nan)
    yield _line(write, "kAngleOffset", offset, error, "rad")


def _feedforward(found: Fit, write: Language, spelling: Spelling, *, cls: str) -> Iterator[str]:
    per = _code_unit(found)
    angle = "angle, " if found.type == "arm" else ""
    yield ""
    yield f"{write.comment} Volts: FEEDFORWARD.{spelling.method}({angle}velocity, nextVelocity)"
    yield (
        f"{write.comment} with velocities in {per.symbol}/s, the next one {PERIOD:.0f} ms later "
        "(not an acceleration)."
    )
    yield write.build.format(cls=cls, gains=", ".join(ORDER[found.type]))


def _feedback(found: Fit, write: Language) -> Iterator[str]:
    """The lines of the suggested feedback gains; those of an arm are converted to radians."""
    per = _code_unit(found)
    factor = per.si / find_unit(found.units).si
    yield ""
    loops = found.feedback()
    if not loops:
        yield f"{write.comment} The fit suggests no feedback gains."
    tried = try_feedback_gains(found, PRESETS["default"])
    bad = {trial.loop for trial in tried if not trial.is_good}
    for loop, gains in loops.items():
        held = f"({per.symbol}/s)" if loop == "velocity" else per.symbol
        if min(gains.kp, gains.kd) < 0.0:
            yield f"{write.comment} No gains for the {loop} loop: the delay is too long for them."
            continue
        if loop in bad:
            yield (
                f"{write.comment} No gains for the {loop} loop: SysId's suggestion is no good "
                "start. sysid fit says why."
            )
            continue
        yield (
            f"{write.comment} To start from, added to the feedforward: PIDController of the "
            f"{loop} [{held.strip('()')}], {PERIOD:.0f} ms"
        )
        word = loop.capitalize()
        for letter, value, top in (("P", gains.kp, "V"), ("D", gains.kd, "V·s")):
            start = float(f"{value * factor:.{FEWEST}g}")
            yield _line(write, f"k{word}{letter}", start, math.nan, f"{top}/{held}")


def _code_unit(found: Fit) -> Unit:
    """The unit of position in the code."""
    return find_unit("radians" if found.type == "arm" else found.units)


def format_code_error(value: float, error: float) -> str:
    """One standard error as the end of a comment: `` ± 0.01``; empty if it is not known."""
    if not math.isfinite(error):
        return ""
    return f" ± {error:.2g}" if error >= FINEST * abs(value) else f" ± less than {FINEST:.1%}"


def _line(write: Language, name: str, value: float, error: float, per: str) -> str:
    """The line of one constant, with its unit, and its standard error if it has one."""
    known = format_code_error(value, error)
    constant = write.constant.format(name=name, value=round_to_error(value, error))
    return f"{constant}  {write.comment} [{per}]{known}"
