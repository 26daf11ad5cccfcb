"""Fixtures everybody uses."""

import os
import shutil
from pathlib import Path

import pytest
from hypothesis import settings

# A machine may be busy: how long an example takes says nothing about whether it is right.
settings.register_profile("course", deadline=None)
settings.load_profile("course")

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def shared() -> Path:
    """Reference data that is not part of the project: known answers and logs of real robots.

    Looked for beside the project, or where the environment variable SYSID_SHARED says.
    """
    folder = Path(os.environ.get("SYSID_SHARED", ROOT.parent / "shared"))
    if not (folder / "data").is_dir():
        pytest.skip(f"reference data not found at {folder} (set SYSID_SHARED to its folder)")
    return folder


@pytest.fixture(scope="session")
def root() -> Path:
    """The top folder of the project."""
    return ROOT


@pytest.fixture
def copy(request, tmp_path, monkeypatch):
    """A copy of the exercise a file tests, in a course of its own, in whose folder commands run."""
    own = request.module.OWN
    folder = tmp_path / "exercises" / own.name
    shutil.copytree(own.folder, folder, ignore=shutil.ignore_patterns("data", "__pycache__"))
    (tmp_path / "lessons").mkdir()
    monkeypatch.chdir(tmp_path)
    return type(own)(own.name, folder)
