"""Step responses of feedback gains: the suggested ones, and the user's own."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure, SubFigure

from sim.core.errors import BadRequest
from sim.core.units import Unit
from sim.fit.feedback_trial import FeedbackTrial, format_gain_pair
from sim.plot.decimate import decimate_curve
from sim.plot.measured_vs_simulated import add_shared_legend, make_plain_axes
from sim.plot.picture import COLORS, INK, LINES, MARKERS, PAPER, REFERENCE, Picture
from sim.plot.table import Table, to_text

WIDTH, HEIGHT = 7.6, 4.2  # [in]
MOST = 500  # points of a curve drawn at most
MARK = 0.13  # [share of a panel] distance of markers
WIDER = 1.6  # [steps] upper limit of the axis: an unstable response leaves the picture


def plot_step_responses(tried: Sequence[FeedbackTrial], *, per: Unit) -> Picture:
    """The step response of each loop, with its voltage.

    Args:
        tried: the trials of one loop or of both, at least one.
        per: the unit of position of the trials.

    Raises:
        BadRequest: there are no trials.
    """
    if not tried:
        raise BadRequest("no feedback gains to draw", advice="Fit a log whose gains are positive.")
    loops = group_by_loop(tried)
    figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained", facecolor=PAPER)
    for part, mine in zip(figure.subfigures(1, len(loops), squeeze=False).flat, loops, strict=True):
        draw_loop(part, mine, per=per)
    return Picture(figure, describe_trials(tried, per=per), _numbers(tried, per))


def group_by_loop(tried: Sequence[FeedbackTrial]) -> list[list[FeedbackTrial]]:
    """The trials grouped by loop."""
    loops = dict.fromkeys(trial.loop for trial in tried)
    return [[trial for trial in tried if trial.loop == loop] for loop in loops]


def draw_loop(figure: SubFigure, tried: Sequence[FeedbackTrial], *, per: Unit) -> None:
    """Draw the step responses of one loop: the controlled signal above, the voltage below.

    Args:
        figure: an empty figure.
        tried: the trials of one loop.
        per: the unit of position of the trials.
    """
    target, end = tried[0].response.target, max(map(_time_to_show, tried))
    upper, lower = figure.subplots(2, 1, sharex=True)
    make_plain_axes((upper, lower))
    for index, trial in enumerate(tried):
        time = np.array(trial.response.time)
        for axes, values in ((upper, trial.response.value), (lower, trial.response.voltage)):
            there = np.array(values)[time <= end]
            kept = decimate_curve(there, most=MOST)
            axes.plot(
                time[kept], there[kept], color=COLORS[index], linestyle=LINES[index],
                marker=MARKERS[index], markersize=4, markevery=MARK, linewidth=1.4,
                label=trial.owner,
            )  # fmt: skip
    upper.axhline(target, color=REFERENCE, linestyle=":", linewidth=1.2, label="target")
    low, high = upper.get_ylim()
    upper.set_ylim(max(low, (1.0 - WIDER) * target), min(high, WIDER * target))
    loop = tried[0].loop
    upper.set_title(f"{loop} loop", fontsize=10, color=INK)
    upper.set_ylabel(f"{loop} [{_unit(loop, per)}]", color=INK, fontsize=9)
    lower.set_ylabel("voltage [V]", color=INK, fontsize=9)
    lower.set_xlabel("time since the target jumped [s]", color=INK, fontsize=9)
    add_shared_legend(figure, (upper,))


def _time_to_show(trial: FeedbackTrial) -> float:
    """Time to show [s]: twice the time to settle or to leave the picture."""
    response, settled = trial.response, trial.verdict.settled
    reach = (WIDER - 0.5) * abs(response.target)
    pairs = zip(response.time, response.value, strict=True)
    left = next((t for t, y in pairs if abs(y - 0.5 * response.target) > reach), None)
    until = settled if settled is not None else left
    return response.time[-1] if until is None else min(response.time[-1], max(2.0 * until, 0.2))


def describe_trials(tried: Sequence[FeedbackTrial], *, per: Unit) -> str:
    """A sentence about each step response in the picture."""
    return " ".join(
        f"{trial.owner.capitalize()} gains of the {trial.loop} loop are "
        f"{format_gain_pair(trial.gains)}. When the target jumps by "
        f"{to_text(trial.response.target)} {_unit(trial.loop, per)}, "
        f"the loop {trial.verdict.description}."
        for trial in tried
    )


def _numbers(tried: Sequence[FeedbackTrial], per: Unit) -> Table:
    rows = tuple(
        (
            f"{trial.loop}, {trial.owner}",
            f"{to_text(trial.response.target)} {_unit(trial.loop, per)}",
            _seconds(trial.verdict.reached),
            f"{trial.verdict.overshoot:.0%}",
            _seconds(trial.verdict.settled),
            f"{max(map(abs, trial.response.voltage)):.1f}",
        )
        for trial in tried
    )
    header = (
        "loop",
        "step",
        "90% of the target [s]",
        "past the target",
        "settled [s]",
        "most volts [V]",
    )
    return Table(header, rows)


def _seconds(value: float | None) -> str:
    return "never" if value is None else f"{value:.3f}"


def _unit(loop: str, per: Unit) -> str:
    return f"{per.symbol}/s" if loop == "velocity" else per.symbol
