"""``sysid reconcile``: the search for effects, and what it writes."""

import json
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

import click

from sim.cli.fit.paste import make_paste_text
from sim.cli.fit.plausibility import check_against_physics
from sim.cli.log_reader import LogReader
from sim.cli.open.reconcile_job import search_effects
from sim.cli.open.saved_page import save_page
from sim.cli.open.session import OpenLog, Reading
from sim.cli.options import refuse_overwriting
from sim.core.log import Log
from sim.fit import Fit, fit
from sim.physics.engine import engine_can_compile
from sim.reconcile import Story
from sim.reconcile.story_text import apply_story
from sim.report.page_file import choose_page_path
from sim.report.story_terminal import show_progress, show_story
from sim.support.command_line import DONE, NOT_RIGHT, print_error
from sim.support.extras import format_install_command

UNSURE = ("unexplained", "ambiguous")  # verdicts with exit code 1


def reconcile_files(
    files: Sequence[Path],
    *,
    validation: Path | None,
    held_out: Path | None,
    travel: float | None,
    effort: float,
    html: Path | None,
    paste: str | None,
    season: str,
    radius: float | None,  # noqa: ARG001 - the code of --paste reads it
    reader: LogReader,
    as_json: bool,
) -> int:
    """Find effects and print or write them, as the command's options say; returns the exit code.

    Raises:
        Refusal: a file cannot be read or written, or a log cannot be fitted.
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
        save_page(OpenLog(1, names, files[0], finished={"": logs["log"]}), Reading(), html, story)
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
    checked, _ = check_against_physics(fit(log, type=story.model.type), log, parts=None)
    return apply_story(story, checked.in_log_units())
