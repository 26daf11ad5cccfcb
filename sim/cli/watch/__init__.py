"""``sysid watch``: the gains of a robot whose tests are still being run."""

import json
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from sim.cli.fit.against import check_against_physics, compare_directions_alone
from sim.cli.options import FILE, as_json, read_file_parts, reading_options, velocity_options
from sim.core.vocabulary import FOUR_TESTS
from sim.feedback import PRESETS
from sim.support.command_line import DONE

if TYPE_CHECKING:
    from sim.cli.watch.live_fit import LiveFit, WatchUpdate
    from sim.cli.watch.recordings import Source

Show = Callable[["WatchUpdate"], None]

PAUSE = 0.2  # [s] between looks; a program of WPILib writes its log out four times a second


@click.command()
@click.argument("place", metavar="[FILE|FOLDER]", type=FILE, required=False)
@click.option(
    "--nt",
    metavar="ADDRESS",
    help="Follow NetworkTables instead: localhost, 10.TE.AM.2, or a team number.",
)
@click.option(
    "--save", type=FILE, metavar="FOLDER", help="Keep what NetworkTables sent, as .wpilog files."
)
@reading_options
@velocity_options
@as_json
def watch(
    place: Path | None,
    *,
    nt: str | None,
    save: Path | None,
    type_: str | None,
    units: str | None,
    motor: str | None,
    pick: int | None,
    velocity_scale: float,
    ignore_velocity: bool,
    as_json: bool,
    **entries: str | None,
) -> int:
    """Fit a robot's log while the tests are run, and say after each what to do next.

    Give the .wpilog that a robot or a simulation is writing, or the folder in which it will appear;
    or --nt ADDRESS to follow NetworkTables. Ctrl-C ends it and prints the gains.

    For example: sysid watch logs
    """
    if (place is None) == (nt is None):
        raise click.UsageError("Give a log or a folder, or --nt ADDRESS: one of them.")
    if save is not None and nt is None:
        raise click.UsageError("--save keeps what NetworkTables sends, so it needs --nt.")
    from sim.cli.watch.live_fit import LiveFit  # noqa: PLC0415 - --help must not wait for it

    read = partial(
        read_file_parts, units=units, type=type_, motor=motor, entries=entries,
        velocity=None if ignore_velocity else velocity_scale, pick=pick,
    )  # fmt: skip
    with ExitStack() as ends:
        source = _open_source(place, nt=nt, save=save, state=entries["state"], ends=ends)
        live = LiveFit(source, read, type=type_ or "")
        show = _show_json if as_json else _show
        if not as_json:
            click.echo(f"Run {', '.join(FOUR_TESTS)}, in any order.\nCtrl-C here ends it.")
            sys.stdout.flush()
        threading.Thread(target=_warm_up, daemon=True).start()
        try:
            _follow(live, show=show, quiet=as_json)
        except KeyboardInterrupt:
            pass
        return DONE if as_json else _end(live)


def _open_source(
    place: Path | None, *, nt: str | None, save: Path | None, state: str | None, ends: ExitStack
) -> "Source":
    """What is to be followed; it is closed with the stack.

    Raises:
        Refusal: it is not there, or needs a package that is not.
    """
    if place is not None:
        from sim.cli.watch.recordings import FileSource  # noqa: PLC0415 - reads formats

        return FileSource(place, state=state)
    from sim.cli.watch.network_tables import NetworkTablesSource  # noqa: PLC0415 - only with --nt

    if save is None:
        temporary = tempfile.TemporaryDirectory(prefix="sysid-watch-", ignore_cleanup_errors=True)
        save = Path(ends.enter_context(temporary))
    source = NetworkTablesSource(nt or "", folder=save, state=state)
    ends.callback(source.close)
    return source


def _follow(live: "LiveFit", *, show: Show, quiet: bool) -> None:
    """Look again and again; only an exception ends it."""
    told = ""
    while True:
        update = live.look()
        if update is not None:
            show(update)
        status = live.source.status
        if status != told and not quiet:
            click.echo(status)
            told = status
        sys.stdout.flush()
        if update is None:
            time.sleep(PAUSE)


def _show(update: "WatchUpdate") -> None:
    """Print a block: which tests have ended, the gains so far, and what to do next."""
    from sim.report.fit_terminal import format_gains  # noqa: PLC0415 - --help must not wait for it
    from sim.report.gain_verdicts import gain_verdict  # noqa: PLC0415 - the same

    log, pooled = update.log, update.pooled
    runs = 0 if log is None else len(log.runs)
    click.echo(f"\n{', '.join(update.tests)} ended; {runs} run{'s' * (runs != 1)} so far.")
    if pooled is None:
        click.echo(f"  no gains yet: {update.refusal}")
    else:
        for name, value, error, unit in format_gains(pooled.found):
            click.echo(f"  {name} {value} {unit}, one standard error {error}")
        click.echo(f"  {gain_verdict(pooled.found, log)}")
    click.echo(f"  Next: {update.advice}")


def _show_json(update: "WatchUpdate") -> None:
    click.echo(json.dumps(update.to_json(), allow_nan=False))


def _end(live: "LiveFit") -> int:
    """Print the last gains as ``sysid fit`` does; its exit code."""
    update = live.last
    click.echo("")
    if update is None or update.log is None or update.pooled is None:
        why = "no test has ended" if update is None else str(update.refusal)
        click.echo(f"There are no gains: {why}")
        return DONE
    from sim.fit.feedback_trial import trial_doubts, try_feedback_gains  # noqa: PLC0415 - only now
    from sim.report.fit_terminal import show_fit  # noqa: PLC0415 - the same

    preset = PRESETS["default"]
    found = check_against_physics(update.pooled.found, update.log, parts=None)
    found, notes = compare_directions_alone(found, update.log, patient=False)
    found = found.in_log_units()
    tried = try_feedback_gains(found, preset, own=None)
    found = replace(found, doubts=(*found.doubts, *trial_doubts(found, tried)))
    show_fit(
        found, preset=preset, title=", ".join(map(str, update.paths)), log=update.log,
        tried=tried, notes=(*notes, *update.pooled.notes),
    )  # fmt: skip
    return DONE


def _warm_up() -> None:
    """Load what the first fit needs while nothing happens yet."""
    import sim.fit.output_error  # noqa: PLC0415 - that is the point of it
    import sim.inspect.detect_faults  # noqa: PLC0415 - the same
    import sim.report.next_test  # noqa: F401, PLC0415 - the same
    from sim.physics.engine import load_engine  # noqa: PLC0415 - the same

    load_engine()
