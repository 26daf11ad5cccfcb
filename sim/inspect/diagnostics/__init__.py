"""Warnings about a log that SysId does not give and that are no fault of the catalogue.

Each check is a function of the features and gives doubts: a cause, a number and what to look at.
They are quiet about a log that is as it should be.
"""

from contextlib import suppress

import numpy as np

from sim.core.doubt import Doubt
from sim.inspect.diagnostics.directions import check_directions
from sim.inspect.diagnostics.motion import (
    check_r2_hides_misfit,
    check_ramp_rate,
    check_repeated_tests,
    check_too_little_motion,
)
from sim.inspect.diagnostics.sensor import (
    check_plausible_speed,
    check_rest_noise,
    check_velocity_lag,
    check_velocity_scale,
)
from sim.inspect.log_features import LogFeatures

LOOKS = (
    check_velocity_lag,
    check_velocity_scale,
    check_plausible_speed,
    check_rest_noise,
    check_directions,
    check_r2_hides_misfit,
    check_repeated_tests,
    check_too_little_motion,
    check_ramp_rate,
)


def diagnose_log(features: LogFeatures) -> tuple[Doubt, ...]:
    """Everything odd about a log that no fault of the catalogue explains.

    Args:
        features: of the log.
    """
    doubts: list[Doubt] = []
    for each in LOOKS:
        with suppress(np.linalg.LinAlgError):  # a log without a solution says nothing here
            doubts += each(features)
    return tuple(doubts)
