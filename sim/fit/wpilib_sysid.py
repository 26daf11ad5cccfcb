"""WPILib SysId's recipe from end to end (method ``sysid``)."""

from sim.core.errors import NotIdentifiable
from sim.core.log import DIRECTIONS, FOUR_TESTS, Log
from sim.core.units import find_unit
from sim.fit.metrics import score_simulated_velocity
from sim.fit.regression import regress_acceleration
from sim.fit.result import Fit, refuse_length_of_arm
from sim.fit.sysid_doubts import list_sysid_doubts
from sim.fit.sysid_rows import prepare_rows


def fit_wpilib_sysid(log: Log, *, type: str, median: int = 1) -> Fit:  # noqa: A002 - SysId's word
    """Fit a log as SysId does.

    Args:
        log: a log with the four tests; of a repeated test only the first run is used.
        type: ``simple``, ``elevator`` or ``arm``.
        median: [samples] window of the median filter on velocity; 1 is none.

    Raises:
        BadRequest: an arm whose position is not an angle, or a window that SysId does not offer.
        NotIdentifiable: the log does not determine these gains.
    """
    per = find_unit(log.units)
    refuse_length_of_arm(log, type=type)
    try:
        prepared = prepare_rows(log, median=median)
        found = regress_acceleration(prepared.rows, type=type)
    except NotIdentifiable as refusal:
        raise refusal.move(refusal.where or log.source) from refusal
    forward, reverse = (
        score_simulated_velocity(
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
        doubts=(*log.doubts, *list_sysid_doubts(log, prepared, found, (forward, reverse))),
    )
