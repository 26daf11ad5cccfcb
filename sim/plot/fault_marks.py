"""Marks of damaged parts of a log: hatched boxes around the curve, letters, and sentences."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from string import ascii_uppercase
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Rectangle

from sim.core.errors import BadRequest
from sim.core.log import DIRECTIONS, Array, Log, Run
from sim.inspect.fault import Damage, LogInterval
from sim.plot.picture import COLORS, INK, LINES, PAPER

HATCHES = ("////", "\\\\\\\\", "xxxx", "----", "..", "++++")
COLOR = COLORS[3]
BACKGROUND = "#F9EEF5"  # a pale tone of ``COLOR``: curves drawn over it stay legible
MARGIN = 0.14  # [share of a panel's height] added above and below for the letters
PADDING = 0.06  # [share of a panel's height] between the curve and the edge of its box
NARROWEST = 0.012  # [share of a panel's width] least width of a box, so that it is visible
CLOSE = 0.05  # [share of a panel's width] nearer letters would cover each other
NAMED = 6  # parts of one fault that are described; further ones are counted

Damaged: TypeAlias = Damage | LogInterval
Signals: TypeAlias = Mapping[int, Sequence[tuple[Axes, Array]]]


@dataclass(frozen=True)
class FaultMark:
    """The mark of a damaged part of a log.

    Args:
        fault: name of the fault, or ``damage``.
        letter: its letter, the same for all parts with this fault.
        hatch: matplotlib's hatch pattern.
        where: the damaged part.
    """

    fault: str
    letter: str
    hatch: str
    where: LogInterval


@dataclass(frozen=True)
class _Box:
    """A box around a part of a curve, in data coordinates."""

    left: float
    right: float
    bottom: float
    top: float


def assign_fault_marks(log: Log, damages: Iterable[Damaged]) -> tuple[FaultMark, ...]:
    """Assign a letter and a hatch to each fault.

    Raises:
        BadRequest: a damaged part lies outside the log.
    """
    found = [
        (damage.fault, damage.where) if isinstance(damage, Damage) else ("damage", damage)
        for damage in damages
    ]
    order = {fault: place for place, fault in enumerate(dict.fromkeys(f for f, _ in found))}
    for fault, where in found:
        _check(log, fault, where)
    return tuple(
        FaultMark(
            fault,
            ascii_uppercase[order[fault] % len(ascii_uppercase)],
            HATCHES[order[fault] % len(HATCHES)],
            where,
        )
        for fault, where in found
    )


def draw_fault_marks(log: Log, damage: Sequence[FaultMark], *, drawn: Signals) -> None:
    """Draw boxes and letters around the damaged parts of the curves.

    Args:
        log: the log.
        damage: marks of its damaged parts.
        drawn: run -> its panels, each with its signal (n,) over the time since the run began.
    """
    if not damage:
        return
    limits = {axes: axes.get_ylim() for pairs in drawn.values() for axes, _ in pairs}
    # Panels may share limits, so all are read before any is changed
    for axes, (bottom, top) in limits.items():
        margin = MARGIN * (top - bottom)
        axes.set_ylim(bottom - margin, top + margin)
        axes.set_xlim(axes.get_xlim())  # keep the limits when boxes are added
    for index, pairs in drawn.items():
        here = [mark for mark in damage if mark.where.run == index]
        for axes, signal in pairs:
            boxes = [_box(axes, log.runs[index], signal, mark.where) for mark in here]
            for mark, box in zip(here, boxes, strict=True):
                _draw(axes, box, mark.hatch, index=DIRECTIONS.index(log.runs[index].direction))
            _letters(axes, here, boxes)


def make_legend_entries(damage: Sequence[FaultMark]) -> list[Patch]:
    """A legend entry for each fault."""
    first = {mark.fault: mark for mark in reversed(damage)}
    return [
        Patch(
            facecolor=BACKGROUND,
            edgecolor=COLOR,
            hatch=first[fault].hatch,
            label=f"{first[fault].letter}: {fault}{_name_whole_part(first[fault].where)}",
        )
        for fault in dict.fromkeys(mark.fault for mark in damage)
    ]


def describe_faults(log: Log, damage: Sequence[FaultMark], *, drawn: Iterable[int]) -> str:
    """Sentences about where each fault is; empty if there is none.

    Args:
        log: the log.
        damage: marks of its damaged parts.
        drawn: indices of the runs that the picture shows.
    """
    there, text = set(drawn), ""
    for fault in dict.fromkeys(mark.fault for mark in damage):
        parts = [mark for mark in damage if mark.fault == fault]
        sentences = [_describe_part(log, mark.where, there) for mark in parts[:NAMED]]
        if len(parts) > NAMED:
            sentences.append(f"The fault is in {len(parts) - NAMED} more parts.")
        text += f" Hatching and the letter {parts[0].letter} mark the fault “{fault}”. "
        text += " ".join(sentences)
    return text


def _check(log: Log, fault: str, where: LogInterval) -> None:
    if where.run is None:
        return
    advice = "Give only faults that were found in this log."
    if not 0 <= where.run < len(log.runs):
        raise BadRequest(
            f"{fault} in run {where.run} of a log whose runs are 0 to {len(log.runs) - 1}",
            where=log.source,
            advice=advice,
        )
    time = log.runs[where.run].time
    if not time.size or where.end < time[0] or where.start > time[-1]:
        span = f"{time[0]:.2f} to {time[-1]:.2f} s" if time.size else "no sample"
        raise BadRequest(
            f"{fault} from {where.start:.2f} to {where.end:.2f} s, but {log.runs[where.run].test}, "
            f"run {where.run}, has {span}",
            where=log.source,
            advice=advice,
        )


def _box(axes: Axes, run: Run, signal: Array, where: LogInterval) -> _Box:
    """The box around the curve, from the sample before the damage to the one after it."""
    first = max(int(np.searchsorted(run.time, where.start, side="right")) - 1, 0)
    last = min(int(np.searchsorted(run.time, where.end)), len(run) - 1)
    part = signal[first : last + 1]
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    start, end = where.start - run.time[0], where.end - run.time[0]
    wider = max(NARROWEST * (right - left) - (end - start), 0.0) / 2.0
    padding = PADDING * (top - bottom)
    return _Box(start - wider, end + wider, part.min() - padding, part.max() + padding)


def _draw(axes: Axes, box: _Box, hatch: str, *, index: int) -> None:
    """Draw a hatched box with a frame in the color and line style of its curve."""
    corner, width, height = (box.left, box.bottom), box.right - box.left, box.top - box.bottom
    below = 1.5  # below the curves
    background = {"edgecolor": COLOR, "facecolor": BACKGROUND, "hatch": hatch, "linewidth": 0.0}
    frame = {"edgecolor": COLORS[index], "linestyle": LINES[index], "linewidth": 1.2, "fill": False}
    for style in (background, frame):
        axes.add_patch(Rectangle(corner, width, height, zorder=below, **style))


def _letters(axes: Axes, here: Sequence[FaultMark], boxes: Sequence[_Box]) -> None:
    """Write the letters outside the curve; letters that would overlap share one text."""
    left, right = axes.get_xlim()
    groups: list[list[tuple[_Box, str]]] = []
    for box, mark in sorted(zip(boxes, here, strict=True), key=lambda pair: pair[0].left):
        middle = box.left + box.right
        if groups and middle - (groups[-1][-1][0].left + groups[-1][-1][0].right) < 2 * CLOSE * (
            right - left
        ):
            groups[-1].append((box, mark.letter))
        else:
            groups.append([(box, mark.letter)])
    for group in groups:
        bottom = min(box.bottom for box, _ in group)
        top = max(box.top for box, _ in group)
        above = bottom + top >= 0.0
        starts, ends = min(box.left for box, _ in group), max(box.right for box, _ in group)
        axes.annotate(
            " ".join(sorted({letter for _, letter in group})),
            ((max(starts, left) + min(ends, right)) / 2.0, top if above else bottom),
            xytext=(0, 2 if above else -2),
            textcoords="offset points",
            ha="center",
            va="bottom" if above else "top",
            fontsize=9,
            fontweight="bold",
            color=INK,
            annotation_clip=True,
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.6, "alpha": 0.85},
        )


def _name_whole_part(where: LogInterval) -> str:
    """Suffix of a legend entry for a missing test or a damaged log, which have no box."""
    if where.run is not None:
        return ""
    return f" ({where.test})" if where.test else " (the whole log)"


def _describe_part(log: Log, where: LogInterval, drawn: set[int]) -> str:
    """A sentence about a damaged part, with times since the run began."""
    if where.run is None:
        return (
            f"The test {where.test} is not in the log."
            if where.test
            else "The whole log is damaged."
        )
    run = log.runs[where.run]
    start, end = where.start - run.time[0], where.end - run.time[0]
    whole = where.start <= run.time[0] and where.end >= run.time[-1]
    name = run.test if where.run in drawn else f"Run {where.run}, {run.test},"
    text = f"{name} is damaged from "
    text += "its start to its end." if whole else f"{max(start, 0.0):.2f} to {end:.2f} s."
    return text if where.run in drawn else f"{text} The picture does not show this run."
