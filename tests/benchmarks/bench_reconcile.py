"""How often ``sysid reconcile`` names what is missing: made here, solved blind, then scored.

    python tests/benchmarks/bench_reconcile.py [--seed N] [--cases 22] [--jobs 2] [--keep FOLDER]
                                               [--physics mujoco]

One process makes fresh cases, another solves them and is told nothing but the logs, the base type
and the travel. The answers are written before the key is opened. What a mechanism can have of the
catalogue is hidden in a realistic and in a third of that size, clean and with everyday dirt; beside
it are complete models, physics of no catalogue, two effects at once, and shuffled voltages. The
bench moves the mechanisms; or MuJoCo does, which knows nothing of the solver's engine.
"""

import argparse
import json
import secrets
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from reconcile_scores import controls, score
from reconcile_table import goals, lines

HERE = Path(__file__).resolve().parent
CASES = 22  # of each group of one effect: the catalogue, once
KEY = "key.json"


def main() -> None:
    """Make, solve, open the key, print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, help="Same seed, same cases; fresh ones without.")
    parser.add_argument("--cases", type=int, default=CASES, help="Of each group of one effect.")
    parser.add_argument("--shuffled", type=int, default=20, help="Controls.")
    parser.add_argument("--jobs", type=int, default=2, help="Cases at a time.")
    parser.add_argument("--physics", default="bench", help="Or mujoco, where it is installed.")
    parser.add_argument("--keep", type=Path, help="Folder for cases, answers and key.")
    parser.add_argument("--json", action="store_true", help="Plain data for other programs.")
    parser.add_argument("--command", default="sysid reconcile", help="Another solver.")
    asked = parser.parse_args()
    if asked.keep is not None and asked.keep.exists():
        sys.exit(f"{asked.keep} is there already. Name a folder that is not.")
    seed = secrets.randbelow(10**6) if asked.seed is None else asked.seed
    with tempfile.TemporaryDirectory() as cases, tempfile.TemporaryDirectory() as private:
        out, key = Path(cases) / "cases", Path(private) / KEY
        took = _made(asked, seed=seed, out=out, key=key), _solved(asked, out=out)
        answers = json.loads((Path(cases) / "answers.json").read_text(encoding="utf-8"))
        opened = json.loads(key.read_text(encoding="utf-8"))
        if asked.keep is not None:
            _keep(Path(cases), opened, where=asked.keep)
    scored, verdicts = score(answers, opened), controls(answers, opened)
    if asked.json:
        rows = [{**asdict(goal), "met": goal.met} for goal in goals(scored, verdicts)]
        told = {"seed": seed, "goals": rows, "shuffled": verdicts}
        print(json.dumps({**told, "cases": [asdict(one) for one in scored]}))
        return
    print(f"seed {seed}: {len(answers)} cases made in {took[0]:.0f} s, solved in {took[1]:.0f} s")
    print(*lines(scored, verdicts), sep="\n")


def _made(asked: argparse.Namespace, *, seed: int, out: Path, key: Path) -> float:
    """[s] it took to make the cases."""
    words = ["--seed", str(seed), "--cases", str(asked.cases), "--shuffled", str(asked.shuffled)]
    words += ["--jobs", str(asked.jobs), "--physics", asked.physics]
    words += ["--out", str(out), "--key", str(key)]
    return _run("reconcile_cases.py", *words)


def _solved(asked: argparse.Namespace, *, out: Path) -> float:
    """[s] it took to solve them; the key is not among what the solver is told."""
    answers = out.parent / "answers.json"
    words = [str(out), "--out", str(answers), "--jobs", str(asked.jobs)]
    return _run("reconcile_blind.py", *words, "--command", asked.command)


def _run(script: str, *words: str) -> float:
    began = time.perf_counter()
    subprocess.run([sys.executable, str(HERE / script), *words], check=True)
    return time.perf_counter() - began


def _keep(cases: Path, key: Mapping[str, Mapping[str, Any]], *, where: Path) -> None:
    """Cases, answers, and only now the key: of the cases, and of the controls beside them."""
    shutil.copytree(cases / "cases", where)
    shutil.copy(cases / "answers.json", where)
    plain = {name: truth for name, truth in key.items() if not truth["shuffled"]}
    (where / KEY).write_text(json.dumps(plain), encoding="utf-8")
    control = {name.rpartition("/")[2]: truth for name, truth in key.items() if truth["shuffled"]}
    if control:
        (where / "shuffled" / KEY).write_text(json.dumps(control), encoding="utf-8")


if __name__ == "__main__":
    main()
