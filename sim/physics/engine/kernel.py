"""The compiled engine: compiled by Numba once, then loaded without it.

Numba takes half a second to start, even if it only loads what it compiled before. Its output is
therefore cached as an object file, which LLVM loads by itself in 40 ms. A file of another
processor, a damaged one, and one with a missing symbol are not loaded. If a new file does not work
when a child process tries it, an empty file replaces it, and from then on Numba with its own cache
is used.
"""

import ctypes
import hashlib
import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from sim.core.log import Array
from sim.physics.engine.machine_code import ObjectCode, extract_code, identify_machine, link_code
from sim.support.work import cache

KEPT = 4  # engines that stay in the cache
DOUBLE = np.dtype(np.float64)
INTEGER, POINTER = ctypes.c_int64, ctypes.c_void_p
BYTES = ctypes.c_char * 0
SIGNATURE = ctypes.CFUNCTYPE(  # of the function that `_entry_lines` in compose.py writes
    None, *[INTEGER] * 4, *[POINTER] * 18, INTEGER, *[POINTER] * 4
)
NO_USE = b""  # content of the file if object files do not work here
TIMEOUT = 60  # [s] of a trial that takes a tenth
ROOM = 1000  # more numbers than any array of fixed length has
TRIAL = (
    "import sys, pathlib, sim.physics.engine.kernel as it; "
    "it.try_kernel_file(pathlib.Path(sys.argv[1]))"
)


class Kernel:
    """The compiled integrator, called with arrays.

    Args:
        address: address of the machine code.
        alive: the object that owns the code, which must not be freed while it is called.
    """

    def __init__(self, address: int, alive: object) -> None:
        self._call = SIGNATURE(address)
        self._alive = alive

    def move(
        self, edges: Array, time: Array, commanded: Array, slides: Array, bodies: Array,
        low: Array, high: Array, frictions: Array, run_lags: Array, memory_groups: Array, c: Array,
        w: Array, on: Array, p: Array, memory: Array, tables: Array, start_times: Array,
        steps: Array, base_only: bool, measured: Array, kalman_gains: Array, errors: Array,
        out: Array,
    ) -> None:  # fmt: skip
        """Simulate runs; the arguments are those of ``stepping.step_runs``.

        Raises:
            TypeError: an array is not contiguous, not of doubles, or has a wrong length. The
                machine code would read it wrongly without an error.
        """
        n, count = time.size, start_times.size
        rows = len(measured)
        if {commanded.size, slides.size, len(out)} != {n} or rows not in {0, n}:
            raise TypeError("arrays of the same runs are of one length")
        if errors.shape != measured.shape:
            raise TypeError("each measurement has its innovation")
        if kalman_gains.shape[1:] != (4,) or len(kalman_gains) not in {min(rows, 1), rows}:
            raise TypeError("each measurement has four gains, or all have the same")
        each = low.size, high.size, frictions.size, run_lags.size, memory_groups.size
        if {len(bodies), *each, edges.size - 1} != {count}:
            raise TypeError("there is one of everything for each run")
        if count and not (edges[0] == 0 and edges[-1] == n and (edges[1:] >= edges[:-1]).all()):
            raise TypeError("runs lie one behind the other")
        self._call(
            count, n, rows, len(kalman_gains), _get_address(edges), _get_address(time),
            _get_address(commanded), _get_address(slides), _get_address(bodies),
            _get_address(low), _get_address(high), _get_address(frictions),
            _get_address(run_lags), _get_address(memory_groups), _get_address(c), _get_address(w),
            _get_address(on), _get_address(p), _get_address(memory), _get_address(tables),
            _get_address(start_times), _get_address(steps), base_only, _get_address(measured),
            _get_address(kalman_gains), _get_address(errors), _get_address(out),
        )  # fmt: skip


def _get_address(array: Array) -> int:
    """The address of an array's data.

    Raises:
        TypeError: the array is not contiguous, or not of doubles.
    """
    flags = array.flags
    if array.dtype != DOUBLE or not flags.c_contiguous:
        raise TypeError("the engine reads and writes doubles that lie in one piece")
    if flags.writeable:  # four times as fast, which matters for short runs
        return ctypes.addressof(BYTES.from_buffer(array.data))
    address: int = array.__array_interface__["data"][0]
    return address


def find_kernel_file(folder: Path, seal: str) -> Path:
    """The cache file for the machine code of an engine on this processor.

    Args:
        folder: the cache.
        seal: hash of the engine's text.
    """
    own = hashlib.sha256(f"{seal}\n{identify_machine()}".encode()).hexdigest()[:20]
    return folder / f"sysid_engine_{own}.kernel"


def load_kernel(text: str, kept: Path) -> Kernel:
    """The kernel of an engine: loaded from the cache, or compiled and cached.

    Args:
        text: source of the engine's module.
        kept: the cache file, from ``find_kernel_file``.
    """
    content = cache.read_cached(kept)
    code = ObjectCode.from_bytes(content) if content else None
    if code is not None and (found := link_code(code)):
        return Kernel(*found)
    if content == NO_USE:
        made = _compile_file(text, kept)
    else:
        made = _compile_text(text)
        _store_code(extract_code(made), kept)
    return Kernel(made.address, made)


def _compile_text(text: str) -> Any:  # noqa: ANN401 - Numba has no types
    """The function ``move``, compiled by Numba: a ``numba.core.ccallback.CFunc``."""
    module = ModuleType("sysid_engine")
    exec(compile(text, "sysid_engine", "exec"), module.__dict__)  # noqa: S102 - our own text
    return module.move


def _compile_file(text: str, kept: Path) -> Any:  # noqa: ANN401 - Numba has no types
    """The compiled ``move`` from a source file, so that Numba can use its own cache."""
    name = kept.stem
    try:
        path = _write_source(kept.parent / f"{name}.py", text)
    except OSError:  # a home that cannot be written to: compiled anew each time
        path = _write_source(Path(tempfile.mkdtemp(prefix="sysid-")) / f"{name}.py", text)
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module.move


def _write_source(path: Path, text: str) -> Path:
    """Write the module's file unless it exists; returns its path."""
    if not path.exists():
        cache.write_cached(path, text.encode())
    return path


def _store_code(code: ObjectCode, kept: Path) -> None:
    """Cache the object code, or an empty file if another process cannot use it."""
    try:
        cache.write_cached(kept, code.to_bytes())
        if not _works_in_child(kept):
            cache.write_cached(kept, NO_USE)
        _remove_old_kernels(kept.parent)
    except OSError:  # a home that cannot be written to: compiled anew each time
        return


def _works_in_child(kept: Path) -> bool:
    """Whether a child process can load and call it: LLVM ends a process that cannot link it."""
    try:
        done = subprocess.run(  # noqa: S603 - the running Python, with our own program
            [sys.executable, "-c", TRIAL, str(kept)],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            capture_output=True,
            timeout=TIMEOUT,
            check=False,
        )
    except (OSError, subprocess.SubprocessError):
        return False
    return done.returncode == 0


def _remove_old_kernels(where: Path) -> None:
    """Remove all but the newest engines from the cache, with Numba's files for them."""
    for old in cache.select_older(where.glob("sysid_engine_*.kernel"), than=KEPT):
        compiled = where.glob(f"__pycache__/{old.stem}.*")
        cache.remove_files((old, old.with_suffix(".py"), *compiled))


def try_kernel_file(kept: Path) -> None:
    """Test a cached kernel by calling it with no runs; a broken one ends the process."""
    code = ObjectCode.from_bytes(kept.read_bytes())
    found = link_code(code) if code is not None else None
    if found is None:
        sys.exit(1)
    none, some = np.zeros((0, 2)), np.zeros(ROOM)
    of_runs = ("low", "high", "frictions", "run_lags", "memory_groups", "start_times")
    runs = dict.fromkeys(("time", "commanded", "slides", *of_runs), none[:, 0])
    model = dict.fromkeys(("c", "w", "on", "p", "memory", "tables", "steps"), some)
    Kernel(*found).move(
        edges=np.zeros(1), bodies=np.zeros((0, 5)), **runs, **model, base_only=True,
        measured=none, kalman_gains=np.zeros((0, 4)), errors=none, out=none,
    )  # fmt: skip
