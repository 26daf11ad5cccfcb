"""Method ``sysid``: WPILib SysId's recipe from end to end, and what SysId leaves unsaid."""

from sim.errors import BadRequest
from sim.fit.doubts import doubts_about
from sim.fit.metrics import simulated_velocity
from sim.fit.regression import regress
from sim.fit.result import Fit
from sim.log import DIRECTIONS, FOUR_TESTS, Log
from sim.prepare import prepare
from sim.units import unit


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
        doubts=(*log.doubts, *doubts_about(log, prepared, found, (forward, reverse))),
    )
