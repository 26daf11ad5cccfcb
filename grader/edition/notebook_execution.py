"""A lesson's notebook, run from top to bottom in a copy of its course that nobody worked in."""

import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grader.fingerprint import PACKAGES, list_authored_files
from sim.core.errors import BadRequest
from sim.support.atomic_file import write_atomically

COPIED = ("lessons", "exercises", "solutions")
LONGEST_CELL = 120  # [s] after which a cell counts as hung
MADE_FROM = "made_from"  # in a kept notebook's metadata: the digest of what its outputs depend on


def execute_notebook(
    path: Path, *, environment: Mapping[str, str] | None = None, allow_errors: bool = False
) -> Any:  # noqa: ANN401 - nbformat has no types
    """Execute a notebook; the result holds its outputs and the state of its widgets.

    Args:
        path: of the notebook, in the folder ``lessons`` of a course.
        environment: further variables for its kernel.
        allow_errors: go on after a cell that fails; its error is its output.

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
            allow_errors=allow_errors,
            resources={
                "metadata": {"path": str(_copy_course(course, Path(home)) / path.parent.name)}
            },
        )
        paths = (str(course), os.environ.get("PYTHONPATH", ""))
        variables = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "PYTHONIOENCODING": "utf-8",
            "IPYTHONDIR": home,
            **(environment or {}),
        }
        try:
            client.execute(env=variables, stderr=subprocess.DEVNULL)  # the kernel's own remarks
        except (CellExecutionError, CellTimeoutError) as error:
            last = str(error).strip().splitlines()[-1]
            raise BadRequest(
                f"a cell of {path.name} fails: {last}",
                where=str(path),
                advice="Run the lesson in JupyterLab to see which.",
            ) from None
    return notebook


def keep_notebook(notebook: Any, path: Path, *, folder: Path) -> None:  # noqa: ANN401 - nbformat has no types
    """Store an executed notebook for ``find_kept_notebook``.

    Args:
        notebook: as `execute_notebook` returns it.
        path: of the notebook that was executed.
        folder: where it is kept.
    """
    import nbformat  # noqa: PLC0415 - only who builds pages needs it

    notebook.metadata[MADE_FROM] = _digest_sources(path)
    folder.mkdir(parents=True, exist_ok=True)
    text = nbformat.writes(notebook)  # type: ignore[no-untyped-call] # nbformat has no types
    write_atomically(folder / path.name, text.encode("utf-8"))


def find_kept_notebook(path: Path, *, folder: Path) -> Any | None:  # noqa: ANN401 - nbformat has no types
    """An executed notebook that was kept; None where it or the code that it ran has changed.

    Args:
        path: of the notebook without outputs.
        folder: where executed ones are kept.
    """
    import nbformat  # noqa: PLC0415 - only who builds pages needs it

    kept = folder / path.name
    if not kept.is_file():
        return None
    notebook = nbformat.read(kept, 4)  # type: ignore[no-untyped-call] # nbformat has no types
    return notebook if notebook.metadata.get(MADE_FROM) == _digest_sources(path) else None


def _digest_sources(path: Path) -> str:
    """A digest of a notebook and of the Python code of both packages."""
    found = hashlib.sha256(path.read_bytes())
    for top in PACKAGES:
        for source in list_authored_files(top):
            if source.suffix == ".py":
                found.update(source.relative_to(top).as_posix().encode("utf-8"))
                found.update(hashlib.sha256(source.read_bytes()).digest())
    return found.hexdigest()


def _copy_course(course: Path, to: Path) -> Path:
    """The course without anybody's own data: a page shows what everybody sees."""
    for name in COPIED:
        if (course / name).is_dir():
            left = shutil.ignore_patterns("data", "__pycache__", ".*")
            shutil.copytree(course / name, to / name, ignore=left)
    return to
