"""How long a dataset takes, and how much memory: seconds, files a second, most memory at a time.

    python tests/benchmarks/bench_dataset.py [LOGS] [PROCESSES]

The whole command as a person runs it, from its start to the sealed key: logs of four tests (34 s of
a robot's time) as WPILOG, each of another mechanism, once plain and once with effects hidden and
faults made. Memory is that of all its processes together, counted once where they share it.
"""

import subprocess
import sys
import tempfile
import time
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


def measured(text: str, *, processes: int) -> tuple[float, int, int]:
    """Seconds, most bytes, and number of files of one dataset.

    Args:
        text: the logs of the specification.
        processes: so many make it.
    """
    with tempfile.TemporaryDirectory() as folder:
        spec = Path(folder) / "spec.toml"
        spec.write_text(f'name = "benchmark"\nseed = 1\n{ROUTINE}{text}', encoding="utf-8")
        start = time.perf_counter()
        running = psutil.Popen(
            [
                *(sys.executable, "-c", "from sim.cli import main; main()"),
                *("dataset", str(spec), "-o", f"{folder}/data", "--processes", str(processes)),
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
        return taken, most, len(list(Path(folder, "data").iterdir()))


def main() -> None:
    """Print one line for each kind of dataset."""
    words = sys.argv[1:]
    logs, processes = ([int(text) for text in words] + [1000, 2][len(words) :])[:2]
    goal = f"   target {TARGET:g} s, {MOST / 1e6:g} MB" if (logs, processes) == (1000, 2) else ""
    for name, text in KINDS.items():
        taken, most, files = measured(text.format(count=logs // 2), processes=processes)
        print(
            f"{name:20} {files:6} files   {taken:7.2f} s   {files / taken:7.0f} files/s   "
            f"{most / 1e6:6.0f} MB   {processes} processes{goal}",
            flush=True,
        )


if __name__ == "__main__":
    main()
