"""Warnings about a log that SysId does not give and that are not faults of the catalogue.

Each check is a function of the features and returns doubts with a cause, a number and advice.
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
    check_rest_noise,
    check_velocity_lag,
)
from sim.inspect.log_features import LogFeatures
from sim.inspect.log_units import doubt_scale

CHECKS = (
    check_velocity_lag,
    doubt_scale,
    check_rest_noise,
    check_directions,
    check_r2_hides_misfit,
    check_repeated_tests,
    check_too_little_motion,
    check_ramp_rate,
)


def diagnose_log(features: LogFeatures) -> tuple[Doubt, ...]:
    """All warnings about a log that are not about faults of the catalogue.

    Args:
        features: features of the log.
    """
    doubts: list[Doubt] = []
    for check in CHECKS:
        with suppress(np.linalg.LinAlgError):  # equations without a solution give no warning
            doubts += check(features)
    return tuple(doubts)
