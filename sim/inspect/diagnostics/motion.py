"""Check the motion: whether the log has enough of it, and whether the gains reproduce it."""

from collections.abc import Iterator

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import Refusal
from sim.core.log import Array, Run
from sim.fit import Fit, fit
from sim.inspect.baseline_model import SLOWEST, BaselineModel
from sim.inspect.log_features import MIN_SAMPLES, LogFeatures

GOOD_R2 = 0.9  # simulated velocity R² that WPILib's documentation calls good
MISFIT = 0.12  # [share of the top speed] error of a simulation over ``MISFIT_TIME``
MISFIT_TIME = 0.1  # [s]
REPEATABLE = 0.06  # [share of the top speed] largest normal difference of two runs of a test
RISE = 2  # [samples] between 10 % and 90 % of the top speed, at least
INTERCEPT = 0.35  # [V] by which a fast ramp may shift a line that is drawn by hand


def check_r2_hides_misfit(features: LogFeatures) -> Iterator[Doubt]:
    """Doubts about a simulated velocity R² above 0.9 that hides a misfit."""
    try:
        found = fit(features.log, method="sysid")
    except Refusal:
        return
    model = _make_baseline_model(found)
    if model is None or found.simulated_velocity_r2 < GOOD_R2:
        return
    worst, said = MISFIT, ""
    for run in features.log.runs:
        strays = _replay_errors(run, model, features.period)
        if strays.size and strays.max() > worst:
            worst = float(strays.max())
            said = f"{run.test} at {run.time[int(np.argmax(strays))]:.2f} s"
    if not said:
        return
    yield Doubt(
        "fine-r2",
        f"SysId would still show a simulated velocity R² of {found.simulated_velocity_r2:.2f}, "
        f"which counts as good. But in {said} a simulation with SysId's gains is wrong by "
        f"{worst:.0%} of the top speed. Plot these seconds before you trust kA.",
    )


def _make_baseline_model(found: Fit) -> BaselineModel | None:
    """The fitted gains as a baseline model; None if kV or kA is not positive."""
    gains = found.gains
    if not (gains["kV"] > 0.0 and gains["kA"] > 0.0):
        return None
    kg, tilt = gains.get("kG", 0.0), gains.get("offset_rad")
    load = (kg, 0.0, 0.0) if tilt is None else (0.0, kg * np.cos(tilt), -kg * np.sin(tilt))
    return BaselineModel(gains["kV"], gains["kA"], max(gains["kS"], 0.0), np.array(load))


def _replay_errors(run: Run, model: BaselineModel, period: float) -> Array:
    """(n,) [share of the top speed] error of a replay, the least within ``MISFIT_TIME``."""
    top = run.top_speed
    wide = 2 * round(0.5 * MISFIT_TIME / period) + 1
    if not top or len(run) <= wide or not run.kind.startswith(("quasi", "dynamic")):
        return np.zeros(0)
    moving = np.flatnonzero(run.moving)
    first, last = int(moving[0]), int(moving[-1]) + 1
    velocity = float(run.velocity[first])
    replay = model.replay(run, voltage=run.voltage, first=first, last=last, velocity=velocity)
    off = np.zeros(len(run))
    off[first:last] = np.abs(run.velocity[first:last] - replay) / top
    off = np.pad(off, wide // 2, mode="edge")
    return np.asarray(np.lib.stride_tricks.sliding_window_view(off, wide).min(axis=1))


def check_repeated_tests(features: LogFeatures) -> Iterator[Doubt]:
    """Doubts about repeated tests that differ."""
    if features.baseline is None:
        return
    for test in dict.fromkeys(run.test for run in features.log.runs):
        runs = [i for i, run in enumerate(features.log.runs) if run.test == test]
        ahead = [_measure_speed_excess(features, i) for i in runs]
        apart = max(ahead) - min(ahead)
        if apart > REPEATABLE:
            yield Doubt(
                "repeats-differ",
                f"The {len(runs)} runs of {test} differ by {apart:.0%} of their speed at the"
                " same voltage, and SysId uses only the first. Find out what changed "
                "between them: the battery, the load, the temperature, or a slip.",
            )


def _measure_speed_excess(features: LogFeatures, index: int) -> float:
    """[share of its top speed] median of a run's velocity minus the predicted one."""
    run, predicted = features.log.runs[index], features.predicted_velocities[index]
    if not run.top_speed:
        return 0.0
    ahead = (run.velocity - predicted) * np.sign(predicted)
    return float(np.median(ahead[run.moving])) / run.top_speed


def check_too_little_motion(features: LogFeatures) -> Iterator[Doubt]:
    """Doubts about tests that hardly move, and steps that end too early."""
    runs = [run for run in features.log.runs if len(run)]
    if runs and all(not np.ptp(run.position) and not run.velocity.any() for run in runs):
        yield _doubt_motion(runs)
        return
    for run in features.log.runs:
        moving = int((run.moving & (np.abs(run.velocity) > features.still_speed)).sum())
        if moving < MIN_SAMPLES and run.kind in ("quasistatic", "dynamic"):
            yield Doubt(
                "little-motion",
                f"Only {moving} of the {len(run)} samples of {run.test} are in motion, so "
                f"this run contains almost no information. {_advise_more_motion(run)}",
            )
        elif run.kind == "dynamic" and (samples := _count_rise_samples(run)) < RISE:
            yield Doubt(
                "short-rise",
                f"{run.test} reaches 90 % of its top speed within {samples} samples, so "
                "hardly any sample contains information about kA. Log every 5 ms, if the "
                "controller sends that fast.",
            )


def _advise_more_motion(run: Run) -> str:
    """Advice to make a run move more: a longer one, or a higher voltage."""
    most = float(np.abs(run.voltage).max(initial=0.0))
    if run.kind == "quasistatic":
        return (
            f"Let the ramp run beyond {most:.2g} V; at that voltage it had hardly started to move."
        )
    lasts = float(np.ptp(run.time)) if len(run) else 0.0
    return f"Let it run longer than {lasts:.1f} s, or use a larger step than {most:.2g} V."


def _doubt_motion(runs: list[Run]) -> Doubt:
    """A grave warning about a log without any motion."""
    volts = max(float(np.abs(run.voltage).max()) for run in runs)
    lasts = max(float(np.ptp(run.time)) for run in runs)
    return Doubt(
        "no-motion",
        f"Nothing moves in this log: in all {len(runs)} runs, the longest of {lasts:.1f} s, "
        f"position and velocity stay the same with up to {volts:.2g} V. Either the mechanism "
        "stood still, or the log does not contain its sensor. Turn it by hand, and check "
        "whether the position changes.",
        grave=True,
    )


def _count_rise_samples(run: Run) -> int:
    """[samples] between 10 % and 90 % of the top speed; all if it starts in motion."""
    done = int(np.argmax(np.abs(run.velocity) > 0.9 * run.top_speed))
    return len(run) if run.moving[0] else done - int(np.argmax(run.moving))


def check_ramp_rate(features: LogFeatures) -> Iterator[Doubt]:
    """Doubts about ramps so fast that a line through their voltages misses kS."""
    long = [run for run in features.log.runs if len(run) > MIN_SAMPLES]
    ramps = [run for run in long if run.kind == "quasistatic"]
    if features.baseline is None or not ramps:
        return
    rate = float(np.median([_measure_ramp_rate(run) for run in ramps]))
    shift = features.baseline.timescale * rate
    if shift < INTERCEPT or features.baseline.timescale >= SLOWEST:  # then it is not measured
        return
    yield Doubt(
        "fast-ramp",
        f"The voltage ramp rises by {rate:.2g} V/s, which is fast for a mechanism with a time "
        f"constant of {features.baseline.timescale:.2g} s. SysId allows for that, but a "
        f"straight line through the plot of voltage against velocity gives a kS that is "
        f"{shift:.2f} V too large. If you want to draw such a line, use half the ramp rate: "
        f"{0.5 * rate:.2g} V/s.",
    )


def _measure_ramp_rate(run: Run) -> float:
    """[V/s] slope of a ramp's first part, which a weak battery does not flatten."""
    size = np.abs(run.voltage)
    low, high = (int(np.argmax(size > share * size.max())) for share in (0.1, 0.6))
    return float((size[high] - size[low]) / (run.time[high] - run.time[low])) if high > low else 0.0
