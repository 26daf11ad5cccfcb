"""``sysid reconcile``."""

import json
from contextlib import nullcontext
from pathlib import Path

import click

from sim.cli.fit.paste import make_paste_text
from sim.cli.log_reader import LogReader
from sim.cli.open.page_data import replace_gains
from sim.cli.open.reconcile_job import search_effects
from sim.cli.open.saved_page import save_page
from sim.cli.open.session import OpenLog
from sim.cli.options import (
    FILE,
    as_json,
    combine_options,
    paste_options,
    reading_options,
    refuse_overwriting,
)
from sim.core.log import Log
from sim.fit import Fit, fit
from sim.physics.engine import engine_can_compile
from sim.reconcile import Story
from sim.report.page_file import choose_page_path
from sim.report.story_terminal import show_progress, show_story
from sim.support.command_line import DONE, NOT_RIGHT, print_error
from sim.support.extras import format_install_command

UNSURE = ("unexplained", "ambiguous")  # verdicts with exit code 1


# Validation data, limits of the search, and the file to write.
reconcile_options = combine_options(
    click.option("--validation", type=FILE, help="Other runs: they must confirm each effect."),
    click.option("--held-out", type=FILE, help="More runs, used only to show the gap."),
    click.option(
        "--travel",
        type=float,
        help="Distance from stop to stop, in the log's units, if known.",
    ),
    click.option(
        "--effort",
        type=click.FloatRange(min=0.0, min_open=True),
        metavar="X",
        default=1.0,
        show_default=True,
        help="Search X times as long before the search stops with the best model so far.",
    ),
    click.option("--html", type=FILE, help="Write a page with every figure and number."),
    paste_options,
    click.option("--radius", type=float, help="Radius of wheel or drum [m], for --paste."),
)


@click.command()
@click.argument("files", nargs=-1, required=True, type=FILE)
@reconcile_options
@reading_options
@as_json
def reconcile(  # noqa: PLR0917 - click passes options by name
    files: tuple[Path, ...],
    validation: Path | None,
    held_out: Path | None,
    travel: float | None,
    effort: float,
    html: Path | None,
    paste: str | None,
    season: str,
    radius: float | None,  # noqa: ARG001 - the code of --paste reads it
    reader: LogReader,
    as_json: bool,  # noqa: FBT001 - click passes it by name
) -> int:
    """Find effects that the model of a mechanism does not contain.

    The command also shows how much these effects reduce the gap, and the gains of the model that
    contains them. FILES contain the four tests of one mechanism. An effect is accepted only if the
    model with it predicts the runs of --validation better; without --validation, each run is
    predicted from the others.

    For example: sysid reconcile arm.wpilog --validation faster.wpilog --html arm.html

    Exit code 0 means that nothing is missing, or that the missing effects were found; 1 that
    something remains unexplained or ambiguous.
    """
    refuse_overwriting(html, inputs=[*files, validation, held_out])
    if html is not None:
        choose_page_path(html)  # refuse a wrong name before the search, not after it

    logs = {"log": reader.read_joined(files)}
    logs |= {
        name: reader.read_joined([file])
        for name, file in (("validation", validation), ("held_out", held_out))
        if file is not None
    }
    _warn_uncompiled()
    quiet = nullcontext(lambda _, __: None)
    with quiet if as_json or paste else show_progress() as progress:
        story = search_effects(
            logs, type=reader.type, travel=travel, effort=effort, progress=progress
        )
    if html is not None:
        names = ", ".join(file.name for file in files)  # a page travels; folders are private
        save_page(OpenLog(1, names, files[0], finished={"": logs["log"]}), html, story)
    if paste:
        fit = _make_fit(story, logs["log"])
        click.echo(make_paste_text(fit, paste, season=int(season)), nl=False)
    elif as_json:
        click.echo(json.dumps(story.to_json(), allow_nan=False))
    else:
        show_story(story, title=", ".join(map(str, files)))
    return NOT_RIGHT if story.verdict in UNSURE or story.remainder else DONE


def _warn_uncompiled() -> None:
    """Warn that the search is slow without Numba: it simulates thousands of times."""
    if not engine_can_compile():
        print_error(
            "Numba is not installed, so this takes minutes instead of seconds; the result is the "
            f"same. To make it quick: {format_install_command('fast')}",
            name="sysid",
        )


def _make_fit(story: Story, log: Log) -> Fit:
    """The fit of a log, with the gains of a story's last model."""
    plain = fit(log, type=story.model.type).in_log_units()
    if story.gains == story.gains_without:
        return plain
    return replace_gains(plain, story.gains, story.model.parts)
