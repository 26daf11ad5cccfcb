"""Fixtures everybody uses."""

import itertools
import os
import re
import shutil
from pathlib import Path

import pytest
from hypothesis import settings

# A machine may be busy: how long an example takes says nothing about whether it is right.
settings.register_profile("course", deadline=None)
settings.load_profile("course")

ROOT = Path(__file__).resolve().parents[1]
SLOW = (  # files that take long; begun first, they keep no core waiting at the end
    "test_lessons_in_browser",
    "test_animation_in_browser",
    "test_edition_in_browser",
    "test_instructors_day",
    "test_install",
    "test_without_numba",
    "test_open_in_browser",
    "test_signals_in_browser",
    "test_open_server",
    "test_reconcile_real",
    "test_engine",
    "test_lessons",
    "test_plausible_draws",
    "test_exercises",
    "test_exercise12_by_hand",
    "test_exercise12",
    "test_faults",
    "test_hostile_answers",
    "test_adding_an_effect",
    "test_mutation",
    "test_mutation_toml",
    "test_jupyterhub",
    "test_autograder",
    "test_sysid",
    "test_robotcode_bench_sandboxed_run",
    "test_report",
    "test_exercise7",
    "test_by_mujoco",
    "test_story",
    "test_robotcode_corpus",
    "test_exercise5",
    "test_package_files",
    "test_package_keys",
    "test_guessing",
    "test_reconcile_in_browser",
    "test_robotcode_fuzz",
    "test_release",
    "test_workers",
    "test_everyday_effects",
    "test_reconcile",
    "test_fuzz",
    "test_real_logs_inspected",
    "test_real_logs_looked_at",
    "test_comparison",
    "test_bench_reconcile",
    "test_executors",
    "test_watch_robot",
    "test_swerve",
    "test_site",
)


def pytest_ignore_collect(collection_path, config):
    """Leave out the files of which no test is asked for: reading one takes as long as some tests.

    ``None`` lets pytest decide.
    """
    if not collection_path.name.startswith("test_"):
        return None
    unwanted = {"not slow": True, "slow": False}.get(config.option.markexpr)
    return True if unwanted is (collection_path.stem in SLOW) else None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark the tests of slow files, and put them before all others."""
    place = {name: number for number, name in enumerate(SLOW)}
    for one in items:
        if one.path.stem in place:
            one.add_marker(pytest.mark.slow)
    items.sort(key=lambda one: place.get(one.path.stem, len(SLOW)))


@pytest.fixture(scope="session")
def shared() -> Path:
    """Reference data that is not part of the project: known answers and logs of real robots.

    Looked for beside the project, or where the environment variable SYSID_SHARED says.
    """
    folder = Path(os.environ.get("SYSID_SHARED", ROOT.parent / "shared"))
    if not (folder / "data").is_dir():
        pytest.skip(f"reference data not found at {folder} (set SYSID_SHARED to its folder)")
    return folder


@pytest.fixture(scope="module")
def browser():
    """A Chromium without a window."""
    from chromium import launched  # noqa: PLC0415 - only where a browser is asked for

    with launched() as chromium:
        yield chromium


@pytest.fixture
def reads(request, tmp_path):
    """Asserts that a text is the one that was kept for this test in ``tests/snapshots``.

    The test's own folder stands there as FOLDER.
    """
    from wording import compare_part  # noqa: PLC0415 - as above

    count = itertools.count(1)

    def same(text):
        number = next(count)
        title = request.node.name if number == 1 else f"{request.node.name}, {number}"
        text = str(text).replace(str(tmp_path), "FOLDER")
        text = re.sub(r"FOLDER[\\\w./-]*", lambda path: path[0].replace("\\", "/"), text)  # Windows
        compare_part(request.path.stem, title, text)

    return same


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
