"""The command `sysid` as a process of its own, as another program runs it."""

import subprocess
import sys

START = "from sim.cli import main; main()"


def run_sysid(*words, folder=None, before=""):
    """Run the command in a folder, after a line of Python; what it prints, and its exit code."""
    return subprocess.run(
        [sys.executable, "-c", f"{before}\n{START}", *map(str, words)],
        cwd=folder, capture_output=True, encoding="utf-8", check=False, timeout=300,
    )  # fmt: skip
