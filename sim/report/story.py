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
    plot_remaining_gap,
)
from sim.plot.story_bars import make_candidate_table
from sim.plot.table import Table
from sim.reconcile.story import AMBIGUOUS, UNEXPLAINED, Finding, Story
from sim.reconcile.story_text import (
    FAULT,
    MINOR,
    describe_effect,
    describe_gains,
    describe_parameter,
    describe_size,
    format_estimate,
    format_gap,
    list_gains,
    list_inspections,
    list_next_tests,
    list_remarks,
    write_gain_caution,
    write_headline,
)
from sim.report.page_file import choose_page_path, load_templates, write_page_file


@dataclass(frozen=True)
class FindingText:
    """The texts of a finding on the page.

    Args:
        name: name of the effect, or of several that cannot be distinguished.
        summary: the effect in a few words.
        leads: whether it is a fault or a major effect.
        size: ``major``, ``minor`` or ``damage to the log``, and how likely it is.
        sentence: what it does.
        parameters: name, value, error, unit and meaning of each parameter.
        gap: the gap before and after the effect is added; empty for damage.
        looks: title and text of what to inspect on the robot, or to do.
        separating_test: the test that distinguishes it from the effects it may be confused with.
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
    """Write the page as one file; if that fails, an existing file stays as it was.

    Args:
        story: result of ``reconcile``.
        path: path of the page.
        title: names of the files.

    Raises:
        BadRequest: the name does not end in .html, or the file cannot be written.
    """
    target = choose_page_path(path)
    write_page_file(render_story(story, title=title), target)


def render_story(story: Story, *, title: str) -> str:
    """The page as HTML; the same story always gives the same text.

    Args:
        story: result of ``reconcile``.
        title: names of the files.
    """
    last = len(story.chapters) - 1
    tried = [number for number, chapter in enumerate(story.chapters) if chapter.tried]
    overlaid = range(1, last + 1) or (0,)  # chapter 0 only if there is no other
    return (
        load_templates()
        .get_template("story.html.jinja")
        .render(
            title=title,
            story=story,
            per=find_unit(story.shown.units),
            headline=write_headline(story),
            unsure=story.remainder or story.verdict in {AMBIGUOUS, UNEXPLAINED},
            remarks=list_remarks(story),
            findings=[_describe_finding(one, story) for one in story.findings],
            gains=list_gains(story),
            gains_title=describe_gains(story),
            caution=write_gain_caution(story),
            overview=_html(make_findings_table(story)),
            tests=list_next_tests(story),
            shrinking=_html(plot_gap_by_round(story)),
            places=[(place.sentence, f"{place.sure:.0f}") for place in story.where],
            gaps=_draw_gap(story),
            rounds=[(_name_model(story, n), _draw_candidates(story, n)) for n in tried],
            overlays=[(_name_model(story, n), _html(plot_overlays(story, n))) for n in overlaid],
        )
    )  # fmt: skip


def _draw_gap(story: Story) -> Markup:
    """What the first and the last model leave, or the reason why there are none."""
    try:
        return Markup().join(map(_html, plot_remaining_gap(story)))
    except BadRequest as refusal:
        return Markup("<p>{}</p>").format(str(refusal))


def _draw_candidates(story: Story, chapter: int) -> Markup:
    """The candidates of a round: bars, or a table if no candidate improves the model."""
    if max(one.improvement for one in story.chapters[chapter].tried) < 1.0:
        return _html(make_candidate_table(story, chapter))
    return _html(plot_candidate_bars(story, chapter))


def _name_model(story: Story, chapter: int) -> str:
    """The name of a chapter's model: the base model and the effects added to it."""
    added = [one.added for one in story.chapters[1 : chapter + 1]]
    return " + ".join(["base model", *added])


def _describe_finding(one: Finding, story: Story) -> FindingText:
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
    return Markup(shown.html)  # noqa: S704 - both escape their texts
