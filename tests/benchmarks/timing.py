"""How the benchmarks measure: repeat, sort, and print the least, the median and the most."""

import time
import tracemalloc
from collections.abc import Callable
from statistics import median


def seconds(work: Callable[[], object], *, repeats: int = 25) -> list[float]:
    """Wall seconds of each of ``repeats`` calls, after one that is not counted, sorted."""
    work()
    taken = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        taken.append(time.perf_counter() - start)
    return sorted(taken)


def peak(work: Callable[[], object]) -> int:
    """Bytes that a call holds at most, beyond what was there before, after one not counted."""
    work()
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def line(name: str, taken: list[float], *, target: float | None = None) -> str:
    """One figure as a line: milliseconds, and the target beside it."""
    goal = f"   target {1e3 * target:g} ms" if target else ""
    least, middle, most = 1e3 * taken[0], 1e3 * median(taken), 1e3 * taken[-1]
    return f"{name:56} {least:9.2f} {middle:9.2f} {most:9.2f} ms{goal}"


HEADER = f"{'':56} {'least':>9} {'median':>9} {'most':>9}"
