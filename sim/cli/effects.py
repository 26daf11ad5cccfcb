"""``sysid effects``."""

import click

from sim.cli.options import as_json, list_catalogue
from sim.physics.effect import Effect
from sim.physics.effects import EFFECTS, list_look_alikes


@click.command()
@as_json
def effects(*, as_json: bool) -> None:
    """List the effects that a mechanism can have.

    You can hide an effect in a simulated mechanism, and add it to a model.
    """
    list_catalogue(
        EFFECTS, "kind", "formula", "fingerprint", "inspect", describe=_describe, as_json=as_json
    )


def _describe(effect: Effect) -> dict[str, object]:
    """The parameters of an effect, and what tells it from similar effects."""
    parameters = {
        one.name: {"what": one.what, "unit": one.unit.format(u="unit")} for one in effect.parameters
    }
    return {"parameters": parameters, "apart": list_look_alikes(effect.name)}
