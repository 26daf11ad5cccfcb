"""WPILOG files that are cut off, damaged or foreign: read as far as they go, or refused."""

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from wpilog_file import FOUR, HEADER, Logger, Motor, record, routine

import sim
import sim.io
from sim.core.errors import Refusal, UnreadableFile
from sim.core.log import Log

TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])

SOUND = Logger()
routine(SOUND, Motor("a"), loops=8)
CONTENT = b"".join(SOUND.parts)


def refusal(path: Path) -> UnreadableFile:
    with pytest.raises(UnreadableFile) as caught:
        sim.read(path)
    return caught.value


NOTHING = {  # content -> the byte at which it stops making sense
    "a header and nothing else": (HEADER, 12),
    "half a header": (b"WPILOG\0\1\0", 9),
    "half a magic": (b"WPI", 3),
    "cut in the extra": (HEADER[:8] + struct.pack("<I", 999), 12),
    "foreign": (b"\0\1" * 40, 0),
    "of a later version": (b"WPILOG\x05\x02" + bytes(9), 6),
    "zeros after the header": (HEADER + bytes(64), 12),
    "a size no file has": (HEADER + b"\x0c\x00\xff\xff\xff\x7f\x00" + bytes([3] * 99), 12),
    "an unknown control record": (HEADER + record(0, 0, b"\7\1\0\0\0") + bytes([9] * 9), 12),
    "values of no entry": (HEADER + record(5, 1, bytes(8)) + record(5, 2, bytes(8)), 12),
}


@pytest.mark.parametrize(("content", "at"), NOTHING.values(), ids=NOTHING)
def test_file_without_a_value_is_refused_with_the_place(
    tmp_path: Path, content: bytes, at: int
) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(content)

    assert refusal(path).where == f"{path}, byte {at}"


def whole_until(index: int) -> int:
    """The offset behind so many records of the sound file."""
    return sum(len(part) for part in SOUND.parts[: index + 1])


@pytest.mark.parametrize("cut", [1, 5, 12, 19])
def test_a_file_cut_off_at_its_end_is_read_up_to_there(tmp_path: Path, cut: int) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(CONTENT[:-cut])
    offset = whole_until(len(SOUND.parts) - 2)
    left = len(CONTENT) - cut - offset
    if left < 0:
        offset = whole_until(len(SOUND.parts) - 3)
        left = len(CONTENT) - cut - offset

    log = sim.read(path)

    assert [run.test for run in log.runs] == list(FOUR)
    (doubt,) = [one for one in log.doubts if one.code == "truncated"]
    assert f"at byte {offset}" in doubt.message
    assert f"{left} bytes" in doubt.message
    assert "Copy the file" in doubt.message


def test_damage_behind_a_whole_run_is_doubted_loudly(tmp_path: Path) -> None:
    path = tmp_path / "log.wpilog"
    middle = whole_until(len(SOUND.parts) * 2 // 3)
    path.write_bytes(CONTENT[:middle] + record(77, 5, b"?") + CONTENT[middle:])

    log = sim.read(path)

    assert [run.test for run in log.runs] == list(FOUR[:3])
    assert [doubt.code for doubt in log.doubts] == ["damaged"]


def read_or_refuse(path: Path) -> Log | Refusal:
    try:
        return sim.read(path)
    except Refusal as refused:
        return refused


@TMP
@given(noise=st.binary(max_size=400))
def test_any_bytes_behind_a_header_are_refused_in_a_sentence(tmp_path: Path, noise: bytes) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(HEADER + noise)

    said = read_or_refuse(path)

    assert isinstance(said, Refusal)
    assert said.where.startswith(str(path))
    assert said.advice


@TMP
@given(length=st.integers(0, len(CONTENT) - 1))
def test_a_part_of_a_file_is_read_as_far_as_it_goes(tmp_path: Path, length: int) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(CONTENT)
    whole = sim.read(path)
    path.write_bytes(CONTENT[:length])

    part = read_or_refuse(path)

    if isinstance(part, Refusal):
        assert not whole.runs or length < whole_until(len(SOUND.parts) // 4)
        return
    for ours, theirs in zip(part.runs, whole.runs, strict=False):
        assert ours.test == theirs.test
        both = min(len(ours), len(theirs))  # the last sample of a run may count if no end is seen
        assert both >= len(ours) - 1
        assert np.array_equal(ours.velocity[:both], theirs.velocity[:both])
    lost = sum(map(len, part.runs)) < sum(map(len, whole.runs))
    ended = [run.test for run in part.runs] == [run.test for run in whole.runs[: len(part.runs)]]
    assert part.doubts or (ended and lost)
