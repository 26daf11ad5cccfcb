"""A fit as one self-contained web page, or as one picture.

    write_page(report, "drive.html")
    write_picture(report, "drive.png")

On the page, every figure has a caption and a table of its numbers, and the doubts come first.
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

from markupsafe import Markup

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.core.units import Unit, find_unit
from sim.feedback import Preset
from sim.fit import Fit
from sim.fit.feedback_trial import FeedbackTrial
from sim.fit.replay import RunReplay, replay_fit
from sim.plot.fit_overview import plot_fit_overview
from sim.plot.measured_vs_simulated import make_error_table, plot_measured_vs_simulated
from sim.plot.picture import Picture
from sim.plot.step_response import plot_step_responses
from sim.report.page_file import choose_page_path, load_templates, write_page_file
from sim.report.rows import (
    make_controller_rows,
    make_gain_rows,
    make_measure_rows,
    make_snippet_rows,
)


@dataclass(frozen=True, eq=False)
class Report:
    """The content of a report: a fit, its log and its feedback trials.

    Args:
        title: names of the files.
        found: the fit, in the unit to show, with the doubts to show.
        log: what it was fitted to.
        preset: the motor controller that ``tried`` is for.
        tried: simulated trials of feedback gains; empty if there are none.
        notes: sentences about checks that passed.
    """

    title: str
    found: Fit
    log: Log
    preset: Preset
    tried: tuple[FeedbackTrial, ...] = ()
    notes: tuple[str, ...] = field(default=())

    @property
    def position_unit(self) -> Unit:
        """The unit of position."""
        return find_unit(self.found.units)

    @cached_property
    def runs(self) -> tuple[RunReplay, ...]:
        """Every run, measured and simulated; empty if these gains cannot be simulated."""
        try:
            return replay_fit(self.found, self.log)
        except BadRequest:  # the doubts about the gains say why
            return ()


def write_page(report: Report, path: str | os.PathLike[str]) -> None:
    """Write the page as one file; if that fails, an existing file stays as it was.

    Raises:
        BadRequest: the name does not end in .html, or the file cannot be written.
    """
    target = choose_page_path(path)
    write_page_file(render_page(report), target)


def write_picture(report: Report, path: str | os.PathLike[str]) -> None:
    """Write all runs and the loops' step responses as one picture.

    Raises:
        BadRequest: the file's name does not end in .png, .svg or .pdf, the file cannot be written,
            or there is nothing to draw.
    """
    plot_fit_overview(report.runs, report.tried, per=report.position_unit).save(path)


def render_page(report: Report) -> str:
    """The page as HTML; the same report always gives the same text."""
    return (
        load_templates()
        .get_template("page.html.jinja")
        .render(
            title=report.title,
            found=report.found,
            per=report.position_unit,
            preset=report.preset.name,
            gains=make_gain_rows(report.found),
            measures=make_measure_rows(report.found),
            grave=_messages(report.found.doubts, grave=True),
            doubts=_messages(report.found.doubts, grave=False),
            notes=report.notes,
            overview=Markup(make_error_table(report.runs, per=report.position_unit).html),  # noqa: S704 - it escapes
            runs=[
                (run.run.test, _html(plot_measured_vs_simulated(run, per=report.position_unit)))
                for run in report.runs
            ],
            steps=_html(plot_step_responses(report.tried, per=report.position_unit))
            if report.tried
            else None,
            tried=[(trial.owner, trial.loop, trial.verdict.description) for trial in report.tried],
            controllers=make_controller_rows(report.found),
            snippets=make_snippet_rows(report.found),
        )
    )


def _messages(doubts: Sequence[Doubt], *, grave: bool) -> list[str]:
    return [doubt.text for doubt in doubts if doubt.grave == grave]


def _html(picture: Picture) -> Markup:
    return Markup(picture.html)  # noqa: S704 - a picture escapes its texts
