"""Warnings about a log that SysId's recipe does not give: repeats, stale samples, signs."""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.core.doubt import GAINS, Doubt
from sim.core.log import DIRECTIONS, FOUR_TESTS, Array, Log, Run
from sim.core.units import Unit, convert_gains, find_unit
from sim.fit.metrics import SimulationScore
from sim.fit.regression import Regression
from sim.fit.result import format_gain_unit
from sim.fit.sysid_rows import NEAR_TOP, PreparedRows

DUBIOUS_R2 = 0.2  # acceleration R² below which WPILib's documentation calls kA dubious
GOOD_R2 = 0.9  # simulated velocity R² above which WPILib's documentation calls a fit good
STALE = 0.6  # [share of accelerating samples] that repeat; up to one half, kA has no bias
SURELY = 2.0  # [standard errors] below zero, from which on noise is not the cause
OPPOSED_SIGNS = Doubt(
    "sign-opposed",
    "kV and kA are negative: a positive voltage gives a negative velocity in this log. Invert "
    "the encoder or the motor, and record again.",
    grave=True,
)


def list_sysid_doubts(
    log: Log, prepared: PreparedRows, found: Regression, simulated: tuple[SimulationScore, ...]
) -> tuple[Doubt, ...]:
    """All doubts about a fit by SysId's recipe.

    Args:
        log: the fitted log.
        prepared: the rows that were used.
        found: the result of the regression.
        simulated: R² and RMSE of the forward and of the reverse tests.
    """
    return (
        *_doubt_repeats(log),
        *_doubt_stale_velocities(log),
        *_doubt_signs(found.gains, found.errors, per=find_unit(log.units)),
        *_doubt_low_r2(found.r2, simulated),
        *_doubt_slow_steps(prepared.velocity_delay, found.gains),
    )


def _doubt_repeats(log: Log) -> Iterator[Doubt]:
    """Doubts about runs that SysId does not use: repeated and unknown tests."""
    counts = {test: len(log.list_runs_of_test(test)) for test in FOUR_TESTS}
    again = [f"{test} ({count} runs)" for test, count in counts.items() if count > 1]
    other = sorted({run.test for run in log.runs} - set(FOUR_TESTS))
    if again:
        yield Doubt(
            "repeated-test",
            f"Only the first run of each test is used, as in SysId; recorded more than once: "
            f"{', '.join(again)}. If the first was the bad one, delete it from the log.",
        )
    if other:
        yield Doubt("unused-test", f"SysId's method does not use: {', '.join(other)}.")


def _doubt_stale_velocities(log: Log) -> Iterator[Doubt]:
    """A doubt about velocities that were logged more often than they were measured.

    If a velocity repeats for n samples, SysId uses the two samples at each jump and divides the
    jump by two periods instead of n. kA is then too small by the factor 2/n = 2·(1 - share
    repeated).
    """
    steps = [
        _measure_rise_changes(log.list_runs_of_test(test)[0])
        for test in FOUR_TESTS
        if test.startswith("dynamic")
    ]
    repeated = np.concatenate(steps) == 0.0
    share = float(repeated.mean()) if repeated.size else 0.0
    if share < STALE:
        return
    yield Doubt(
        "stale-velocity",
        f"While the mechanism speeds up, {share:.0%} of the samples repeat the velocity of the "
        "sample before: the log is faster than the motor controller sends. SysId's recipe "
        "computes the acceleration from these velocities, so kA becomes about "
        f"{2 * (1 - share):.0%} of its true value. Log at the controller's own rate, or raise "
        "that rate.",
        gains=("kA",),
    )


def _measure_rise_changes(run: Run) -> Array:
    """The changes of velocity from the first motion until near the top speed."""
    speed = np.abs(run.velocity)
    moving = int(np.argmax(speed > 0.0))
    top = int(np.argmax(speed >= NEAR_TOP * speed.max()))
    return np.asarray(np.diff(run.velocity[moving : top + 1]))


def _doubt_signs(
    gains: Mapping[str, float], errors: Mapping[str, float], *, per: Unit
) -> list[Doubt]:
    """Doubts about gains with a wrong sign."""
    if gains["kV"] < 0 and gains["kA"] < 0:
        return [OPPOSED_SIGNS]
    cause = {
        "kS": "friction cannot push. Look for noise in the velocity, for a mechanism that was "
        "moved by hand, or for gravity that the type leaves out",
        "kV": "a motor does not accelerate without voltage. Look for a wrong test name or a "
        "stuck sensor",
        "kA": "inertia is never negative. Look at the dynamic tests: is there a voltage step, and "
        "does the velocity follow it",
        "kG": "gravity should pull the mechanism back. Is forward up in this log?",
    }
    shown = convert_gains(gains, factor=per.si)
    return [
        Doubt(
            "negative-gain",
            f"{gain} = {shown[gain]:.3g} {format_gain_unit(gain, per)} is negative: {why}.",
            grave=gains[gain] + SURELY * errors[gain] < 0,
        )
        for gain, why in cause.items()
        if gains.get(gain, 1.0) < 0
    ]


def _doubt_low_r2(r2: float, simulated: tuple[SimulationScore, ...]) -> Iterator[Doubt]:
    """Doubts about a low R² of the acceleration or of the simulated velocity."""
    for way, part in zip(DIRECTIONS, simulated, strict=True):
        if part.r2 < GOOD_R2:
            yield Doubt(
                "low-simulated-r2",
                f"The simulated velocity R² of the {way} tests is {part.r2:.2f}; a fit that "
                f"reproduces its log has {GOOD_R2} or more. Plot the velocity: did the mechanism "
                "slip, stop or sag?",
                gains=GAINS,
            )
    if r2 < DUBIOUS_R2:
        yield Doubt(
            "low-acceleration-r2",
            f"The acceleration R² is {r2:.2f}. WPILib's documentation calls kA dubious if "
            f"it is below {DUBIOUS_R2}. Look for noise in the velocity, and try --median 5.",
            gains=("kA",),
        )


def _doubt_slow_steps(delay: float, gains: Mapping[str, float]) -> Iterator[Doubt]:
    """A doubt about a delay [s] of the velocity that is longer than kA/kV."""
    timescale = gains["kA"] / gains["kV"] if gains["kV"] else 0.0
    if not 0.0 < timescale < delay:
        return
    yield Doubt(
        "slow-measurement",
        f"The velocity reacts {delay * 1000:.0f} ms after the voltage, more slowly than the "
        f"mechanism itself (kA/kV = {timescale * 1000:.0f} ms): do not trust kA. Shorten the"
        " velocity filter of the motor controller, or log faster.",
        gains=("kA",),
    )
