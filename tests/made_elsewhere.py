"""Logs whose truth is known, from an integrator that shares no code with the simulation.

Explicit steps of 50 µs: dry friction that holds at rest, an exponential extra at a crawl
(Stribeck), drag with the square of the speed, a slope. The record has a late command, a velocity
averaged over a window, noise, rounding and a clock that jitters.

Two sets are made of it. ``error_logs``: six mechanisms, four noises, two periods, three kinds
(``ideal``; ``sensor``: what a recorder adds; ``everyday``: what every gearbox adds).
``lag_logs``: a light drivetrain under all combinations of four inertias, windows and lags.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product

import numba
import numpy as np

from sim.bench.mechanisms import MECHANISMS
from sim.core.log import Array, Log, Run

STEP = 5e-5  # [s]
NAMES = ("arm", "drivetrain", "elevator", "intake", "shooter", "turret")  # so figures compare
KINDS = ("ideal", "sensor", "everyday")
NOISES = (0.003, 0.01, 0.03, 0.1)  # [m/s] of a drivetrain that makes FULL_SPEED at 12 V
PERIODS = (0.01, 0.02)  # [s]
FULL_SPEED = 4.0  # [m/s]
RAMP, VOLTS, LONGEST = 0.5, 3.5, 10.0  # [V/s], [V], [s]
INERTIAS = (0.02, 0.04, 0.06, 0.1)  # [V·s²/m] kA of the lag logs
WINDOWS = (0.02, 0.04, 0.06, 0.1)  # [s]
LAGS = (0.0, 0.005, 0.015, 0.03)  # [s]


@dataclass(frozen=True)
class Truth:
    """What a log is made of.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        gains: kS, kV, kA and kG.
        lowest: [unit] lower stop; the way is ``travel``.
        travel: [unit] after which a test ends.
        noise: [unit/s] of the velocity.
        grain: [unit] of the position.
        period: [s].
        units: ``meters`` or ``radians``.
        lean: share by which kS is more forward and less in reverse.
        breakaway: friction at rest over kS.
        slow: [unit/s] speed over which that fades.
        drag: [V·s²/unit²].
        slope: [V] of a floor.
        window: [s] over which the velocity is averaged.
        lag: [s] from the logged voltage to the motion.
        jitter: [s] of the clock.
        velocity_grain: [unit/s].
        position_noise: [unit].
        quiet: [unit/s] speed below which the velocity's noise fades; 0 trembles at rest, too.
    """

    type: str
    gains: Mapping[str, float]
    travel: float
    noise: float
    grain: float
    period: float
    units: str = "meters"
    lowest: float = 0.0
    lean: float = 0.0
    breakaway: float = 1.0
    slow: float = 1.0
    drag: float = 0.0
    slope: float = 0.0
    window: float = 0.0
    lag: float = 0.0
    jitter: float = 0.0
    velocity_grain: float = 0.0
    position_noise: float = 0.0
    quiet: float = 0.0


@numba.njit(cache=True)
def _moved(  # noqa: PLR0917 - compiled code takes its arguments by place
    volts: Array, every: int, x: float, low: float, high: float, physics: Array
) -> tuple[Array, Array]:
    """Position and velocity after each fine step; each voltage lasts ``every`` of them."""
    ks, kv, ka, kg, arm, lean, breakaway, slow, drag, slope = physics
    n = volts.size * every
    positions, velocities = np.empty(n), np.empty(n)
    v = 0.0
    for i in range(n):
        u = volts[i // every]
        pull = u - kg * (math.cos(x) if arm else 1.0) - slope
        way = v if v != 0.0 else pull
        rubs = ks * (1.0 + (lean if way > 0.0 else -lean))
        rubs *= 1.0 + (breakaway - 1.0) * math.exp(-abs(v) / slow)
        if v == 0.0 and abs(pull) <= rubs:
            positions[i], velocities[i] = x, 0.0
            continue
        pull -= rubs if way > 0.0 else -rubs
        half = v + 0.5 * STEP / ka * (pull - kv * v - drag * v * abs(v))  # the midpoint rule
        next_v = v + STEP / ka * (pull - kv * half - drag * half * abs(half))
        if v * next_v < 0.0:
            next_v = 0.0
        x += 0.5 * STEP * (v + next_v)
        v = next_v
        if x <= low or x >= high:
            x, v = min(max(x, low), high), 0.0
        positions[i], velocities[i] = x, v
    return positions, velocities


def record(truth: Truth, rng: np.random.Generator) -> Log:
    """Four tests of a mechanism, as they would be logged."""
    runs = []
    clock = 1.0
    for kind, way in product(("quasistatic", "dynamic"), (1.0, -1.0)):
        name = f"{kind}-{'forward' if way > 0.0 else 'reverse'}"
        runs.append(_run(truth, name, clock, rng))
        clock = float(runs[-1].time[-1]) + 1.0
    return Log(tuple(runs), units=truth.units, type=truth.type)


def _run(truth: Truth, name: str, clock: float, rng: np.random.Generator) -> Run:
    gains, period, way = truth.gains, truth.period, 1.0 if name.endswith("forward") else -1.0
    stopped = truth.type != "simple"
    low, high = (truth.lowest, truth.lowest + truth.travel) if stopped else (-math.inf, math.inf)
    begin = (low if way > 0.0 else high - 0.02 * truth.travel) if stopped else 0.0
    count = int(LONGEST / period)
    index = np.arange(count)
    volts = way * (RAMP * period * (index + 2) if name.startswith("q") else np.full(count, VOLTS))
    every = round(period / STEP)
    held = round((truth.lag) / STEP)
    fine = np.concatenate([np.zeros(held), np.repeat(volts, every)])
    physics = np.array([
        gains["kS"], gains["kV"], gains["kA"], gains.get("kG", 0.0), float(truth.type == "arm"),
        truth.lean, truth.breakaway, truth.slow, truth.drag, truth.slope,
    ])  # fmt: skip
    position, velocity = _moved(fine, 1, begin, low, high, physics)
    times = period * index + np.clip(
        truth.jitter * rng.standard_normal(count), -0.4 * period, 0.4 * period
    )
    times[0] = 0.0
    at = np.minimum(np.maximum(np.round(times / STEP).astype(int), 0), position.size - 1)
    way_gone = np.concatenate([[position[0]], position])
    if truth.window:
        before = np.maximum(at - round(truth.window / STEP), 0)
        seen = (way_gone[at] - way_gone[before]) / truth.window
    else:
        seen = np.concatenate([[0.0], velocity])[at]
    noise = truth.noise
    if truth.quiet:
        noise = noise * -np.expm1(-np.abs(seen) / truth.quiet)
    seen = seen + noise * rng.standard_normal(count)
    if truth.velocity_grain:
        seen = np.round(seen / truth.velocity_grain) * truth.velocity_grain
    where = way_gone[at] + truth.position_noise * rng.standard_normal(count)
    where = np.round(where / truth.grain) * truth.grain
    gone = np.abs(way_gone[at] - begin) > (0.94 if stopped else 1.0) * truth.travel
    end = int(np.argmax(gone)) if gone.any() else count
    return Run(name, clock + times[:end], volts[:end], where[:end], seen[:end])


def error_logs(*, seeds: int = 3, first: int = 0) -> Iterator[tuple[str, str, Truth, Log]]:
    """Mechanism, kind, truth and log."""
    plan = product(NAMES, KINDS, PERIODS, NOISES, range(first, first + seeds))
    for name, kind, period, noise, seed in plan:
        rng = np.random.default_rng(
            [
                NAMES.index(name),
                KINDS.index(kind),
                round(1e4 * period),
                round(1e4 * noise),
                seed,
            ]
        )
        truth = _drawn(name, kind, period, noise, rng)
        yield name, kind, truth, record(truth, rng)


def _drawn(name: str, kind: str, period: float, noise: float, rng: np.random.Generator) -> Truth:
    built = MECHANISMS[name].draw(rng)
    gains = dict(built.gains)
    top = 12.0 / gains["kV"]
    truth = Truth(
        built.type, gains, travel=built.travel or math.inf, noise=noise * top / FULL_SPEED,
        grain=built.sensor.resolution, period=period,
        units="meters" if built.units == "meters" else "radians", lowest=built.lowest or 0.0,
    )  # fmt: skip
    if kind == "sensor":
        return replace(
            truth, window=rng.uniform(0.0, 0.04), lag=rng.uniform(0.0, 0.012), jitter=4e-4,
            grain=4.0 * truth.grain, velocity_grain=0.5 * truth.noise,
        )  # fmt: skip
    if kind == "everyday":
        return replace(
            truth, lean=rng.choice([-0.05, 0.05]), breakaway=1.15, slow=0.02 * top,
            drag=rng.uniform(0.0, 0.3) / top**2, slope=rng.choice([-0.02, 0.02]),
        )  # fmt: skip
    return truth


def lag_logs(*, seeds: int = 3, first: int = 0) -> Iterator[tuple[str, Truth, Log]]:
    """Name, truth and log of every inertia, window and lag."""
    for ka, window, lag, seed in product(INERTIAS, WINDOWS, LAGS, range(first, first + seeds)):
        rng = np.random.default_rng([round(1e3 * ka), round(1e3 * window), round(1e4 * lag), seed])
        truth = Truth(
            "simple", {"kS": rng.uniform(0.1, 0.3), "kV": rng.uniform(2.0, 3.0), "kA": ka},
            travel=10.0, noise=0.01, grain=2e-4, period=0.02, window=window, lag=lag,
        )  # fmt: skip
        yield f"kA {ka} window {window} lag {lag} #{seed}", truth, record(truth, rng)
