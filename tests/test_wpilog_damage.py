"""WPILOG files that are cut off, damaged or foreign: read as far as they go, or refused."""

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from wpilog_file import FOUR, HEADER, Logger, Motor, finish, record, routine, start

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


@pytest.mark.parametrize(
    ("content", "what", "at", "advice"),
    [
        pytest.param(HEADER, "no records", 12, "Run the tests", id="a header and nothing else"),
        pytest.param(b"WPILOG\0\1\0", "ends after 9 bytes", 9, "Copy it", id="half a header"),
        pytest.param(b"WPI", "ends after 3 bytes", 3, "Copy it", id="half a magic"),
        pytest.param(
            HEADER[:8] + struct.pack("<I", 999),
            "ends after 12",
            12,
            "Copy it",
            id="cut in the extra",
        ),
        pytest.param(b"\0\1" * 40, "does not begin with WPILOG", 0, "Give the", id="foreign"),
        pytest.param(
            b"WPILOG\x05\x02" + bytes(9), "version 2.5", 6, "WPILOG 1.0", id="of a later version"
        ),
        pytest.param(HEADER + bytes(64), "zero bytes", 12, "Copy it", id="zeros after the header"),
        pytest.param(
            HEADER + b"\x0c\x00\xff\xff\xff\x7f\x00" + bytes([3] * 99),
            "claims 2147483647 bytes",
            12,
            "Copy it",
            id="a size no file has",
        ),
        pytest.param(
            HEADER + record(0, 0, b"\x07\x01\0\0\0") + bytes([9] * 9),
            "makes no sense",
            12,
            "Copy it",
            id="an unknown control record",
        ),
        pytest.param(
            HEADER + record(5, 1, bytes(8)) + record(5, 2, bytes(8)),
            "a record of the unknown entry 5",
            12,
            "Copy it",
            id="values of no entry",
        ),
        pytest.param(
            CONTENT[:60], "within its header|claims", 12, "Copy it", id="cut before the first value"
        ),
    ],
)
def test_a_file_that_tells_nothing_says_what_is_wrong_and_where(
    tmp_path: Path, content: bytes, what: str, at: int, advice: str
) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(content)

    said = refusal(path)

    assert any(part in said.what for part in what.split("|"))
    assert said.advice.startswith(advice) or advice in said.advice
    assert said.where.startswith(str(path))
    if content != CONTENT[:60]:
        assert said.where == f"{path}, byte {at}"


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


def test_zeros_that_a_lost_power_supply_leaves_count_as_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(CONTENT + bytes(4096))

    log = sim.read(path)

    assert len(log.runs) == 4
    assert [doubt.code for doubt in log.doubts] == ["truncated"]


def test_damage_behind_a_whole_run_is_doubted_loudly(tmp_path: Path, reads) -> None:
    path = tmp_path / "log.wpilog"
    middle = whole_until(len(SOUND.parts) * 2 // 3)
    path.write_bytes(CONTENT[:middle] + record(77, 5, b"?") + CONTENT[middle:])

    log = sim.read(path)

    assert [run.test for run in log.runs] == list(FOUR[:3])
    assert [doubt.code for doubt in log.doubts] == ["damaged"]
    reads(log.doubts[0].message)


def test_damage_before_the_first_whole_run_is_refused(tmp_path: Path, reads) -> None:
    path = tmp_path / "log.wpilog"
    early = whole_until(20)
    path.write_bytes(CONTENT[:early] + b"\x0c\x01\xff\xff\xff\x7f\x00" + CONTENT[early:])

    said = refusal(path)

    assert said.where == f"{path}, byte {early}"
    assert said.what.startswith("the file is damaged")
    reads(said.advice)


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


@TMP
@given(flips=st.dictionaries(st.integers(0, len(CONTENT) - 1), st.integers(1, 255), min_size=1))
def test_a_file_with_flipped_bits_is_read_or_refused(tmp_path: Path, flips: dict[int, int]) -> None:
    content = bytearray(CONTENT)
    for at, flip in flips.items():
        content[at] ^= flip
    path = tmp_path / "log.wpilog"
    path.write_bytes(content)

    said = read_or_refuse(path)

    assert isinstance(said, Log) or said.advice


def test_the_end_of_an_entry_that_never_started_is_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(HEADER + record(0, 1, finish(9)) + record(0, 2, start(1, "a", "double")))

    assert [entry.name for entry in sim.io.list_entries(path)] == ["a"]
