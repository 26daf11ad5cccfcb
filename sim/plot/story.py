"""A reconcile story in pictures and a table."""

from sim.core.units import find_unit
from sim.plot.story_gap import plot_residual_maps
from sim.plot.table import Table
from sim.reconcile.story import Story
from sim.reconcile.story_text import describe_size, format_gap, format_parameter

__all__ = ["make_findings_table", "plot_residual_maps"]


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
