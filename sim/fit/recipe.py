"""Method ``sysid``: WPILib SysId's recipe from end to end, and what SysId leaves unsaid."""

from collections.abc import Mapping

import numpy as np

from sim.doubt import Doubt
from sim.errors import BadRequest
from sim.fit.metrics import Simulated, simulated_velocity
from sim.fit.regression import Regression, regress
from sim.fit.result import Fit
from sim.log import DIRECTIONS, FOUR_TESTS, Log
from sim.prepare import Prepared, prepare
from sim.units import unit

DUBIOUS_R2 = 0.2  # acceleration R² below which WPILib's documentation calls kA dubious
STALE = (
    0.25  # [share of moving samples] more than this repeat only when frames are slower than logs
)
SURELY = 2.0  # [standard errors] further below zero than this is no accident of noise
UNSURE = 0.5  # [share of a gain] a standard error this large leaves even its sign in doubt
GOOD_R2 = 0.9  # simulated velocity R² above which WPILib's documentation calls a fit good


def sysid(log: Log, *, type: str, median: int = 1) -> Fit:  # noqa: A002 - SysId's word
    """Fit a log as SysId does.

    Args:
        log: with the four tests; of a test that was repeated only the first run counts.
        type: ``simple``, ``elevator`` or ``arm``.
        median: [samples] window of the median filter on velocity.

    Raises:
        BadRequest: an arm whose position is no angle.
        NotIdentifiable: the log cannot tell these gains.
    """
    per = unit(log.units)
    if type == "arm" and not per.angular:
        raise BadRequest(
            f"an arm's position must be an angle, and this log is in {per.name}",
            where=log.source,
            advice="Say --units radians, rotations or degrees, or --type elevator.",
        )
    prepared = prepare(log, median=median)
    found = regress(prepared.rows, type=type)
    forward, reverse = (
        simulated_velocity(
            [prepared.raw[f"{kind}-{way}"] for kind in ("quasistatic", "dynamic")],
            found.gains,
            type=type,
        )
        for way in DIRECTIONS
    )
    return Fit(
        type=type,
        method="sysid",
        units="radians" if per.angular else "meters",
        log_units=per.name,
        gains=found.gains,
        errors=found.errors,
        acceleration_r2=found.r2,
        acceleration_rmse=found.rmse,
        simulated_velocity_r2=forward.r2,
        simulated_velocity_rmse=forward.rmse,
        samples_used={test: len(prepared.rows[test]) for test in FOUR_TESTS},
        position_delay=prepared.position_delay,
        velocity_delay=prepared.velocity_delay,
        velocity_threshold=prepared.threshold,
        step_duration=prepared.step_duration,
        doubts=(*log.doubts, *_doubts(log, prepared, found, (forward, reverse))),
    )


def _doubts(
    log: Log, prepared: Prepared, found: Regression, simulated: tuple[Simulated, ...]
) -> list[Doubt]:
    doubts = [*_repeats(log), *_stale(log), *_signs(found.gains, found.errors)]
    if found.r2 < DUBIOUS_R2:
        doubts.append(
            Doubt(
                "low-acceleration-r2",
                f"The acceleration R² is {found.r2:.2f}; below {DUBIOUS_R2} WPILib's documentation "
                "calls kA dubious. Look for noise in the velocity, and try --median 5.",
            )
        )
    doubts += [
        Doubt(
            "low-simulated-r2",
            f"The simulated velocity R² of the {way} tests is {part.r2:.2f}; a fit that reproduces "
            f"its log has {GOOD_R2} or more. Plot the velocity: did the mechanism slip, stop or "
            "sag?",
        )
        for way, part in zip(DIRECTIONS, simulated, strict=True)
        if part.r2 < GOOD_R2
    ]
    doubts += [
        Doubt(
            "unsure-gain",
            f"{gain} = {found.gains[gain]:.2g} ± {error:.1g}: this log hardly tells {gain}. A "
            "longer or harder test would.",
        )
        for gain, error in found.errors.items()
        if gain != "offset_rad" and error > UNSURE * abs(found.gains[gain])
    ]
    slow = prepared.position_delay if prepared.velocity_delay < 0 else prepared.velocity_delay
    timescale = found.gains["kA"] / found.gains["kV"] if found.gains["kV"] else 0.0
    if 0.0 < timescale < slow:
        doubts.append(
            Doubt(
                "slow-measurement",
                f"The velocity answers {slow * 1000:.0f} ms after the voltage, later than the "
                f"mechanism itself (kA/kV = {timescale * 1000:.0f} ms): kA is not to be trusted. "
                "Shorten the velocity filter of the motor controller, or log faster.",
            )
        )
    return doubts


def _repeats(log: Log) -> list[Doubt]:
    again = [f"{test} ({len(log.of(test))} runs)" for test in FOUR_TESTS if len(log.of(test)) > 1]
    other = sorted({run.test for run in log.runs} - set(FOUR_TESTS))
    doubts = []
    if again:
        doubts.append(
            Doubt(
                "repeated-test",
                f"Only the first run of each test is used, as in SysId; recorded more than once: "
                f"{', '.join(again)}. If the first was the bad one, delete it from the log.",
            )
        )
    if other:
        doubts.append(Doubt("unused-test", f"SysId's recipe has no use for: {', '.join(other)}."))
    return doubts


def _stale(log: Log) -> list[Doubt]:
    """Velocities that were logged more often than they were measured."""
    steps = [np.diff(log.of(test)[0].velocity) for test in FOUR_TESTS if test.startswith("dyn")]
    moving = [log.of(test)[0].velocity[1:] != 0.0 for test in FOUR_TESTS if test.startswith("dyn")]
    repeated = np.concatenate(
        [step[moves] == 0.0 for step, moves in zip(steps, moving, strict=True)]
    )
    if not repeated.size or repeated.mean() < STALE:
        return []
    return [
        Doubt(
            "stale-velocity",
            f"{repeated.mean():.0%} of the moving samples repeat the velocity before them: it was "
            "logged faster than the motor controller sends it. SysId leaves those out and takes "
            "the jumps between them for acceleration, so kA comes out too small. Log at the "
            "controller's own rate, or raise that rate.",
        )
    ]


def _signs(gains: Mapping[str, float], errors: Mapping[str, float]) -> list[Doubt]:
    if gains["kV"] < 0 and gains["kA"] < 0:
        return [
            Doubt(
                "sign-opposed",
                "kV and kA are negative: a positive voltage makes a negative velocity in this log. "
                "Invert the encoder or the motor, so that plus is plus, and record again.",
                grave=True,
            )
        ]
    cause = {
        "kS": "friction cannot push. Look for noise in the velocity, for a mechanism that was "
        "moved by hand, or for gravity that the type leaves out",
        "kV": "a motor does not speed up without voltage. Look for a wrong test name or a stuck "
        "sensor",
        "kA": "inertia is never negative. Look at the dynamic tests: is there a voltage step, and "
        "a velocity that follows?",
        "kG": "gravity should pull the mechanism back. Is forward up in this log?",
    }
    return [
        Doubt(
            "negative-gain",
            f"{gain} = {gains[gain]:.3g} is negative: {why}.",
            grave=gains[gain] + SURELY * errors[gain] < 0,
        )
        for gain, why in cause.items()
        if gains.get(gain, 1.0) < 0
    ]
