"""What `sysid fit --json` takes as a command: processor time and memory of the whole process.

    python tests/benchmarks/bench_command.py [REPETITIONS]

Once for four tests of 500 samples, once for a match's log of 125 MB that has 300 other entries
around the same tests. Python keeps its compiled modules, as it does for an installed package. The
least and the median are printed, and the load of the machine: processor time grows where others use
the same caches.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import psutil
from bench_fit import log

from sim.io import write
from sim.io.formats.wpilog.control import Start, make_start_payload

COMMAND = "from sim.cli import main; main()"
SIZE = 125_000_000  # [bytes]
OTHERS = ["double"] * 180 + ["boolean", "int64", "float", "string", "double[]"] * 20 + ["raw"] * 20
LENGTH = {"double": 8, "boolean": 1, "int64": 8, "float": 4, "string": 12}
LONG = 32  # [bytes] of any other type
START = 20_000_000  # [µs] when a robot has started up
FIRST_ID = 1000  # of the other entries
TARGETS = {"4 x 500": (0.25, None), "match": (1.2, 200e6)}


def record(number: int, payload: bytes) -> bytes:
    """A record with an id of two bytes, a size of one and a time of four."""
    head = bytes([0b0011_0001]) + number.to_bytes(2, "little") + len(payload).to_bytes(1, "little")
    return head + START.to_bytes(4, "little") + payload


def match_log(path: Path, own: bytes, *, size: float = SIZE) -> Path:
    """A file of a size [bytes] with the records of another one in its middle."""
    first = 12 + int.from_bytes(own[8:12], "little")
    pieces = [own[:first]]
    for number, kind in enumerate(OTHERS, FIRST_ID):
        pieces.append(record(0, make_start_payload(Start(number, f"NT:/x/{number}", kind, ""))))
    loop = [record(n, b" " * LENGTH.get(kind, LONG)) for n, kind in enumerate(OTHERS, FIRST_ID)]
    block = b"".join(loop)
    count = int(size) // len(block)
    with path.open("wb") as stream:
        stream.write(b"".join(pieces))
        for number in range(count):
            stream.write(own[first:] if number == count // 2 else block)
    return path


def measured(path: Path) -> tuple[float, float]:
    """Processor seconds and most bytes of one command."""
    arguments = [sys.executable, "-c", COMMAND, "fit", "--json", str(path)]
    compiled = {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(path.parent)}
    before = os.times()
    with subprocess.Popen(
        arguments, stdout=subprocess.DEVNULL, env={**os.environ, **compiled}
    ) as running:
        most, process = 0.0, psutil.Process(running.pid)
        while running.poll() is None:
            try:
                most = max(most, float(process.memory_info().rss))
            except psutil.NoSuchProcess:
                break
            time.sleep(0.02)
    after = os.times()
    used = after.children_user + after.children_system
    return used - before.children_user - before.children_system, most


def main() -> None:
    """Print one line for each file."""
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    with tempfile.TemporaryDirectory() as folder:
        paths = {"4 x 500": Path(folder, "four.wpilog"), "match": Path(folder, "match.wpilog")}
        write(log(500), paths["4 x 500"])
        match_log(paths["match"], paths["4 x 500"].read_bytes())
        for name, path in paths.items():
            measured(path)
            taken, most = zip(*(measured(path) for _ in range(repetitions)), strict=True)
            seconds, memory = TARGETS[name]
            goal = f"   target {seconds:g} s" + (f", {memory / 1e6:g} MB" if memory else "")
            print(
                f"{name:10} {path.stat().st_size / 1e6:6.1f} MB   least {min(taken):.2f} s   "
                f"median {median(taken):.2f} s   {max(most) / 1e6:4.0f} MB{goal}   "
                f"load {psutil.getloadavg()[0]:.1f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
