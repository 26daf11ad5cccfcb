"""Simulate FRC mechanisms, read their logs, fit gains, and reconcile model and log.

The most common names are here: ``sim.read``, ``sim.write``, ``sim.Log``, ``sim.Run``,
``sim.Routine``, ``sim.MECHANISMS``, ``sim.Refusal``. Functions are in modules:
``from sim.fit import fit``, ``from sim.bench.simulate import simulate``.

Large modules are imported only when they are used, so a command that prints its help starts at
once. Importing ``sim`` sets NumPy's linear algebra to one thread, unless the environment sets the
number.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sim.bench.mechanisms import MECHANISMS
    from sim.bench.routine import Routine
    from sim.core.errors import Refusal
    from sim.core.log import Log, Run
    from sim.io import read, write

from sim.support.blas_threads import use_one_blas_thread

use_one_blas_thread()

_HOME = {
    "Log": "sim.core.log",
    "Run": "sim.core.log",
    "Refusal": "sim.core.errors",
    "read": "sim.io",
    "write": "sim.io",
    "Routine": "sim.bench.routine",
    "MECHANISMS": "sim.bench.mechanisms",
}

__all__ = ["MECHANISMS", "Log", "Refusal", "Routine", "Run", "read", "write"]


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'sim' has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)
