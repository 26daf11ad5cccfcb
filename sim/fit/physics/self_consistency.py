"""Check a fit without knowledge of its parts: kS, kG/kA, and the time constant kA/kV."""

import math
from collections.abc import Iterator

from sim.core.doubt import Doubt
from sim.core.units import BATTERY, GRAVITY, find_unit
from sim.fit.physics.parts import BELOW, HEAVY, SURELY
from sim.fit.result import Fit

CASCADE = 2.0  # [g] largest kG/kA of a cascade elevator
WATCH = {"simple": 0.5, "elevator": 0.8, "arm": 0.8}  # [V] kS; arms of real robots have up to 0.74
CRUISE = 0.4  # [of free speed] a typical velocity: 2 m/s of a drivetrain's 4.7
LOOPS = 2.0  # [sample periods] with a shorter kA/kV too few samples show the acceleration
FEW_LOOPS = 1.0  # [sample periods] the same for an output-error fit with a small error of kA
SURE = 0.03  # [share of kA] a standard error below it is small


def check_friction(found: Fit) -> Iterator[Doubt]:
    """Doubts about a kS that is too large, or that should be watched."""
    ks, kv = found.gains["kS"], found.gains["kV"]
    surely = ks - SURELY * found.errors["kS"]
    share = f"kS = {ks:.2f} V, {ks / BATTERY:.0%} of 12 V,"
    if surely > CRUISE * BATTERY:
        per = find_unit(found.log_units)
        at = f" ({per.format_speed(CRUISE * BATTERY / kv)})" if kv > 0.0 else ""
        yield Doubt(
            "friction-stop",
            f"{share} is more than the motor needs for {CRUISE:.0%} of its free speed{at}: "
            "look for a brake, a jam, a wrong test name, or gravity that type "
            f"{found.type} leaves out.",
            grave=True,
        )
    elif surely > WATCH[found.type]:
        yield Doubt(
            "friction-watch",
            f"{share} is above {WATCH[found.type]:g} V, the limit of most mechanisms of type "
            f"{found.type}: compare with last week, turn it by hand, and check belt tension, "
            "bearings and alignment.",
        )


def check_gravity(found: Fit) -> Iterator[Doubt]:
    """Doubts if kG and kA of an elevator are not those of one mass.

    A stage of mass m that moves at half the carriage's speed adds m/2 to the weight that the motor
    feels and m/4 to the inertia, so the quotient is between g and 2 g.
    """
    kg, ka = found.gains.get("kG", 0.0), found.gains["kA"]
    if found.type != "elevator" or find_unit(found.units).angular or kg <= 0.0 or ka <= 0.0:
        return
    lift = kg / ka
    unsure = SURELY * lift * math.hypot(found.errors["kG"] / kg, found.errors["kA"] / ka)
    said = f"kG/kA = {lift:.3g} m/s²"
    if lift - unsure > GRAVITY / BELOW:
        cascade = lift - unsure <= CASCADE * GRAVITY / BELOW
        may = (
            f"A cascade elevator, whose lower stages move slower than its carriage, has up to "
            f"{CASCADE * GRAVITY:.3g}, and then this is right. An elevator of one stage cannot"
            if cascade
            else f"No elevator has more than {CASCADE * GRAVITY:.3g}"
        )
        yield Doubt(
            "gravity-above-g",
            f"{said} is above {GRAVITY} m/s². {may}: kA would be too small or kG too "
            "large. Look at the unit of position, at the dynamic tests, and for "
            "something other than its weight that pulls it down.",
            grave=not cascade,
        )
    elif lift + unsure < GRAVITY / HEAVY * BELOW:
        yield Doubt(
            "gravity-below-g",
            f"{said} is {1.0 - lift / GRAVITY:.0%} below {GRAVITY} m/s², and rotors "
            "explain 3 to 10 %: look for a spring or counterweight that carries it, a "
            "slope, a late or averaged velocity that makes kA too large, and the unit of "
            "position.",
        )


def check_timescale(found: Fit, period: float) -> Iterator[Doubt]:
    """Doubts about a kA/kV that is short against the sample period [s]."""
    kv, ka = found.gains["kV"], found.gains["kA"]
    if kv <= 0.0 or ka <= 0.0:
        return
    sure = found.method == "output-error" and found.errors["kA"] < SURE * ka
    scale = ka / kv
    if scale < (FEW_LOOPS if sure else LOOPS) * period:
        yield Doubt(
            "fast-mechanism",
            f"kA/kV = {scale * 1000:.2g} ms is only {scale / period:.1f} times the "
            f"{period * 1000:.3g} ms between two samples, so kA is uncertain. Log every "
            f"{max(scale / 4.0, 0.001) * 1000:.2g} ms (a faster status frame and a Notifier), "
            "or compute kA from the load, and use only kV for the feedback gains.",
            gains=("kA",),
        )
