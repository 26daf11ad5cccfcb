"""Where a dataset goes: what is there already, what must not be there, and what has changed."""

import json
import os
import shutil
from itertools import count

import pytest
from dataset_made import DAMAGED, PLAIN, SECRET, key, make_dataset, spec, sysid
from places import read_all

from sim.bench.dataset import key as keys
from sim.bench.dataset.folder import DatasetPlace
from sim.core.errors import BadRequest
from sim.support.secret import Secret


def refused(capsys, *arguments):
    """What is said by a command that refuses, in one line."""
    capsys.readouterr()
    assert sysid("dataset", *arguments) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.count("\n") == 1
    return shown.err


def test_finished_logs_are_not_made_again(tmp_path, capsys, reads):
    path = spec(tmp_path, DAMAGED)
    folder = make_dataset(path)
    before = {one: one.stat().st_ino for one in folder.rglob("*")}
    capsys.readouterr()

    make_dataset(path)

    assert {one: one.stat().st_ino for one in folder.rglob("*")} == before
    reads(capsys.readouterr().out)


def test_a_file_that_went_missing_is_made_again(tmp_path):
    path = spec(tmp_path, DAMAGED)
    folder = make_dataset(path)
    before = read_all(folder)
    (folder / "ann" / "log-02.csv").unlink()
    shutil.rmtree(folder / "bo")

    assert read_all(make_dataset(path)) == before


def test_foreign_file_is_never_overwritten_without_the_option(tmp_path, capsys, reads):
    path = spec(tmp_path)
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "log-02.wpilog").write_bytes(b"a robot's own log")
    (tmp_path / "data" / "notes.txt").write_bytes(b"mine")

    said = refused(capsys, path, "-o", tmp_path / "data")

    reads(said)
    assert read_all(tmp_path / "data") == {
        "log-02.wpilog": b"a robot's own log",
        "notes.txt": b"mine",
    }
    assert not (tmp_path / "data.key.json").exists()
    made = read_all(make_dataset(path, "data", "--overwrite"))
    assert made.pop("notes.txt") == b"mine"
    assert made == read_all(make_dataset(path, "other"))


@pytest.mark.parametrize(
    "other",
    [
        pytest.param(PLAIN.replace("seed = 1", "seed = 2"), id="seed"),
        pytest.param(PLAIN.replace("3.0", "3.1"), id="step"),
    ],
)
def test_files_of_another_spec_are_foreign(tmp_path, capsys, other, reads):
    before = read_all(make_dataset(spec(tmp_path)))

    said = refused(capsys, spec(tmp_path, other), "-o", tmp_path / "data")

    reads(said)
    assert read_all(tmp_path / "data") == before


def test_file_that_appears_during_the_run_is_not_overwritten(tmp_path, reads):
    place = DatasetPlace(tmp_path / "data", tmp_path / "key", "week3", Secret(b"", hidden=False))
    place.write_file("log-01.csv", b"ours")
    place.write_file("log-01.csv", b"ours")  # the same again is no harm: a killed run leaves it
    (tmp_path / "data" / "log-02.csv").write_bytes(b"somebody else's")

    with pytest.raises(BadRequest) as refused:
        place.write_file("log-02.csv", b"ours")
    reads(refused.value)

    assert read_all(tmp_path / "data") == {"log-01.csv": b"ours", "log-02.csv": b"somebody else's"}


def test_a_file_that_was_edited_is_kept(tmp_path, capsys, reads):
    path = spec(tmp_path)
    (make_dataset(path) / "log-01.wpilog").write_bytes(b"changed by a student")

    reads(refused(capsys, path, "-o", tmp_path / "data"))


def test_logs_removed_from_the_spec_stay_in_the_key_without_overwrite(tmp_path, capsys, reads):
    folder = make_dataset(spec(tmp_path, DAMAGED))
    fewer = spec(tmp_path, DAMAGED.replace('"ann", ', ""))

    said = refused(capsys, fewer, "-o", folder)

    reads(said)
    assert {log["student"] for log in key(folder)["logs"]} == {"ann", "Bo"}
    make_dataset(fewer, "data", "--overwrite")
    assert {log["student"] for log in key(folder)["logs"]} == {"Bo"}


@pytest.mark.parametrize(
    ("output", "said"),
    [
        ("file", "file: this is not a folder. Name another with -o."),
        ("file/data", "Not a directory"),
        ("long" * 100, "File name too long"),
        ("file/deep/data", "Not a directory"),
    ],
)
def test_impossible_output_folder_is_refused(tmp_path, capsys, output, said):
    (tmp_path / "file").write_bytes(b"a file")

    assert said in refused(capsys, spec(tmp_path), "-o", tmp_path / output)
    assert (tmp_path / "file").read_bytes() == b"a file"


def test_a_key_that_cannot_be_written_is_refused_before_a_log_is_made(tmp_path, capsys):
    said = refused(
        capsys, spec(tmp_path), "-o", tmp_path / "data", "--key", tmp_path / "none" / "key.json"
    )

    assert "key.json: the key cannot be written (No such file or directory)." in said
    assert read_all(tmp_path) == {"spec.toml": PLAIN.encode()}


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (("-o", "data", "--key", "data/key.json"), "data/key.json: the key lies in the folder"),
        (("-o", "."), "spec.toml: the spec lies in the folder of the data"),
    ],
)
def test_key_inside_the_data_folder_is_refused(tmp_path, monkeypatch, capsys, arguments, what):
    spec(tmp_path, DAMAGED)
    monkeypatch.chdir(tmp_path)

    assert what in refused(capsys, "spec.toml", *arguments)
    assert not (tmp_path / "data").exists()


def test_secret_inside_the_data_folder_is_refused(tmp_path, capsys, reads):
    path = spec(tmp_path, DAMAGED.replace("class.secret", "data/class.secret"), secret="")

    reads(refused(capsys, path, "-o", tmp_path / "data"))


def test_dataset_command_without_a_folder_is_refused(tmp_path, capsys, reads):
    reads(refused(capsys, spec(tmp_path)))


def check(path, folder, capsys):
    """Exit code and lines of --check."""
    capsys.readouterr()
    code = sysid("dataset", path, "-o", folder, "--check")
    shown = capsys.readouterr()
    return code, (shown.out or shown.err).splitlines()


def test_an_unchanged_dataset_passes_the_check(tmp_path, capsys):
    path = spec(tmp_path, DAMAGED)
    folder = make_dataset(path)

    assert check(path, folder, capsys) == (
        0,
        [f"{folder}: 8 logs, all unchanged; the seal is intact."],
    )


def test_every_change_to_the_data_is_noticed(tmp_path, capsys):
    path = spec(tmp_path, DAMAGED)
    folder = make_dataset(path)
    changed = folder / "ann" / "log-01.csv"
    changed.write_bytes(changed.read_bytes().replace(b"1", b"2", 1))
    (folder / "bo" / "log-02.wpilog").unlink()
    shutil.copy(folder / "bo" / "log-03.csv", folder / "bo" / "log-99.csv")

    assert check(path, folder, capsys) == (
        1,
        ["changed: ann/log-01.csv", "missing: bo/log-02.wpilog", "in no key: bo/log-99.csv"],
    )


def test_another_spec_is_noticed(tmp_path, capsys, reads):
    folder = make_dataset(spec(tmp_path, DAMAGED))
    more = DAMAGED.replace('["ann"', '["zoe", "ann"').replace("1.5]", "1.6]")

    (folder / "ann" / "log-01.csv").unlink()
    code, lines = check(spec(tmp_path, more), folder, capsys)

    assert code == 1
    reads(lines)  # one line a file that matters, and one for all the others


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(lambda logs: logs[0]["gains"].update(kV=2.5), id="a gain"),
        pytest.param(lambda logs: logs[0]["files"].update({"ann/log-01.csv": "0" * 64}), id="hash"),
        pytest.param(lambda logs: logs.pop(), id="a log less"),
        pytest.param(lambda logs: logs[0].update(student="Bo"), id="another student"),
    ],
)
def test_every_change_to_the_key_is_noticed(tmp_path, capsys, change, reads):
    path = spec(tmp_path, DAMAGED)
    folder = make_dataset(path)
    content = key(folder)
    change(content["logs"])
    (tmp_path / "data.key.json").write_text(json.dumps(content), encoding="utf-8")

    reads(refused(capsys, path, "-o", folder, "--check"))
    reads(refused(capsys, path, "-o", folder))


@pytest.mark.parametrize("content", ["", "{", "[]", "{}", '{"logs": [], "seal": 7}'])
def test_file_that_is_no_key_is_refused(tmp_path, capsys, content, reads):
    path = spec(tmp_path)
    folder = make_dataset(path)
    (tmp_path / "data.key.json").write_text(content, encoding="utf-8")

    reads(refused(capsys, path, "-o", folder, "--check"))


def test_reformatted_key_passes_the_check(tmp_path, capsys):
    path = spec(tmp_path, DAMAGED)
    folder = make_dataset(path)
    content = json.dumps(key(folder), indent=4, sort_keys=True)
    (tmp_path / "data.key.json").write_text(content, encoding="utf-8")

    assert check(path, folder, capsys)[0] == 0


def test_another_secret_does_not_open_the_seal(tmp_path, capsys, reads):
    path = spec(tmp_path, DAMAGED)
    folder = make_dataset(path)
    (tmp_path / "class.secret").write_text(SECRET + "!", encoding="utf-8")

    reads(refused(capsys, path, "-o", folder, "--check"))
    (tmp_path / "class.secret").unlink()
    reads(refused(capsys, path, "-o", folder))
    assert not (tmp_path / "class.secret").exists()  # none is made in place of the lost one
    reads(refused(capsys, path, "-o", folder, "--check"))


def test_check_without_a_key_is_refused(tmp_path, capsys, reads):
    said = refused(capsys, spec(tmp_path), "-o", tmp_path / "data", "--check")

    reads(said)


def test_key_and_secret_are_readable_by_their_owner_only(tmp_path):
    make_dataset(spec(tmp_path, DAMAGED, secret=""))

    for name in ("data.key.json", "class.secret"):
        path = tmp_path / name
        assert path.stat().st_mode & 0o077 == 0 or path.drive  # a drive letter: Windows


@pytest.mark.parametrize("calls", [0, 2])
def test_full_disk_gets_one_line_and_the_next_run_continues(tmp_path, monkeypatch, capsys, calls):
    whole = read_all(make_dataset(spec(tmp_path, DAMAGED), "whole"))
    real, counted = os.utime, count()

    def full(path, times):
        if next(counted) >= calls:
            raise OSError(28, "No space left on device")
        real(path, times)

    with monkeypatch.context() as context:
        context.setattr(os, "utime", full)  # the last step before a file gets its name
        said = refused(capsys, tmp_path / "spec.toml", "-o", tmp_path / "data")

    assert "No space left on device" in said
    there = read_all(tmp_path / "data")
    assert there.items() < whole.items()
    assert len(there) == calls
    assert read_all(make_dataset(tmp_path / "spec.toml")) == whole


def test_a_disk_too_full_for_the_key_keeps_the_files(tmp_path, monkeypatch, capsys):
    path = spec(tmp_path)
    real, counted = keys.write_atomically, count()

    def full(*arguments, **named):
        if next(counted):
            raise OSError(28, "No space left on device")
        real(*arguments, **named)

    with monkeypatch.context() as context:
        context.setattr(keys, "write_atomically", full)
        said = refused(capsys, path, "-o", tmp_path / "data")

    assert f"{tmp_path / 'data.key.json'}: the key cannot be written (No space left" in said
    before = read_all(tmp_path / "data")
    assert len(before) == 4
    assert read_all(make_dataset(path)) == before
