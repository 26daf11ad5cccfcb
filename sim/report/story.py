"""A reconcile story as one web page.

write_story(story, "arm.html", title="arm.wpilog")
"""

import os
from dataclasses import dataclass

from markupsafe import Markup

from sim.core.errors import BadRequest
from sim.core.units import find_unit
from sim.plot.picture import Picture
from sim.plot.story import (
    make_findings_table,
    plot_candidate_bars,
    plot_gap_by_round,
    plot_overlays,
    plot_residual_maps,
)
from sim.plot.story_bars import make_candidate_table
from sim.plot.table import Table
from sim.reconcile.story import AMBIGUOUS, UNEXPLAINED, Finding, Story
from sim.reconcile.story_text import (
    FAULT,
    MINOR,
    describe_effect,
    describe_parameter,
    describe_size,
    format_estimate,
    format_gap,
    list_inspections,
    list_next_tests,
    list_remarks,
    write_headline,
)
from sim.report.page_file import choose_page_path, load_templates, write_page_file


@dataclass(frozen=True)
class FindingText:
    """The texts of a finding on the page.

    Args:
        name: with its look-alikes.
        summary: what it is, in a few words.
        leads: whether it is more than a minor effect.
        size: ``major`` or ``minor`` and how likely it is, or ``damage to the log``.
        sentence: what it does.
        parameters: name, value, error, unit, what it means.
        gap: from where to where it brings the gap; empty for damage.
        looks: what to look at on the robot, or to do, each with a head.
        separating_test: which test tells it from its look-alikes.
    """

    name: str
    summary: str
    leads: bool
    size: str
    sentence: str
    parameters: tuple[tuple[str, str, str, str, str], ...]
    gap: str
    looks: tuple[tuple[str, str], ...]
    separating_test: str


def write_story(story: Story, path: str | os.PathLike[str], *, title: str) -> None:
    """Write the page, whole or not at all.

    Args:
        story: what was found.
        path: of the page.
        title: where the log came from.

    Raises:
        BadRequest: its name does not end as a page's, or it cannot be written.
    """
    target = choose_page_path(path)
    write_page_file(render_story(story, title=title), target)


def render_story(story: Story, *, title: str) -> str:
    """The page as text; the same story always gives the same.

    Args:
        story: what was found.
        title: where the log came from.
    """
    last = len(story.chapters) - 1
    tried = [number for number, chapter in enumerate(story.chapters) if chapter.tried]
    told = range(1, last + 1) or (0,)  # the base alone has no before
    return (
        load_templates()
        .get_template("story.html.jinja")
        .render(
            title=title,
            story=story,
            per=find_unit(story.shown.units),
            headline=write_headline(story),
            unsure=story.remainder or story.verdict in {AMBIGUOUS, UNEXPLAINED},
            beside=list_remarks(story),
            findings=[_told(one, story) for one in story.findings],
            overview=_html(make_findings_table(story)),
            tests=list_next_tests(story),
            shrinking=_html(plot_gap_by_round(story)),
            places=[(place.sentence, f"{place.sure:.0f}") for place in story.where],
            gaps=_gaps(story),
            rounds=[(_base(story, n), _lineup(story, n)) for n in tried],
            overlays=[(_base(story, n), _html(plot_overlays(story, n))) for n in told],
        )
    )  # fmt: skip


def _gaps(story: Story) -> Markup:
    """The map, or why there is none."""
    try:
        return _html(plot_residual_maps(story))
    except BadRequest as refusal:
        return Markup("<p>{}</p>").format(str(refusal))


def _lineup(story: Story, chapter: int) -> Markup:
    """The suspects of a round; where none explains anything, bars would show nothing."""
    if max(one.improvement for one in story.chapters[chapter].tried) < 1.0:
        return _html(make_candidate_table(story, chapter))
    return _html(plot_candidate_bars(story, chapter))


def _base(story: Story, chapter: int) -> str:
    """What a chapter's model is called."""
    added = [one.added for one in story.chapters[1 : chapter + 1]]
    return " + ".join(["base model", *added])


def _told(one: Finding, story: Story) -> FindingText:
    fault = one.kind == FAULT
    before, after = (format_gap(gap, story) for gap in (one.gap_before, one.gap_after))
    return FindingText(
        " or ".join([one.effect, *one.ambiguous_with]),
        describe_effect(one.effect),
        fault or one.size != MINOR,
        describe_size(one),
        one.sentence,
        tuple(
            (
                name,
                *format_estimate(estimate),
                "" if estimate.unit == "1" else estimate.unit,
                describe_parameter(one.effect, name),
            )
            for name, estimate in one.parameters.items()
        ),
        "" if fault else f"from {before} to {after} times the noise",
        list_inspections(one),
        one.separating_test,
    )


def _html(shown: Picture | Table) -> Markup:
    return Markup(shown.html)  # noqa: S704 - both escape what they say
