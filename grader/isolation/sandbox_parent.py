"""The parent's side: start the child, send it the data, limit its time, read its output, end it."""

import contextlib
import importlib.util
import json
import os
import secrets
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, TYPE_CHECKING, cast

from grader.isolation.landlock import SCOPE_ABI
from grader.isolation.result_parsing import CallResult, ParsedResults, parse_results
from grader.isolation.scratch import scratch_folder

if TYPE_CHECKING:
    import numpy as np

ROOT = Path(__file__).resolve().parents[2]  # where the package grader is found
START = (
    f"import sys; sys.path.insert(0, {str(ROOT)!r}); "
    "from grader.isolation.sandbox_child import main; main()"
)
PYTHON = (sys.executable, "-I", "-S", "-B", "-X", "utf8", "-c")  # none of a user's own settings
CONFINED = True  # False leaves only limits, as where a system has no more: to see that they do
LANDLOCK_ABI: int | None = None  # at most; a number confines as an older kernel would, for tests
KEPT = ("SYSTEMROOT", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")  # without them no Python may start
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
UNTIL_READY = 60.0  # [s] for Python and numpy to load, which on a cold disk takes long
LAST_WORDS = 1.0  # [s] for what is left in the pipes of a process that has ended
PIECE = 65536  # [bytes]


@dataclass(frozen=True)
class FunctionCall:
    """One call of a function of the learner's.

    Args:
        function: its name.
        data: name of the argument -> an array, or a number or a text.
    """

    function: str
    data: Mapping[str, "np.ndarray[tuple[int, ...], np.dtype[np.generic]] | float | str"] = field(
        default_factory=dict
    )


@dataclass(frozen=True)
class Limits:
    """Limits of a child process: time, memory, output.

    Args:
        seconds: [s] for all calls together, by the clock on the wall and of the processor.
        memory: [bytes] of address space; numpy and scipy need a quarter of this.
        file: [bytes] of one file it writes.
        prints: [bytes] of its own prints that are kept.
        numbers: [bytes] of what it answers.
    """

    seconds: float = 10.0
    memory: int = 2 * 1024**3
    file: int = 16 * 1024**2
    prints: int = 4000
    numbers: int = 64 * 1024

    def make_child_limits(self) -> dict[str, int]:
        """The limits that the child sets for itself: processor time [s] and memory [bytes]."""
        return {"seconds": int(self.seconds) + 1, "memory": self.memory, "file": self.file}


@dataclass(frozen=True)
class SandboxOutcome:
    """The outcome of running a learner's code.

    Args:
        answers: one for each call, in order; those before an untimely end are kept.
        ended: why it ended before the last call; empty if it did not.
        printed: what it printed, as far as it was kept, and how much was not.
        level: what confined it, in words.
        seconds: [s] from start to end.
    """

    answers: tuple[CallResult, ...]
    ended: str
    printed: str
    level: str
    seconds: float


def run_functions(
    source: Path,
    *,
    calls: Sequence[FunctionCall],
    limits: Limits = Limits(),
    packages: Sequence[str] = ("numpy",),
) -> SandboxOutcome:
    """Run functions of a learner's file in a process of their own.

    Args:
        source: the file.
        calls: what to call, in order; each stands alone: one that fails stops no other.
        limits: how much it may take.
        packages: which installed packages it may import, besides Python's own.
    """
    begin = time.monotonic()
    nonce = secrets.token_hex(16)
    with scratch_folder() as made:
        given, work = made / "given", made / "work"
        given.mkdir()
        work.mkdir()
        orders = {
            "nonce": nonce,
            "root": str(ROOT),
            "confined": CONFINED,
            "landlock_abi": LANDLOCK_ABI,
            "packages": find_package_paths(packages),
            **_write_orders(source, calls, given),
            "limits": limits.make_child_limits(),
        }
        child = _Child(orders, work=work, limits=limits)
        ended = child.watch(limits.seconds)
    received = parse_results(child.said.kept, nonce=nonce, file=source.name)
    return _make_outcome(received, calls, ended, child, time.monotonic() - begin)


def find_isolation_level() -> str:
    """What confines a learner's code on this system: tried, not assumed."""
    with tempfile.TemporaryDirectory() as made:
        probe = Path(made, "probe.py")
        probe.write_text("def probe():\n    return {}\n", encoding="utf-8")
        return run_functions(probe, calls=[FunctionCall("probe")]).level


def find_package_paths(packages: Sequence[str]) -> dict[str, str]:
    """Package -> its folder, or its only file, of those that are installed."""
    specs = {name: importlib.util.find_spec(name) for name in packages}
    found: dict[str, str] = {}
    for name, spec in specs.items():
        if spec is not None and spec.submodule_search_locations:
            found[name] = next(iter(spec.submodule_search_locations))
        elif spec is not None and spec.has_location and spec.origin:
            found[name] = spec.origin
    return found


def _write_orders(source: Path, calls: Sequence[FunctionCall], given: Path) -> dict[str, object]:
    """Copy the source and the arrays into a folder; returns the orders to the child."""
    copy = given / source.name
    copy.write_bytes(source.read_bytes())
    orders: list[dict[str, object]] = []
    for number, call in enumerate(calls):
        arrays: dict[str, str] = {}
        values: dict[str, object] = {}
        for name, value in call.data.items():
            if isinstance(value, int | float | str):
                values[name] = value
            else:
                import numpy as np  # noqa: PLC0415 - only where there are arrays

                file = given / f"{number}-{name}.npy"
                np.save(file, value, allow_pickle=False)
                arrays[name] = str(file)
        orders.append({"function": call.function, "arrays": arrays, "values": values})
    some = any(one["arrays"] for one in orders)
    return {"source": str(copy), "given": str(given), "calls": orders, "arrays": some}


class _Pipe:
    """Reads a pipe to its end and keeps the first bytes of it."""

    def __init__(self, stream: IO[bytes], *, most: int, line: Callable[[], None]) -> None:
        self.kept, self.dropped = b"", 0
        self.stream, self.most, self.line = stream, most, line
        self.thread = threading.Thread(target=self._read, daemon=True)
        self.thread.start()

    def _read(self) -> None:
        while piece := os.read(self.stream.fileno(), PIECE):
            room = self.most - len(self.kept)
            self.kept += piece[:room]
            self.dropped += len(piece[room:])
            if b"\n" in piece:
                self.line()
        self.line()


class _Child:
    """The process, from its start to its end."""

    def __init__(self, orders: Mapping[str, object], *, work: Path, limits: Limits) -> None:
        self.process = subprocess.Popen(  # noqa: S603 - our own Python and our own program
            [*PYTHON, START],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=work,
            env=make_child_environment(work),
            start_new_session=True,
        )
        into, said, printed = (
            cast("IO[bytes]", pipe)  # all three were asked for
            for pipe in (self.process.stdin, self.process.stdout, self.process.stderr)
        )
        self.ready = threading.Event()
        self.said = _Pipe(said, most=limits.numbers, line=self.ready.set)
        self.printed = _Pipe(printed, most=limits.prints, line=_do_nothing)
        with contextlib.suppress(OSError):  # one that has ended reads no orders
            into.write(json.dumps(orders).encode())
            into.close()

    def watch(self, seconds: float) -> str:
        """Wait for the child, or end it at the limit; the reason if it ended abnormally."""
        ended = ""
        try:
            self.ready.wait(UNTIL_READY)
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            ended = f"it was still running after {seconds:g} s and was stopped"
        finally:
            self._end_child()
        return ended or _explain_end(self.process.returncode)

    def _end_child(self) -> None:
        """End the child and all its processes, and read the rest of its pipes."""
        end_session(self.process)
        for pipe in (self.said, self.printed):
            pipe.thread.join(LAST_WORDS)
            if not pipe.thread.is_alive():
                pipe.stream.close()


def end_session(process: "subprocess.Popen[bytes]") -> None:
    """End a process that was started in a session of its own, and all that it started."""
    if sys.platform != "win32":
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()
    process.wait()


def _do_nothing() -> None:
    pass


def make_child_environment(work: Path) -> dict[str, str]:
    """The few environment variables of a child, whose home is its own folder."""
    kept = {name: os.environ[name] for name in KEPT if name in os.environ}
    own = dict.fromkeys(("HOME", "TMPDIR", "TEMP", "TMP"), str(work))
    return {**kept, **own, **dict.fromkeys(THREADS, "1")}


def _explain_end(code: int) -> str:
    """Why a process ended, by its code; nothing if it ended as it should."""
    if code >= 0:
        return "" if code == 0 else f"your code ended the program, with exit code {code}"
    if -code == getattr(signal, "SIGXCPU", None):
        return "it took too much of the processor's time and was stopped"
    name = signal.Signals(-code).name
    return f"the system stopped it ({name})"


def _make_outcome(
    received: ParsedResults,
    calls: Sequence[FunctionCall],
    ended: str,
    child: _Child,
    seconds: float,
) -> SandboxOutcome:
    missing = received.crash or ended or "your code ended the program before it gave an answer"
    answers = tuple(
        received.answers.get(number, CallResult(reason=missing)) for number in range(len(calls))
    )
    whole = len(received.answers) == len(calls)
    printed = child.printed.kept.decode("utf-8", errors="replace")
    if child.printed.dropped:
        printed += f"\n… and {child.printed.dropped:,} bytes more, which were dropped"
    said = "" if whole else missing
    return SandboxOutcome(answers, said, printed, _describe_level(received.force), seconds)


def _describe_level(force: Mapping[str, object] | None) -> str:
    """What confined the child, in words."""
    if force is None:
        return "not started"
    version, filtered = force.get("landlock"), force.get("seccomp") is True
    if isinstance(version, int) and 0 < version < SCOPE_ABI and not filtered:
        return (
            f"limited: no files (Landlock ABI {version}); but it can stop other programs of yours"
        )
    if version:
        calls = "system calls filtered" if filtered else "it may start processes"
        return f"isolated (Landlock ABI {version}, {calls})"
    if filtered:
        return "limited: no network, no processes; but it can read files"
    limited = force.get("limited")
    named = ["time", *(limited if isinstance(limited, list) else []), "output"]
    words = [name for name in dict.fromkeys(named) if name != "processor time"]
    return f"limited: {', '.join(words)} only; it can read files and reach the network"
