"""A reconcile story in pictures and a table."""

from dataclasses import replace

from sim.core.units import find_unit
from sim.estimation.measurements import MIN_SAMPLES
from sim.plot.picture import Picture
from sim.plot.table import Table
from sim.plot.voltage_residual import plot_voltage_residual
from sim.reconcile.story import Story
from sim.reconcile.story_text import describe_size, format_gap, format_parameter

__all__ = ["make_findings_table", "plot_remaining_gap"]


def plot_remaining_gap(story: Story) -> list[Picture]:
    """The gap that the base model and the last model leave on the shown log, in five views.

    Raises:
        BadRequest: there is nothing to compare, or a simulation diverged.
    """
    runs = tuple(run for run in story.shown.runs if len(run) >= MIN_SAMPLES)
    log = replace(story.shown, runs=runs)
    base, *more = story.chapters
    titles = {"base model": base}
    if more:
        titles[f"with {', '.join(one.added for one in more)}"] = more[-1]
    return [
        plot_voltage_residual(
            log,
            chapter.model,
            title=title,
            simulated=[track[:, 1] for track in chapter.tracks],
            compared=story.compared,
        )
        for title, chapter in titles.items()
    ]


def make_findings_table(story: Story) -> Table:
    """A table of the findings: name, size, parameters with errors, and change of the gap."""
    rows = []
    for one in story.findings:
        parameters = "; ".join(
            format_parameter(name, estimate) for name, estimate in one.parameters.items()
        )
        gap = f"{format_gap(one.gap_before, story)} to {format_gap(one.gap_after, story)}"
        rivals = f" or {' or '.join(one.ambiguous_with)}" if one.ambiguous_with else ""
        rows.append(
            (
                f"{one.effect}{rivals}",
                describe_size(one),
                parameters or "-",
                "-" if one.kind == "fault" else gap,
            )
        )
    caption = (
        f"Verdict: {story.verdict}. The noise is {story.noise_floor:.3g} "
        f"{find_unit(story.shown.units).symbol}/s."
    )
    header = ("finding", "size", "parameters", "gap [times the noise]")
    return Table(header, tuple(rows) or (("nothing", "-", "-", "-"),), caption)
