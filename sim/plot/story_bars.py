"""Bar charts of a story: the candidates of a round, and the gap after each round."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from sim.core.errors import BadRequest
from sim.core.units import find_unit
from sim.plot.picture import COLORS, INK, PAPER, REFERENCE, Picture, make_panels
from sim.plot.table import Table, to_text
from sim.reconcile.story import Story, TriedCandidate

BARS = 10  # candidates drawn at most
TAKEN, PASSED, REFUSED = "taken", "also possible", "not admitted"
LOOKS = {TAKEN: (COLORS[0], ""), PASSED: (COLORS[4], ".."), REFUSED: ("#CCCCCC", "///")}


def plot_candidate_bars(story: Story, chapter: int = 0) -> Picture:
    """Bars of the candidates of a round: how much each would explain.

    Args:
        story: result of ``reconcile``.
        chapter: number of the chapter.

    Raises:
        BadRequest: there is no such chapter, or no candidate was tried in it.
    """
    count = len(story.chapters)
    if not -count <= chapter < count:
        raise BadRequest(f"no chapter {chapter}", advice=f"Choose one of 0 to {count - 1}.")
    tried = story.chapters[chapter].tried
    if not tried:
        others = [number for number, one in enumerate(story.chapters) if one.tried]
        advice = "No effect was tried on any model: read the verdict."
        if others:
            advice = f"Choose one of: {', '.join(map(str, others))}."
        raise BadRequest(f"nothing was tried in chapter {chapter}", advice=advice)
    taken = find_next_effect(story, chapter)
    drawn = tried[:BARS]
    figure, ((axes,),) = make_panels(1, 1, height=0.9 + 0.3 * len(drawn))
    _bars(axes, drawn, taken)
    axes.set_yticks(range(len(drawn)), [one.effect for one in drawn])
    axes.set_ylim(len(drawn) - 0.4, -0.6)
    axes.set_xlabel("how much likelier the model becomes with it [of −2 log L]", color=INK)
    axes.grid(visible=False, axis="y")
    axes.set_axisbelow(True)
    axes.legend(fontsize=8, labelcolor=INK, loc="lower right")
    listed = ". ".join(
        f"{one.effect} {_format_score(one.improvement)}, {_describe_status(one, taken)}"
        for one in drawn
    )
    alt = f"Bars show what each suspect explains, the likeliest first: {listed}."
    return Picture(figure, alt, make_candidate_table(story, chapter))


def _bars(axes: Axes, drawn: Sequence[TriedCandidate], taken: str) -> None:
    """Draw a bar for each candidate, as long as its improvement."""
    most = max((max(one.improvement, 0.0) for one in drawn), default=0.0) or 1.0
    seen: set[str] = set()
    for place, one in enumerate(drawn):
        kind = describe_candidate_status(one, taken)
        color, hatch = LOOKS[kind]
        axes.barh(
            place, max(one.improvement, 0.0), color=color, hatch=hatch, edgecolor=INK,
            linewidth=0.6, height=0.7, label=kind if kind not in seen else None,
        )  # fmt: skip
        seen.add(kind)
        _write_at_bar(axes, max(one.improvement, 0.0), place, _format_score(one.improvement))
    axes.set_xlim(0.0, 1.15 * most)


def make_candidate_table(story: Story, chapter: int) -> Table:
    """A table of all candidates of a round."""
    taken = find_next_effect(story, chapter)
    rows = tuple(
        (
            one.effect,
            _format_score(one.improvement),
            _format_gap_value(one.gap_ratio),
            _describe_status(one, taken),
        )
        for one in story.chapters[chapter].tried
    )
    header = ("suspect", "likelier by", "gap becomes, times", "and so")
    return Table(header, rows)


def find_next_effect(story: Story, chapter: int) -> str:
    """The effect that was added after a round of the story; empty if none was."""
    chapter %= len(story.chapters)
    return story.chapters[chapter + 1].added if chapter + 1 < len(story.chapters) else ""


def describe_candidate_status(one: TriedCandidate, taken: str) -> str:
    """Whether a candidate was added, was admissible, or was rejected."""
    if one.effect == taken:
        return TAKEN
    return PASSED if one.admitted else REFUSED


def _describe_status(one: TriedCandidate, taken: str) -> str:
    kind = describe_candidate_status(one, taken)
    return f"{kind}: {one.why}" if kind == REFUSED and one.why else kind


def _format_score(score: float) -> str:
    """The score rounded to an integer, as text."""
    return f"{round(score)}".replace("-", "−") if np.isfinite(score) else "not known"


def plot_gap_by_round(story: Story) -> Picture:
    """The gap on the shown log after each round, in multiples of the noise."""
    names = ["base model", *(f"+ {one.added}" for one in story.chapters[1:])]
    floor = story.noise_floor if story.noise_floor > 0.0 else 1.0
    gaps = [one.gap / floor for one in story.chapters]
    figure, ((axes,),) = make_panels(1, 1, height=1.1 + 0.42 * len(gaps))
    _draw_gaps(axes, gaps)
    axes.axvline(1.0, color=REFERENCE, linestyle="--", linewidth=1.2)
    axes.annotate(
        "the noise of the velocity", (1.0, -0.55), xytext=(4, 0),
        textcoords="offset points", fontsize=8, color=INK, va="center",
    )  # fmt: skip
    axes.set_yticks(range(len(gaps)), names)
    axes.set_ylim(len(gaps) - 0.5, -0.85)
    axes.set_xlabel("gap: RMS velocity error of the simulation [times the noise]", color=INK)
    axes.grid(visible=False, axis="y")
    axes.set_axisbelow(True)
    symbol = find_unit(story.shown.units).symbol
    rows = tuple(
        (name, _format_gap_value(one.gap), _format_gap_value(gap))
        for name, one, gap in zip(names, story.chapters, gaps, strict=True)
    )
    listed = ", ".join(f"{name} {times}" for name, _, times in rows)
    return Picture(
        figure,
        f"Bars show how many times the noise the simulation is off: {listed}. A dashed line at 1 "
        "marks the noise.",
        Table(("model", f"gap [{symbol}/s]", "times the noise"), rows),
    )


def _draw_gaps(axes: Axes, gaps: Sequence[float]) -> None:
    """Draw a bar for each gap; that of the base model is hatched, infinite ones are longest."""
    longest = max([gap for gap in gaps if np.isfinite(gap)] or [1.0])
    for place, gap in enumerate(gaps):
        length = gap if np.isfinite(gap) else 1.3 * longest
        axes.barh(
            place, length, color=COLORS[0] if place else COLORS[1], height=0.6,
            hatch="" if place else "///", edgecolor=PAPER,
        )  # fmt: skip
        _write_at_bar(axes, length, place, _format_gap_value(gap))
    away = not np.isfinite(gaps).all()
    axes.set_xlim(0.0, max((1.6 if away else 1.15) * longest, 1.8))


def _format_gap_value(value: float) -> str:
    if math.isnan(value):
        return "not computed"
    return to_text(value) if math.isfinite(value) else "ran away"


def _write_at_bar(axes: Axes, x: float, y: float, text: str) -> None:
    axes.annotate(
        text, (x, y), xytext=(4, 0), textcoords="offset points", va="center", fontsize=8, color=INK
    )
