"""``sysid reconcile``: its options."""

from pathlib import Path
from typing import Any

import click

from sim.cli import reconcile as work
from sim.cli.options import FILE, as_json, combine_options, paste_options, reading_options

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
def reconcile(files: tuple[Path, ...], **options: Any) -> int:  # noqa: ANN401 - click's options
    """Find effects that the model of a mechanism does not contain.

    The command also shows how much these effects reduce the gap, and the gains of the model that
    contains them. FILES contain the four tests of one mechanism. An effect is accepted only if the
    model with it predicts the runs of --validation better; without --validation, each run is
    predicted from the others.

    For example: sysid reconcile arm.wpilog --validation faster.wpilog --html arm.html

    Exit code 0 means that nothing is missing, or that the missing effects were found; 1 that
    something remains unexplained or ambiguous.
    """
    code: int = work.run.reconcile_files(files, **options)
    return code
