"""Pool fits of equal parts: both sides, four modules, repeated recordings.

Each part is fitted alone and the gains are averaged; the samples are not. Two sides report at
different times, so the mean of their samples changes twice as often, each time by half a step, and
a fit takes these steps for noise or motion: kA became 9e-05 where the sides alone had 0.38 and
0.40. A joint fit with common gains would avoid that too, but its gains may lie outside those of
both parts, and its errors ignore that the parts differ.

The mean is that of the random-effects model (R. DerSimonian and N. Laird, "Meta-analysis in
clinical trials", 1986): with s_i the standard error of part i and t² the variance between parts,

    w_i = 1/(s_i² + t²)        gain = Σ w_i·gain_i / Σ w_i        error = sqrt(1/Σ w_i)

All weights are positive, so a gain never lies outside those of its parts. The error is no smaller
than the scatter of the parts says (J. Hartung and G. Knapp, 2001).
"""

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.fit.result import Fit, multiply_gains

LEAST_ERROR = 1e-9  # [share of a gain] smaller standard errors count as this


def pool_fits(fits: Mapping[str, Fit]) -> Fit:
    """The weighted mean of the fits of equal parts, in the unit of the first.

    Delays are means. R² and RMSE are those of each part simulated with its own gains.

    Args:
        fits: name of each part -> its fit; at least one.

    Raises:
        BadRequest: they are of different types, or one measures a length and another an angle.
    """
    first, *others = fits.values()
    if any(one.type != first.type for one in others):
        raise BadRequest(
            f"fits of types {', '.join(dict.fromkeys(one.type for one in fits.values()))} have no "
            "common gains",
            advice=Action("same-type"),
        )
    if not others:
        return first
    alike = _orient_alike([first, *(one.in_units(first.units) for one in others)])
    first = alike[0]
    pooled = {
        name: pool_values(
            [_get_gain(first, one, name) for one in alike],
            [one.errors.get(name, math.nan) for one in alike],
        )
        for name in first.gains
        if all(name in one.gains for one in alike)
    }
    r2, rmse = _pool_quality(
        alike, lambda one: (one.simulated_velocity_r2, one.simulated_velocity_rmse)
    )
    accelerations = _pool_quality(alike, lambda one: (one.acceleration_r2, one.acceleration_rmse))
    return replace(
        first,
        gains={name: gain for name, (gain, _) in pooled.items()},
        errors={name: error for name, (_, error) in pooled.items()},
        acceleration_r2=accelerations[0],
        acceleration_rmse=accelerations[1],
        simulated_velocity_r2=r2,
        simulated_velocity_rmse=rmse,
        samples_used=_sum_samples(alike),
        position_delay=_compute_mean(one.position_delay for one in alike),
        velocity_delay=_compute_mean(one.velocity_delay for one in alike),
        velocity_threshold=_compute_mean(one.velocity_threshold for one in alike),
        step_duration=max(one.step_duration for one in alike),
        doubts=merge_doubts(fits),
    )


def pool_values(values: list[float], errors: list[float]) -> tuple[float, float]:
    """The mean of values with known standard errors, and its standard error.

    Args:
        values: (n,) the value of each part.
        errors: (n,) one standard error of each; not finite if it is unknown.

    Returns:
        The mean and its standard error, which is nan if one of the errors is unknown.
    """
    if not all(map(math.isfinite, errors)):
        return _compute_mean(values), math.nan
    least = max(LEAST_ERROR * max(map(abs, values)), 1e-300)
    own = [max(error, least) ** 2 for error in errors]
    between = _compute_variance_between(values, own)
    weights = [1.0 / (square + between) for square in own]
    total = math.fsum(weights)
    shares = [weight / total for weight in weights]
    mean = math.fsum(share * value for share, value in zip(shares, values, strict=True))
    mean = min(max(mean, min(values)), max(values))  # rounding
    scatter = (
        _sum_weighted_squares(values, shares, mean) / (len(values) - 1) if len(values) > 1 else 0.0
    )
    return mean, math.sqrt(max(1.0 / total, scatter))


def merge_doubts(fits: Mapping[str, Fit]) -> tuple[Doubt, ...]:
    """The doubts of all parts; a doubt of several parts is listed once, with their names.

    Args:
        fits: the name of each part -> its fit.
    """
    found: dict[str, dict[str, list[Doubt]]] = {}
    for name, one in fits.items():
        for doubt in one.doubts:
            found.setdefault(doubt.code, {}).setdefault(name, []).append(doubt)
    return tuple(
        doubt for several in found.values() for doubt in _merge_doubts(several, whole=len(fits))
    )


def _merge_doubts(several: Mapping[str, list[Doubt]], *, whole: int) -> list[Doubt]:
    """The doubts of one code: one for all parts if they are equal, else those of the worst part."""
    kinds = {tuple(doubts) for doubts in several.values()}
    if len(kinds) == 1 and len(several) == whole:
        return list(next(iter(kinds)))
    if all(f", {name}, " in one.message for name, doubts in several.items() for one in doubts):
        return [one for doubts in several.values() for one in doubts]  # each names its part
    worst = max(several.values(), key=lambda doubts: any(doubt.grave for doubt in doubts))
    first, *others = several
    names = f"{first} and {len(others)} more" if len(others) > 1 else ", ".join(several)
    return [replace(doubt, message=f"{names}: {doubt.message}") for doubt in worst]


def _orient_alike(fits: list[Fit]) -> list[Fit]:
    """The fits, with negative gains inverted unless all parts have negative gains.

    A part whose voltage was logged with the wrong sign has negative gains, and a warning.
    """
    if all(one.gains["kV"] < 0.0 for one in fits):
        return fits
    signs = [-1.0 if one.gains["kV"] < 0.0 else 1.0 for one in fits]
    return [
        replace(one, gains=multiply_gains(one.gains, sign))
        for one, sign in zip(fits, signs, strict=True)
    ]


def _get_gain(first: Fit, other: Fit, name: str) -> float:
    """A gain of another part; an angle is brought within half a turn of the first part's."""
    value = other.gains[name]
    if name != "offset_rad":
        return value
    return value + math.tau * round((first.gains[name] - value) / math.tau)


def _compute_variance_between(values: list[float], own: list[float]) -> float:
    """The variance between parts beyond what their own errors explain; 0 if there is none."""
    weights = [1.0 / square for square in own]
    total = math.fsum(weights)
    mean = math.fsum(w * value for w, value in zip(weights, values, strict=True)) / total
    excess = _sum_weighted_squares(values, weights, mean) - (len(values) - 1)
    size = total - math.fsum(w * w for w in weights) / total
    return max(excess / size, 0.0) if size > 0.0 else 0.0


def _sum_weighted_squares(values: list[float], weights: list[float], mean: float) -> float:
    """The weighted sum of squared deviations from the mean."""
    return math.fsum(w * (value - mean) ** 2 for w, value in zip(weights, values, strict=True))


def _pool_quality(
    fits: list[Fit], scores: Callable[[Fit], tuple[float, float]]
) -> tuple[float, float]:
    """R² and RMSE of all parts together, from those of each."""
    weights = [max(sum(one.samples_used.values()), 1) for one in fits]
    rows = [scores(one) for one in fits]
    if not all(map(math.isfinite, (number for row in rows for number in row))):
        return min(r2 for r2, _ in rows), max(rmse for _, rmse in rows)
    count = sum(weights)
    share = math.fsum(w * r2 for w, (r2, _) in zip(weights, rows, strict=True)) / count
    missed = math.fsum(w * rmse**2 for w, (_, rmse) in zip(weights, rows, strict=True)) / count
    return share, math.sqrt(missed)


def _sum_samples(fits: list[Fit]) -> dict[str, int]:
    """Test -> number of samples used, summed over the parts."""
    counts: Counter[str] = Counter()
    for one in fits:
        counts.update(one.samples_used)
    return dict(counts)


def _compute_mean(values: Iterable[float]) -> float:
    every = list(values)
    return math.fsum(every) / len(every)
