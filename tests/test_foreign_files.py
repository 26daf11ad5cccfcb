"""Files and paths that are no log: called by their name, with advice."""

import os
from pathlib import Path

import pytest

import sim
from sim import io
from sim.core.errors import Refusal, UnreadableFile
from sim.core.log import Log, Run

LOG = Log((Run("dynamic-forward", [0.0, 0.1], [7.0, 7.0], [0.0, 0.1], [0.0, 2.0]),))

FOREIGN = [
    ("log.hoot", b"\x00hoot", "SignalLogger", "Phoenix Tuner X .*owlet on PATH"),
    ("match.dslog", b"\x00\x00\x00\x04\x00", "Driver Station", "DataLogManager"),
    ("match.dsevents", b"\x00\x00\x00\x04\x00", "Driver Station", "DataLogManager"),
    ("renamed.wpilog", b"\x00\x00\x00\x04\x00", "Driver Station", "DataLogManager"),
    ("log.revlog", b"\x01\x02", "REV", "revlog-converter"),
    ("log.rlog", b"\x01\x02", "AdvantageKit", "AdvantageScope, export it as WPILOG"),
    ("logs.zip", b"PK\x03\x04\x14", "zip archive or a workbook", "Unpack it, or save .* as CSV"),
    ("log.csv", b"PK\x03\x04\x14", "zip archive or a workbook", "Unpack it, or save .* as CSV"),
    ("log.csv.gz", b"\x1f\x8b\x08", "gzip", "Unpack it first"),
    ("plot.png", b"\x89PNG\r\n\x1a\n", "a picture", "the robot's own log"),
    ("plot.jpg", b"\xff\xd8\xff\xe0", "a picture", "the robot's own log"),
    ("guide.pdf", b"%PDF-1.7", "PDF", "the robot's own log"),
    ("log.csv", "test,time_s\n".encode("utf-16"), "UTF-16", "Save it as UTF-8"),
    ("log.csv", b"\n<!DOCTYPE html><html>", "a web page", "the button Raw"),
    ("log.json", b"<html lang=en>", "a web page", "the button Raw"),
    ("notes.txt", b"drove well\n", "plain text without", "begins with test,time_s,voltage"),
    ("notes", b"\x07\x00\x07\x00", "some binary format", "Logs are .*csv.*json"),
    ("numbers.csv", b"1,2,3\n4,5,6\n", "no column test or time_s", "Name the columns test,time_s"),
    ("package.json", b'{"name": "robot"}', "no run in it", "slow-forward"),
    ("list.json", b"[1, 2]", "not an object", "the JSON that SysId saved"),
]


@pytest.mark.parametrize(
    ("name", "data", "what", "advice"), FOREIGN, ids=[f"{row[0]} {row[2]}" for row in FOREIGN]
)
def test_unsupported_format_is_named_in_the_refusal(
    tmp_path: Path, name: str, data: bytes, what: str, advice: str
) -> None:
    path = tmp_path / name
    path.write_bytes(data)

    with pytest.raises(Refusal, match=f"{what}.*{advice}") as caught:
        sim.read(path)

    assert str(caught.value).startswith(str(path))


@pytest.mark.parametrize(
    ("name", "said"),
    [
        pytest.param("", "this is a folder.*path of a log file", id="a folder"),
        pytest.param("empty.csv", "the file is empty.*Copy it", id="an empty file"),
        pytest.param("trian.csv", r"no such file\. Did you mean .*train\.csv\?", id="misspelled"),
        pytest.param("zzz.wpilog", r"no such file\. Check the spelling", id="missing"),
        pytest.param("deep/x.csv", r"no such file\. There is no folder .*deep", id="no folder"),
        pytest.param("train.csv/x.csv", "no such file", id="a file for a folder"),
        pytest.param("a\0b.csv", "this is not a path.*path of a log file", id="a zero byte"),
        pytest.param("x" * 5000, "cannot be read|no such file", id="a name too long"),
    ],
)
def test_a_path_that_leads_to_no_log_is_refused_with_advice(
    tmp_path: Path, name: str, said: str
) -> None:
    sim.write(LOG, tmp_path / "train.csv")
    (tmp_path / "empty.csv").touch()

    with pytest.raises(UnreadableFile, match=said):
        sim.read(os.fspath(tmp_path) + os.sep + name)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_is_refused_and_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "log.csv")

    with pytest.raises(UnreadableFile) as refused:
        sim.read(tmp_path / "log.csv")
    assert refused.value.advice


def test_an_enormous_file_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sim.write(LOG, tmp_path / "log.csv")
    monkeypatch.setattr(io, "LARGEST_FILE", 10)

    with pytest.raises(UnreadableFile) as refused:
        sim.read(tmp_path / "log.csv")
    assert refused.value.advice


@pytest.mark.parametrize(
    ("trouble", "said"),
    [
        (PermissionError(13, "Permission denied"), "may not read this file.*permissions"),
        (OSError(5, "Input/output error"), r"cannot be read \(Input/output error\).*Copy it"),
    ],
)
def test_a_file_the_system_withholds_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, trouble: OSError, said: str
) -> None:
    def withhold(*_: object, **__: object) -> None:
        raise trouble

    sim.write(LOG, tmp_path / "log.csv")
    monkeypatch.setattr(Path, "open", withhold)

    with pytest.raises(UnreadableFile, match=said):
        sim.read(tmp_path / "log.csv")
