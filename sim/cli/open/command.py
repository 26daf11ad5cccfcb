"""``sysid open``: a page in the browser that shows and fits logs, with a slider for each gain."""

import os
import sys
import tempfile
import threading
import webbrowser
from collections.abc import Sequence
from pathlib import Path

import click

from sim.cli import open as work
from sim.cli.open.view import PageView
from sim.cli.options import FILE, combine_options
from sim.support.command_line import DONE

# Options of the commands that serve the page.
page_options = combine_options(
    click.option(
        "--port",
        type=click.IntRange(0, 65535),
        default=0,
        help="Port of the page on this machine.  [default: a free one]",
    ),
    click.option("--no-browser", is_flag=True, help="Only print the address of the page."),
)


@click.command(name="open")
@click.argument("files", nargs=-1, type=FILE)
@click.option("--raw", is_flag=True, help="Show only the data: no faults, no fit.")
@page_options
def open(files: tuple[Path, ...], *, raw: bool, port: int, no_browser: bool) -> int:  # noqa: A001 - the command's own name
    """Open logs in your browser.

    See their runs and faults, and move the gains until the curves match. Drag logs onto the page,
    or name them here. The page works offline, and sends nothing to other computers. Ctrl-C stops
    the command.

    For example: sysid open drive.wpilog
    """
    serve_page(files, view=PageView(raw=raw), port=port, no_browser=no_browser)
    return DONE


def serve_page(
    files: Sequence[Path], *, view: PageView, port: int = 0, no_browser: bool = False
) -> None:
    """Serve the page until Ctrl-C, and print its address.

    Args:
        files: the logs to open at the start.
        view: what the page shows of them.
        port: port on this machine; 0 takes a free one.
        no_browser: only print the address.

    Raises:
        BadRequest: the port is taken, or there are too many files.
    """
    with tempfile.TemporaryDirectory(prefix="sysid-open-", ignore_cleanup_errors=True) as folder:
        session = work.session.Session(Path(folder), files, view=view)
        with work.server.PageServer(session, port=port) as server:
            click.echo(f"The page is at {server.address}\nCtrl-C here ends it.")
            sys.stdout.flush()
            threading.Thread(target=session.warm_up, daemon=True).start()
            if not no_browser:
                open_browser(server.address)
            try:
                server.serve_forever()
            except KeyboardInterrupt:
                click.echo("")


def open_browser(address: str) -> None:
    """Show an address in the user's browser, unless the variable BROWSER is ``none``."""
    if os.environ.get("BROWSER") != "none":
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
