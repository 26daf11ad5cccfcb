"""How long a dataset takes, and how much memory: seconds, files a second, most memory at a time.

    python tests/benchmarks/bench_dataset.py [LOGS] [PROCESSES] [cluster]

With ``cluster``, the workers of a Dask cluster on this machine make the logs, too: PROCESSES
workers of one thread, which must make the same files. Memory is then that of the command alone.

The whole command as a person runs it, from its start to the sealed key: logs of four tests (34 s of
a robot's time) as WPILOG, each of another mechanism, once plain and once with effects hidden and
faults made. Memory is that of all its processes together, counted once where they share it.
"""

import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path

import psutil

ROUTINE = "[routine]\nramp = 0.5\nstep = 3.5\ntimeout = 10.0\n"
PLAIN = '[[logs]]\nmechanisms = ["drivetrain", "shooter"]\ncount = {count}\n'
DAMAGED = """
[[logs.effects]]
name = ["stribeck", "asymmetric-friction"]
size = [0.5, 2.0]
[[logs.effects]]
name = "velocity-filter"
chance = 0.5
[[logs.faults]]
name = ["encoder-slip", "loop-overrun", "sign-flip"]
severity = [0.5, 1.5]
"""
KINDS = {"plain": PLAIN, "effects and faults": PLAIN + DAMAGED}
TARGET = 60.0  # [s] for 1,000 logs on two cores
MOST = 1e9  # [bytes]
LOOK = 0.2  # [s] between two looks at the memory


def memory(process: psutil.Process) -> int:
    """Bytes that a process and those it started hold now; less exact where a system tells less."""
    total = 0
    for one in [process, *process.children(recursive=True)]:
        try:
            full = one.memory_full_info()
            total += getattr(full, "pss", full.uss)
        except (psutil.NoSuchProcess, psutil.AccessDenied):
            continue
    return total


def measured(text: str, *, asked: Sequence[str]) -> tuple[float, int, dict[str, str]]:
    """Seconds, most bytes, and the digest of each file of one dataset, by its name.

    Args:
        text: the logs of the specification.
        asked: options of the command.
    """
    with tempfile.TemporaryDirectory() as folder:
        spec = Path(folder) / "spec.toml"
        spec.write_text(f'name = "benchmark"\nseed = 1\n{ROUTINE}{text}', encoding="utf-8")
        start = time.perf_counter()
        running = psutil.Popen(
            [
                *(sys.executable, "-c", "from sim.cli import main; main()"),
                *("dataset", str(spec), "-o", f"{folder}/data", *asked),
            ],
            stdout=subprocess.DEVNULL,
        )
        most = 0
        while running.poll() is None:
            most = max(most, memory(running))
            time.sleep(LOOK)
        taken = time.perf_counter() - start
        if running.returncode:
            sys.exit(f"the command ended with {running.returncode}")
        there = Path(folder, "data").iterdir()
        return taken, most, {path.name: sha256(path.read_bytes()).hexdigest() for path in there}


def report(name: str, found: tuple[float, int, dict[str, str]], more: str) -> None:
    """Print one line."""
    taken, most, files = found
    print(
        f"{name:20} {len(files):6} files   {taken:7.2f} s   {len(files) / taken:7.0f} files/s   "
        f"{most / 1e6:6.0f} MB{more}",
        flush=True,
    )


def main() -> None:
    """Print one line for each kind of dataset, and another for the cluster."""
    words = [one for one in sys.argv[1:] if one != "cluster"]
    logs, processes = ([int(text) for text in words] + [1000, 2][len(words) :])[:2]
    goal = f"   target {TARGET:g} s, {MOST / 1e6:g} MB" if (logs, processes) == (1000, 2) else ""
    for name, text in KINDS.items():
        made = text.format(count=logs // 2)
        here = measured(made, asked=("--processes", str(processes)))
        report(name, here, f"   {processes} processes{goal}")
        if "cluster" in sys.argv:
            from distributed import LocalCluster  # noqa: PLC0415 - an extra

            with LocalCluster(
                n_workers=processes, threads_per_worker=1, dashboard_address="127.0.0.1:0"
            ) as found:
                there = measured(made, asked=("--cluster", found.scheduler_address))
            same = "the same files" if here[2] == there[2] else "OTHER files"
            report(name, there, f"   {processes} workers of a cluster: {same}")


if __name__ == "__main__":
    main()
