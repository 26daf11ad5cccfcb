"""Healthy robots, below and above their current limits: how often reconcile finds nothing missing.

    python tests/benchmarks/bench_complete.py [LOGS] [FIRST SEED]

Nothing is hidden in any of them. Mechanisms of the bench are drawn anew, on a good, a tired and an
old battery, with steps that no limit touches and with steps that one cuts; each is reconciled from
three logs. "Nothing is missing" is right, and so is the name of the limit that acts. A log in which
the battery browned out is no healthy robot's, and is left out.
"""

import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace

import numpy as np

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.core.units import find_unit
from sim.physics.battery import Battery
from sim.reconcile import reconcile

BATTERIES = {
    "good": Battery(12.9, 0.012),
    "tired": Battery(12.4, 0.022),
    "old": Battery(12.1, 0.03),
}
STEPS = {"below": (2.5, 3.0, 2.0), "across": (3.0, 5.0, 2.5), "above": (5.0, 7.0, 4.0)}  # [V]
HEAVIEST = 2.0  # [V] steps of what falls lie that much higher


def solved(number: int) -> tuple[str, str, str, str, tuple[str, ...], str, float]:
    """Mechanism, battery, steps, verdict, names, what remains, seconds of processor time."""
    rng = np.random.default_rng([20261124, number])
    kind = sorted(MECHANISMS)[number % len(MECHANISMS)]
    battery = sorted(BATTERIES)[int(rng.integers(len(BATTERIES)))]
    steps = sorted(STEPS)[int(rng.integers(len(STEPS)))]
    mechanism = replace(MECHANISMS[kind].draw(rng), battery=BATTERIES[battery])
    more = HEAVIEST if mechanism.type != "simple" else 0.0
    logs = [
        simulate(mechanism, Routine(ramp=0.7, step=step + more, timeout=8.0), rng=rng)
        for step in STEPS[steps]
    ]
    if any(log.doubts for log in logs):
        return kind, battery, steps, "brownout", (), "", 0.0
    began = time.process_time()
    try:
        story = reconcile(
            logs[0], validation=logs[1], held_out=logs[2], type=mechanism.type,
            travel=mechanism.travel / find_unit(mechanism.units).si if mechanism.stops else None,
        )  # fmt: skip
    except Refusal as refused:
        return kind, battery, steps, "refused", (), str(refused), time.process_time() - began
    names = tuple(f"{one.effect} ({one.size})" for one in story.findings)
    took = time.process_time() - began
    return kind, battery, steps, story.verdict, names, story.remains, took


def main() -> None:
    """Reconcile, and print what was found where nothing is."""
    count, first = (int(word) for word in (*sys.argv[1:], "48", "0")[:2])
    found: Counter[str] = Counter()
    seconds = []
    with ProcessPoolExecutor(2) as pool:
        for kind, battery, steps, verdict, names, remains, took in pool.map(
            solved, range(first, first + count)
        ):
            if verdict == "brownout":
                continue
            right = verdict == "nothing-missing" and not any("major" in name for name in names)
            right |= verdict == "explained" and set(names) == {"current-limit (major)"}
            found["right" if right else "wrong"] += 1
            found["named"] += bool(names)
            seconds.append(took)
            if names or not right:
                print(kind, battery, steps, verdict, *names, remains, f"{took:.1f} s", flush=True)
    healthy = found["right"] + found["wrong"]
    share = found["right"] / healthy
    print(f"{healthy} healthy robots: {share:.3f} right, {found['named']} with a name")
    print(f"{np.median(seconds):.1f} s of a core in the middle, {max(seconds):.1f} s at most")


if __name__ == "__main__":
    main()
