"""Exercise 12, answered by trying: one effect after another, judged by the validation."""

from collections.abc import Iterable
from pathlib import Path

from sim.core.errors import Refusal
from sim.physics.effects import EFFECTS
from sim.plot.effect_search import EffectSearch

SHOWS = {  # the plot with the largest share -> effects that lesson 9 lists for it
    "speed": ("drag", "stribeck", "velocity-scale", "voltage-limit", "deadband", "heating"),
    "time since the voltage jumped": (
        "velocity-filter", "delay", "compliance", "backlash", "current-limit", "wheel-slip",
        "inertia-change",
    ),
    "position": ("cogging", "spring", "gravity-cosine"),
    "battery voltage": ("battery-sag",),
    "direction": ("asymmetric-friction", "asymmetric-back-emf", "constant-load"),
}  # fmt: skip
HELPS = 0.96  # [of the gap before] an effect that narrows it less is not worth a name
NOISE = 1.05  # [noises] of a gap in which nothing is missing any more


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    search = EffectSearch.read(data)
    find_effects(search)
    effects, *lines = (line.partition("  #")[0] for line in search.open().splitlines())
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    for line in lines[-2:]:
        text = text.replace(f'{line.partition(" = ")[0]} = ""', line)
    text = text.replace("effects = []", effects)
    return {
        "answers.toml": text.replace("in quotes\n", "in quotes\n" + "\n".join(lines[:-2]) + "\n")
    }


def find_effects(search: EffectSearch) -> None:
    """Add the effects that narrow the gap of the validation, the best first; then stop.

    Those that can cause the plot with the largest share are tried first, the others only if none of
    them helps.
    """
    while search.gaps["validation"] > NOISE:
        views = search.views.views
        likely = SHOWS[max(views, key=lambda name: views[name].explains)]
        if not (_add_best(search, likely) or _add_best(search, EFFECTS)):
            break
    for effect in search.effects[:-1]:  # one that later effects made needless
        gap, chosen = search.gaps["validation"], search.effects
        try:
            search.take_back(effect)
        except Refusal:  # without it, nothing in the log looks like a later one
            continue
        if search.gaps["validation"] * HELPS > gap:
            search.choose(chosen)


def _add_best(search: EffectSearch, names: Iterable[str]) -> bool:
    """Add the effect that narrows the gap most; False if none narrows it enough."""
    before, gaps = search.gaps["validation"], {}
    for name in names:
        if name not in search.effects:
            try:
                search.add(name)
            except Refusal:  # nothing in the log looks like it
                continue
            gaps[name] = search.gaps["validation"]
            search.take_back()
    best = min(gaps, key=gaps.__getitem__, default="")
    if not best or gaps[best] > HELPS * before:
        return False
    search.add(best)
    return True
