"""``sysid watch``: fit a log while the robot's tests are still running."""

import json
import sys
import tempfile
import threading
import time
from contextlib import ExitStack, suppress
from dataclasses import replace
from pathlib import Path

import click

from sim.cli.fit.plausibility import check_against_physics, compare_directions_alone
from sim.cli.log_reader import LogReader
from sim.cli.open.command import open_browser, page_options
from sim.cli.open.server import PageServer
from sim.cli.open.session import LiveView, Session
from sim.cli.options import FILE, as_json, reading_options
from sim.cli.watch.live_fit import LiveFit, WatchUpdate
from sim.cli.watch.network_tables import NetworkTablesSource
from sim.cli.watch.recordings import FileSource, Source
from sim.core.vocabulary import FOUR_TESTS
from sim.feedback import PRESETS
from sim.fit.between_recordings import describe_next_recording
from sim.fit.feedback_trial import try_feedback_gains, warn_of_bad_suggestions
from sim.physics.engine import load_engine
from sim.report.fit_terminal import format_gains, show_fit
from sim.report.gain_verdicts import write_gain_verdict
from sim.support.command_line import DONE

PAUSE = 0.2  # [s] between polls; a WPILib program writes its log to disk four times a second


@click.command()
@click.argument("place", metavar="[FILE|FOLDER]", type=FILE, required=False)
@click.option(
    "--nt",
    metavar="ADDRESS",
    help="Follow NetworkTables instead of a file. ADDRESS is localhost, an address such as "
    "10.12.34.2, or a team number such as 1234.",
)
@click.option(
    "--save", type=FILE, metavar="FOLDER", help="Keep what NetworkTables sent, as .wpilog files."
)
@click.option("--page", is_flag=True, help="Also show the runs live, on the page of `sysid open`.")
@page_options
@reading_options
@as_json
def watch(
    place: Path | None,
    *,
    nt: str | None,
    save: Path | None,
    page: bool,
    port: int,
    no_browser: bool,
    reader: LogReader,
    as_json: bool,
) -> int:
    """Fit a robot's log after each test, and say what to do next.

    Name the .wpilog that a robot or a simulation is writing, or the folder in which it will
    appear, or give --nt ADDRESS to follow NetworkTables. Ctrl-C stops it and prints the gains.

    For example: sysid watch logs
    """
    if (place is None) == (nt is None):
        raise click.UsageError("Give either a log or folder, or --nt ADDRESS.")
    if save is not None and nt is None:
        raise click.UsageError("--save keeps what NetworkTables sends, so it needs --nt.")

    with ExitStack() as stack:
        source = _open_source(
            place, nt=nt, save=save, state=reader.entries.get("state"), stack=stack
        )
        live = LiveFit(source, reader.read_file, type=reader.type or "")
        session = _open_page(port, stack=stack, no_browser=no_browser) if page else None
        if not as_json:
            click.echo(f"Run {', '.join(FOUR_TESTS)}, in any order.\nCtrl-C here ends it.")
            sys.stdout.flush()
        with suppress(KeyboardInterrupt):
            threading.Thread(target=load_engine, daemon=True).start()
            _follow_source(live, session, as_json=as_json)
        if not as_json:
            _show_end(live)
    return DONE


def _open_source(
    place: Path | None, *, nt: str | None, save: Path | None, state: str | None, stack: ExitStack
) -> Source:
    """The source to follow: a file, a folder or NetworkTables; the stack closes it.

    Raises:
        Refusal: the source does not exist, or needs a package that is not installed.
    """
    if place is not None:
        return FileSource(place, state=state)

    folder = save or _make_temporary_folder("sysid-watch-", stack)
    source = NetworkTablesSource(nt or "", folder=folder, state=state)
    stack.callback(source.close)
    return source


def _open_page(port: int, *, stack: ExitStack, no_browser: bool) -> Session:
    """Serve the page of `sysid open` until the stack is closed.

    Raises:
        BadRequest: the port is taken.
    """
    session = Session(_make_temporary_folder("sysid-open-", stack))
    session.live = LiveView("starting", dict.fromkeys(FOUR_TESTS, 0))
    server = stack.enter_context(PageServer(session, port=port))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    stack.callback(server.shutdown)
    click.echo(f"The page is at {server.address}", err=True)
    if not no_browser:
        open_browser(server.address)
    return session


def _make_temporary_folder(prefix: str, stack: ExitStack) -> Path:
    temporary = tempfile.TemporaryDirectory(prefix=prefix, ignore_cleanup_errors=True)
    return Path(stack.enter_context(temporary))


def _follow_source(live: LiveFit, session: Session | None, *, as_json: bool) -> None:
    """Poll the source and show each update, until an exception ends it."""
    status = ""
    while True:
        update = live.poll()
        if update is not None:
            show = _show_json if as_json else _show_update
            show(update)
        if session is not None:
            _renew_page(session, live)
        if live.source.status != status:
            status = live.source.status
            if not as_json:
                click.echo(status)
        sys.stdout.flush()
        if update is None:
            time.sleep(PAUSE)


def _renew_page(session: Session, live: LiveFit) -> None:
    """Show on the page the tests that have ended since the last call, and the advice."""
    for one in live.take_changed():
        session.renew(one, one.path, one.logs)
    update = live.last
    log = None if update is None else update.log
    counts = {test: len(log.list_runs_of_test(test)) if log else 0 for test in FOUR_TESTS}
    session.live = LiveView(live.source.status, counts, "" if update is None else update.advice)


def _show_update(update: WatchUpdate) -> None:
    """Print a block: which tests have ended, the gains so far, and what to do next."""
    log, pooled = update.log, update.pooled
    runs = 0 if log is None else len(log.runs)
    click.echo(f"\n{', '.join(update.tests)} ended; {runs} run{'s' * (runs != 1)} so far.")
    if pooled is None:
        click.echo(f"  no gains yet: {update.refusal}")
    else:
        for name, value, error, unit in format_gains(pooled.found):
            click.echo(f"  {name} {value} {unit}, one standard error {error}")
        click.echo(f"  {write_gain_verdict(pooled.found, log)}")
    click.echo(f"  Next: {update.advice}")


def _show_json(update: WatchUpdate) -> None:
    click.echo(json.dumps(update.to_json(), allow_nan=False))


def _show_end(live: LiveFit) -> None:
    """Print the last gains as ``sysid fit`` does."""
    update = live.last
    click.echo("")
    if update is None or update.log is None or update.pooled is None:
        click.echo(f"There are no gains: {update.refusal if update else 'no test has ended.'}")
        return

    preset = PRESETS["default"]
    found, _ = check_against_physics(update.pooled.found, update.log, parts=None)
    found, notes = compare_directions_alone(found, update.log, include_long=False)
    tried = try_feedback_gains(found := found.in_log_units(), preset, own=None)
    found = replace(found, doubts=(*found.doubts, *warn_of_bad_suggestions(found, tried)))
    show_fit(
        found, preset=preset, title=", ".join(map(str, update.paths)), log=update.log,
        tried=tried, notes=(*notes, *update.pooled.notes, *describe_next_recording(found)),
    )  # fmt: skip
