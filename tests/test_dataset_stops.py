"""A dataset that is stopped in the middle, however that comes about, and the next run."""

import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress
from itertools import count
from pathlib import Path

import psutil
import pytest
from dataset_made import DAMAGED, PLAIN, files, key, make, process, spec, sysid

from sim.dataset import folder as shelf
from sim.dataset import key as keys

LONG = PLAIN.replace("count = 2", "count = 60")  # 120 logs: enough work for two processes
LONGEST = 100.0  # [s] a start takes, should the engine have to be compiled first
ENOUGH = 10  # [files] after which a run is in full swing


@pytest.fixture(autouse=True)
def _no_secret_around(monkeypatch):
    monkeypatch.delenv("SYSID_SECRET", raising=False)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """What a run that nothing stops makes of LONG."""
    folder = make(spec(tmp_path_factory.mktemp("whole"), LONG), "data", "--processes", 1)
    return files(folder), key(folder)


def started(tmp_path):
    """A run of two processes in full swing."""
    running = process("dataset", "spec.toml", "-o", "data", "--processes", 2, folder=tmp_path)
    deadline = time.monotonic() + LONGEST
    while len(list((tmp_path / "data").glob("log*"))) < ENOUGH:
        if running.poll() is not None or time.monotonic() > deadline:
            running.kill()
            pytest.fail(f"it is not in full swing: {running.communicate()}")
        time.sleep(0.005)
    return running


def left(tmp_path):
    """The logs in the folder; whatever else is there may only be the one being written."""
    there = files(tmp_path / "data")
    logs = {name: data for name, data in there.items() if name.startswith("log-")}
    assert len(there) <= len(logs) + 1
    return logs


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill -9")
def test_a_killed_run_leaves_whole_files_and_the_next_one_goes_on(tmp_path, undisturbed, capsys):
    path = spec(tmp_path, LONG)
    running = started(tmp_path)
    workers = psutil.Process(running.pid).children(recursive=True)

    os.kill(running.pid, signal.SIGKILL)
    running.communicate(timeout=LONGEST)

    whole, truth = undisturbed
    there = left(tmp_path)
    assert ENOUGH <= len(there) < len(whole)
    assert there.items() <= whole.items()
    assert not (tmp_path / "data.key.json").exists()
    assert not psutil.wait_procs(workers, timeout=5.0)[1]  # nobody works on for no one

    before = {path: path.stat().st_ino for path in (tmp_path / "data").glob("log*")}
    folder = make(path, "data", "--processes", 1)

    assert files(folder) == whole
    assert key(folder) == truth
    assert {path: path.stat().st_ino for path in before} == before  # kept, not made again
    assert f"120 logs, {len(before)} of them made earlier" in capsys.readouterr().out
    assert sorted(one.name for one in tmp_path.iterdir()) == ["data", "data.key.json", "spec.toml"]


@pytest.mark.skipif(sys.platform == "win32", reason="a test cannot press Ctrl+C on Windows")
def test_ctrl_c_leaves_whole_files_and_says_how_to_go_on(tmp_path, undisturbed):
    spec(tmp_path, LONG)
    running = started(tmp_path)

    os.killpg(running.pid, signal.SIGINT)  # a terminal sends it to all of them
    _, said = running.communicate(timeout=LONGEST)

    whole, _ = undisturbed
    there = files(tmp_path / "data")
    assert there.items() < whole.items()
    assert running.returncode == 130
    assert said == (
        f"sysid: stopped with {len(there)} of 120 logs whole. Run the same command to go on.\n"
    )
    assert files(make(tmp_path / "spec.toml", "data", "--processes", 1)) == whole


def test_a_worker_that_is_killed_is_told_in_one_line(tmp_path, undisturbed):
    spec(tmp_path, LONG)
    running = started(tmp_path)

    for worker in psutil.Process(running.pid).children():
        if "spawn_main" in " ".join(worker.cmdline()):
            worker.kill()
    _, said = running.communicate(timeout=LONGEST)

    assert running.returncode == 2
    assert said.count("\n") == 1
    assert "was ended from outside, perhaps for want of memory. Run the same command" in said
    assert left(tmp_path).items() <= undisturbed[0].items()


@pytest.fixture
def small_disk(tmp_path):
    """A disk that a few of PLAIN's logs fill."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount, umount = (shutil.which(name) or "" for name in ("mount", "umount"))
    command = [mount, "-t", "tmpfs", "-o", "size=128k", "tmpfs", str(disk)]
    if not mount or subprocess.run(command, check=False, capture_output=True).returncode:
        pytest.skip("no disk can be mounted here")
    yield disk
    subprocess.run([umount, str(disk)], check=True)


def test_a_disk_that_is_really_full_keeps_whole_files_only(tmp_path, small_disk, capsys):
    path = spec(tmp_path, PLAIN.replace("count = 2", "count = 10"))

    assert sysid("dataset", path, "-o", small_disk / "data", "--key", tmp_path / "key.json") == 2

    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "cannot be written (No space left on device). Make room there" in said
    there = files(small_disk / "data")
    whole = files(make(path, "whole"))
    assert there
    assert there.items() < whole.items()


def full_after(monkeypatch, module, name, *, calls):
    """Let the disk be full after so many files."""
    real = getattr(module, name)
    counted = count()

    def write(self, *arguments):
        if next(counted) >= calls:
            real(self, *(one[:100] if isinstance(one, bytes) else one for one in arguments))
            raise OSError(28, "No space left on device")
        return real(self, *arguments)

    monkeypatch.setattr(module, name, write)


@pytest.mark.parametrize("calls", [0, 2])
def test_a_full_disk_is_one_line_and_the_next_run_goes_on(tmp_path, monkeypatch, capsys, calls):
    whole = files(make(spec(tmp_path, DAMAGED), "whole"))
    capsys.readouterr()

    with monkeypatch.context() as context:
        full_after(context, shelf.Path, "write_bytes", calls=3 * calls)  # two of three by a worker
        assert sysid("dataset", tmp_path / "spec.toml", "-o", tmp_path / "data") == 2

    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "No space left on device" in said
    there = files(tmp_path / "data")
    assert there.items() < whole.items()
    assert bool(there) == bool(calls)
    if not calls:
        assert sorted(one.name for one in tmp_path.iterdir() if "whole" not in one.name) == [
            "class.secret", "spec.toml",
        ]  # fmt: skip
    assert files(make(tmp_path / "spec.toml")) == whole


def test_a_disk_too_full_for_the_key_keeps_the_files(tmp_path, monkeypatch, capsys):
    path = spec(tmp_path)

    def full(*_arguments, **_named):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as context:
        context.setattr(keys.json, "dump", full)
        assert sysid("dataset", path, "-o", tmp_path / "data") == 2

    said = capsys.readouterr().err
    assert f"{tmp_path / 'data.key.json'}: the key cannot be written (No space left" in said
    assert len(files(tmp_path / "data")) == 4
    assert not (tmp_path / "data.key.json").exists()
    make(path)
    assert "4 logs, 4 of them made earlier" in capsys.readouterr().out


def test_a_journal_that_was_torn_costs_one_log(tmp_path, capsys):
    path = spec(tmp_path)
    folder = make(path)
    journal = tmp_path / "data.key.json.part"
    truth = key(folder)
    lines = keys.Journal(tmp_path / "data.key.json", secret=secret_of(path))
    lines.begin(truth["logs"])
    lines.close()
    (tmp_path / "data.key.json").unlink()
    journal.write_bytes(journal.read_bytes()[:-20])
    (folder / max(truth["logs"][-1]["files"])).unlink()
    capsys.readouterr()

    make(path)

    assert "4 logs, 3 of them made earlier" in capsys.readouterr().out
    assert key(folder) == truth


def secret_of(path: Path):
    from sim.dataset.secret import find_secret  # noqa: PLC0415 - one test needs it
    from sim.dataset.spec import read_spec  # noqa: PLC0415 - the same

    return find_secret(read_spec(path), make=False)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such terminals")
def test_a_terminal_shows_a_bar(tmp_path):
    spec(tmp_path)
    main, terminal = os.openpty()
    with os.fdopen(main, "rb", buffering=0) as screen:
        running = process("dataset", "spec.toml", "-o", "data", folder=tmp_path, stderr=terminal)
        os.close(terminal)
        drawn = b""
        with suppress(OSError):  # what reading says once the other side is closed
            while part := screen.read(4096):
                drawn += part
        running.communicate(timeout=LONGEST)

    assert b"4/4" in drawn
    assert running.returncode == 0
