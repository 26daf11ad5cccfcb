"""WPILOG files byte by byte: records are found where they are, and values belong to entries."""

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from wpilog_file import (
    HEADER,
    finish,
    record,
    records,
    start,
)

from sim.io.entries.entry import Entry
from sim.io.formats.wpilog.contents import SIZES, Contents, read_contents
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
def test_first_record_stands_after_the_extra_header(tmp_path: Path, extra: bytes) -> None:
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


def test_an_entry_that_comes_back_under_another_id_is_joined_in_time_order(tmp_path: Path) -> None:
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
