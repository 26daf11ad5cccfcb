"""The catalogue of simulated mechanisms, one file each."""

import sys

from sim.bench.mechanism import Mechanism
from sim.core.errors import refuse_unknown
from sim.support.catalogue import load_catalogue

MECHANISMS = load_catalogue(sys.modules[__name__], Mechanism)


def find_mechanism(name: str) -> Mechanism:
    """Look up a mechanism.

    Raises:
        BadRequest: no such mechanism; the message lists those there are.
    """
    refuse_unknown("mechanism", name, MECHANISMS)
    return MECHANISMS[name]
