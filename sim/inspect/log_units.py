"""Units of a log that cannot be right: what ``inspect`` reports and every fit warns of."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.log import FOUR_TESTS, Log
from sim.core.units import BATTERY, TURN, find_unit
from sim.inspect.log_features import LogFeatures

CODE = "unit-error"
SCALED = ("kV", "kA")  # gains that contain the unit of the velocity
DUTY = 1.0  # [V] largest duty cycle; real tests use more
MOST = 50.0  # [V] far more than any robot has
FEWEST = 20  # [samples] the voltage of shorter logs is not checked
SLOWEST_LOOP = 1.0  # [s] between samples; larger times are probably not in seconds
NEAR = 0.05  # [share] largest difference from a known factor; slip and filters change it less
DRIVES = ("drive", "swerve")  # in the name of a mechanism; SysId's own tool writes Drivetrain
FASTEST_OF_ALL = 60.0  # [m/s] nothing on a robot is faster
FASTEST, SLOWEST = 9.0, 1.2  # [m/s] of a drive at 12 V: two-speed gearboxes have about 2 to 7
FAR = 2.5  # [1] least factor of a wrong unit
SCALE = 0.05  # [share] of kV with which it can still be used

KNOWN: Mapping[str, float] = {
    "2π, the factor between rotations and radians": TURN,
    "60, the factor between seconds and minutes": 60.0,
    "60/2π, the factor between radians per second and rpm": 60.0 / TURN,
    "360, the factor between rotations and degrees": 360.0,
    "57.3, the factor between radians and degrees": 360.0 / TURN,
    "6, the factor between rpm and degrees per second": 6.0,
    "2π·60, the factor between rotations per second and radians per minute": TURN * 60.0,
    "39.4, the factor between meters and inches": 1.0 / 0.0254,
    "3.28, the factor between meters and feet": 1.0 / 0.3048,
    "12, the factor between feet and inches": 12.0,
    "10, the factor between units per 100 ms and units per second": 10.0,
}


@dataclass(frozen=True)
class UnitError:
    """A signal in a wrong unit.

    Args:
        evidence: what shows it.
        advice: what to do.
        confidence: 0 to 1.
        run: index of the run that shows it; None for the whole log.
        grave: whether no gain can be right.
    """

    evidence: str
    advice: str | Action
    confidence: float
    run: int | None = None
    grave: bool = False


def find_unit_errors(features: LogFeatures) -> Iterator[UnitError]:
    """The signals of a log that are in a wrong unit; a wrong voltage hides the others."""
    voltage = _check_voltage(features.log)
    if voltage is not None:
        yield voltage
        return
    usual = _explain_ratio(features.usual_distance_ratio)
    for index, ratio in enumerate(features.distance_ratios):
        copied = features.position_copy_factors[index]
        said = _explain_ratio(ratio) if usual else ""
        if copied:
            yield UnitError(
                f"The recorded velocity is the position, multiplied by {copied:.3g}. Where the "
                "position does not change, the velocity should be 0, and it is not.",
                "Log the encoder's velocity in place of its position, and record again. Until "
                "then, `sysid fit` takes the slope of the position.",
                confidence=0.97,
                run=index,
            )
        elif said:
            yield UnitError(
                f"The velocity is {ratio:.4g} times the slope of the position. {said}.",
                Action(
                    "velocity-scale",
                    f"{1.0 / ratio:.3g}",
                    before="Make the conversion factors of position and velocity agree.",
                ),
                confidence=0.95,
                run=index,
                grave=True,
            )
    yield from _check_speed(features)


def check_units(log: Log) -> tuple[Doubt, ...]:
    """A warning if a signal of a log is in a wrong unit or scale, the most certain one.

    Args:
        log: the log, with its motion mended (``sim.io.motion.mend_motion``).
    """
    features = LogFeatures(log)
    if not features.period <= SLOWEST_LOOP:
        return ()
    with np.errstate(all="ignore"):  # huge numbers may overflow; then nothing is found
        found = max(find_unit_errors(features), key=lambda one: one.confidence, default=None)
        if found is None:
            return tuple(doubt_scale(features))
    start = f"{log.source}: {found.evidence[:1].lower()}{found.evidence[1:]}"
    if isinstance(found.advice, Action):
        return (Doubt(CODE, start, grave=found.grave, action=found.advice, gains=SCALED),)
    return (Doubt(CODE, f"{start} {found.advice}", grave=found.grave, gains=SCALED),)


def doubt_scale(features: LogFeatures) -> Iterator[Doubt]:
    """A warning if the velocity is a little too large or too small for its position."""
    usual = features.usual_distance_ratio
    if abs(usual - 1.0) <= SCALE or not 1.0 / FAR < usual < FAR:
        return
    yield Doubt(
        "scales-differ",
        f"The velocity is {usual:.3f} times the slope of the position in all runs: one of "
        "the two has a wrong conversion factor. kV and kA depend on the velocity. Move the "
        "mechanism by a known distance, and check whether the position agrees.",
        action=Action("velocity-scale", f"{1.0 / usual:.3g}"),
        gains=SCALED,
    )


def _check_voltage(log: Log) -> UnitError | None:
    """A voltage that is a duty cycle or in millivolts."""
    moving = [run for run in log.runs if run.top_speed > 0.0]
    peak = max((float(abs(run.voltage).max()) for run in moving), default=0.0)
    known = any(doubt.code == "rate-as-voltage" for doubt in log.doubts)
    if known or peak == 0.0 or sum(map(len, moving)) < FEWEST or DUTY < peak <= MOST:
        return None
    if peak > MOST:
        return UnitError(
            f"The largest voltage is {peak:.4g} V, and no robot has so many volts. These are "
            "probably millivolts.",
            "Log volts, and divide by 1000 what you have.",
            confidence=0.95,
            grave=True,
        )
    return UnitError(
        f"The largest voltage is {peak:.4g} V, and a test of a robot needs more. This is probably "
        "a duty cycle (-1 to 1). Then all gains are some 12 times too small.",
        "Log the applied voltage.",
        confidence=0.9,
        grave=True,
    )


def _check_speed(features: LogFeatures) -> Iterator[UnitError]:
    """A mechanism that is faster than any, or a drivetrain that is slower: a wrong unit."""
    per, name = find_unit(features.log.units), features.log.mechanism
    if per.angular:
        return
    drives = any(word in name.lower() for word in DRIVES)
    slowest, fastest = (SLOWEST, FASTEST) if drives else (0.0, FASTEST_OF_ALL)
    speeds = [
        BATTERY * run.top_speed / float(np.abs(run.voltage).max())
        for run in features.log.runs
        if run.test in FOUR_TESTS and run.top_speed and run.voltage.any()
    ]
    speed = float(np.median(speeds)) if speeds else 0.0
    if not speed or slowest <= speed <= fastest or _explain_ratio(features.usual_distance_ratio):
        return
    bound = f"faster than {fastest:g}" if speed > fastest else f"slower than {slowest:g}"
    yield UnitError(
        f"With {BATTERY:g} V this {'drivetrain' if drives else 'mechanism'} would move at about "
        f"{speed:.2g} m/s, and {'no FRC robot' if drives else 'nothing on an FRC robot'} "
        f"is {bound} m/s: position and velocity are not in meters, or their factor is wrong.",
        "Push the robot forward by exactly 1 m and see by how much the logged position changes. "
        "Then set gear ratio and wheel circumference so that it is 1."
        if drives
        else Action("angle-units"),
        confidence=0.9,
    )


def _explain_ratio(ratio: float) -> str:
    """A sentence that explains a distance ratio; empty if no unit is wrong."""
    if 1.0 / FAR < ratio < FAR or not ratio > 0.0:
        return ""
    known = {f"This is {name}": factor for name, factor in KNOWN.items()}
    known |= {f"This is 1 over {name}": 1.0 / factor for name, factor in KNOWN.items()}
    nearest = min(known, key=lambda said: abs(np.log(ratio / known[said])))
    if abs(ratio / known[nearest] - 1.0) < NEAR:
        return nearest
    return (
        "This factor belongs to no unit: probably only one of the two signals contains a gear "
        "ratio or a circumference"
    )
