"""Check the sensor: lag, noise and scale of its readings."""

from collections.abc import Iterator

import numpy as np

from sim.core.doubt import Doubt
from sim.core.units import find_unit
from sim.fit.sysid_rows import estimate_noise_floor
from sim.inspect.log_features import MIN_SAMPLES, LogFeatures
from sim.inspect.log_units import FAR

LAG = 0.02, 1.5  # [s, periods] largest delay without a filter
ROUNDED = 0.01  # [s] to which a delay is rounded: the runs of a log do not agree more closely
FILTERS = {  # [s] WPILib's figures for the delay of a velocity
    "REV's own encoder of a NEO": 0.112,
    "CTRE Phoenix 5, or REV's data port": 0.0815,
}
ALIKE = 0.15  # [share] largest difference of a delay from one of them
PASSES = 0.1  # [share of a ramp's rows] that may be at rest and count as motion


def check_velocity_lag(features: LogFeatures) -> Iterator[Doubt]:
    """Doubts about a velocity that is later than its position."""
    found = features.velocity_lag
    if not 1.0 / FAR < features.usual_distance_ratio < FAR:  # that is a wrong unit
        return
    least = max(LAG[0], LAG[1] * features.period)
    if found is None or not found.matched or found.lag <= least:
        return
    lag = found.lag
    rounded = round(lag / ROUNDED) * ROUNDED
    similar = [name for name, age in FILTERS.items() if abs(lag / age - 1.0) < ALIKE]
    likely = f", as {similar[0]} does" if similar else ""
    yield Doubt(
        "velocity-lag",
        f"The velocity is about {rounded * 1000.0:.0f} ms later than the "
        f"position: most likely the motor controller averages it{likely}. The fit "
        "takes this delay into account. WPILib's SysId does not: its kA is wrong, and the "
        "measurement delay that you enter there changes only the feedback gains. Shorten the "
        "filter of the motor controller.",
    )


def check_rest_noise(features: LogFeatures) -> Iterator[Doubt]:
    """Doubts about small noise at rest that still exceeds SysId's threshold."""
    both = zip(features.log.runs, features.rest_lengths, strict=True)
    ramps = {run: n for run, n in both if run.kind == "quasistatic" and len(run) > MIN_SAMPLES}
    if not ramps:
        return
    threshold = min(estimate_noise_floor(run.velocity) for run in ramps)
    rests = [run.velocity[:still] for run, still in ramps.items()]
    noisy = [rest for rest in rests if rest.size and np.any(np.diff(rest))]
    passed = sum(int(np.sum(np.abs(rest) >= threshold)) for rest in noisy)
    counted = sum(int(np.sum(np.abs(run.velocity) >= threshold)) for run in ramps)
    if passed <= PASSES * counted:
        return
    unit = find_unit(features.log.units)
    yield Doubt(
        "standstill-counted",
        f"SysId thinks that the mechanism moves in {counted} quasistatic samples. In {passed} "
        "of them it stands still, but the noise of the velocity is above SysId's threshold of "
        f"{threshold / unit.si:.2g} {unit.symbol}/s. Set the threshold by hand, above the noise.",
    )
