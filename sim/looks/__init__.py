"""What SysId never says about a log, and what is no fault of the record either.

Each look is a function of the clues and gives doubts: a cause, a number and what to look at. They
are quiet about a log that is as it should be.
"""

from contextlib import suppress

import numpy as np

from sim.clues import Clues
from sim.doubt import Doubt
from sim.looks.directions import directions
from sim.looks.motion import fast_ramp, good_r2, little, twice
from sim.looks.sensor import lags, scale, speed, standing_counted

__all__ = ["look"]

LOOKS = (
    lags,
    scale,
    speed,
    standing_counted,
    directions,
    good_r2,
    twice,
    little,
    fast_ramp,
)


def look(clues: Clues) -> tuple[Doubt, ...]:
    """Everything odd about a log that no fault of the catalogue explains.

    Args:
        clues: of the log.
    """
    doubts: list[Doubt] = []
    for each in LOOKS:
        with suppress(np.linalg.LinAlgError):  # a log without a solution says nothing here
            doubts += each(clues)
    return tuple(doubts)
