"""The result of a fit: gains with standard errors, goodness of fit, and warnings."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.core.units import Unit, compute_unit_ratio, convert_gains, find_unit
from sim.feedback import (
    PRESETS,
    Feedback,
    Preset,
    compute_allowed_velocity_error,
    design_position_loop,
    design_velocity_loop,
)
from sim.feedback.regulator import POSITION_ERROR, VOLTS
from sim.physics.model import Part
from sim.support.printable import finite_or_none


@dataclass(frozen=True)
class Fit:
    """The result of a fit.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        method: ``output-error`` or ``sysid``.
        units: unit of position of the numbers below; meters or radians from a fit.
        log_units: unit of position of the log.
        gains: kS [V], kV [V·s/unit], kA [V·s²/unit], kG [V], offset_rad [rad].
        errors: gain -> one standard error.
        acceleration_r2: R² of the acceleration; with ``sysid`` SysId's adjusted one.
        acceleration_rmse: [unit/s²] RMS error of the acceleration.
        simulated_velocity_r2: R² of the open-loop velocity; with ``sysid`` SysId's own, of the
            forward tests, -inf if the simulation diverges.
        simulated_velocity_rmse: [unit/s] RMS error of the open-loop velocity.
        samples_used: test -> number of samples that were used.
        position_delay: [s] delay from voltage to position.
        velocity_delay: [s] delay from voltage to velocity.
        velocity_threshold: [unit/s] slower quasistatic samples were left out; 0 with
            ``output-error``.
        step_duration: [s] used part of each dynamic test; 0 with ``output-error``.
        lag_differs: whether the lag of the readings was found to differ from run to run.
        parts: small effects that were fitted together with the gains, in SI. A simulation needs
            them, a feedforward leaves them out.
        doubts: warnings about the numbers.
    """

    type: str
    method: str
    units: str
    log_units: str
    gains: Mapping[str, float]
    errors: Mapping[str, float]
    acceleration_r2: float
    acceleration_rmse: float
    simulated_velocity_r2: float
    simulated_velocity_rmse: float
    samples_used: Mapping[str, int]
    position_delay: float
    velocity_delay: float
    velocity_threshold: float
    step_duration: float
    lag_differs: bool = False
    parts: tuple[Part, ...] = field(default=())
    doubts: tuple[Doubt, ...] = field(default=())

    def in_units(self, name: str, *, radius: float | None = None) -> "Fit":
        """The fit converted to another unit of position, as from V·s/radian to V·s/rotation.

        Args:
            name: name of the unit.
            radius: of wheel or drum [m], where one unit is an angle and the other a length.

        Raises:
            BadRequest: an unknown unit, or the radius is missing or not above zero.
        """
        new = find_unit(name)
        factor = compute_unit_ratio(new, find_unit(self.units), radius=radius)
        if math.isnan(factor):
            raise BadRequest(
                f"{self.units} cannot be converted into {name}",
                advice=(
                    "One is a length, the other an angle: the conversion needs the wheel's radius."
                ),
            )
        return replace(
            self,
            units=new.name,
            gains=convert_gains(self.gains, factor=factor),
            errors=convert_gains(self.errors, factor=factor),
            acceleration_rmse=self.acceleration_rmse / factor,
            simulated_velocity_rmse=self.simulated_velocity_rmse / factor,
            velocity_threshold=self.velocity_threshold / factor,
        )

    def in_log_units(self) -> "Fit":
        """The fit converted to the unit of position of the log."""
        return self.in_units(self.log_units)

    @classmethod
    def from_gains(
        cls,
        gains: Mapping[str, float],
        *,
        type: str,  # noqa: A002 - the field's own word
        units: str,
        position_delay: float = 0.0,
        velocity_delay: float = 0.0,
    ) -> "Fit":
        """Gains that come from no log, such as those of theory; measured quantities are nan."""
        return cls(
            type, "none", units, units, gains, errors={}, samples_used={},
            acceleration_r2=math.nan, acceleration_rmse=math.nan, simulated_velocity_r2=math.nan,
            simulated_velocity_rmse=math.nan, velocity_threshold=math.nan, step_duration=math.nan,
            position_delay=position_delay, velocity_delay=velocity_delay,
        )  # fmt: skip

    def feedback(
        self,
        preset: Preset = PRESETS["default"],
        *,
        position_error: float = POSITION_ERROR,
        velocity_error: float | None = None,
        volts: float = VOLTS,
    ) -> dict[str, Feedback]:
        """Loop -> suggested feedback gains; empty if kV or kA has the wrong sign.

        With the default preset the measurement's delay is that of the log, as in SysId. Other
        presets have a delay of their own.

        Args:
            preset: the motor controller.
            position_error: [unit] the error that ``volts`` correct.
            velocity_error: [unit/s] the same; None takes SysId's default.
            volts: [V] for these errors.
        """
        kv, ka = self.gains["kV"], self.gains["kA"]
        if not (kv >= 0.0 and ka > 0.0):
            return {}
        allowed = velocity_error or compute_allowed_velocity_error(ks=self.gains["kS"], kv=kv)
        if not allowed > 0.0:
            return {}
        return {
            "velocity": design_velocity_loop(
                kv=kv,
                ka=ka,
                preset=preset,
                velocity_error=allowed,
                volts=volts,
                delay=self.choose_feedback_delay(preset, loop="velocity"),
            ),
            "position": design_position_loop(
                kv=kv,
                ka=ka,
                preset=preset,
                position_error=position_error,
                velocity_error=allowed,
                volts=volts,
                delay=self.choose_feedback_delay(preset, loop="position"),
            ),
        }

    def choose_feedback_delay(self, preset: Preset, *, loop: str) -> float:
        """[s] delay for which gains are designed: the log's for WPILib's preset, else its own."""
        if preset is not PRESETS["default"]:
            return preset.delay
        return max(0.0, self.velocity_delay if loop == "velocity" else self.position_delay)

    def list_doubts(self, preset: Preset = PRESETS["default"]) -> tuple[Doubt, ...]:
        """The doubts about the gains, and those about the feedback gains of one preset."""
        return (
            *self.doubts,
            *(
                Doubt(
                    "negative-feedback",
                    f"The suggested {loop} kP is negative: with the delay in this log the loop "
                    "cannot be as stiff as SysId's default setting requires. Do not use it; "
                    "start with a small positive one.",
                )
                for loop, gains in self.feedback(preset).items()
                if gains.kp < 0.0
            ),
        )

    def to_json(self, preset: Preset = PRESETS["default"]) -> dict[str, object]:
        """The fit as data for JSON; the keys are fixed, because other programs read them."""
        return {
            "type": self.type,
            "method": self.method,
            "units": self.units,
            "gains": dict(self.gains),
            "errors": dict(self.errors),
            "acceleration_r2": self.acceleration_r2,
            "acceleration_rmse": self.acceleration_rmse,
            "simulated_velocity_r2": finite_or_none(self.simulated_velocity_r2),
            "simulated_velocity_rmse": finite_or_none(self.simulated_velocity_rmse),
            "samples_used": dict(self.samples_used),
            "feedback": {
                loop: {"kP": gains.kp, "kD": gains.kd}
                for loop, gains in self.feedback(preset).items()
            },
            "warnings": [{"code": d.code, "message": d.text} for d in self.list_doubts(preset)],
            "small_effects": {
                part.effect: part.to_json(find_unit(self.units)) for part in self.parts
            },
        }

    def format_gain_unit(self, gain: str) -> str:
        """The unit of a gain, as printed: ``V·s/m``."""
        return format_gain_unit(gain, find_unit(self.units))


def refuse_length_of_arm(log: Log, *, type: str) -> None:  # noqa: A002 - the field's own word
    """Refuse an arm whose position is a length.

    Raises:
        BadRequest: it is.
    """
    if type == "arm" and not find_unit(log.units).angular:
        raise BadRequest(
            f"an arm's position must be an angle, and this log is in {log.units}",
            where=log.source,
            advice=Action("angle"),
        )


def multiply_gains(gains: Mapping[str, float], sign: float) -> dict[str, float]:
    """The gains times a sign; an angle stays as it is."""
    return {name: value if name == "offset_rad" else sign * value for name, value in gains.items()}


def format_gain_unit(gain: str, per: Unit) -> str:
    """The unit of a gain when position is measured in ``per``."""
    return {"kV": f"V·s/{per.symbol}", "kA": f"V·s²/{per.symbol}", "offset_rad": "rad"}.get(
        gain, "V"
    )
