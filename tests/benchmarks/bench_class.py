"""How long a class takes: ``grade class`` as a whole process, on all cores, and once more.

    python tests/benchmarks/bench_class.py [STUDENTS]

All thirteen exercises, answers right, half right, mistaken and missing (`class_made.py`). The
second run finds everything graded. Processor time is what the run asks of the machine, however busy
that is with other things (Windows does not tell it). Memory is that of the largest process. Aim:
500 students in five minutes.
"""

import json
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import psutil
from bench_grade import loaded, spent
from class_made import ROOT, SECRET, asked, make_class

from sim.support.work.executor import count_available_cores

CORES = count_available_cores()
TARGET = 300.0  # [s] for 500 students
LOOK = 0.5  # [s] between two looks at the memory
CODE = f"import sys; sys.path.insert(0, {str(ROOT)!r}); from grader.cli import main; main()"


def largest(process: psutil.Process) -> int:
    """Bytes of the largest of the processes that a process started, and of itself."""
    sizes = [0]
    for one in [process, *process.children(recursive=True)]:
        try:
            sizes.append(one.memory_info().rss)
        except (psutil.NoSuchProcess, psutil.AccessDenied):
            continue
    return max(sizes)


def grade_class(handed_in: Path, secret: Path, *, only: Sequence[str]) -> tuple[float, int]:
    """Seconds of one whole run, and the bytes of its largest process.

    Raises:
        RuntimeError: it could not grade.
    """
    chosen = [word for name in only for word in ("--exercise", name)]
    options = ["--secret", str(secret), *chosen]
    said = handed_in.with_name("said.txt")
    most, begin = 0, time.perf_counter()
    with said.open("wb") as stream:
        running = psutil.Popen(
            [sys.executable, "-c", CODE, "class", str(handed_in), *options],
            stdout=stream,
            stderr=stream,
            cwd=ROOT,
        )
        while True:
            most = max(most, largest(running))
            try:
                code = running.wait(LOOK)
                break
            except psutil.TimeoutExpired:
                continue
    took = time.perf_counter() - begin
    if code not in {0, 1}:
        raise RuntimeError(said.read_text(encoding="utf-8"))
    return took, most


def outcomes(results: Path) -> Counter[str]:
    """What became of every answer: how many are of each status."""
    kept = [json.loads(path.read_text(encoding="utf-8")) for path in results.glob("*.json")]
    return Counter(record["status"] for one in kept for record in one["grades"])


def main() -> None:
    """Print a table."""
    students = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        secret, handed_in = folder / "secret", folder / "class"
        secret.write_bytes(SECRET)
        kinds = make_class(
            students, course=folder / "course", out=handed_in, processes=count_available_cores()
        )
        said = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
        print(f"{students} students x 13 exercises on {CORES} cores; {said}")
        names = [one.name for one in asked(ROOT)]
        before = spent()
        total, most = grade_class(handed_in, secret, only=names)
        work = spent() - before
        there = sum(1 for _ in handed_in.glob("*/*"))
        results = folder / "class-graded" / "results"
        written = {one: one.stat().st_mtime_ns for one in results.glob("*.json")}
        again, _ = grade_class(handed_in, secret, only=names)
        anew = sum(one.stat().st_mtime_ns != written.get(one) for one in results.glob("*.json"))
        aim = TARGET * students / 500
        print(f"{'everything':36}{total:8.1f} s   aim {aim:.0f} s, {loaded()}")
        became = outcomes(results)
        print("graded: " + ", ".join(f"{count} {one}" for one, count in became.most_common()))
        print(f"{'processor time':36}{work:8.1f} s   {work / CORES:.0f} s on {CORES} cores")
        print(f"{'each of ' + str(there) + ' submissions':36}{1e3 * total / there:8.0f} ms")
        print(f"{'once more':36}{again:8.1f} s   {anew} students graded again")
        print(f"{'largest process':36}{most / 1e6:8.0f} MB")


if __name__ == "__main__":
    main()
