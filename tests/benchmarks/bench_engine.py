"""How fast the bench steps: print, never gate.

python tests/benchmarks/bench_engine.py
"""

import os
import subprocess
import sys
import tempfile
import time
from contextlib import suppress

import numpy as np
from timing import HEADER, line, seconds

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.physics.effects import EFFECTS
from sim.support.work.cache import CACHE

ROUTINE = Routine(ramp=0.5, step=3.5)
VARIANTS = 1000
TIMED_SCRIPT = """
import numpy as np, sim
from sim.bench.simulate import simulate
simulate(sim.MECHANISMS["drivetrain"], sim.Routine(), rng=np.random.default_rng(1))
"""


def main() -> None:
    """Print every figure."""
    one_mechanism()
    variants()
    processes()


def one_mechanism() -> None:
    """Four tests of each mechanism, and of a drivetrain with each effect."""
    print("Four tests in process, after the first")
    print(HEADER)
    for name, built in MECHANISMS.items():
        long = sum(np.ptp(run.time) for run in simulate(built, ROUTINE, rng=rng()).runs)
        took = seconds(lambda built=built: simulate(built, ROUTINE, rng=rng()))
        print(line(f"{name}, {long:.0f} s recorded", took, target=0.010))
    drive = MECHANISMS["drivetrain"]
    for name, effect in EFFECTS.items():
        if not effect.reason_against(drive.scale):
            built = drive.hide(name)
            took = seconds(lambda built=built: simulate(built, ROUTINE, rng=rng()), repeats=9)
            print(line(f"drivetrain with {name}", took))


def variants() -> None:
    """Many drivetrains, each drawn, each with one or two effects of its own."""
    chance = rng()
    drive = MECHANISMS["drivetrain"]
    able = [name for name, effect in EFFECTS.items() if not effect.reason_against(drive.scale)]
    built = []
    for _ in range(VARIANTS):
        one = drive.draw(chance)
        for name in chance.choice(able, size=int(chance.integers(1, 3)), replace=False).tolist():
            with suppress(BadRequest):  # two effects that cannot be in one model
                one = one.hide(name, float(chance.uniform(0.3, 1.5)))
        built.append(one)
    began = time.perf_counter()
    for one in built:
        simulate(one, ROUTINE, rng=chance)
    took = time.perf_counter() - began
    print(f"{VARIANTS} drivetrains with effects: {took:.1f} s, {1e3 * took / VARIANTS:.1f} ms each")
    print("  (target: 10 ms each on one core)")


def processes() -> None:
    """A whole process that simulates: the first compiles, the next load what it left."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, CACHE: folder}
        for said in ("first, compiling (target: 15 s)", "from the cache (target: 1.5 s)"):
            began = time.perf_counter()
            subprocess.run([sys.executable, "-c", TIMED_SCRIPT], env=environment, check=True)
            print(f"whole process, {said}: {time.perf_counter() - began:.2f} s")


def rng() -> np.random.Generator:
    """The same chance every time."""
    return np.random.default_rng(1)


if __name__ == "__main__":
    main()
