"""Where a log is damaged: hatched boxes around the curve, a letter for each fault, and words."""

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
GROUND = "#F9EEF5"  # the same, pale: what is drawn over it stays legible
ROOM = 0.14  # [share of a panel's height] added above and below, so that a letter has its place
AROUND = 0.06  # [share of a panel's height] from the curve to the edge of its box
NARROWEST = 0.012  # [share of a panel's width] a box is at least this wide: it must be seen
CLOSE = 0.05  # [share of a panel's width] letters nearer than this would cover each other
NAMED = 6  # stretches of one fault that are told one by one; of more, the number

Damaged: TypeAlias = Damage | LogInterval
Signals: TypeAlias = Mapping[int, Sequence[tuple[Axes, Array]]]


@dataclass(frozen=True)
class FaultMark:
    """A damaged part of a log, as it is drawn.

    Args:
        fault: its name, or what else to call it.
        letter: what stands beside it; the same for all parts with this fault.
        hatch: as matplotlib writes it.
        where: the damaged part.
    """

    fault: str
    letter: str
    hatch: str
    where: LogInterval


@dataclass(frozen=True)
class _Box:
    """A box around a stretch of a curve, in the panel's coordinates."""

    left: float
    right: float
    bottom: float
    top: float


def assign_fault_marks(log: Log, damages: Iterable[Damaged]) -> tuple[FaultMark, ...]:
    """Give each fault its letter and its hatch.

    Raises:
        BadRequest: a damage lies outside the log, so it must be of another one.
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
    """Draw the damaged stretches around the curves of their runs.

    Args:
        log: the log.
        damage: what is wrong with it.
        drawn: run -> the panels it is drawn in, each with its signal, (n,), over the time since the
            run began.
    """
    if not damage:
        return
    limits = {axes: axes.get_ylim() for pairs in drawn.values() for axes, _ in pairs}
    for axes, (bottom, top) in limits.items():  # panels may share them, so all are asked first
        room = ROOM * (top - bottom)
        axes.set_ylim(bottom - room, top + room)
        axes.set_xlim(axes.get_xlim())  # boxes never widen what is shown
    for index, pairs in drawn.items():
        here = [mark for mark in damage if mark.where.run == index]
        for axes, signal in pairs:
            boxes = [_box(axes, log.runs[index], signal, mark.where) for mark in here]
            for mark, box in zip(here, boxes, strict=True):
                _draw(axes, box, mark.hatch, index=DIRECTIONS.index(log.runs[index].direction))
            _letters(axes, here, boxes)


def make_legend_entries(damage: Sequence[FaultMark]) -> list[Patch]:
    """One entry of the legend for each fault."""
    first = {mark.fault: mark for mark in reversed(damage)}
    return [
        Patch(
            facecolor=GROUND,
            edgecolor=COLOR,
            hatch=first[fault].hatch,
            label=f"{first[fault].letter}: {fault}{_apart(first[fault].where)}",
        )
        for fault in dict.fromkeys(mark.fault for mark in damage)
    ]


def describe_faults(log: Log, damage: Sequence[FaultMark], *, drawn: Iterable[int]) -> str:
    """Which fault is where, in sentences; empty if there is none."""
    there, said = set(drawn), ""
    for fault in dict.fromkeys(mark.fault for mark in damage):
        parts = [mark for mark in damage if mark.fault == fault]
        told = [_place(log, mark.where, there) for mark in parts[:NAMED]]
        if len(parts) > NAMED:
            told.append(f"The fault is in {len(parts) - NAMED} more parts.")
        said += f" Hatching and the letter {parts[0].letter} mark the fault “{fault}”. "
        said += " ".join(told)
    return said


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
    """Around the curve from the sample before the damage to the one after it: a gap has both."""
    first = max(int(np.searchsorted(run.time, where.start, side="right")) - 1, 0)
    last = min(int(np.searchsorted(run.time, where.end)), len(run) - 1)
    part = signal[first : last + 1]
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    start, end = where.start - run.time[0], where.end - run.time[0]
    wider = max(NARROWEST * (right - left) - (end - start), 0.0) / 2.0
    around = AROUND * (top - bottom)
    return _Box(start - wider, end + wider, part.min() - around, part.max() + around)


def _draw(axes: Axes, box: _Box, hatch: str, *, index: int) -> None:
    """A hatched ground, and a frame in the color and the dashes of the curve it belongs to."""
    corner, width, height = (box.left, box.bottom), box.right - box.left, box.top - box.bottom
    below = 1.5  # the curves are drawn over it
    ground = {"edgecolor": COLOR, "facecolor": GROUND, "hatch": hatch, "linewidth": 0.0}
    frame = {"edgecolor": COLORS[index], "linestyle": LINES[index], "linewidth": 1.2, "fill": False}
    for style in (ground, frame):
        axes.add_patch(Rectangle(corner, width, height, zorder=below, **style))


def _letters(axes: Axes, here: Sequence[FaultMark], boxes: Sequence[_Box]) -> None:
    """Write the letters outside the curve; those that would cover each other side by side."""
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


def _apart(where: LogInterval) -> str:
    """What the legend adds about damage that no box can show."""
    if where.run is not None:
        return ""
    return f" ({where.test})" if where.test else " (the whole log)"


def _place(log: Log, where: LogInterval, drawn: set[int]) -> str:
    """A damaged part in words, in the time of its run, which the picture shows."""
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
    said = f"{name} is damaged from "
    said += "its start to its end." if whole else f"{max(start, 0.0):.2f} to {end:.2f} s."
    return said if where.run in drawn else f"{said} The picture does not show this run."
