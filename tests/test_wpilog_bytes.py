"""WPILOG files byte by byte: sound, packed, in windows, cut off and damaged."""

import lzma
import struct
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from wpilog_file import (
    FOUR,
    HEADER,
    Logger,
    Motor,
    finish,
    metadata,
    record,
    records,
    routine,
    start,
)

import sim
import sim.io
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal, UnreadableFile
from sim.core.log import Log
from sim.io import list_entries, read, read_motors, write
from sim.io.entries.entry import Entry
from sim.io.formats.wpilog import contents
from sim.io.formats.wpilog import records as record_reader
from sim.io.formats.wpilog.contents import SIZES, Contents, read_contents
from sim.io.formats.wpilog.growing import GrowingLog
from sim.io.formats.wpilog.records import find_records, pad, read_headers

TMP = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


def contents_in(tmp_path: Path, *parts: bytes) -> Contents:
    path = tmp_path / "log.wpilog"
    path.write_bytes(HEADER + b"".join(parts))
    return read_contents(path)


def values(entry: Entry) -> list[object]:
    return entry.numbers().tolist() if entry.type in SIZES else entry.texts()


ANY_RECORD = st.tuples(
    st.one_of(st.integers(0, 3), st.integers(0, 2**32 - 1)),
    st.one_of(st.integers(0, 300), st.integers(0, 2**64 - 1)),
    st.one_of(st.binary(max_size=40), st.sampled_from((b"\x30\x01\x08" * 9, b"\0" * 300))),
    st.tuples(st.integers(1, 4), st.integers(1, 4), st.integers(1, 8)),
)


@given(several=st.lists(ANY_RECORD, max_size=60))
def test_any_records_with_any_headers_are_found_where_they_are(
    several: list[tuple[int, int, bytes, tuple[int, int, int]]],
) -> None:
    body = b"".join(record(*one) for one in several)

    starts, end = find_records(body)
    head = read_headers(pad(body), starts)

    assert end == len(body)
    assert [
        (number, time % 2**64, body[at : at + size])
        for _, number, size, time, at in head.T.tolist()
    ] == list(records(HEADER + body))


@TMP
@given(extra=st.binary(max_size=20))
def test_first_record_follows_the_extra_header(tmp_path: Path, extra: bytes) -> None:
    path = tmp_path / "log.wpilog"
    path.write_bytes(
        HEADER[:8] + struct.pack("<I", len(extra)) + extra + record(0, 5, start(7, "it", "raw"))
    )

    found = read_contents(path)

    assert [entry.name for entry in found.list_entries()] == ["it"]
    assert found.damage is None


@pytest.mark.parametrize(
    ("kind", "packed", "expected"),
    [
        pytest.param("double", struct.pack("<d", 0.1), 0.1, id="double"),
        pytest.param("float", struct.pack("<f", 0.1), float(np.float32(0.1)), id="float"),
        pytest.param("int64", struct.pack("<q", -(2**62) - 1), -(2.0**62), id="int64"),
        pytest.param("boolean", b"\x01", True, id="true"),
        pytest.param("boolean", b"\x00", False, id="false"),
        pytest.param("string", "Grüße".encode(), "Grüße", id="string"),
        pytest.param("string", b"", "", id="empty string"),
        pytest.param("string", b"a\xff", "a\ufffd", id="string that is not UTF-8"),
    ],
)
@pytest.mark.parametrize("widths", [(1, 1, 1), (2, 1, 4), (4, 4, 8), (3, 2, 5)], ids=str)
def test_each_type_is_decoded(
    tmp_path: Path, kind: str, packed: bytes, expected: object, widths: tuple[int, int, int]
) -> None:
    found = contents_in(
        tmp_path, record(0, 5, start(7, "it", kind, "unit")), record(7, 123_456, packed, widths)
    )

    (entry,) = found.list_entries()
    assert (entry.name, entry.type, entry.metadata) == ("it", kind, "unit")
    assert entry.time.tolist() == [123_456]
    assert values(entry) == [expected]


def double(number: int, time: int, value: float) -> bytes:
    return record(number, time, struct.pack("<d", value))


def test_entry_that_returns_under_another_id_is_joined_in_time_order(tmp_path: Path) -> None:
    found = contents_in(
        tmp_path,
        record(0, 0, start(1, "it", "double", "Meter")),
        double(1, 10, 1.0),
        double(1, 30, 3.0),
        record(0, 0, finish(1)),
        record(0, 0, start(9, "it", "double")),
        double(9, 20, 2.0),
        double(9, 40, 4.0),
        record(0, 0, start(3, "it", "float")),
        record(3, 50, struct.pack("<f", 5.0)),
    )

    first, other = found.list_entries()
    assert (first.metadata, first.time.tolist(), values(first)) == (
        "Meter",
        [10, 20, 30, 40],
        [1.0, 2.0, 3.0, 4.0],
    )
    assert (other.type, values(other)) == ("float", [5.0])


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


def test_packed_log_is_smaller_and_is_read_back(plain, tmp_path):
    path = tmp_path / "again.wpilogxz"
    write(read(plain), path)

    assert path.stat().st_size < plain.stat().st_size
    assert_same(read(path), read(plain))


def test_truncated_packed_log_is_read_up_to_the_cut(plain, packed):
    content = packed.read_bytes()
    packed.write_bytes(content[: round(0.8 * len(content))])
    log = read(packed)

    assert {"truncated", "unfinished-run"} & {doubt.code for doubt in log.doubts}
    assert 1 <= len(log.runs) <= 4
    np.testing.assert_array_equal(log.runs[0].velocity, read(plain).runs[0].velocity)


def test_damaged_packed_log_is_refused_in_one_line(packed):
    content = bytearray(packed.read_bytes())
    content[len(content) // 2] ^= 0xFF
    packed.write_bytes(content)

    with pytest.raises(UnreadableFile, match="packed with xz, and damaged") as refused:
        read(packed)
    assert str(refused.value).count("\n") == 0
    assert str(packed) in str(refused.value)


def test_packed_log_that_unpacks_to_too_much_is_refused(packed, monkeypatch):
    monkeypatch.setattr(record_reader, "LARGEST_FILE", 10_000)

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


WINDOWED = settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None, max_examples=200
)
KINDS = ("double", "int64", "boolean", "string", "raw")
IDS = st.integers(1, 4)
RECORD = st.one_of(
    st.builds(lambda n, kind: (0, start(n, f"entry {n % 3}", kind)), IDS, st.sampled_from(KINDS)),
    st.builds(lambda n: (0, finish(n)), IDS),
    st.builds(lambda n: (0, metadata(n, "later")), IDS),
    *[
        st.builds(lambda n, c=content: (n, c), IDS)
        for content in (b"\0" * 8, b"\1" * 8, b"\1", b"text " * 9)
    ],
    st.builds(lambda n, size: (n, b"x" * size), IDS, st.integers(0, 400)),
)


def make_comparable(values):
    """The values in a form in which a number that is not one equals itself."""
    return values.tolist() if values.dtype.kind in "OU" else values.tobytes()


def shape(found, wanted):
    """Entries that are wanted, and what is odd about a file."""
    rows = [
        (
            entry.name, entry.type, entry.metadata, entry.time.tolist(),
            entry.values.dtype, make_comparable(entry.values),
        )
        for entry in found.list_entries() if wanted(entry)
    ]  # fmt: skip
    return rows, found.damage, found.orphans


@WINDOWED
@given(
    several=st.lists(RECORD, max_size=60),
    cut=st.integers(0, 60),
    tail=st.sampled_from((b"", b"\0" * 40, b"\xff" * 30)),
    name=st.sampled_from(("", "entry 1")),
)
def test_reading_in_small_windows_gives_the_same_contents(tmp_path, several, cut, tail, name):
    path = tmp_path / "log.wpilog"
    body = b"".join(record(n, 7 * i, content) for i, (n, content) in enumerate(several))
    path.write_bytes(HEADER + body[: max(len(body) - cut, 0)] + tail)

    def wanted(entry):
        return not name or entry.name == name

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(contents, "WINDOW", 24)
        parts = read_contents(path, wanted)

    assert shape(parts, wanted) == shape(read_contents(path), wanted)


def test_a_log_of_other_things_takes_no_more_memory_than_a_window(tmp_path):
    log = simulate(
        MECHANISMS["drivetrain"], Routine(ramp=0.5, step=4.0), rng=np.random.default_rng(1)
    )
    path = tmp_path / "log.wpilog"
    sim.write(log, path)
    content = path.read_bytes()
    others = b"".join(
        record(0, 1, start(number, f"NT:/x/{number}", "double")) for number in range(500, 600)
    )
    block = b"".join(record(number, 1_000_000, b"\0" * 8) for number in range(500, 600))
    first = 12 + int.from_bytes(content[8:12], "little")
    path.write_bytes(content[:first] + others + block * 20_000 + content[first:])
    sim.read(path, units="meters")

    tracemalloc.start()
    read = sim.read(path, units="meters")
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert path.stat().st_size > 30_000_000
    assert most < path.stat().st_size
    assert [len(run) for run in read.runs] == [len(run) for run in log.runs]
