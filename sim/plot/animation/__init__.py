"""An animated mechanism and plots of its motion, with a common time cursor.

    animate_mechanism("drivetrain", Scene(time, (Motion("robot", velocity=v),)), ...)

The result is HTML with a script inside. It works in JupyterLab and in a page without a server, and
needs no network. If a motion has gains, the page simulates it (``sim/physics/engine/simulate.js``),
so that a slider has an effect at once.

animation.js   clock and plots over time
stages.js      drawings of the mechanisms
charts.js      menus, sliders, axes, and the charts of ``charts.py``
ticks.js       round numbers on an axis
animation.css  styles, for light and dark pages
"""

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from sim.core.errors import BadRequest, refuse_unknown
from sim.core.log import Array
from sim.physics import engine
from sim.plot.animation.scene import (
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Rule,
    Scene,
    Score,
    TestPlan,
)
from sim.plot.picture import COLORS, COLORS_ON_DARK, LINES

__all__ = [
    "Animation",
    "Choice",
    "Gain",
    "Knob",
    "Motion",
    "Panel",
    "Rule",
    "Scene",
    "Score",
    "TestPlan",
    "animate_mechanism",
    "read_script",
]

FOLDER = Path(__file__).parent
KINDS = ("drivetrain", "elevator", "arm", "flywheel", "swerve")
DIGITS = 5  # significant digits of what is drawn
DASHES = {"-": "", "--": "7 4", "-.": "8 3 2 3", ":": "2 3"}  # matplotlib's line styles in SVG


@dataclass(frozen=True)
class Animation:
    """An animated figure.

    Args:
        data: the scenes and plots for the script, as plain data.
        alt: a description of the figure in a few sentences with numbers.
    """

    data: Mapping[str, Any]
    alt: str

    @property
    def html(self) -> str:
        """Figure, description, style and script as self-contained HTML."""
        data = json.dumps(self.data, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
        data = data.replace("</", "<\\/")  # a name in the data must not end the script
        style = _write_palette() + (FOLDER / "animation.css").read_text(encoding="utf-8")
        return (
            f"<style>{style}</style>"
            f'<figure class="motion" data-motion data-lm-suppress-shortcuts="true" role="group" '
            f'aria-label="{escape(self.alt)}">'
            '<p class="motion-still">Run this cell, and the mechanism moves here.</p>'
            f'<script type="application/json">{data}</script></figure>'
            f"<details><summary>This figure in words</summary><p>{escape(self.alt)}</p></details>"
            f'<script type="module">{read_script()}</script>'
        )

    def __str__(self) -> str:
        """The description, for a terminal."""
        return self.alt

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html}


def _get_color_name(at: int) -> str:
    """The name of the CSS variable of a color of the palette."""
    return f"--motion-color-{at}"


def _write_palette() -> str:
    """The colors as CSS variables, by JupyterLab's theme or by the page's color scheme."""

    def rule(selector: str, colors: Iterable[str]) -> str:
        named = (f"{_get_color_name(at)}:{color}" for at, color in enumerate(colors))
        return f"{selector}{{{';'.join(named)}}}"

    either = (
        f"light-dark({light},{dark})" for light, dark in zip(COLORS, COLORS_ON_DARK, strict=True)
    )
    return (
        rule(".motion", COLORS)
        + f"@supports(color:light-dark(red,red)){{{rule('.motion', either)}}}"
        + rule('body[data-jp-theme-light="true"] .motion', COLORS)
        + rule('body[data-jp-theme-light="false"] .motion', COLORS_ON_DARK)
    )


@cache
def read_script() -> str:
    """The script of every animation: its files as one JavaScript module."""
    files = (
        Path(engine.__file__).with_name("simulate.js"),
        FOLDER / "ticks.js",
        FOLDER / "stages.js",
        FOLDER / "charts.js",
        FOLDER / "animation.js",
    )
    rows = [row for file in files for row in file.read_text(encoding="utf-8").splitlines()]
    return "\n".join(row for row in rows if not row.startswith("import "))


def animate_mechanism(
    kind: str,
    scenes: Scene | Mapping[tuple[str, ...], Scene],
    *,
    panels: Sequence[Panel],
    alt: str,
    choices: Sequence[Choice] = (),
    knobs: Sequence[Knob] = (),
    score: Score | None = None,
    rules: Sequence[Rule] = (),
    span: tuple[float, float] | None = None,
    wall: float | Gain | None = None,
    marks: Mapping[str, float | Gain] | None = None,
    slow: float = 1.0,
) -> Animation:
    """An animated mechanism and plots of its motion, with a common time cursor.

    Args:
        kind: ``drivetrain``, ``elevator``, ``arm``, ``flywheel`` or ``swerve``.
        scenes: the scene, or with choices one scene for each combination of options.
        panels: the plots, from top to bottom; limits that are not given fit the scenes.
        alt: a description of the figure with numbers.
        choices: menus that select the scene.
        knobs: sliders that set gains of the motions that the page simulates.
        score: the motion that is compared with the target.
        rules: conditions on a test plan; the page shows which are met.
        span: lowest and highest position drawn [m or rad]; by default, those of the scenes.
        wall: position of the wall of a drivetrain's floor [m].
        marks: name -> position of a line across that floor [m].
        slow: turns drawn for each turn of a flywheel, which is too fast for the eye.

    Raises:
        BadRequest: no such mechanism, a combination of options without a scene, or a signal that
            does not have one value for each time of its scene.
    """
    refuse_unknown("drawing", kind, KINDS)
    every = _key_by_options(scenes, choices)
    low, high = span or (None, None)
    stage = {
        "low": low,
        "high": high,
        "wall": _describe_value(wall),
        "marks": [{"label": n, "at": _describe_value(at)} for n, at in (marks or {}).items()],
        "slow": slow,
        "kind": kind,
        "unit": "rad" if kind in {"arm", "flywheel"} else "m",
        "words": f"{kind}, drawn at the time of the cursor",
    }
    data = {
        "stage": stage,
        "colors": list_colors(),
        "choices": describe_choices(choices),
        "knobs": [vars(knob) for knob in knobs],
        "score": None if score is None else vars(score),
        "rules": [vars(rule) | {"at_most": _describe_value(rule.at_most)} for rule in rules],
        "panels": [vars(panel) for panel in panels],
        "scenes": {"|".join(key): _describe_scene(scene) for key, scene in every.items()},
    }
    return Animation(data, alt)


def list_colors() -> list[str]:
    """The colors of the palette, as the page writes them."""
    return [f"var({_get_color_name(at)})" for at in range(len(COLORS))]


def describe_choices(choices: Sequence[Choice]) -> list[dict[str, object]]:
    """The menus as plain data for the script."""
    return [vars(one) | {"value": one.value or one.options[0]} for one in choices]


def _key_by_options(
    scenes: Scene | Mapping[tuple[str, ...], Scene], choices: Sequence[Choice]
) -> dict[tuple[str, ...], Scene]:
    """The scenes by their options, after ``_check_scenes``."""
    every: dict[tuple[str, ...], Scene] = (
        {(): scenes} if isinstance(scenes, Scene) else dict(scenes)
    )
    _check_scenes(every, choices)
    return every


def _check_scenes(scenes: Mapping[tuple[str, ...], Scene], choices: Sequence[Choice]) -> None:
    """Refuse options without a scene, and signals without one value for each time."""
    wanted: list[tuple[str, ...]] = [()]
    for choice in choices:
        wanted = [(*key, option) for key in wanted for option in choice.options]
    missing = [key for key in wanted if key not in scenes]
    if missing:
        raise BadRequest(
            f"no scene for {', '.join(missing[0]) or 'a figure without choices'}",
            advice="Give one scene for each combination of options.",
        )
    for scene in scenes.values():
        curves = {"the target": scene.target}
        for motion in scene.motions:
            names = ("position", "velocity", "voltage", "heading")
            curves |= {f"the {name} of {motion.name!r}": getattr(motion, name) for name in names}
        for name, curve in curves.items():
            if curve is not None and not isinstance(curve, Gain) and len(curve) != len(scene.time):
                raise BadRequest(
                    f"{name} has {len(curve)} values for {len(scene.time)} times",
                    advice="Give one value for each time.",
                )


def _describe_scene(scene: Scene) -> dict[str, Any]:
    """A scene as plain data for the script; its motions take colors and dashes in their order."""
    motions: list[dict[str, Any]] = []
    colored = 0
    for motion in scene.motions:
        color = None if motion.asked else colored % len(COLORS)
        line = LINES[colored % len(LINES)]
        colored += not motion.asked
        motions.append(
            {
                "name": motion.name,
                "ghost": motion.ghost or motion.asked,
                "color": color,
                "dash": "3 3" if motion.asked else DASHES.get(str(line), "5 2 1 2"),
                "asked": motion.asked,
                "turns": motion.turns,
                "type": motion.type,
                "start": motion.start,
                "gains": _describe_gains(motion.gains),
                "program": _describe_gains(motion.program),
                "plan": _describe_gains(vars(motion.plan) if motion.plan else None),
                "voltage": _describe_value(motion.voltage)
                if isinstance(motion.voltage, Gain)
                else _list_numbers(motion.voltage),
                "velocity": _list_numbers(motion.velocity),
                "position": None
                if motion.gains is not None
                else _list_numbers(motion.find_position(scene)),
                "heading": _list_numbers(motion.heading),
            }
        )
    return {
        "title": scene.title,
        "time": _list_numbers(scene.time),
        "target": _list_numbers(scene.target),
        "motions": motions,
    }


def _describe_gains(gains: Mapping[str, float | Gain] | None) -> dict[str, Any] | None:
    if gains is None:
        return None
    return {name: _describe_value(gain) for name, gain in gains.items()}


def _describe_value(value: float | Gain | None) -> Any:  # noqa: ANN401 - as JSON has it
    """A number or the data of a ``Gain``; None for None and for infinite numbers."""
    if isinstance(value, Gain):
        return vars(value)
    return None if value is None or not math.isfinite(value) else float(value)


def round_numbers(values: Sequence[float] | Array) -> list[float | None]:
    """(n,) values rounded to ``DIGITS`` significant digits; None for nan."""
    return [
        None if math.isnan(value) else float(f"{value:.{DIGITS}g}")
        for value in np.asarray(values, dtype=float).tolist()
    ]


def _list_numbers(values: Array | None) -> list[float | None] | None:
    return None if values is None else round_numbers(values)
