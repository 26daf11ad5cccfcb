"""The catalogue of log formats: what every format owes, and files that are of none."""

import os
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import sim
from sim import io
from sim.core.errors import BadRequest
from sim.core.log import Log, Run

MODULES = {name: import_module(f"sim.io.formats.{name}") for name in io.FORMATS}
LOG = Log((Run("dynamic-forward", [0.0, 0.1], [7.0, 7.0], [0.0, 0.1], [0.0, 2.0]),))


def test_only_the_format_in_use_is_imported(tmp_path: Path, root: Path) -> None:
    path = tmp_path / "log.csv"
    sim.write(LOG, path)
    code = "import sim, sys; sim.read(sys.argv[1]); print(*sys.modules, sep='\\n')"

    done = subprocess.run(
        [sys.executable, "-c", code, str(path)], cwd=root, capture_output=True, check=True
    )

    loaded = set(done.stdout.decode().split())
    assert "sim.io.formats.csv" in loaded
    assert not {f"sim.io.formats.{name}" for name in io.FORMATS if name != "csv"} & loaded


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"units": "furlongs"}, "unknown units 'furlongs'.*meters, feet"),
        ({"type": "catapult"}, "unknown type 'catapult'.*simple, elevator, arm"),
    ],
)
def test_an_unknown_word_is_refused_with_the_known_ones(
    tmp_path: Path, asked: dict[str, str], said: str
) -> None:
    sim.write(LOG, tmp_path / "log.csv")

    with pytest.raises(BadRequest, match=said):
        sim.read(tmp_path / "log.csv", **asked)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        pytest.param("log.json", r"ends in '\.json'.*End its name in one of: .*\.csv", id="json"),
        pytest.param("log", r"ends in 'nothing'.*one of: .*\.csv", id="no suffix"),
        pytest.param("deep/log.csv", "cannot be written.*a folder that exists", id="no folder"),
        pytest.param("folder.csv", "is there already and cannot be replaced.*another", id="folder"),
        pytest.param("file/log.csv", "cannot be written", id="a file for a folder"),
        pytest.param("a\0b.csv", "zero byte", id="a zero byte"),
    ],
)
def test_log_that_cannot_be_written_is_refused_with_advice(
    tmp_path: Path, name: str, said: str
) -> None:
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "file").touch()

    with pytest.raises(BadRequest, match=said):
        sim.write(LOG, os.fspath(tmp_path) + os.sep + name)

    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["file", "folder.csv"]


@pytest.mark.parametrize("trouble", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_failed_write_leaves_the_old_file_unchanged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, trouble: BaseException
) -> None:
    def halfway(_: Log, path: Path) -> None:
        path.write_text("half a log", encoding="utf-8")
        raise trouble

    sim.write(LOG, tmp_path / "log.csv")
    before = (tmp_path / "log.csv").read_bytes()
    monkeypatch.setattr(MODULES["csv"], "write", halfway)

    with pytest.raises((BadRequest, KeyboardInterrupt)) as caught:
        sim.write(LOG, tmp_path / "log.csv")

    assert (tmp_path / "log.csv").read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["log.csv"]
    if isinstance(trouble, OSError):
        assert "(No space left on device). Choose a folder" in str(caught.value)


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    sim.write(LOG, tmp_path / "log.csv")
    link = tmp_path / "link.csv"
    try:
        link.symlink_to(tmp_path / "log.csv")
    except OSError:
        pytest.skip("this system does not let us make symbolic links")
    (tmp_path / "log.csv").write_text("old", encoding="utf-8")

    sim.write(LOG, link)

    assert link.is_symlink()
    assert len(sim.read(tmp_path / "log.csv").runs) == 1
