"""``sysid faults``."""

import click

from sim.cli.options import as_json, list_catalogue
from sim.inspect.faults import FAULTS


@click.command()
@as_json
def faults(*, as_json: bool) -> None:
    """List the faults that a log can have.

    `sysid inspect` looks for these faults.
    """
    list_catalogue(FAULTS, "ordinary", "kinds", "types", "whole", as_json=as_json)
