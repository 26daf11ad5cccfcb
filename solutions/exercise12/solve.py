"""Exercise 12, answered by trying: one effect after another, judged by the validation."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from grader.course import find_course
from grader.exercise import find_exercise
from sim.core.units import find_unit
from sim.io import read

if TYPE_CHECKING:
    from sim.core.log import Log
    from sim.physics.model import Model

SUSPECTS = (
    "velocity-filter",
    "delay",
    "drag",
    "stribeck",
    "cogging",
    "asymmetric-back-emf",
    "asymmetric-friction",
)
NARROW = 1.05  # [noises] of a gap in which nothing is missing any more
HELPS = 0.96  # [of the gap before] an effect that narrows it less is not worth a name


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    room = find_exercise("exercise12", find_course(Path(__file__).resolve().parent)).module
    logs = {name: read(data / f"{name}.wpilog") for name in ("log", "validation", "held-out")}
    base = room.with_gains(logs["log"], ())
    model = _found(room, logs["log"], logs["validation"])
    before, after = (
        room.gap(one, logs["held-out"]) / room.noise(logs["held-out"]) for one in (base, model)
    )
    per = find_unit(logs["log"].units)
    lines = "".join(
        f"{part.effect}.{name} = {one['value']:.6g}\n"
        for part in model.parts
        for name, one in part.to_json(per).items()
    )
    listed = ", ".join(f'"{part.effect}"' for part in model.parts)
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    text = text.replace("effects = []", f"effects = [{listed}]")
    text = text.replace("in quotes\n", f"in quotes\n{lines}")
    text = text.replace('gap_before = ""', f"gap_before = {before:.3g}")
    return {"answers.toml": text.replace('gap_after = ""', f"gap_after = {after:.3g}")}


def _found(room: Any, log: "Log", validation: "Log") -> "Model":  # noqa: ANN401 - loaded by path
    """A model with the effects that narrow the gap of the validation, the best first."""
    model = room.with_gains(log, ())
    gap = room.gap(model, validation)
    while gap > NARROW * room.noise(validation):
        for start in (model, None):  # quick first; where nothing helps, all from the beginning
            best = min(_tried(room, log, model, start), key=lambda one: room.gap(one, validation))
            if room.gap(best, validation) <= HELPS * gap:
                break
        else:
            break
        model, gap = best, room.gap(best, validation)
    return _needed(room, log, validation, model)


def _needed(room: Any, log: "Log", validation: "Log", model: "Model") -> "Model":  # noqa: ANN401 - as above
    """The model without effects that later ones made needless."""
    for name in [part.effect for part in model.parts]:
        rest = [part.effect for part in model.parts if part.effect != name]
        if not rest:
            break
        without = room.with_effects(log, rest, like=model)
        if HELPS * room.gap(without, validation) <= room.gap(model, validation):
            model = without
    return model


def _tried(room: Any, log: "Log", model: "Model", start: "Model | None") -> "list[Model]":  # noqa: ANN401 - as above
    """The model with one more suspect, each in its turn."""
    has = [part.effect for part in model.parts]
    return [
        room.with_effects(log, [*has, name], like=start) for name in SUSPECTS if name not in has
    ]
