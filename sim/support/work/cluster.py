"""Run jobs on a Dask cluster (extra ``cluster``).

A worker gets a job and gives back plain data, and this process writes it: machines need this
package in the same version, and no disk in common. What a job holds does travel, be it a seed, the
truth about a log or a learner's answer: over a network that is not one's own, use ``tls://``.
"""

import logging
import re
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import Any, TypeVar

from sim.core.errors import BadRequest
from sim.support.work.process_pool import AHEAD, collect_results

Job = TypeVar("Job")
Result = TypeVar("Result")

ADDRESS = re.compile(r"((tcp|tls|wss?)://)?(\[[0-9a-fA-F:]+\]|[^\s/:]+):\d{1,5}/?")
PATIENCE = 10.0  # [s] until a scheduler has to answer
US = "sysid-course"


def run_jobs_on_cluster(
    work: Callable[[Job], Result], jobs: Sequence[Job], *, address: str
) -> Iterator[Result]:
    """Do jobs on a Dask cluster.

    Args:
        work: does one job; a function of a module of this package.
        jobs: what to do.
        address: of its scheduler: ``tcp://10.0.0.5:8786``.

    Raises:
        BadRequest: Dask is not installed here, nobody answers, or the workers cannot do it.
    """
    dask = _dask()
    with _quiet(), _client(dask, address) as client:
        workers = _workers(client, address)
        try:
            executor = client.get_executor(pure=False)
            yield from collect_results(executor, work, jobs, ahead=AHEAD * workers)
        except Exception as error:  # whatever Dask makes of a connection that is gone
            lost = isinstance(error, CancelledError | OSError | dask.KilledWorker)
            if client.status == "running" and not lost:
                raise
            raise BadRequest(
                f"the cluster at {address} was lost ({type(error).__name__})",
                advice="See that its machines have memory and stay on, then run the same command "
                "again to go on.",
            ) from None


@contextmanager
def _quiet() -> Iterator[None]:
    """Without the pages that Dask logs of a lost connection: what is lost is said in one line."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        yield
    finally:
        logging.disable(before)


def _dask() -> ModuleType:
    """Dask's own package; nothing else here needs it."""
    try:
        return import_module("distributed")
    except ImportError:
        raise BadRequest(
            "a cluster needs Dask, which is not installed",
            advice='Install the extra "cluster": pip install "sysid-course[cluster]"',
        ) from None


def _client(dask: ModuleType, address: str) -> Any:  # noqa: ANN401 - of a package that may be absent
    """A connection to a scheduler."""
    advice = "Start one with: dask scheduler; and give the address it prints."
    if not ADDRESS.fullmatch(address):
        raise BadRequest(f"{address!r} is not the address of a Dask scheduler", advice=advice)
    try:
        return dask.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:  # what cannot be reached, and what has no such protocol
        raise BadRequest(
            f"no Dask scheduler answers at {address} ({type(error).__name__})", advice=advice
        ) from None


def _workers(client: Any, address: str) -> int:  # noqa: ANN401 - as above
    """How many workers there are; none, or one that would make something else, is refused."""
    found = client.run(version, US, on_error="return")
    if not found:
        raise BadRequest(
            f"the scheduler at {address} has no workers",
            advice=f"Start some with: dask worker {address}",
        )
    for worker, theirs in found.items():
        if theirs != version(US):
            has = f"has {US} {theirs}" if isinstance(theirs, str) else f"has no {US}"
            raise BadRequest(
                f"the worker at {worker} {has}",
                advice=f"Install {US} {version(US)} on every machine, as here.",
            )
    return len(found)
