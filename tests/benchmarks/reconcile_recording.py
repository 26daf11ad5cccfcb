"""Record a case's three sessions on the bench, clean or with everyday dirt.

No robot is as clean as the bench: in every case friction differs from run to run, something shakes
the mechanism that no log shows, and the velocity has more noise than on a good day.
"""

import inspect
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from reconcile_sizes import Hidden
from reconcile_strangers import SHAKES

from sim.bench.mechanism import Mechanism
from sim.bench.routine import COAST_AFTER, LEVEL_LASTS, LEVELS, TRIANGLE_RISES, Routine
from sim.bench.simulate import simulate
from sim.core.log import Log, Run
from sim.physics.effect import Scale
from sim.physics.effects import find_effect as find
from sim.physics.effects.inertia_change import LATER
from sim.physics.engine.model_arrays import COARSEST
from sim.physics.model import Part

FOUR = ("quasistatic", "dynamic")
SESSIONS = {
    "train": FOUR,
    "validation": FOUR,
    "test": (*FOUR, "coast", "triangle", "multistep"),
}
"""Name of a file -> kinds of tests in it."""

TIMEOUT = 10.0  # [s] of a test, SysIdRoutine's own
OVER, SHORTEST, LONGEST = 4.0, 1.0, 4.0  # [kA/kV], [s], [s] for which a step is held: 98 % of it
SHORT, LONG = 0.5, 0.75  # [V/s] of ramps, with and without an end of the travel to reach
STEP = (5.6, 6.4)  # [V] of the largest level
LESS = {"validation": (0.60, 0.78), "test": (0.70, 0.92)}  # [share of it] of the others
ABOVE = 1.2  # [V] of a step beyond what it takes to hold still

DIRT = {
    "stribeck": (0.0, 0.06),  # [V]
    "battery-sag": (0.0, 0.09),  # [share of the driving volts, at a battery's full voltage]
    "delay": (0.0, 0.006),  # [s]
    "cogging": (0.0, 0.06),  # [V]
}
"""Everyday effect -> its size from to, the largest that counts as everyday; nobody has to name it.
"""
JITTER = (0.0004, 0.0015)  # [s] of dirty cases
NOISE = (0.004, 0.012)  # [V] of the logged voltage of dirty cases

FRICTION = (0.02, 0.06)  # [share] by which it differs from run to run
SHAKEN, LOOP = (0.02, 0.08), 0.02  # [V] of what shakes it in such a loop [s], and no log shows
NOISY, FAST = (0.003, 0.010), 6.0  # [share] noise of the speed that so many volts reach

WARMS, WARMER = "heating", 0.2  # [share] more resistance after a session's four tests: 50 K

MOMENT = (0.3, 0.7)  # [share of a run's motion] when something happens once
WHILE = (0.3, 0.7)  # [share of a step's top speed] at which inertia changes: later nothing shows it
ONCE, ENDS = "onset", "until"  # parameters of what happens at a moment, and of what lasts
FIRST, PASSING = "train", 0.4  # the session in which it happens; [1] of what ends with its run


@dataclass(frozen=True)
class Held(Routine):
    """A routine of which somebody lets go: of a step when it is over, of the rest after one round.

    Nobody drives across the hall, or heats a motor, to see the same speed for ten seconds.

    Args:
        over: [s] until a step is.
    """

    over: float = LONGEST

    def lasts(self, test: str, /) -> float:
        """[s] until a test ends, if it comes to no end of the travel before."""
        held = {
            "dynamic": self.over,
            "coast": COAST_AFTER + self.over,
            "triangle": 4.0 * TRIANGLE_RISES,
            "multistep": len(LEVELS) * LEVEL_LASTS,
        }
        return min(self.timeout, held.get(test.rpartition("-")[0], self.timeout))

    @classmethod
    def of(cls, mechanism: Mechanism, levels: "Levels", session: str) -> "Held":
        """The routine of a session.

        Args:
            mechanism: what moves.
            levels: its voltages.
            session: one of ``SESSIONS``.
        """
        over = OVER * mechanism.gains["kA"] / mechanism.gains["kV"]
        over = min(max(over, SHORTEST), LONGEST)
        return cls(levels.ramp, levels.steps[session], TIMEOUT, SESSIONS[session], over)


Moves = Callable[..., list[Run]]
"""The runs of a session, of a mechanism and a routine, as ``on_the_bench`` makes them."""


@dataclass(frozen=True)
class Levels:
    """The voltages of a case's sessions.

    Args:
        ramp: [V/s].
        steps: name of a session -> [V].
    """

    ramp: float
    steps: dict[str, float]

    @classmethod
    def draw(cls, mechanism: Mechanism, rng: np.random.Generator) -> "Levels":
        """Levels that move a mechanism."""
        most = float(rng.uniform(*STEP))
        least = mechanism.friction + abs(mechanism.gains.get("kG", 0.0)) + ABOVE
        steps = {name: max(most * float(rng.uniform(*less)), least) for name, less in LESS.items()}
        return cls(SHORT if mechanism.stops else LONG, {"train": most, **steps})


@dataclass(frozen=True)
class Day:
    """What all sessions of a case have in common, and nobody has to name; none of it at first.

    Args:
        parts: everyday effects.
        wobble: [share] by which friction differs from run to run.
        shakes: [V] of pushes that no log shows, in each ``LOOP``.
        jitter: [s] of the loops.
        noise: [V] of the logged voltage.
        noisy: [m/s or rad/s] of the velocity; 0 leaves it to the mechanism's own sensor.
    """

    parts: tuple[Part, ...] = ()
    wobble: float = 0.0
    shakes: float = 0.0
    jitter: float = 0.0
    noise: float = 0.0
    noisy: float = 0.0

    @classmethod
    def draw(cls, hidden: Hidden, rng: np.random.Generator, *, dirty: bool) -> "Day":
        """A day of a mechanism.

        Args:
            hidden: the mechanism and what is hidden in it.
            rng: the source of chance.
            dirty: with everyday dirt.
        """
        mechanism = hidden.mechanism
        wobble, shakes, noisy = (float(rng.uniform(*each)) for each in (FRICTION, SHAKEN, NOISY))
        day = cls(wobble=wobble, shakes=shakes, noisy=noisy * FAST / mechanism.gains["kV"])
        if not dirty:
            return day
        jitter, noise = (float(rng.uniform(*each)) for each in (JITTER, NOISE))
        everyday = tuple(_everyday(mechanism.scale, hidden.parts, rng))
        return replace(day, parts=everyday, jitter=jitter, noise=noise)


CALM = Day()


def recorded(
    hidden: Hidden,
    levels: Levels,
    day: Day,
    *,
    session: str,
    period: float,
    rng: np.random.Generator,
    moved: Moves,
) -> Log:
    """One session.

    Args:
        hidden: the mechanism and what is hidden in it.
        levels: its voltages.
        day: what is ordinary.
        session: one of ``SESSIONS``.
        period: [s] between samples.
        rng: the source of chance.
        moved: the physics.
    """
    routine = Held.of(hidden.mechanism, levels, session)
    sensor = replace(hidden.mechanism.sensor, jitter=day.jitter)
    if day.noisy:
        sensor = replace(sensor, velocity_noise=day.noisy)
    mechanism = replace(hidden.mechanism, sensor=sensor)
    parts = (*hidden.parts, *day.parts)
    if day.shakes:
        pushes = day.shakes * math.sqrt(LOOP / COARSEST)
        parts = (*parts, Part(SHAKES.name, {"volts": pushes, "seed": float(rng.random())}))
    lasting = tuple(part for part in parts if ONCE not in part.parameters)
    again = [part for part in parts if ONCE in part.parameters and ENDS not in part.parameters]
    changed = tuple(_since(part, session) for part in parts if _is_changed(part, session))
    built = replace(mechanism, hidden=(*lasting, *changed))
    if again:
        pilot = moved(built, routine, rng=rng, period=period, wobble=0.0)
        sudden = (replace(part, parameters=_at(part, pilot, rng)) for part in again)
        built = replace(built, hidden=(*built.hidden, *sudden))
    runs = moved(built, routine, rng=rng, period=period, wobble=day.wobble)
    runs = [
        replace(run, voltage=run.voltage + day.noise * rng.standard_normal(len(run)))
        for run in runs
    ]
    return Log(tuple(runs), units=mechanism.units, type=mechanism.type)


def heated(
    hidden: Hidden, levels: Levels, *, period: float, rng: np.random.Generator, moved: Moves
) -> Hidden:
    """The same, with a motor that warms by as much whatever it drives.

    The catalogue's example goes by time, and leaves cold what draws current for a moment only.

    Args:
        hidden: the mechanism and what is hidden in it.
        levels: its voltages.
        period: [s] between samples.
        rng: the source of chance.
        moved: the physics.
    """
    if WARMS not in hidden.sizes:
        return hidden
    cold = replace(hidden, parts=tuple(p for p in hidden.parts if p.effect != WARMS))
    log = recorded(cold, levels, CALM, session="train", period=period, rng=rng, moved=moved)
    heat = sum(period * float(np.sum(_drop(cold, run) ** 2)) for run in log.runs)
    warm = Part(WARMS, {"rate": WARMER * hidden.sizes[WARMS] / heat})
    return replace(cold, parts=(*cold.parts, warm))


def _drop(hidden: Hidden, run: Run) -> np.ndarray:
    """(n,) [V] that drive current: what comes of the logged voltage on its way to the motor."""
    kv = hidden.mechanism.gains["kV"]
    volts = run.voltage
    for part in sorted(hidden.parts, key=lambda one: find(one.effect).order):
        act = find(part.effect).hooks.get("transform_voltage")
        if act is None:
            continue
        asked = inspect.signature(act).parameters
        pairs = zip(volts.tolist(), run.velocity.tolist(), strict=True)
        given = ({**part.parameters, "u": u, "v": v, "kv": kv} for u, v in pairs)
        volts = np.array([act(**{name: one[name] for name in asked}) for one in given])
    return volts - kv * run.velocity


def permuted(log: Log, *, rng: np.random.Generator) -> Log:
    """The log with its voltages dealt out anew to all samples of all runs."""
    volts = rng.permutation(np.concatenate([run.voltage for run in log.runs]))
    ends = np.cumsum([len(run) for run in log.runs])[:-1]
    return _with_voltages(log, np.split(volts, ends))


def exchanged(log: Log, *, rng: np.random.Generator) -> Log:
    """The log with every run's voltage from another run, and not merely of the other sign."""
    count = len(log.runs)
    ahead = np.array([run.test.endswith("forward") for run in log.runs])
    while True:
        order = rng.permutation(count)
        if not np.any(order == np.arange(count)) and np.any(ahead[order] == ahead):
            break
    stretched = [
        np.interp(
            np.linspace(0.0, 1.0, len(run)),
            np.linspace(0.0, 1.0, len(log.runs[other])),
            log.runs[other].voltage,
        )
        for run, other in zip(log.runs, order.tolist(), strict=True)
    ]
    return _with_voltages(log, stretched)


def _with_voltages(log: Log, volts: list[np.ndarray]) -> Log:
    runs = (replace(run, voltage=each) for run, each in zip(log.runs, volts, strict=True))
    return replace(log, runs=tuple(runs))


def on_the_bench(
    mechanism: Mechanism,
    routine: Routine,
    *,
    rng: np.random.Generator,
    period: float,
    wobble: float,
) -> list[Run]:
    """The runs of a session, each with the friction of its own moment.

    The bench has one friction for a session: so each run is taken from a session of its own, of
    the same voltages before it, and what came before differs by that little friction only.
    """
    if wobble == 0.0:
        return list(simulate(mechanism, routine, rng=rng, period=period).runs)
    runs = []
    for place in range(len(routine.tests)):
        share = 1.0 + wobble * float(np.clip(rng.standard_normal(), -2.5, 2.5))
        varied = replace(mechanism, friction=share * mechanism.friction)
        until = replace(routine, kinds=routine.kinds[: place // 2 + 1])
        runs.append(simulate(varied, until, rng=rng, period=period).runs[place])
    return runs


def _everyday(scale: Scale, parts: tuple[Part, ...], rng: np.random.Generator) -> Iterator[Part]:
    """Small effects that any robot has, but for those that are hidden anyway."""
    drawn = {name: float(rng.uniform(*sizes)) for name, sizes in DIRT.items()}
    phase, waves = float(rng.uniform(0.0, 2.0 * math.pi)), float(rng.uniform(8.0, 25.0))
    values = {
        "stribeck": {"extra": drawn["stribeck"], "slow": 0.08 * scale.speed},
        "battery-sag": {"share": drawn["battery-sag"] / (1.0 - drawn["battery-sag"])},
        "delay": {"lag": drawn["delay"]},
        "cogging": {
            "cosine": drawn["cogging"] * math.cos(phase),
            "sine": drawn["cogging"] * math.sin(phase),
            "turns": 2.0 * math.pi * waves / scale.reach,
        },
    }
    there = {part.effect for part in parts}
    return (Part(name, each) for name, each in values.items() if name not in there)


def happened(
    hidden: Hidden, levels: Levels, *, period: float, rng: np.random.Generator, moved: Moves
) -> Hidden:
    """The same, with the moment at which what changes once does so: in a step of the first session.

    It does while that accelerates: inertia is seen in no ramp, and in no step that is over.

    Args:
        hidden: the mechanism and what is hidden in it.
        levels: its voltages.
        period: [s] between samples.
        rng: the source of chance.
        moved: the physics.
    """
    if not any(ENDS in part.parameters for part in hidden.parts):
        return hidden
    lasting = tuple(part for part in hidden.parts if ONCE not in part.parameters)
    still = replace(hidden, parts=lasting)
    pilot = recorded(still, levels, CALM, session=FIRST, period=period, rng=rng, moved=moved)
    return replace(hidden, parts=tuple(_happens(part, pilot, rng) for part in hidden.parts))


def _happens(part: Part, pilot: Log, rng: np.random.Generator) -> Part:
    if ENDS not in part.parameters:
        return part
    step = [run for run in pilot.runs if "dynamic" in run.test][int(rng.integers(2))]
    speed = np.abs(step.velocity)
    onset = float(step.time[int(np.argmax(speed > rng.uniform(*WHILE) * speed.max()))])
    began = float(pilot.runs[0].time[0])
    values = {**part.parameters, ONCE: onset - began}
    end = float(step.time[-1]) + 0.5 - began
    return replace(part, parameters={**values, ENDS: end} if rng.random() < PASSING else values)


def _at(part: Part, runs: Sequence[Run], rng: np.random.Generator) -> dict[str, float]:
    """Its parameters if it happens in the middle of a run's motion."""
    run = runs[int(rng.integers(len(FOUR) * 2))]
    speed = np.abs(run.velocity)
    moving = run.time[speed > 0.1 * speed.max()]
    onset = float(moving[0] + rng.uniform(*MOMENT) * (moving[-1] - moving[0]))
    return {**part.parameters, ONCE: onset - float(runs[0].time[0])}


def _is_changed(part: Part, session: str) -> bool:
    """Whether a session knows of what changes once: what ended with a run is over by the next."""
    return ENDS in part.parameters and (session == FIRST or part.parameters[ENDS] >= LATER)


def _since(part: Part, session: str) -> Part:
    """The same; what is for good is there from the beginning of the next session."""
    if session == FIRST:
        return part
    return replace(part, parameters={**part.parameters, ONCE: 0.0})
