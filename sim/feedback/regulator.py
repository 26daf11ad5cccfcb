"""Suggested feedback gains kP and kD: a linear-quadratic regulator, as WPILib SysId sets it up.

    Q = diag(1/q²), R = 1/r²   (Bryson's rule: q the error that is worth r volts)
    K = (BᵀSB + R)⁻¹ BᵀSA      S from the discrete Riccati equation over the controller's period
    K ← K (A - BK)^(delay/period)   for a delayed measurement

Source: WPILib SysId 2026.2.2, ``analysis/FeedbackAnalysis.cpp`` and ``FeedbackControllerPreset``.
The suggestion is a starting point, not a tuned controller.
"""

import math
from dataclasses import dataclass

from sim.core.errors import BadRequest
from sim.core.units import BATTERY
from sim.feedback.linear_quadratic import design_two_state_regulator

MASSLESS = 1e-7  # [V·s²/unit] with a smaller kA, the input of SysId's model is the velocity


@dataclass(frozen=True)
class Preset:
    """The units and loop times of one kind of motor controller.

    Args:
        name: its name.
        output: units of its output per volt.
        velocity_time: seconds in the time unit of its velocity; 60 if it is per minute.
        period: period of its control loop [s].
        normalized: whether its derivative gain is per second, not per loop.
        delay: delay of its velocity measurement [s].
    """

    name: str
    output: float
    velocity_time: float
    period: float
    normalized: bool
    delay: float

    def format_units(self, loop: str, per: str) -> tuple[str, str]:
        """The units of kP and kD: output per error, and output per speed of the error.

        Args:
            loop: ``velocity`` or ``position``.
            per: symbol of the unit of position.
        """
        output = "V" if self.output == 1.0 else "duty cycle" if self.output < 1.0 else "native"
        speed = f"({per}/{TIMES[self.velocity_time]})"
        rate = f"({per}/s)" if self.normalized else f"({per}/{self.period * 1e3:.0f} ms)"
        return f"{output}/{speed if loop == 'velocity' else per}", f"{output}/{rate}"


TIMES = {1.0: "s", 0.1: "100 ms", 60.0: "min"}  # [s] the time in a velocity -> its symbol
PRESETS: dict[str, Preset] = {
    "default": Preset("WPILib", 1.0, 1.0, 0.020, normalized=True, delay=0.0),
    "ctre-phoenix5": Preset(
        "CTRE Phoenix 5", 1023 / 12, 0.1, 0.001, normalized=False, delay=81.5e-3
    ),
    "ctre-phoenix6": Preset("CTRE Phoenix 6", 1.0, 1.0, 0.001, normalized=True, delay=1e-3),
    "rev-brushless": Preset(
        "REV brushless port", 1 / 12, 60.0, 0.001, normalized=False, delay=0.112
    ),
    "rev-brushed": Preset("REV brushed port", 1 / 12, 60.0, 0.001, normalized=False, delay=81.5e-3),
    "venom": Preset("Venom", 4096 / 12, 60.0, 0.001, normalized=False, delay=5e-3),
}

VOLTS = 7.0  # [V] voltage that corresponds to the allowed error (SysId's default)
POSITION_ERROR = 0.1  # [unit] allowed position error (SysId's default)
VELOCITY_ERROR = 1.5  # [unit/s] allowed velocity error if none is given (SysId's struct default)
SPEED_SHARE = 0.25  # share of the free speed at 12 V that SysId allows as velocity error by default


@dataclass(frozen=True)
class Feedback:
    """Gains of one loop, in the output units of its preset."""

    kp: float
    kd: float


def compute_allowed_velocity_error(*, ks: float, kv: float) -> float:
    """SysId's default allowed velocity error, a quarter of the free speed at 12 V [unit/s].

    Args:
        ks: static friction [V].
        kv: [V·s/unit].
    """
    return SPEED_SHARE * (BATTERY - ks) / kv if kv else VELOCITY_ERROR


def design_velocity_loop(
    *,
    kv: float,
    ka: float,
    preset: Preset = PRESETS["default"],
    velocity_error: float = VELOCITY_ERROR,
    volts: float = VOLTS,
    delay: float | None = None,
) -> Feedback:
    """Gains of a velocity loop.

    Args:
        kv: [V·s/unit].
        ka: [V·s²/unit].
        preset: units and timing of the motor controller.
        velocity_error: allowed velocity error [unit/s], which corresponds to ``volts``.
        volts: voltage for this error [V].
        delay: delay of the measurement [s]; None takes the preset's.

    Raises:
        BadRequest: kV or kA is negative or not finite, or an allowed error is not positive.

    Examples:
        >>> round(design_velocity_loop(kv=2.5, ka=0.4).kp, 2)
        2.44
    """
    _refuse_bad_plant(kv=kv, ka=ka, errors=(velocity_error, volts))
    if ka < MASSLESS:
        return Feedback(0.0, 0.0)
    rate = -kv / ka
    a = math.exp(rate * preset.period)
    b = math.expm1(rate * preset.period) / -kv if kv else preset.period / ka
    k, closed = _design_scalar_regulator(a, b, q=velocity_error**-2, r=volts**-2)
    k *= closed ** (_choose_delay(preset, delay) / preset.period)
    return Feedback(k * preset.output / preset.velocity_time, 0.0)


def design_position_loop(
    *,
    kv: float,
    ka: float,
    preset: Preset = PRESETS["default"],
    position_error: float = POSITION_ERROR,
    velocity_error: float = VELOCITY_ERROR,
    volts: float = VOLTS,
    delay: float | None = None,
) -> Feedback:
    """Gains of a position loop.

    Args:
        kv: [V·s/unit].
        ka: [V·s²/unit].
        preset: units and timing of the motor controller.
        position_error: allowed position error [unit], which corresponds to ``volts``.
        velocity_error: allowed velocity error [unit/s], which corresponds to ``volts``.
        volts: voltage for these errors [V].
        delay: delay of the measurement [s]; None takes the preset's.

    Raises:
        BadRequest: as for ``design_velocity_loop``.
    """
    _refuse_bad_plant(kv=kv, ka=ka, errors=(position_error, velocity_error, volts))
    loops = _choose_delay(preset, delay) / preset.period
    if ka < MASSLESS:  # no inertia: the velocity answers at once, so it is the input
        k, closed = _design_scalar_regulator(1.0, preset.period, q=position_error**-2, r=volts**-2)
        return Feedback(kv * k * closed**loops * preset.output, 0.0)
    per_position, per_velocity = design_two_state_regulator(
        -kv / ka,
        1.0 / ka,
        period=preset.period,
        q=(position_error**-2, velocity_error**-2),
        r=volts**-2,
        loops=loops,
    )
    per_loop = 1.0 if preset.normalized else preset.period
    return Feedback(per_position * preset.output, per_velocity * preset.output / per_loop)


def _design_scalar_regulator(a: float, b: float, *, q: float, r: float) -> tuple[float, float]:
    """Gain and closed-loop factor of x⁺ = a·x + b·u, from its Riccati equation's positive root.

    b²S² + (r - a²r - b²q)S - qr = 0
    """
    half = (r * (1.0 - a * a) - b * b * q) / 2.0
    s = (math.sqrt(half * half + b * b * q * r) - half) / (b * b)
    k = b * s * a / (b * b * s + r)
    return k, max(0.0, a - b * k)


def _choose_delay(preset: Preset, delay: float | None) -> float:
    return preset.delay if delay is None else max(0.0, delay)


def _refuse_bad_plant(*, kv: float, ka: float, errors: tuple[float, ...]) -> None:
    if not (math.isfinite(kv) and math.isfinite(ka) and kv >= 0.0 and ka >= 0.0):
        raise BadRequest(
            f"no feedback gains for kV = {kv:.4g}, kA = {ka:.4g}",
            advice="Both must be zero or more: does a positive voltage give a positive velocity?",
        )
    if not all(error > 0.0 for error in errors):
        raise BadRequest(
            "an allowed error or voltage is not positive", advice="Give numbers above zero."
        )
