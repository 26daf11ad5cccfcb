"""A dataset that is stopped in the middle, however that comes about, and the next run."""

import os
import signal
import sys
import time
from contextlib import contextmanager, suppress
from uuid import uuid4

import psutil
import pytest
from dataset_made import PLAIN, key, make_dataset, process, spec
from places import read_all

from sim.support.work.interrupt import deferred_interrupt

LONG = PLAIN.replace("count = 2", "count = 60")  # 120 logs: enough work for two processes
LONGEST = 100.0  # [s] a start takes, should the engine have to be compiled first
ENOUGH = 10  # [files] after which a run is in full swing


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """What a run that nothing stops makes of LONG."""
    folder = make_dataset(spec(tmp_path_factory.mktemp("whole"), LONG), "data", "--processes", 1)
    return read_all(folder), key(folder)


@contextmanager
def started(tmp_path):
    """A run of two processes in full swing."""
    asked = ("dataset", "spec.toml", "-o", "data", "--processes", 2)
    with process(*asked, folder=tmp_path) as running:
        deadline = time.monotonic() + LONGEST
        while len(list((tmp_path / "data").glob("log*"))) < ENOUGH:
            if running.poll() is not None or time.monotonic() > deadline:
                running.kill()
                pytest.fail(f"it is not in full swing: {running.communicate()}")
            time.sleep(0.005)
        yield running


def left(tmp_path):
    """The logs in the folder; whatever else is there may only be the one being written."""
    there = read_all(tmp_path / "data")
    logs = {name: data for name, data in there.items() if name.startswith("log-")}
    assert len(there) <= len(logs) + 1
    return logs


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill -9")
def test_killed_run_leaves_whole_files_and_the_next_run_continues(tmp_path, undisturbed, capsys):
    path = spec(tmp_path, LONG)
    with started(tmp_path) as running:
        workers = psutil.Process(running.pid).children(recursive=True)

        os.kill(running.pid, signal.SIGKILL)
        running.communicate(timeout=LONGEST)

    whole, truth = undisturbed
    there = left(tmp_path)
    assert ENOUGH <= len(there) < len(whole)
    assert there.items() <= whole.items()
    assert not psutil.wait_procs(workers, timeout=5.0)[1]  # nobody works on for no one

    for folder in (tmp_path, tmp_path / "data"):  # as if it was killed while it wrote
        (folder / f".{uuid4().hex}.part.json").touch()
    before = {path: path.stat().st_ino for path in (tmp_path / "data").glob("log*")}
    kept = sum(None not in entry["files"].values() for entry in key(tmp_path / "data")["logs"])
    folder = make_dataset(path, "data", "--processes", 1)

    assert read_all(folder) == whole
    assert key(folder) == truth
    assert {path: path.stat().st_ino for path in before} == before  # not written again
    earlier = f", {kept} of them made earlier" if kept else ""
    assert f"120 logs{earlier}. The truth" in capsys.readouterr().out
    assert sorted(one.name for one in tmp_path.iterdir()) == ["data", "data.key.json", "spec.toml"]


@pytest.mark.skipif(sys.platform == "win32", reason="a test cannot press Ctrl+C on Windows")
def test_ctrl_c_leaves_whole_files_and_says_how_to_continue(tmp_path, undisturbed):
    spec(tmp_path, LONG)
    with started(tmp_path) as running:
        os.killpg(running.pid, signal.SIGINT)  # a terminal sends it to all of them
        _, said = running.communicate(timeout=LONGEST)

    whole, _ = undisturbed
    there = read_all(tmp_path / "data")
    assert there.items() < whole.items()
    assert running.returncode == 130
    assert said == (
        f"sysid: stopped with {len(there)} of 120 logs done. Run the same command to continue.\n"
    )
    assert read_all(make_dataset(tmp_path / "spec.toml", "data", "--processes", 1)) == whole


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such terminals")
def test_a_terminal_shows_a_progress_bar(tmp_path):
    spec(tmp_path)
    main, terminal = os.openpty()
    asked = ("dataset", "spec.toml", "-o", "data")
    with (
        os.fdopen(main, "rb", buffering=0) as screen,
        process(*asked, folder=tmp_path, stderr=terminal) as running,
    ):
        os.close(terminal)
        drawn = b""
        with suppress(OSError):  # what reading says once the other side is closed
            while part := screen.read(4096):
                drawn += part
        running.communicate(timeout=LONGEST)

    assert b"4/4" in drawn
    assert running.returncode == 0


@pytest.mark.skipif(sys.platform == "win32", reason="a test cannot press Ctrl+C on Windows")
def test_first_ctrl_c_finishes_the_current_file_and_second_stops_at_once():
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    with deferred_interrupt() as stop_if_noted:
        stop_if_noted()
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            stop_if_noted()
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)

    assert signal.signal(signal.SIGINT, before) is signal.default_int_handler
