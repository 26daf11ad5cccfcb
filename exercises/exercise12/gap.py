"""The gap between a log and a model's simulation of it, and the gains that make it narrowest."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from sim.core.log import Array, Log
    from sim.physics.model import Model, Part

MOVING = 0.02  # [share of the top speed] slower, and without a voltage, there is nothing to compare
COARSE = 0.01  # [s] step while a search looks around
LEAST = {"kS": 0.0, "kV": 1e-9, "kA": 1e-9}
ROBUST, THIRD = 1.4826, math.sqrt(20.0)  # of a median deviation, of a third difference
STARTS = 2  # of each effect
ROUNDS = 60  # steps of one search
TRUST = 1e-5  # [share] a change below it is none
USUAL = {"kS": 0.1}  # [V] its size where a search begins with none
FAR = 1e4  # [noises] a simulation that ran away is this far off, and no farther


def compared(log: "Log") -> "list[Array]":
    """(n,) of every run: whether a sample counts, which no model has a say in."""
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed

    top = max(float(np.max(np.abs(run.velocity))) for run in log.runs)
    return [(np.abs(run.velocity) > MOVING * top) | (run.voltage != 0.0) for run in log.runs]


def errors(model: "Model", log: "Log", *, step: float | None = None) -> "Array":
    """(n,) [m/s or rad/s] measured velocity less the simulated one, wherever a sample counts.

    The simulation is open loop: it gets the voltages of the log, and not one look at the rest.
    """
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed

    from sim.physics.replay import replay_log  # noqa: PLC0415 - the engine takes a moment to load

    tracks = replay_log(model, log, step=step)
    left = [
        (run.velocity - track.seen)[where]
        for run, track, where in zip(log.runs, tracks, compared(log), strict=True)
    ]
    return np.concatenate(left)


def gap(model: "Model", log: "Log") -> float:
    """[m/s or rad/s] root mean square of the errors."""
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed

    return float(np.sqrt(np.mean(errors(model, log) ** 2)))


def noise(log: "Log") -> float:
    """[m/s or rad/s] of the velocity, measured without a model: smooth motion has no jerks."""
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed

    top = max(float(np.max(np.abs(run.velocity))) for run in log.runs)
    jerks = [np.diff(run.velocity, 3)[np.abs(run.velocity[3:]) > MOVING * top] for run in log.runs]
    sizes = np.sort(np.abs(np.concatenate(jerks)))  # np.median would load masked arrays first
    return ROBUST * float(sizes[sizes.size // 2]) / THIRD


def with_gains(log: "Log", parts: "Sequence[Part]") -> "Model":
    """A model with these effects, its kS, kV and kA fitted to a log by simulating it."""
    start = _start(log)

    def model(values: "Array") -> "Model":
        return _model(dict(zip(start, values.tolist(), strict=True)), parts)

    least, most = [*LEAST.values()], [math.inf] * len(LEAST)
    return model(_searched(model, log, [*start.values()], least, most))


def with_effects(log: "Log", names: Sequence[str], *, like: "Model | None" = None) -> "Model":
    """A model with these effects, gains and parameters fitted to a log; one start after another.

    Args:
        log: to fit.
        names: of the effects.
        like: a model to go on from; what it has is started where it is.
    """
    from itertools import product  # noqa: PLC0415 - only where something is searched

    from sim.physics.effects import find_effect  # noqa: PLC0415 - the same
    from sim.physics.model import Part  # noqa: PLC0415 - the same
    from sim.physics.voltage_residual import compute_voltage_residual  # noqa: PLC0415 - the same

    gains = _start(log) if like is None else dict(like.gains)
    there = {part.effect: part.parameters for part in (like.parts if like else ())}
    seen = compute_voltage_residual(log, gains, type="simple")
    begins = [
        [there[name]] if name in there else list(find_effect(name).start_values(seen))[:STARTS]
        for name in names
    ]
    known = [one for name in names for one in find_effect(name).parameters]
    least = [*(LEAST[name] for name in gains), *(one.least for one in known)]
    most = [math.inf] * len(gains) + [one.most for one in known]

    def model(values: "Array") -> "Model":
        left = iter(values.tolist())
        found = {name: next(left) for name in gains}
        parts = [Part(name, {one: next(left) for one in find_effect(name).names}) for name in names]
        return _model(found, parts)

    best, smallest = None, math.inf
    for chosen in product(*begins):
        first = [*gains.values(), *(value for one in chosen for value in one.values())]
        values = _searched(model, log, first, least, most)
        width = gap(model(values), log)
        if width < smallest:
            best, smallest = model(values), width
    if best is None:
        raise ValueError("the log contains no sign of these effects")
    return best


def _left(model: "Callable[[Array], Model]", log: "Log") -> "Callable[[Array], Array]":
    """What a model of some values leaves of a log, in noises."""
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed

    unit = noise(log)

    def left(values: "Array") -> "Array":
        with np.errstate(over="ignore", invalid="ignore"):
            off = errors(model(values), log, step=COARSE) / unit
        return np.clip(np.nan_to_num(off, nan=FAR), -FAR, FAR)

    return left


def _searched(
    model: "Callable[[Array], Model]",
    log: "Log",
    first: Sequence[float],
    least: Sequence[float],
    most: Sequence[float],
) -> "Array":
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed
    from scipy.optimize import least_squares  # noqa: PLC0415 - the same

    begin = np.clip(np.array(first, dtype=float), least, most)
    usual = [USUAL.get(name, 1e-6) for name in LEAST] + [1e-6] * (begin.size - len(LEAST))
    scale = np.maximum(np.abs(begin), usual)

    left = _left(model, log)
    found = least_squares(
        lambda values: left(np.clip(values * scale, least, most)),
        begin / scale,
        bounds=(np.array(least) / scale, np.array(most) / scale + 1e-12),
        diff_step=1e-3,
        xtol=TRUST,
        ftol=TRUST,
        max_nfev=ROUNDS,
    )
    return np.clip(found.x * scale, least, most)


def _start(log: "Log") -> dict[str, float]:
    """kS, kV and kA to begin with: as if nothing were missing."""
    from sim.fit import fit  # noqa: PLC0415 - numpy only where it is needed

    found = fit(log, type="simple", method="sysid").in_units(
        "radians" if log.units == "rotations" else "meters"
    )
    return {name: max(found.gains[name], 10.0 * LEAST[name], 1e-6) for name in LEAST}


def _model(gains: Mapping[str, float], parts: "Sequence[Part]") -> "Model":
    from sim.physics.model import Model  # noqa: PLC0415 - the engine takes a moment to load

    return Model("simple", gains, tuple(parts))
