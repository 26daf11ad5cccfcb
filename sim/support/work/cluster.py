"""Run jobs on a Dask cluster (extra ``cluster``).

A worker does a job in a child process and returns plain data, and this process writes it. So all
machines need the same version of this package, but no shared disk. Jobs go through the network,
with seeds, true parameters or students' answers: if you do not trust it, use ``tls://``.
"""

import logging
import re
from collections.abc import Iterator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import Any

from sim.core.errors import BadRequest

ADDRESS = re.compile(r"((tcp|tls|wss?)://)?(\[[0-9a-fA-F:]+\]|[^\s/:]+):\d{1,5}/?")
PATIENCE = 10.0  # [s] to wait for the answer of a scheduler
PACKAGE = "sysid-course"


@contextmanager
def open_cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """The executor of a Dask cluster, and its number of threads.

    Args:
        address: address of the scheduler: ``tcp://10.0.0.5:8786``.

    Raises:
        BadRequest: Dask is not installed here, no scheduler answers, there are no workers, a
            worker has another version of this package, or the connection is lost.
    """
    dask = _import_dask()
    with _disable_logging(), _connect(dask, address) as client:
        threads = _count_threads(client, address)
        try:
            yield client.get_executor(pure=False), threads
        except Exception as error:  # Dask raises many types when a connection is lost
            lost = isinstance(error, CancelledError | OSError | dask.KilledWorker)
            if client.status == "running" and not lost:
                raise
            raise BadRequest(
                f"the cluster at {address} was lost ({type(error).__name__})",
                advice="See that its machines have memory and stay on, then run the same command "
                "again to go on.",
            ) from None


@contextmanager
def _disable_logging() -> Iterator[None]:
    """Disable logging: Dask logs pages about a lost connection, which is reported in one line."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        yield
    finally:
        logging.disable(before)


def _import_dask() -> ModuleType:
    """Dask's package ``distributed``, imported only when it is needed.

    Raises:
        BadRequest: it is not installed.
    """
    try:
        return import_module("distributed")
    except ImportError:
        raise BadRequest(
            "a cluster needs Dask, which is not installed",
            advice='Install the extra "cluster": pip install "sysid-course[cluster]"',
        ) from None


def _connect(dask: ModuleType, address: str) -> Any:  # noqa: ANN401 - of a package that may be absent
    """A connection to a scheduler.

    Raises:
        BadRequest: the address is invalid, or no scheduler answers.
    """
    advice = "Start one with: dask scheduler; and give the address it prints."
    if not ADDRESS.fullmatch(address):
        raise BadRequest(f"{address!r} is not the address of a Dask scheduler", advice=advice)
    try:
        return dask.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:  # not reachable, or an unknown protocol
        raise BadRequest(
            f"no Dask scheduler answers at {address} ({type(error).__name__})", advice=advice
        ) from None


def _count_threads(client: Any, address: str) -> int:  # noqa: ANN401 - as above
    """The number of threads of all workers.

    Raises:
        BadRequest: there are none, or one has another version of this package.
    """
    found = client.run(version, PACKAGE, on_error="return")
    if not found:
        raise BadRequest(
            f"the scheduler at {address} has no workers",
            advice=f"Start some with: dask worker {address}",
        )
    for worker, theirs in found.items():
        if theirs != version(PACKAGE):
            has = f"has {PACKAGE} {theirs}" if isinstance(theirs, str) else f"has no {PACKAGE}"
            raise BadRequest(
                f"the worker at {worker} {has}",
                advice=f"Install {PACKAGE} {version(PACKAGE)} on every machine, as here.",
            )
    return sum(client.nthreads().values())
