"""CTRE's `.hoot`: converted by owlet where it is installed, refused in one line where it is not."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest
from open_page import drive_log, write_log

from sim.core.errors import UnreadableFile
from sim.io import list_entries, read, read_motors

ADVICE = "Phoenix Tuner X"
HOOT = b"can_s0".ljust(70, b"\x00") + b"\x13" + bytes(range(200))


@pytest.fixture
def hoot(tmp_path):
    """A log of CTRE's SignalLogger, which only CTRE's owlet can convert."""
    path = tmp_path / "a match.hoot"
    path.write_bytes(HOOT)
    return path


def make_owlet(folder, *, body):
    """A program that stands for owlet; it is called as AdvantageScope calls it."""
    script = folder / "owlet.py"
    script.write_text(
        "import shutil, sys\n"
        "source, target, flag, kind = sys.argv[1:]\n"
        "assert (flag, kind) == ('-f', 'wpilog')\n"
        "assert open(source, 'rb').read(6) == b'can_s0'\n"
        f"{body}\n",
        encoding="utf-8",
    )
    if os.name == "nt":
        program = folder / "owlet.bat"
        program.write_text(f'@"{sys.executable}" "{script}" %*\n', encoding="utf-8")
    else:
        program = folder / "owlet"
        program.write_text(
            f'#!/bin/sh\nexec "{sys.executable}" "{script}" "$@"\n', encoding="utf-8"
        )
        program.chmod(0o755)
    return program


@pytest.fixture
def owlet(tmp_path, monkeypatch):
    """Makes owlet, found by its variable."""

    def make_handler(body):
        folder = tmp_path / "tools"
        folder.mkdir(exist_ok=True)
        program = make_owlet(folder, body=body)
        monkeypatch.setenv("SYSID_OWLET", str(program))
        return program

    return make_handler


def copies(path):
    return f"shutil.copyfile({str(path)!r}, target)"


def test_hoot_file_is_read_after_conversion_by_owlet(hoot, owlet, tmp_path):
    expected = read(write_log(drive_log(), tmp_path / "drive.wpilog"))
    owlet(copies(tmp_path / "drive.wpilog"))
    log = read(hoot)

    assert log.source == str(hoot)
    assert [run.test for run in log.runs] == [run.test for run in expected.runs]
    for one, other in zip(log.runs, expected.runs, strict=True):
        np.testing.assert_array_equal(one.velocity, other.velocity)
    assert len(read_motors(hoot)) == 1
    assert len(list_entries(hoot)[0].numbers())  # nothing is read later, when its file is gone


def test_without_owlet_the_message_says_how_to_convert_the_log(hoot, monkeypatch, tmp_path):
    monkeypatch.delenv("SYSID_OWLET", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(UnreadableFile, match="owlet, which is not installed") as refused:
        read(hoot)

    assert ADVICE in refused.value.advice
    assert "SYSID_OWLET" in refused.value.advice
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("print('compliancy 19 is newer', file=sys.stderr); sys.exit(3)", "compliancy 19 is newer"),
        ("pass", "cannot convert it"),
    ],
)
def test_refusal_quotes_owlet_when_it_cannot_convert(hoot, owlet, body, said):
    owlet(body)
    with pytest.raises(UnreadableFile, match="CTRE's owlet cannot convert it") as refused:
        read(hoot)

    assert said in refused.value.what
    assert ADVICE in refused.value.advice


def test_conversion_leaves_no_files_behind(hoot, owlet, tmp_path, monkeypatch):
    write_log(drive_log(), tmp_path / "drive.wpilog")
    owlet(copies(tmp_path / "drive.wpilog"))
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(scratch))
    log = read(hoot)

    assert list(scratch.iterdir()) == []
    assert not any(str(scratch) in doubt.message for doubt in log.doubts)
    assert not Path(hoot.with_suffix(".wpilog")).exists()
