"""The faults that a record may have, one file each."""

import sys

from sim.core.errors import BadRequest
from sim.inspect.fault import Fault, load_fault
from sim.support.catalogue import list_members

FAULTS: dict[str, Fault] = {
    found.name: found
    for found in (
        load_fault(module, name=name)
        for name, module in list_members(sys.modules[__name__]).items()
    )
}


def find_fault(name: str) -> Fault:
    """Look up a fault.

    Raises:
        BadRequest: no such fault; the message lists those there are.
    """
    if name not in FAULTS:
        raise BadRequest(f"unknown fault {name!r}", advice=f"Choose one of: {', '.join(FAULTS)}.")
    return FAULTS[name]
