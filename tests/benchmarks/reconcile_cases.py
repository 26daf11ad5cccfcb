"""Make the cases of the benchmark of reconcile, each a folder with three logs and no answer.

    python tests/benchmarks/reconcile_cases.py --seed 1 --cases 22 --out FOLDER --key KEY.json

``train.csv`` and ``validation.csv`` are the four tests at two levels, ``test.csv`` has other levels
and other inputs, ``case.json`` what a team knows of its mechanism. The answers go where ``--key``
says, which the solver is not told.
"""

import argparse
import json
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from reconcile_plan import plan
from reconcile_strangers import admit

PHYSICS = ("bench", "mujoco")  # what may move the mechanisms


def main() -> None:
    """Make all cases of a plan."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--cases", type=int, required=True)
    parser.add_argument("--shuffled", type=int, required=True)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--physics", choices=PHYSICS, default=PHYSICS[0])
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--key", type=Path, required=True)
    asked = parser.parse_args()
    if asked.key.resolve().is_relative_to(asked.out.resolve()):
        sys.exit(f"{asked.key} is in the solver's folder. Put the key elsewhere.")
    admit()
    from reconcile_making import store  # noqa: PLC0415 - the engine counts effects when imported
    from reconcile_recording import on_the_bench as moved  # noqa: PLC0415 - the same

    from sim.physics.engine import load_engine  # noqa: PLC0415 - the same

    cases = plan(seed=asked.seed, cases=asked.cases, shuffled=asked.shuffled)
    if asked.physics == "mujoco":
        try:
            from reconcile_mujoco import moved  # noqa: PLC0415 - not everybody has it
        except ModuleNotFoundError:
            sys.exit("MuJoCo is not installed. Run: pip install 'sysid-course[physics]'")
    work = partial(store, seed=asked.seed, out=asked.out, moved=moved)
    load_engine()  # compiled once, for all
    with ProcessPoolExecutor(asked.jobs, initializer=admit) as pool:
        key = dict(pool.map(work, cases))
    asked.key.write_text(json.dumps(key), encoding="utf-8")


if __name__ == "__main__":
    main()
