"""Fixtures everybody uses."""

import gc
import itertools
import os
import re
import shutil
import socket
import tarfile
from pathlib import Path

import pytest
from hypothesis import settings
from places import ROOT
from small_course import lay_out

# A machine may be busy: how long an example takes says nothing about whether it is right.
settings.register_profile("course", deadline=None)
settings.load_profile("course")

SLOW_FILE = re.compile(r"^pytestmark = \[?\s*pytest\.mark\.slow", flags=re.MULTILINE)


def pytest_ignore_collect(collection_path, config):
    """Leave out the files of which no test is asked for: reading one takes as long as some tests.

    ``None`` lets pytest decide.
    """
    if not collection_path.name.startswith("test_"):
        return None
    text = collection_path.read_text(encoding="utf-8")
    unwanted = {
        "not slow": SLOW_FILE.search(text),
        "slow": "pytest.mark.slow" not in text,
    }.get(config.option.markexpr)
    return True if unwanted else None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Begin with a browser's tests, then other slow ones: no core waits for one at the end."""
    items.sort(
        key=lambda one: (not one.get_closest_marker("slow"), "in_browser" not in one.path.stem)
    )


def pytest_collection_finish():
    """Let the garbage collector pass over all that was imported: it stays until the end."""
    gc.collect()
    gc.freeze()


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
def real_logs(shared, tmp_path_factory) -> Path:
    """The folder of further logs of real robots, unpacked."""
    packed = shared / "data" / "real-more" / "logs.tar.xz"
    if not packed.is_file():
        pytest.skip(f"logs of real robots not found: {packed}")
    folder = tmp_path_factory.mktemp("real")
    with tarfile.open(packed) as archive:
        archive.extractall(folder, filter="data")
    return folder / "real-more"


@pytest.fixture(autouse=True)
def no_secret_around(monkeypatch):
    """No class's secret is set where tests run."""
    monkeypatch.delenv("SYSID_SECRET", raising=False)


@pytest.fixture
def port():
    """A port that nothing listens on."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


@pytest.fixture(scope="module")
def browser():
    """A Chromium without a window."""
    from chromium import launched  # noqa: PLC0415 - only where a browser is asked for

    with launched() as chromium:
        yield chromium


@pytest.fixture(scope="module")
def robot_code_once():
    """Each robot program is run once: nothing in the answers beside it changes its run."""
    from grader.robotcode import running  # noqa: PLC0415 - as above

    run, kept = running._run, {}

    def run_once(path, kind, mounts, **options):
        beside = (one for one in sorted(path.parent.iterdir()) if one.suffix == path.suffix)
        texts = tuple((one.name, one.read_bytes()) for one in beside)
        key = (path.name, kind, repr(mounts), *options.items(), texts)
        if key not in kept:
            kept[key] = run(path, kind, mounts, **options)
        return kept[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(running, "_run", run_once)
        yield


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


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A small course, in whose folder the command runs."""
    lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def all_exercises(tmp_path, monkeypatch):
    """A copy of the course's exercises, in whose folder the command runs."""
    ignored = shutil.ignore_patterns("data", "__pycache__")
    shutil.copytree(ROOT / "exercises", tmp_path / "exercises", ignore=ignored)
    (tmp_path / "lessons").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path
