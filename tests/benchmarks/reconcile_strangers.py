"""Physics that is in no catalogue: what a solver must flag instead of giving it a known name.

Each is written as an effect is, and admitted to the engine of the one process that makes cases; the
solver runs in another, which never hears of them.
"""

import math
from collections.abc import Callable, Iterator, Mapping

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.effects import EFFECTS
from sim.physics.voltage_residual import VoltageResidual

SIX = 6.0  # [V] of an ordinary dynamic test: how fast a place is passed
CENTER = 0.5  # [share of the reach] where a bump lies if nobody says


def bump(x: float, height: float, place: float, width: float) -> float:
    """[V] a swelling at one place: a seam of the carpet, a bent rail."""
    return height * math.exp(-(((x - place) / width) ** 2))


def ordinary_bump(scale: Scale, size: float) -> Mapping[str, float]:
    """More than half a volt over a twentieth of the way."""
    return {
        "height": 0.6 * size,
        "place": CENTER * scale.reach,
        "width": 0.05 * scale.reach,
    }


def bump_pace(values: Mapping[str, float], gains: Mapping[str, float]) -> float:
    """[s] in which it is passed."""
    return values["width"] * gains["kV"] / SIX


def band(v: float, volts: float, at: float, width: float) -> float:
    """[V] against the motion in one band of speed: a belt that hums."""
    if v == 0.0:
        return 0.0
    return math.copysign(volts * math.exp(-(((abs(v) - at) / width) ** 2)), v)


def ordinary_band(scale: Scale, size: float) -> Mapping[str, float]:
    """Half a volt around half of the step's speed."""
    return {"volts": 0.5 * size, "at": 0.5 * scale.speed, "width": 0.12 * scale.speed}


def clock(memory: float, dt: float) -> float:
    """[s] since the log began: what it remembers is how late it is."""
    return memory + dt


def swing(u: float, memory: float, volts: float, rate: float) -> float:
    """[V] with what another motor shakes it by, whatever this one does."""
    return u + volts * math.sin(rate * memory)


def ordinary_swing(_: Scale, size: float) -> Mapping[str, float]:
    """A third of a volt, somewhat more than once a second."""
    return {"volts": 0.35 * size, "rate": 2.0 * math.pi * 1.3}


def swing_pace(values: Mapping[str, float], _: Mapping[str, float]) -> float:
    """[s] of a swing, over 2π."""
    return 1.0 / values["rate"]


def push(u: float, memory: float, volts: float, onset: float, lasts: float) -> float:
    """[V] for a moment, once: somebody bumps into it."""
    return u + volts if onset <= memory < onset + lasts else u


def ordinary_push(_: Scale, size: float) -> Mapping[str, float]:
    """A volt and a half for a sixth of a second."""
    return {"volts": 1.5 * size, "onset": 1.0, "lasts": 0.15}


def push_pace(values: Mapping[str, float], _: Mapping[str, float]) -> float:
    """[s] it lasts, over four."""
    return 0.25 * values["lasts"]


def dip(u: float, memory: float, depth: float, every: float, lasts: float) -> float:
    """[V] that is left while something else starts up on the same battery, at a rhythm."""
    return u * (1.0 - depth) if memory % every < lasts else u


def ordinary_dip(_: Scale, size: float) -> Mapping[str, float]:
    """A third for an eighth of a second, less than once a second."""
    return {"depth": min(0.35 * size, 0.6), "every": 1.3, "lasts": 0.12}


def dip_pace(values: Mapping[str, float], _: Mapping[str, float]) -> float:
    """[s] it lasts, over four."""
    return 0.25 * values["lasts"]


def clings(u: float, memory: float, volts: float) -> float:
    """[V] that are left of the voltage while what clings is drawn along."""
    return u - volts * memory


def drawn(memory: float, dt: float, v: float, way: float) -> float:
    """[1] how far it is drawn, -1 to 1: after a turn it takes a while to come round (Dahl 1968)."""
    if v == 0.0:
        return memory
    toward = math.copysign(1.0, v)
    return toward + (memory - toward) * math.exp(-abs(v) * dt / way)


def ordinary_cling(scale: Scale, size: float) -> Mapping[str, float]:
    """Half a volt that is drawn along within a tenth of the reach."""
    return {"volts": 0.5 * size, "way": 0.1 * scale.reach}


def shaken(u: float, memory: float, volts: float) -> float:
    """[V] with what a floor and a gear shake it by: of that size, and another in each step."""
    return u + volts * math.sqrt(12.0) * (memory - 0.5)


def thrown(memory: float, seed: float) -> float:
    """[1] from 0 to 1, the next of a sequence that nobody foretells."""
    return (9821.0 * (memory + seed) + 0.211327) % 1.0


def ordinary_shakes(_: Scale, size: float) -> Mapping[str, float]:
    """A seventh of a volt in each step of the engine."""
    return {"volts": 0.14 * size, "seed": 0.5}


def no_starts(_: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Nobody looks for it."""
    return iter(())


def _stranger(
    name: str,
    numbers: Mapping[str, float],
    acts: Mapping[str, Callable[..., float]],
    example: Callable[[Scale, float], Mapping[str, float]],
    *,
    pace: Callable[[Mapping[str, float], Mapping[str, float]], float] = lambda *_: math.inf,
    cannot: Callable[[Scale], str] = lambda _: "",
) -> Effect:
    """An effect with no more than a making needs; ``numbers`` are names with their neutral values.

    On the path from command to motor it stands behind every known effect.
    """
    return Effect(
        name=name,
        kind="path" if "transform_voltage" in acts else "term",
        summary="outside of the catalogue",
        formula="",
        parameters=tuple(
            Parameter(each, "", "1", least=-1e6, most=1e6, neutral=neutral)
            for each, neutral in numbers.items()
        ),
        fingerprint="",
        inspect="",
        apart={},
        example=example,
        start_values=no_starts,
        hooks=acts,
        shortest_time=pace,
        order=99 if "transform_voltage" in acts else 0,
        reason_against=cannot,
    )


def _only_with_places(scale: Scale) -> str:
    """What turns without end passes a place once in a log."""
    return "" if scale.bounded else "it comes to no place twice"


STRANGERS: Mapping[str, Effect] = {
    one.name: one
    for one in (
        _stranger(
            "bump", {"height": 0.0, "place": 0.0, "width": 1.0}, {"force": bump},
            ordinary_bump, pace=bump_pace, cannot=_only_with_places,
        ),
        _stranger("band", {"volts": 0.0, "at": 1.0, "width": 1.0}, {"force": band}, ordinary_band),
        _stranger(
            "swing", {"volts": 0.0, "rate": 1.0},
            {"transform_voltage": swing, "update_memory": clock}, ordinary_swing, pace=swing_pace,
        ),
        _stranger(
            "push", {"volts": 0.0, "onset": 0.0, "lasts": 1.0},
            {"transform_voltage": push, "update_memory": clock}, ordinary_push, pace=push_pace,
        ),
        _stranger(
            "dip", {"depth": 0.0, "every": 1.0, "lasts": 0.1},
            {"transform_voltage": dip, "update_memory": clock}, ordinary_dip, pace=dip_pace,
        ),
        _stranger(
            "cling", {"volts": 0.0, "way": 1.0},
            {"transform_voltage": clings, "update_memory": drawn}, ordinary_cling,
        ),
    )
}  # fmt: skip
"""Name -> what it is; no name is one of the catalogue."""


SHAKES = _stranger(
    "shakes",
    {"volts": 0.0, "seed": 0.0},
    {"transform_voltage": shaken, "update_memory": thrown},
    ordinary_shakes,
)
"""What is in every case and nobody has to flag: it is another in every run."""

ADMITTED: Mapping[str, Effect] = {**STRANGERS, SHAKES.name: SHAKES}


def admit() -> None:
    """Let this process's engine know them; before the engine is imported, which counts them."""
    EFFECTS.update(ADMITTED)
