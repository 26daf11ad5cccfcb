"""The compiled engine: compiled by Numba once, then loaded without it.

Numba takes half a second to start, even where all it does is to load what it compiled before. What
it made is therefore kept as an object file, which LLVM loads by itself in 40 ms. A file that is
strange - of another processor, with a damaged byte, with a symbol that is not there - is not
loaded. Where a new one does not work in a process of its own, an empty file says so from then on,
and Numba with its own cache does the work.
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

KEPT = 4  # engines of other versions that stay in the cache
NUMBER = np.dtype(np.float64)
INTEGER, PLACE = ctypes.c_int64, ctypes.c_void_p
BYTES = ctypes.c_char * 0
CALLED = ctypes.CFUNCTYPE(  # as `_entry` in compose.py says it
    None, *[INTEGER] * 4, *[PLACE] * 18, INTEGER, *[PLACE] * 4
)
NO_USE = b""  # what is kept where object files were tried, and do not work
PATIENCE = 60  # [s] for one that takes a tenth
ROOM = 1000  # numbers, more than any array of fixed length has
TRIAL = (
    "import sys, pathlib, sim.physics.engine.kernel as it; "
    "it.try_kernel_file(pathlib.Path(sys.argv[1]))"
)


class Kernel:
    """The compiled stepping, called with arrays.

    Args:
        address: of the machine code.
        alive: what must not be freed as long as it is called.
    """

    def __init__(self, address: int, alive: object) -> None:
        self._call = CALLED(address)
        self._alive = alive

    def move(
        self, edges: Array, time: Array, asked: Array, slides: Array, bodies: Array,
        low: Array, high: Array, frictions: Array, run_lags: Array, memory_groups: Array, c: Array,
        w: Array, on: Array, p: Array, memory: Array, ways: Array, began: Array, steps: Array,
        plain: bool, measured: Array, trust: Array, errors: Array, out: Array,
    ) -> None:  # fmt: skip
        """Simulate runs; the arguments are those of ``stepping.step_runs``.

        Raises:
            TypeError: an array does not lie in one piece, of the numbers that the machine code
                reads: it would be read wrongly, without a word.
        """
        n, count = time.size, began.size
        rows = len(measured)
        if {asked.size, slides.size, len(out)} != {n} or rows not in {0, n}:
            raise TypeError("arrays of the same runs are of one length")
        if errors.shape != measured.shape:
            raise TypeError("each measurement has its innovation")
        if trust.shape[1:] != (4,) or len(trust) not in {min(rows, 1), rows}:
            raise TypeError("each measurement has four gains, or all have the same")
        each = low.size, high.size, frictions.size, run_lags.size, memory_groups.size
        if {len(bodies), *each, edges.size - 1} != {count}:
            raise TypeError("there is one of everything for each run")
        if count and not (edges[0] == 0 and edges[-1] == n and (edges[1:] >= edges[:-1]).all()):
            raise TypeError("runs lie one behind the other")
        self._call(
            count, n, rows, len(trust), _place(edges), _place(time), _place(asked), _place(slides),
            _place(bodies), _place(low), _place(high), _place(frictions), _place(run_lags),
            _place(memory_groups), _place(c), _place(w), _place(on), _place(p), _place(memory),
            _place(ways), _place(began), _place(steps), plain, _place(measured),
            _place(trust), _place(errors), _place(out),
        )  # fmt: skip


def _place(array: Array) -> int:
    """Where an array's numbers lie."""
    flags = array.flags
    if array.dtype != NUMBER or not flags.c_contiguous:
        raise TypeError("the engine reads and writes doubles that lie in one piece")
    if flags.writeable:  # four times as fast, which a search with short runs notices
        return ctypes.addressof(BYTES.from_buffer(array.data))
    place: int = array.__array_interface__["data"][0]
    return place


def find_kernel_file(folder: Path, seal: str) -> Path:
    """The file in which the machine code of an engine is kept for this processor.

    Args:
        folder: the cache.
        seal: of the engine's text.
    """
    own = hashlib.sha256(f"{seal}\n{identify_machine()}".encode()).hexdigest()[:20]
    return folder / f"sysid_engine_{own}.kernel"


def load_kernel(text: str, kept: Path) -> Kernel:
    """The kernel of an engine: what was kept, or else compiled, and kept if it can be.

    Args:
        text: of the module, as composed.
        kept: where it is kept.
    """
    content = cache.read_cached(kept)
    code = ObjectCode.from_bytes(content) if content else None
    if code is not None and (found := link_code(code)):
        return Kernel(*found)
    if content == NO_USE:
        made = _of_file(text, kept)
    else:
        made = _of_memory(text)
        _keep(extract_code(made), kept)
    return Kernel(made.address, made)


def _of_memory(text: str) -> Any:  # noqa: ANN401 - Numba has no types
    """What Numba compiles, a ``numba.core.ccallback.CFunc``."""
    module = ModuleType("sysid_engine")
    exec(compile(text, "sysid_engine", "exec"), module.__dict__)  # noqa: S102 - our own text
    return module.move


def _of_file(text: str, kept: Path) -> Any:  # noqa: ANN401 - Numba has no types
    """The same from a file, beside which Numba keeps what it compiled."""
    name = kept.stem
    try:
        path = _written(kept.parent / f"{name}.py", text)
    except OSError:  # a home that cannot be written to: compiled anew each time
        path = _written(Path(tempfile.mkdtemp(prefix="sysid-")) / f"{name}.py", text)
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module.move


def _written(path: Path, text: str) -> Path:
    """The module's file, whole."""
    if not path.exists():
        cache.write_cached(path, text.encode())
    return path


def _keep(code: ObjectCode, kept: Path) -> None:
    """Keep it; where another process does not get along with it, an empty file says so."""
    try:
        cache.write_cached(kept, code.to_bytes())
        if not _works(kept):
            cache.write_cached(kept, NO_USE)
        _forget_old(kept.parent)
    except OSError:  # a home that cannot be written to: compiled anew each time
        return


def _works(kept: Path) -> bool:
    """Whether a process of its own can load and call it: LLVM ends one that it cannot link."""
    try:
        done = subprocess.run(  # noqa: S603 - this very Python, with a text of ours
            [sys.executable, "-c", TRIAL, str(kept)],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            capture_output=True,
            timeout=PATIENCE,
            check=False,
        )
    except (OSError, subprocess.SubprocessError):
        return False
    return done.returncode == 0


def _forget_old(where: Path) -> None:
    """Leave the newest few engines, with what was compiled for them."""
    for old in cache.select_older(where.glob("sysid_engine_*.kernel"), than=KEPT):
        beside = where.glob(f"__pycache__/{old.stem}.*")
        cache.remove_files((old, old.with_suffix(".py"), *beside))


def try_kernel_file(kept: Path) -> None:
    """Test a cached kernel by calling it with no runs; a broken one ends the process."""
    code = ObjectCode.from_bytes(kept.read_bytes())
    found = link_code(code) if code is not None else None
    if found is None:
        sys.exit(1)
    none, some = np.zeros((0, 2)), np.zeros(ROOM)
    runs = dict.fromkeys(
        (
            "time",
            "asked",
            "slides",
            "low",
            "high",
            "frictions",
            "run_lags",
            "memory_groups",
            "began",
        ),
        none[:, 0],
    )
    model = dict.fromkeys(("c", "w", "on", "p", "memory", "ways", "steps"), some)
    Kernel(*found).move(
        edges=np.zeros(1), bodies=np.zeros((0, 5)), **runs, **model, plain=True,
        measured=none, trust=np.zeros((0, 4)), errors=none, out=none,
    )  # fmt: skip
