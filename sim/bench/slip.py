"""Wheel slip of a mechanism: whether it slips, and the effect with which it is then simulated.

The physics is in ``sim/physics/effects/wheel_slip.py``. A mechanism's ``grip`` is an acceleration
of its load; ``spin`` is the inertia of wheels and rotors as a share of the load.
"""

import math

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.physics.effect import are_compatible
from sim.physics.effects import EFFECTS
from sim.physics.engine import Track
from sim.physics.model import Part

SLIP = EFFECTS["wheel-slip"]


def wheels_slip(mechanism: Mechanism, track: Track) -> bool:
    """Whether the wheels slip in a motion, because it needs more than the traction limit.

    Args:
        mechanism: the mechanism.
        track: its simulated motion without slip.
    """
    if mechanism.grip is None or any(part.effect == SLIP.name for part in mechanism.hidden):
        return False  # the motion includes hidden slip
    gains = mechanism.gains
    way = np.sign(np.where(track.velocity == 0.0, track.applied, track.velocity))
    push = np.abs(track.applied - gains["kV"] * track.velocity - gains["kS"] * way)
    return bool(np.any(push > gains["kA"] * mechanism.grip))


def compute_slip_voltage(mechanism: Mechanism) -> float:
    """[V] smallest voltage step from rest at which the wheels slip; infinite if none."""
    if mechanism.grip is None:
        return math.inf
    return mechanism.gains["kS"] + mechanism.gains["kA"] * mechanism.grip


def make_slip_effect(mechanism: Mechanism) -> Part | None:
    """The wheel-slip effect of a mechanism; None if it cannot slip, or has a hidden joint."""
    hidden = [EFFECTS[part.effect] for part in mechanism.hidden]
    if mechanism.grip is None or not are_compatible([*hidden, SLIP]):
        return None
    own = next(one for one in SLIP.parameters if one.name == "share")
    share = min(max(mechanism.spin / (1.0 + mechanism.spin), own.least), own.most)
    grip = mechanism.gains["kA"] * mechanism.grip / (1.0 + mechanism.spin)
    return Part(SLIP.name, {"grip": grip, "share": share})
