"""``sysid mechanisms``."""

import click

from sim.bench.mechanisms import MECHANISMS
from sim.cli.options import as_json, list_catalogue


@click.command()
@as_json
def mechanisms(*, as_json: bool) -> None:
    """List the mechanisms that can be simulated."""
    list_catalogue(MECHANISMS, as_json=as_json)
