"""What R² hides: one drivetrain, logged correctly once and wrongly twenty times.

    found = gains of SysId's recipe        off = found/true - 1

The truth is known, so each R² comes with the errors of the gains, which are unknown on a robot.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.log import Log
from sim.fit import Fit, fit
from sim.teaching.r2_cases import drivetrains, harm

GOOD = 0.9  # [1] simulated velocity R² above which WPILib's docs call a fit good
MEDIAN = 5  # [samples] window of the median filter, which removes single spikes


@dataclass(frozen=True, eq=False)
class Case:
    """A log with a fault, and the fit of SysId's recipe to it.

    Args:
        name: name of the fault, in a few words.
        story: what happened, in one sentence with numbers.
        log: the recorded log.
        truth: the true gains of the mechanism.
        fit: the fit of SysId's recipe.
        harmful: whether the log has a fault that was not repaired.
    """

    name: str
    story: str
    log: Log
    truth: Mapping[str, float]
    fit: Fit
    harmful: bool

    def compute_gain_error(self, gain: str) -> float:
        """Relative error of a gain: 0.1 is 10 % too large, -2 has the wrong sign."""
        return self.fit.gains[gain] / self.truth[gain] - 1.0

    @property
    def has_good_r2(self) -> bool:
        """Whether its simulated velocity R² is above ``GOOD``."""
        return self.fit.simulated_velocity_r2 > GOOD


@dataclass(frozen=True)
class _Recipe:
    """The definition of a case: mechanism and routine, and damage to the log."""

    name: str
    story: str
    setup: drivetrains.Setup = drivetrains.PLAIN
    spoil: Callable[[Log, np.random.Generator], Log] = harm.leave_unchanged
    median: int = 1
    harmful: bool = True


_RECIPES = (
    _Recipe("clean", "nothing: the log is good", harmful=False),
    _Recipe(
        "1 encoder spike",
        "one velocity reading of the forward ramp is 1.6 m/s off",
        spoil=harm.add_spikes(1),
    ),
    _Recipe(
        "3 encoder spikes",
        "three velocity readings of the forward ramp are 1.6 m/s off",
        spoil=harm.add_spikes(3),
    ),
    _Recipe(
        "10 encoder spikes",
        "ten velocity readings of the forward ramp are 1.6 m/s off",
        spoil=harm.add_spikes(10),
    ),
    _Recipe(
        "10 spikes, median of 5",
        "the log with ten wrong readings, after SysId's median filter",
        spoil=harm.add_spikes(10),
        median=MEDIAN,
        harmful=False,
    ),
    _Recipe(
        "encoder slips 10 %",
        "from the middle of both ramps on, the encoder misses 10 % of the motion",
        spoil=harm.add_encoder_slip(0.1),
    ),
    _Recipe(
        "encoder slips 30 %",
        "from the middle of both ramps on, the encoder misses 30 % of the motion",
        spoil=harm.add_encoder_slip(0.3),
    ),
    _Recipe(
        "sudden jump",
        "something sticks and lets go in the forward ramp: 1.2 m/s too fast for 0.2 s",
        spoil=harm.add_position_jump,
    ),
    _Recipe(
        "stop during the rise",
        "both steps hit a stop at 60 % of the top speed, and the voltage goes on for 0.3 s",
        spoil=harm.add_early_stop,
    ),
    _Recipe(
        "commanded volts, 7 V step",
        "a 120 A limit, good battery (20 mΩ); the log contains the commanded voltage",
        setup=drivetrains.GOOD_BATTERY,
        spoil=harm.log_commanded_voltage(drivetrains.GOOD_BATTERY),
    ),
    _Recipe(
        "commanded volts, 10 V step",
        "a 120 A limit, weak battery (35 mΩ); the log contains the commanded voltage",
        setup=drivetrains.WEAK_BATTERY,
        spoil=harm.log_commanded_voltage(drivetrains.WEAK_BATTERY),
    ),
    _Recipe(
        "brownout, commanded volts",
        "the motors are off for 0.3 s of the forward ramp, and the log does not show it",
        spoil=harm.add_brownout,
    ),
    _Recipe(
        "gaps up to 100 ms",
        "every fifth loop is late by up to 100 ms",
        spoil=harm.drop_samples(0.1),
    ),
    _Recipe(
        "gaps up to 300 ms",
        "every fifth loop is late by up to 300 ms",
        spoil=harm.drop_samples(0.3),
    ),
    _Recipe(
        "slow velocity filter",
        "NEO motors, velocity averaged over 0.22 s, so 112 ms late",
        setup=drivetrains.SLOW_FILTER,
    ),
    _Recipe(
        "40 A limit, commanded volts",
        "a 40 A current limit acts; the log contains the commanded voltage",
        setup=drivetrains.LIMITED,
        spoil=harm.log_commanded_voltage(drivetrains.LIMITED),
    ),
    *(
        _Recipe(
            f"wheel slip, {setup.routine.step:g} V step",
            "the step needs more grip than the carpet has",
            setup=setup,
            spoil=harm.add_wheel_slip(setup),
        )
        for setup in drivetrains.GRIPPING
    ),
    _Recipe(
        "friction differs",
        "friction 0.15 V forward, 0.45 V in reverse",
        setup=drivetrains.LEANING,
    ),
    _Recipe(
        "wrong gear ratio", "the encoder's distances are divided by 1.25", spoil=harm.scale_encoder
    ),
    _Recipe("encoder the wrong way", "plus volts, minus velocity", spoil=harm.flip_encoder),
)


def make_cases(*, rng: np.random.Generator) -> tuple[Case, ...]:
    """Make the logs and fit them.

    Args:
        rng: random numbers for noise and gaps; the same state gives the same cases.

    Returns:
        One case for each recipe, the undamaged log first.
    """
    return tuple(_make_case(recipe, rng) for recipe in _RECIPES)


def _make_case(recipe: _Recipe, rng: np.random.Generator) -> Case:
    setup = recipe.setup
    log = recipe.spoil(setup.log(rng=rng), rng)
    found = fit(log, method="sysid", median=recipe.median)
    truth = setup.mechanism.gains
    return Case(recipe.name, recipe.story, log, truth, found, recipe.harmful)
