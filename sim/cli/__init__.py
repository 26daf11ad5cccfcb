"""The command ``sysid``: make, damage, inspect and fit logs."""

import sys
from importlib import import_module

import click

from sim.support.command_line import run_command
from sim.support.completion import explain_completion
from sim.support.lazy_package import lazy_modules

__getattr__ = lazy_modules(__name__)

COMMANDS = {  # each in a module or a folder of this name; the list of commands imports none of them
    "contaminate": "Write a copy of the log FILE with a fault added to it.",
    "dataset": "Make many damaged logs, as the file SPEC describes them.",
    "effects": "List the effects that a mechanism can have.",
    "entries": "List the entries of a robot's log.",
    "faults": "List the faults that a log can have.",
    "fit": "Find kS, kV, kA (and kG) in the logs of one mechanism.",
    "inspect": "Look for faults in the logs of one mechanism.",
    "mechanisms": "List the mechanisms that can be simulated.",
    "open": "Open logs in your browser.",
    "reconcile": "Find effects that the model of a mechanism does not contain.",
    "simulate": "Run the four tests on a simulated MECHANISM, and write a log.",
    "watch": "Fit a robot's log after each test, and say what to do next.",
}
FOLDERS = ("fit", "open", "reconcile", "watch")


class Commands(click.Group):
    """The commands of ``sysid``, imported on first use."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's own
        """The names of all commands."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """The command of a name; None if there is none."""
        if cmd_name not in COMMANDS:
            return None
        module = f"sim.cli.{cmd_name}.command" if cmd_name in FOLDERS else f"sim.cli.{cmd_name}"
        found = getattr(import_module(module), cmd_name)
        return found if isinstance(found, click.Command) else None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the commands and what each of them does."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


def main() -> None:
    """Start ``sysid``."""
    sys.exit(run_command(sysid, name="sysid"))


@click.command(
    cls=Commands,
    epilog=explain_completion("sysid"),
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(package_name="sysid-course")
def sysid() -> None:
    """System identification for FRC mechanisms: simulate them, read their logs, fit their gains.

    Exit codes: 0 done, 1 done but something is not right, 2 could not do it.
    """
