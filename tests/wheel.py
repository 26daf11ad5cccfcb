"""The wheel of this project, built as a release is: from a copy without what learners made."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = (
    ".git",
    ".venv",
    "data",
    "__pycache__",
    ".course",
    "tests",
    ".mypy_cache",
    ".ruff_cache",
)


def build_wheel(place):
    """The path of a wheel that is built in a folder; the test is skipped where pip cannot."""
    source = shutil.copytree(ROOT, place / "source", ignore=shutil.ignore_patterns(*LEFT_OUT))
    built = subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "-w", place, source],
        capture_output=True, encoding="utf-8", check=False,
    )  # fmt: skip
    if built.returncode:
        pytest.skip(f"pip cannot build a wheel here: {built.stderr.strip()[-200:]}")
    (archive,) = place.glob("*.whl")
    return archive
