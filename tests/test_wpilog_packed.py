"""A WPILOG that is packed with xz, `.wpilogxz`, is read as what it holds."""

import lzma

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import UnreadableFile
from sim.io import list_entries, read, read_motors, write
from sim.io.formats.wpilog import records
from sim.io.formats.wpilog.growing import GrowingLog


@pytest.fixture
def plain(tmp_path):
    """A log of four tests."""
    path = tmp_path / "drive.wpilog"
    write(simulate(MECHANISMS["drivetrain"], Routine(), rng=np.random.default_rng(1)), path)
    return path


@pytest.fixture
def packed(plain):
    """The same, packed."""
    path = plain.with_suffix(".wpilogxz")
    path.write_bytes(lzma.compress(plain.read_bytes()))
    return path


def assert_same(one, other):
    """Two logs hold the same runs."""
    assert [run.test for run in one.runs] == [run.test for run in other.runs]
    for mine, others in zip(one.runs, other.runs, strict=True):
        np.testing.assert_array_equal(mine.time, others.time)
        np.testing.assert_array_equal(mine.velocity, others.velocity)


def test_packed_log_is_recognized_by_its_content(plain, packed):
    renamed = packed.rename(packed.with_name("packed.wpilog"))

    assert_same(read(renamed), read(plain))
    assert len(list_entries(renamed)) == len(list_entries(plain))
    assert_same(read_motors(renamed).popitem()[1], read(plain))


def test_what_is_written_packed_is_smaller_and_reads_back(plain, tmp_path):
    path = tmp_path / "again.wpilogxz"
    write(read(plain), path)

    assert path.stat().st_size < plain.stat().st_size
    assert_same(read(path), read(plain))


def test_one_that_was_cut_off_gives_what_came_before(plain, packed):
    content = packed.read_bytes()
    packed.write_bytes(content[: round(0.8 * len(content))])
    log = read(packed)

    assert {"truncated", "unfinished-run"} & {doubt.code for doubt in log.doubts}
    assert 1 <= len(log.runs) <= 4
    np.testing.assert_array_equal(log.runs[0].velocity, read(plain).runs[0].velocity)


def test_one_that_is_damaged_is_refused_in_one_line(packed):
    content = bytearray(packed.read_bytes())
    content[len(content) // 2] ^= 0xFF
    packed.write_bytes(content)

    with pytest.raises(UnreadableFile, match="packed with xz, and damaged") as refused:
        read(packed)
    assert str(refused.value).count("\n") == 0
    assert str(packed) in str(refused.value)


def test_one_that_unpacks_to_too_much_is_refused(packed, monkeypatch):
    monkeypatch.setattr(records, "LARGEST_FILE", 10_000)

    with pytest.raises(UnreadableFile, match="the most that is read"):
        read(packed)


def test_growing_packed_log_can_be_watched(plain, tmp_path):
    content = plain.read_bytes()
    half = len(content) // 2
    path = tmp_path / "grows.wpilogxz"
    packed = lzma.compress(content[:half]) + lzma.compress(content[half:])
    growing, before = GrowingLog(path), 0
    for share in np.linspace(0.0, 1.0, 11):
        path.write_bytes(packed[: round(share * len(packed))])
        tests = growing.list_tests()
        assert len(tests) >= before
        before = len(tests)
        assert not growing.was_replaced

    assert before == 4
