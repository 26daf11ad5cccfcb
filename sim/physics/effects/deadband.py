"""Deadband: the controller ignores small commands.

    u = 0 where |u| < band

Phoenix calls it the neutral deadband. Phoenix 5 sets 4 % (0.48 V of 12), Phoenix 6 none; teams can
set up to 25 %. A kS below the deadband does not show in a log. Phoenix 6:
https://api.ctr-electronics.com/phoenix6/stable/cpp/_motor_output_configs_8hpp_source.html
"""

from collections.abc import Iterator, Mapping

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual

SMALLEST, NEXT, TRIED = 0.06, 1.13, 33
"""[V] The smallest threshold from which a search begins, [1] the ratio of each to the one before,
and their number. A smaller deadband looks like kS, and Phoenix allows none above 3 V."""


def transform_voltage(u: float, band: float) -> float:
    """[V] voltage at the motor for a command ``u``."""
    return u if abs(u) >= band else 0.0


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is a third of a volt above kS."""
    return {"band": scale.ks + 0.33 * size}


def find_start_values(_: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: thresholds up to three volts, each an eighth above the one before.

    The likelihood changes in jumps with the threshold, so a search from far away does not converge.
    If the mechanism sinks under its own weight, the ramps do not show the threshold either.
    """
    yield from ({"band": SMALLEST * NEXT**number} for number in range(TRIED))


EFFECT = Effect(
    name="deadband",
    kind="path",
    summary="small voltages that the motor controller ignores",
    formula="u = 0 where |u| < band",
    parameters=(
        Parameter("band", "smallest voltage that is applied", "V", most=12.0, stepwise=True),
    ),
    fingerprint="Ramps start late and then jump to their speed; below one voltage it coasts.",
    inspect="Check the neutral deadband in the motor controller's configuration.",
    apart={
        "stribeck": (
            "Let the voltage fall slowly (triangle test). Below one voltage a deadband gives no "
            "voltage at all, friction only slows the mechanism."
        ),
        "delay": (
            "Run two ramps. With a deadband the motion starts at the same voltage, with a delay "
            "it starts after the same time."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"transform_voltage": transform_voltage},
    order=1,
)
