"""The catalogue of log formats: what every format owes, and files that are of none."""

import os
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import sim
from sim import io
from sim.core.errors import BadRequest
from sim.core.log import TESTS, Log, Run
from sim.core.units import UNITS

MODULES = {name: import_module(f"sim.io.formats.{name}") for name in io.FORMATS}
WRITERS = sorted(name for name, module in MODULES.items() if hasattr(module, "write"))
SAYS_NO_UNITS = {"csv"}  # whoever reads such a file has to say them
LOG = Log((Run("dynamic-forward", [0.0, 0.1], [7.0, 7.0], [0.0, 0.1], [0.0, 2.0]),))


@st.composite
def runs(draw: st.DrawFn) -> Run:
    """A run of any test, on a clock of whole microseconds as a robot's is."""
    size = draw(st.integers(2, 8))  # one sample is no motion: a format need not keep it
    steps = draw(st.lists(st.integers(1_000, 500_000), min_size=size, max_size=size))
    values = st.lists(st.floats(-1e6, 1e6), min_size=size, max_size=size)
    return Run(
        draw(st.sampled_from(TESTS)),
        (draw(st.integers(0, 10**9)) + np.cumsum(steps)) * 1e-6,
        draw(values),
        draw(values),
        draw(values),
    )


@pytest.mark.parametrize("name", WRITERS)
@given(
    log=st.builds(
        lambda runs, units: Log(tuple(runs), units=units),
        st.lists(runs(), min_size=1, max_size=6),
        st.sampled_from(list(UNITS)),
    )
)
def test_any_log_that_is_written_reads_back(
    name: str, log: Log, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / f"written{MODULES[name].SUFFIXES[0]}"

    sim.write(log, path)
    back = sim.read(path, units=log.units if name in SAYS_NO_UNITS else None)

    assert back.units == log.units
    assert back.source == str(path)
    assert [run.test for run in back.runs] == [run.test for run in log.runs]
    for ours, theirs in zip(log.runs, back.runs, strict=True):
        # A format may move a run in time as a whole, and keep time in microseconds.
        np.testing.assert_allclose(
            theirs.time - theirs.time[0], ours.time - ours.time[0], rtol=0.0, atol=2e-6
        )
        assert np.array_equal(theirs.voltage, ours.voltage)
        np.testing.assert_allclose(theirs.position, ours.position, rtol=1e-12, atol=1e-300)
        np.testing.assert_allclose(theirs.velocity, ours.velocity, rtol=1e-12, atol=1e-300)


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
def test_what_cannot_be_written_is_refused_with_advice(
    tmp_path: Path, name: str, said: str
) -> None:
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "file").touch()

    with pytest.raises(BadRequest, match=said):
        sim.write(LOG, os.fspath(tmp_path) + os.sep + name)

    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["file", "folder.csv"]


@pytest.mark.parametrize("trouble", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_file_is_written_whole_or_stays_as_it_was(
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
