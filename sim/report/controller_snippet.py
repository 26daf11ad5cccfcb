"""Java code with gains for a motor controller or a swerve library: Phoenix 6, REVLib, YAGSL.

    from sim.report.controller_snippet import write_controller_code
    print(write_controller_code(found, target="phoenix6", radius=0.0508))

Each target has its own unit of position, so the code converts kV and kA. Sources:
the documentation of ``Slot0Configs`` in Phoenix 6 26.3 and of ``FeedForwardConfig`` in REVLib
2026.0; for YAGSL, ``SwerveDrive.replaceSwerveModuleFeedforward``, which takes WPILib's class.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from sim.core.advice import Action
from sim.core.errors import BadRequest
from sim.core.units import TURN, find_unit
from sim.feedback import PRESETS, Feedback, Preset
from sim.fit import Fit
from sim.fit.feedback_trial import try_feedback_gains
from sim.report.robot_code_snippet import (
    FEWEST,
    ORDER,
    SPELLINGS,
    format_code_error,
    make_class_name,
    refuse_impossible_gains,
    round_to_error,
)

ROTATION, METER = find_unit("rotations"), find_unit("meters")


@dataclass(frozen=True)
class Conversion:
    """The factor from units of the log to units of the target.

    Args:
        name: the Java constant that holds it.
        factor: its value; 1 needs no constant.
        per: symbol of the target's unit of position.
    """

    name: str
    factor: float
    per: str


@dataclass(frozen=True)
class Target:
    """A motor controller or a library that takes gains.

    Args:
        name: its name, with the release it was checked against.
        unit: its unit of position, ``rotations`` or ``meters``; empty takes the unit of the log.
        imports: the Java classes that the code needs, from fit and season.
        notes: comment lines about other settings that are needed.
        build: the lines that set the gains, kP (and kD) among them if there are any.
        preset: loop times and units of its own feedback; None where it has no loop.
        output: what one unit of its output is: ``V``, or ``1`` for a duty cycle.
    """

    name: str
    unit: str
    imports: Callable[[Fit, int], tuple[str, ...]]
    notes: Callable[[Fit], tuple[str, ...]]
    build: Callable[[Fit, Feedback | None], tuple[str, ...]]
    preset: Preset | None = None
    output: str = "V"


def write_controller_code(
    found: Fit, *, target: str, radius: float | None = None, season: int = 2026, name: str = ""
) -> str:
    """Java with the gains of a fit in the units of a motor controller or a swerve library.

    Args:
        found: the fit, in the unit of its log.
        target: ``phoenix6``, ``revlib`` or ``yagsl``.
        radius: radius of wheel or drum [m], to convert between a length and a rotation.
        season: 2026 or 2027; only YAGSL's lines, which name a class of WPILib, depend on it.
        name: name of the mechanism; empty takes its type.

    Returns:
        The text, with a line break at its end. A gain is written as in the fit, times a constant
        that converts it.

    Raises:
        BadRequest: an unknown target or season, a missing radius, a mechanism that the target has
            no gains for, or gains that are physically impossible.
    """
    if target not in TARGETS:
        raise BadRequest(
            f"unknown target {target!r}", advice=f"Choose one of: {', '.join(TARGETS)}."
        )
    if ("java", season) not in SPELLINGS:
        raise BadRequest(f"unknown season {season!r}", advice="Choose 2026 or 2027.")
    refuse_impossible_gains(found)
    chosen = TARGETS[target]
    if target == "yagsl" and found.type != "simple":
        raise BadRequest(
            f"an {found.type} for YAGSL, which holds the gains of a drive motor",
            advice="Fit the log of the drive motors with --type simple.",
        )
    converted = convert_units(found, chosen.unit, radius=radius)
    class_ = make_class_name(name or found.type)
    feedback = _suggest_feedback(found, chosen)
    return "\n".join(
        (
            *(f"import {one};" for one in chosen.imports(found, season)),
            "",
            *(f"// {line}" for line in _heading(found, chosen)),
            f"public final class {class_} {{",
            f"  private {class_}() {{}}",
            "",
            *(f"  {line}" for line in _constants(found, converted)),
            *(f"  {line}" for line in _feedback_lines(found, chosen, converted, feedback)),
            "",
            *(f"  {line}".rstrip() for line in chosen.build(found, feedback)),
            "}",
            "",
        )
    )


def _heading(found: Fit, chosen: Target) -> Iterator[str]:
    article = "an" if found.type[0] in "ae" else "a"
    yield f"Measured gains of {article} {found.type} mechanism; ± is one standard error."
    yield f"For {chosen.name}:"
    yield from chosen.notes(found)
    if found.doubts:
        yield f"Warnings of the fit, to be read first: {len(found.doubts)}."


def convert_units(found: Fit, unit: str, *, radius: float | None) -> Conversion:
    """The constant by which kV and kA of a fit are multiplied.

    Args:
        found: the fit.
        unit: ``rotations``, ``meters``, or empty for the unit of the fit.
        radius: radius of wheel or drum [m], or None.

    Raises:
        BadRequest: a radius is needed, and is missing or not a positive number.
    """
    given = find_unit(found.units)
    if not unit:
        return Conversion("", 1.0, given.symbol)
    wanted = find_unit(unit)
    name = f"k{given.name.capitalize()}Per{wanted.name.capitalize().removesuffix('s')}"
    if given.angular == wanted.angular:
        return Conversion(name, wanted.si / given.si, wanted.symbol)
    if radius is None or not (math.isfinite(radius) and radius > 0.0):
        raise BadRequest(
            f"no radius between {given.name} and {wanted.name}",
            advice=Action("radius"),
        )
    between = radius if wanted.angular else 1.0 / radius  # [m/rad], or its inverse
    return Conversion(name, wanted.si * between / given.si, wanted.symbol)


def _constants(found: Fit, converted: Conversion) -> Iterator[str]:
    """The lines of the Java constants: the gains, each with its unit and standard error."""
    times = ""
    if converted.factor != 1.0:
        yield f"public static final double {converted.name} = {converted.factor!r};"
        times = f" * {converted.name}"
    units = {"kV": f"V·s/{converted.per}", "kA": f"V·s²/{converted.per}"}
    for gain in ORDER[found.type]:
        error, scale = found.errors[gain], converted.factor if gain in units else 1.0
        value = round_to_error(found.gains[gain], error)
        known = format_code_error(found.gains[gain] * scale, error * scale)
        factor = times if gain in units else ""
        unit = units.get(gain, "V")
        yield f"public static final double {gain} = {value}{factor};  // [{unit}]{known}"
    if found.type == "arm":
        level = -found.gains["offset_rad"] / TURN
        yield (
            f"public static final double kLevelReading = {level:.6f};"
            "  // [rot] of the sensor when the arm is level"
        )


def _choose_loop(found: Fit) -> str:
    """The loop that a mechanism is held by: a position where it can stay, else a velocity."""
    return "velocity" if found.type == "simple" else "position"


def _suggest_feedback(found: Fit, chosen: Target) -> Feedback | None:
    """Suggested gains of the loop, per unit of the fit; None if they are no good start."""
    if chosen.preset is None:
        return None
    trials = try_feedback_gains(found, chosen.preset)
    good = (one.gains for one in trials if one.loop == _choose_loop(found) and one.is_good)
    return next(good, None)


def _feedback_lines(
    found: Fit, chosen: Target, converted: Conversion, feedback: Feedback | None
) -> Iterator[str]:
    """The lines of kP, and of kD where it is not zero, each with its unit."""
    if chosen.preset is None:
        return
    loop = _choose_loop(found)
    if feedback is None:
        yield f"// No kP: the suggestion for the {loop} loop is no good start. sysid fit says why."
        return
    times = f" * {converted.name}" if converted.factor != 1.0 else ""
    held = converted.per if loop == "position" else f"({converted.per}/s)"
    rate = f"({converted.per}/s)" if chosen.preset.normalized else f"({converted.per}/ms)"
    for name, value, per in (("kP", feedback.kp, held), ("kD", feedback.kd, rate)):
        if value:
            text = f"{float(f'{value:.{FEWEST}g}')!r}{times}"
            unit = f"[{chosen.output}/{per}] of the {loop} loop, to start from"
            yield f"public static final double {name} = {text};  // {unit}"


def _phoenix6_imports(found: Fit, season: int) -> tuple[str, ...]:  # noqa: ARG001 - as the others
    gravity = ("com.ctre.phoenix6.signals.GravityTypeValue",) * (found.type != "simple")
    return (
        "com.ctre.phoenix6.configs.Slot0Configs",
        *gravity,
        "com.ctre.phoenix6.signals.StaticFeedforwardSignValue",
    )


def _phoenix6_notes(found: Fit) -> tuple[str, ...]:
    level = "Zero the sensor where the arm is level: Arm_Cosine takes its position's cosine."
    return (
        "Volts per rotation of the mechanism. Set Feedback.SensorToMechanismRatio first.",
        "For requests in volts: VelocityVoltage, PositionVoltage, MotionMagicVoltage.",
        "Set EnableFOC as in the tests; it changes kA, and kV a little.",
        *((level,) if found.type == "arm" else ()),
    )


def _phoenix6_lines(found: Fit, feedback: Feedback | None) -> tuple[str, ...]:
    gravity = {"elevator": "Elevator_Static", "arm": "Arm_Cosine"}.get(found.type)
    weight = (
        "        .withKG(kG)",
        f"        .withGravityType(GravityTypeValue.{gravity})",
    )
    return (
        "public static final Slot0Configs SLOT_0 =",
        "    new Slot0Configs()",
        "        .withKS(kS)",
        "        .withKV(kV)",
        "        .withKA(kA)",
        *(weight if gravity else ()),
        *(("        .withKP(kP)",) if feedback else ()),
        *(("        .withKD(kD)",) if feedback and feedback.kd else ()),
        "        .withStaticFeedforwardSign(StaticFeedforwardSignValue.UseVelocitySign);",
    )


def _revlib_imports(found: Fit, season: int) -> tuple[str, ...]:  # noqa: ARG001 - as the others
    return ("com.revrobotics.spark.config.FeedForwardConfig",)


def _revlib_notes(found: Fit) -> tuple[str, ...]:
    per = find_unit(found.units).symbol
    level = "Zero the encoder where the arm is level: kCos is multiplied by its angle's cosine."
    return (
        f"Volts per {per}/s. Set both conversion factors, so that the encoder counts in {per}.",
        "Without them a Spark counts rotations and rpm of the motor.",
        "kV serves velocity and MAXMotion, kA MAXMotion only; gravity serves position control.",
        *((level,) if found.type == "arm" else ()),
        "Use it with: config.closedLoop.feedForward.apply(FEED_FORWARD);",
        "and config.closedLoop.p(kP), with .d(kD) where there is one: a duty cycle, not volts.",
    )


def _revlib_lines(found: Fit, feedback: Feedback | None) -> tuple[str, ...]:  # noqa: ARG001 - as the others
    gravity = {"elevator": ".kG(kG)", "arm": ".kCos(kG).kCosRatio(kCosRatio)"}.get(found.type, "")
    line = "public static final FeedForwardConfig FEED_FORWARD ="
    made = f"    new FeedForwardConfig().kS(kS).kV(kV).kA(kA){gravity};"
    if found.type != "arm":
        return line, made
    ratio = find_unit(found.units).si / ROTATION.si
    per = find_unit(found.units).symbol
    return (
        f"public static final double kCosRatio = {ratio!r};  // [rot/{per}]",
        "",
        line,
        made,
    )


def _yagsl_imports(found: Fit, season: int) -> tuple[str, ...]:  # noqa: ARG001 - as the others
    return (f"{SPELLINGS['java', season].module}.SimpleMotorFeedforward",)


def _yagsl_notes(found: Fit) -> tuple[str, ...]:  # noqa: ARG001 - as the others
    return (
        "Volts per meter that the wheel rolls. YAGSL takes them for all modules:",
        "swerveDrive.replaceSwerveModuleFeedforward(FEEDFORWARD);",
    )


def _yagsl_lines(found: Fit, feedback: Feedback | None) -> tuple[str, ...]:  # noqa: ARG001 - as the others
    gains = ", ".join(ORDER[found.type])
    return (
        "public static final SimpleMotorFeedforward FEEDFORWARD =",
        f"    new SimpleMotorFeedforward({gains});",
    )


# SysId's preset counts velocity per minute, as a Spark without conversion factors does. The code
# asks for factors that make it count per second.
_SPARK = replace(PRESETS["rev-brushless"], velocity_time=1.0)
TARGETS = {
    "phoenix6": Target(
        "Phoenix 6 (26.3)", ROTATION.name, _phoenix6_imports, _phoenix6_notes, _phoenix6_lines,
        preset=PRESETS["ctre-phoenix6"],
    ),
    "revlib": Target(
        "REVLib (2026)", "", _revlib_imports, _revlib_notes, _revlib_lines,
        preset=_SPARK, output="1",
    ),
    "yagsl": Target("YAGSL", METER.name, _yagsl_imports, _yagsl_notes, _yagsl_lines),
}  # fmt: skip
