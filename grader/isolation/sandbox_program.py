"""The parent of a whole program of ours that runs a learner's code, confined as in ``run``."""

import json
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from grader.isolation import sandbox_parent
from grader.isolation.sandbox_parent import Limits

START = sandbox_parent.START.replace("sandbox_child", "sandbox_program_child")


def run_program(
    script: Path,
    arguments: Sequence[str],
    *,
    folder: Path,
    given: Path,
    packages: Sequence[str],
    limits: Limits,
    beside: Sequence[Path] = (),
    stdin: str = "",
) -> tuple[bool, bytes]:
    """Run a Python program of ours that may read Python, some packages and its own files.

    Args:
        script: the program; it may import Python's own library and ``packages``.
        arguments: as on a command line.
        folder: the only one it may write; empty, and what it leaves there may be a learner's work.
        given: a file, or a folder, that it may read.
        packages: which installed packages it may import.
        limits: how much it may take, and how much of its standard output is kept.
        beside: further files of ours that it imports by their names.
        stdin: what it finds on its standard input.

    Returns:
        Whether it ended by itself, and the beginning of its standard output.
    """
    orders = {
        "script": str(script),
        "beside": [str(path) for path in beside if path != script],
        "arguments": list(arguments),
        "stdin": stdin,
        "root": str(sandbox_parent.ROOT),
        "confined": sandbox_parent.CONFINED,
        "landlock_abi": sandbox_parent.LANDLOCK_ABI,
        "given": str(given),
        "packages": sandbox_parent.find_package_paths(packages),
        "limits": limits.make_child_limits(),
    }
    with tempfile.TemporaryFile() as stdout:
        process = subprocess.Popen(  # noqa: S603 - our own Python and our own program
            [*sandbox_parent.PYTHON, START],
            stdin=subprocess.PIPE,
            stdout=stdout,
            stderr=subprocess.DEVNULL,
            cwd=folder,
            env=sandbox_parent.make_child_environment(folder),
            start_new_session=True,
        )
        ended = True
        try:
            process.communicate(json.dumps(orders).encode(), timeout=limits.seconds)
        except subprocess.TimeoutExpired:
            ended = False
        finally:
            sandbox_parent.end_session(process)
        stdout.seek(0)
        return ended, stdout.read(limits.prints)
