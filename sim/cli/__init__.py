"""The command ``sysid``: make, damage, inspect and fit logs. One file per command."""

import sys
from importlib import import_module
from pkgutil import iter_modules

import click

from sim.support.command_line import run_command
from sim.support.completion import explain_completion

__all__ = ["main", "sysid"]


class Commands(click.Group):
    """The commands of ``sysid``: one per module of this folder, imported on first use."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's own
        """The names of all commands: the modules of this folder, without ``options``."""
        return sorted(found.name for found in iter_modules(__path__) if found.name != "options")

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a name; None if there is none."""
        if cmd_name not in self.list_commands(ctx):
            return None
        found = getattr(import_module(f"sim.cli.{cmd_name}"), cmd_name)
        return found if isinstance(found, click.Command) else None


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
