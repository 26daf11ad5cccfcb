"""``sysid effects``."""

import click

from sim.cli.options import as_json, list_catalogue
from sim.physics.effects import EFFECTS, list_look_alikes


@click.command()
@as_json
def effects(*, as_json: bool) -> None:
    """List the effects that a mechanism can have.

    You can hide an effect in a simulated mechanism, and add it to a model.
    """
    list_catalogue(
        (
            {
                "name": name,
                "summary": found.summary,
                "kind": found.kind,
                "formula": found.formula,
                "parameters": {
                    parameter.name: {
                        "what": parameter.what,
                        "unit": parameter.unit.format(u="unit"),
                    }
                    for parameter in found.parameters
                },
                "fingerprint": found.fingerprint,
                "inspect": found.inspect,
                "apart": list_look_alikes(name),
            }
            for name, found in EFFECTS.items()
        ),
        as_json=as_json,
    )
