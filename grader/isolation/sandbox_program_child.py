"""The child for a whole program of ours that runs a learner's code: confine, then run it.

What to do comes as one JSON object on standard input. The program is read before the course's own
files are out of reach; what it finds out, it leaves in the folder it is started in.
"""

import importlib.util
import io
import json
import sys
from pathlib import Path
from types import ModuleType

from grader.isolation.sandbox_child import (
    PackageFinder,
    close_input,
    confine_process,
    unload_course_modules,
)


def main() -> None:
    """Run the program that standard input asks for, as if it had been started itself."""
    orders = json.load(sys.stdin)
    close_input()
    sys.stdin = io.StringIO(orders["stdin"])
    script = Path(orders["script"])
    for path in map(Path, orders["beside"]):
        sys.modules[path.stem] = _load_module(path)
    code = compile(script.read_text(encoding="utf-8"), str(script), "exec")
    sys.path[:] = [path for path in sys.path if Path(path) != Path(orders["root"])]
    sys.meta_path.append(PackageFinder(orders["packages"]))
    sys.argv[:] = [str(script), *orders["arguments"]]
    confine_process(orders)
    unload_course_modules()
    exec(code, {"__name__": "__main__", "__file__": str(script)})  # noqa: S102 - ours, and the only way once its file is out of reach


def _load_module(path: Path) -> ModuleType:
    """A file of ours as a module."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path.name} cannot be loaded")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
