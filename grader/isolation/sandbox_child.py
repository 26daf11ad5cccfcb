"""The child: it confines itself, reads the learner's file, calls its functions, prints JSON.

What to do comes as one JSON object on standard input; what came out leaves as lines of JSON on what
was standard output when it started. The learner's own prints go where errors go.
"""

import importlib.util
import json
import os
import sys
import traceback
from collections.abc import Callable, Mapping
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any

from grader.isolation.landlock import restrict_file_access
from grader.isolation.limits import end_with_parent, set_limits
from grader.isolation.seccomp import forbid_syscalls

HERE = Path(__file__).resolve()
MOST_NAMES = 32  # numbers of one answer
LARGEST = 1e300  # beyond it a number is infinite, or soon will be
LONGEST = 200  # [characters] of what is said about anything


def main() -> None:
    """Carry out the orders on standard input."""
    orders = json.load(sys.stdin)
    say = _open_result_stream(orders["nonce"])
    sys.path[:] = [path for path in sys.path if Path(path) != Path(orders["root"])]
    sys.meta_path.append(PackageFinder(orders["packages"]))
    force = confine_process(orders)
    unload_course_modules()
    if orders["arrays"]:
        import numpy as np  # noqa: F401, PLC0415 - before the clock starts; only where it is needed
    say({"ready": force})
    path = Path(orders["source"])
    try:
        module = _load_module(path)
    except BaseException as error:  # noqa: BLE001 - sys.exit too is only an answer that is missing
        say({"crash": _describe_crash(error, path)})
        return
    for number, call in enumerate(orders["calls"]):
        try:
            said: dict[str, object] = {"result": _encode_result(_call_function(module, call))}
        except BaseException as error:  # noqa: BLE001 - the same
            said = {"crash": _describe_crash(error, path)}
        say({"call": number, **said})


def _open_result_stream(nonce: str) -> Callable[[Mapping[str, object]], None]:
    """Keep standard output for the result; prints go to standard error."""
    out = os.dup(1)
    os.dup2(2, 1)
    close_input()
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(line_buffering=True, errors="replace")  # type: ignore[union-attr]  # they are text

    def say(what: Mapping[str, object]) -> None:
        rest = (json.dumps({"nonce": nonce, **what}) + "\n").encode()
        while rest:
            rest = rest[os.write(out, rest) :]

    return say


def close_input() -> None:
    """Replace standard input by an empty file: the learner's code must not read the orders."""
    empty = os.open(os.devnull, os.O_RDONLY)
    os.dup2(empty, 0)
    os.close(empty)


class PackageFinder:
    """Finds the packages a learner may import, and no others that happen to be installed."""

    def __init__(self, places: Mapping[str, str]) -> None:
        self.places = {name: Path(place) for name, place in places.items()}

    def find_spec(
        self, name: str, _path: object = None, _target: object = None
    ) -> ModuleSpec | None:
        """Where a package is, for Python's own import."""
        place = self.places.get(name)
        if place is None:
            return None
        if place.is_file():
            return importlib.util.spec_from_file_location(name, place)
        start = place / "__init__.py"
        if start.is_file():
            return importlib.util.spec_from_file_location(
                name, start, submodule_search_locations=[str(place)]
            )
        spec = ModuleSpec(name, None, is_package=True)  # a folder of packages
        spec.submodule_search_locations = [str(place)]
        return spec


def confine_process(orders: Mapping[str, Any]) -> dict[str, object]:
    """Confine this process, and return which restrictions took effect."""
    end_with_parent()
    readable = [Path(orders["given"])]
    for folder in map(Path, orders["packages"].values()):
        readable += [folder, folder.with_name(f"{folder.name}.libs")]
    hidden = HERE.parents[1]
    asked, confined = orders["limits"], orders["confined"]
    newest = orders["landlock_abi"]
    landlock = confined and restrict_file_access(
        readable=readable, folder=Path.cwd(), hidden=hidden, newest=newest
    )
    limited = set_limits(**asked, processes=True)
    seccomp = confined and forbid_syscalls()
    if not seccomp:  # a filter lets no process start; without it the limit does what it can
        set_limits(**asked, processes=False)
    return {
        "landlock": landlock if _is_source_hidden() else 0,
        "seccomp": seccomp,
        "limited": limited,
    }


def unload_course_modules() -> None:
    """Remove the course's modules from ``sys.modules``."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "grader"]:
        del sys.modules[name]


def _is_source_hidden() -> bool:
    """Whether this program can no longer be read: a try tells more than a promise."""
    try:
        HERE.open("rb").close()
    except PermissionError:
        return True
    return False


def _load_module(path: Path) -> ModuleType:
    module = ModuleType(path.stem)
    module.__file__ = str(path)
    sys.modules[path.stem] = module
    code = compile(path.read_text(encoding="utf-8"), str(path), "exec")
    exec(code, vars(module))  # noqa: S102 - that is what this process is for
    return module


def _call_function(module: ModuleType, call: Mapping[str, Any]) -> object:
    function = getattr(module, call["function"], None)
    if not callable(function):
        raise TypeError(f"there is no function {call['function']}")
    arguments = dict(call["values"])
    if call["arrays"]:
        import numpy as np  # noqa: PLC0415 - only where it is needed

        for name, file in call["arrays"].items():
            arguments[name] = np.load(file, allow_pickle=False)
    return function(**arguments)


def _encode_result(result: object) -> object:
    """The returned value as JSON: numbers as numbers, anything else by its type."""
    if type(result) is not dict:
        return _encode_value(result)
    items = list(result.items())[:MOST_NAMES]
    return {"names": [[str(name)[:LONGEST], _encode_value(value)] for name, value in items]}


def _encode_value(value: object) -> object:
    """A number, or ``{"is": its type, "of": what that is a kind of}``."""
    kind = type(value)
    numpy = sys.modules.get("numpy")
    if numpy is not None and (kind is numpy.ndarray or kind.__module__ == "numpy"):
        shape = getattr(value, "shape", ())
        if shape != ():
            return {"is": "ndarray", "of": str(tuple(shape))}
        value = getattr(value, "item", lambda: None)()
        kind = type(value)
    if value is None or kind is bool:
        return value
    if isinstance(value, int | float) and kind in {int, float}:
        if value != value:  # noqa: PLR0124 - only nan differs from itself
            return "nan"
        return float(value) if abs(value) < LARGEST else "inf"
    if kind is str:
        return {"is": "str", "of": str(value)[:LONGEST]}
    return {"is": kind.__name__, "of": [one.__name__ for one in kind.__mro__[1:-1]]}


def _describe_crash(error: BaseException, path: Path) -> dict[str, object]:
    """Where in the learner's file, and the last line of the traceback."""
    steps = traceback.extract_tb(error.__traceback__)
    lines = [step.lineno for step in steps if step.filename == str(path)]
    line = lines[-1] if lines else None
    if isinstance(error, SyntaxError) and error.filename == str(path):
        line = error.lineno
    last = [text for text in traceback.format_exception_only(error) if text.strip()][-1]
    return {"line": line, "says": last.strip()[: 2 * LONGEST]}
