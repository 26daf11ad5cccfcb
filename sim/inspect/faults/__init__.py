"""The faults that a record may have, one file each."""

import sys

from sim.core.errors import refuse_unknown
from sim.inspect.fault import Fault
from sim.support.catalogue import load_catalogue

FAULTS = load_catalogue(sys.modules[__name__], Fault, Fault.find_contract_breaches)


def find_fault(name: str) -> Fault:
    """Look up a fault.

    Raises:
        BadRequest: no such fault; the message lists those there are.
    """
    refuse_unknown("fault", name, FAULTS)
    return FAULTS[name]
