"""A lesson's notebook, run from top to bottom in a copy of its course that nobody worked in."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from sim.core.errors import BadRequest

COPIED = ("lessons", "exercises", "solutions")
LONGEST_CELL = 120  # [s] after which a cell counts as hung


def execute_notebook(path: Path) -> Any:  # noqa: ANN401 - nbformat has no types
    """Run a notebook; what it shows, and the state of its widgets, is in what comes back.

    Raises:
        BadRequest: it cannot be read, or one of its cells fails.
    """
    import nbformat  # noqa: PLC0415 - only who builds pages needs it
    from nbclient import NotebookClient  # noqa: PLC0415 - the same
    from nbclient.exceptions import CellExecutionError, CellTimeoutError  # noqa: PLC0415 - the same

    notebook = nbformat.read(path, 4)  # type: ignore[no-untyped-call] # nbformat has no types
    course = path.parents[1]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as home:
        client = NotebookClient(
            notebook,
            timeout=LONGEST_CELL,
            kernel_name="python3",
            resources={
                "metadata": {"path": str(_copy_course(course, Path(home)) / path.parent.name)}
            },
        )
        paths = (str(course), os.environ.get("PYTHONPATH", ""))
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "PYTHONIOENCODING": "utf-8",
            "IPYTHONDIR": home,
        }
        try:
            client.execute(env=environment, stderr=subprocess.DEVNULL)  # the kernel's own remarks
        except (CellExecutionError, CellTimeoutError) as error:
            last = str(error).strip().splitlines()[-1]
            raise BadRequest(
                f"a cell of {path.name} fails: {last}",
                where=str(path),
                advice="Run the lesson in JupyterLab to see which.",
            ) from None
    return notebook


def _copy_course(course: Path, to: Path) -> Path:
    """The course without anybody's own data: a page shows what everybody sees."""
    for name in COPIED:
        if (course / name).is_dir():
            left = shutil.ignore_patterns("data", "__pycache__", ".*")
            shutil.copytree(course / name, to / name, ignore=left)
    return to
