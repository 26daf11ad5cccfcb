"""A dataset on a disk that fills up, and a journal that is torn or changed."""

import shutil
import subprocess
from itertools import count

import pytest
from dataset_made import DAMAGED, PLAIN, files, key, make_dataset, spec, sysid

from sim.bench.dataset import folder as shelf
from sim.bench.dataset import key as keys
from sim.bench.dataset.key import Journal
from sim.bench.dataset.secret import find_secret
from sim.bench.dataset.spec import read_spec


@pytest.fixture(autouse=True)
def _no_secret_around(monkeypatch):
    monkeypatch.delenv("SYSID_SECRET", raising=False)


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
    whole = files(make_dataset(path, "whole"))
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
    whole = files(make_dataset(spec(tmp_path, DAMAGED), "whole"))
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
    assert files(make_dataset(tmp_path / "spec.toml")) == whole


def test_a_disk_too_full_for_the_journal_leaves_no_file_without_an_entry(tmp_path, monkeypatch):
    path = spec(tmp_path)
    real, calls = Journal.add, count()

    def full(self, entry):
        if next(calls):
            raise OSError(28, "No space left on device")
        real(self, entry)

    with monkeypatch.context() as context:
        context.setattr(Journal, "add", full)
        assert sysid("dataset", path, "-o", tmp_path / "data") == 2

    assert len(files(tmp_path / "data")) == 1
    assert len(files(make_dataset(path))) == 4


def test_a_disk_too_full_for_the_key_keeps_the_files(tmp_path, monkeypatch, capsys):
    path = spec(tmp_path)

    def full(*_arguments, **_named):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as context:
        context.setattr(keys, "write_pieces_atomically", full)
        assert sysid("dataset", path, "-o", tmp_path / "data") == 2

    said = capsys.readouterr().err
    assert f"{tmp_path / 'data.key.json'}: the key cannot be written (No space left" in said
    assert len(files(tmp_path / "data")) == 4
    assert not (tmp_path / "data.key.json").exists()
    make_dataset(path)
    assert "4 logs, 4 of them made earlier" in capsys.readouterr().out


def unfinished(path):
    """A dataset as a kill leaves it after the last log: no key, a journal, and what is in it."""
    folder = make_dataset(path)
    truth = key(folder)
    journal = Journal(folder.with_name("data.key.json"), secret=secret_of(path))
    journal.start(truth["logs"])
    journal.close()
    folder.with_name("data.key.json").unlink()
    return folder, truth, journal


def secret_of(path):
    return find_secret(read_spec(path), make=False)


def test_a_journal_that_was_torn_costs_one_log(tmp_path, capsys):
    path = spec(tmp_path)
    folder, truth, journal = unfinished(path)
    journal.path.write_bytes(journal.path.read_bytes()[:-20])
    (folder / max(truth["logs"][-1]["files"])).unlink()
    capsys.readouterr()

    make_dataset(path)

    assert "4 logs, 3 of them made earlier" in capsys.readouterr().out
    assert key(folder) == truth


def test_a_journal_that_was_changed_is_not_believed(tmp_path, capsys):
    path = spec(tmp_path)
    folder, truth, journal = unfinished(path)
    first = truth["logs"][0]
    ks = str(first["gains"]["kS"]).encode()
    journal.path.write_bytes(journal.path.read_bytes().replace(ks, b"0.5"))
    capsys.readouterr()

    assert sysid("dataset", path, "-o", folder) == 2

    assert (
        f"do not belong to this spec and secret: {min(first['files'])}" in capsys.readouterr().err
    )


def test_half_a_line_does_not_stay_in_the_journal(tmp_path):
    class Full:
        """A stream to a disk that is full after fifty bytes."""

        def __init__(self, stream):
            self.stream = stream
            self.tell, self.close = stream.tell, stream.close

        def write(self, line):
            self.stream.write(line[:50])

        def flush(self):
            self.stream.flush()
            raise OSError(28, "No space left on device")

    _, truth, journal = unfinished(spec(tmp_path))
    journal.start(truth["logs"][:1])
    before = journal.path.read_bytes()
    journal._stream = Full(journal._stream)

    with pytest.raises(OSError, match="No space left"):
        journal.add(truth["logs"][1])

    assert journal.path.read_bytes() == before
