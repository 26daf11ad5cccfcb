"""REV's `.revlog`: records and CAN frames as REV's own converter and specification describe them.

Sources: github.com/REVrobotics/node-revlog-converter, src/lib/revlogParser.ts, and the frames
``STATUS_0`` and ``STATUS_2`` of github.com/REVrobotics/can-specs, version 2.0.2. The bytes here are
written by hand, and share nothing with the reader.
"""

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from open_page import drive_log

from sim.core.errors import Refusal
from sim.io import list_entries, read, read_motors

SPARK, ENCODER, REV, STATUS = 2, 7, 5, 46
DUTY, VOLT, AMPERE = 0.00003082369457075716, 0.0073260073260073, 0.0366300366300366
BUS = 12.0  # [V]


def can_id(device, index, *, kind=SPARK, maker=REV, group=STATUS):
    """The id of a frame as FRC packs it: kind, maker, API class and index, device."""
    return kind << 24 | maker << 16 | group << 10 | index << 6 | device


def status_0(time, device, volts, *, current=3.0):
    """A frame with the applied output, the battery's voltage and the current."""
    duty = round(volts / BUS / DUTY) & 0xFFFF
    data = duty | round(BUS / VOLT) << 16 | round(current / AMPERE) << 28
    return struct.pack("<IIQ", time, can_id(device, 0), data)


def status_2(time, device, velocity, position):
    """A frame with the motor's own encoder."""
    return struct.pack("<IIff", time, can_id(device, 2), velocity, position)


def record(payload, kind=2):
    """A record whose numbers take as few bytes as they need."""
    width = max((len(payload).bit_length() + 7) // 8, 1)
    return bytes([width - 1 << 2, kind]) + len(payload).to_bytes(width, "little") + payload


def frames_of(run, device=3, *, velocity=60.0, turned=1.0):
    """The frames of a run; its meters are taken for rotations."""
    for k, time in enumerate(1000 + np.round(1000 * run.time).astype(int)):
        yield status_0(time, device, turned * run.voltage[k])
        yield status_2(time, device, turned * velocity * run.velocity[k], turned * run.position[k])


def write(path, *records):
    path.write_bytes(b"".join(records))
    return path


@pytest.fixture(scope="module")
def run():
    """A step of a drivetrain."""
    return next(one for one in drive_log().runs if one.test == "dynamic-forward")


def test_a_file_name_gives_the_name_of_the_test(tmp_path, run):
    path = write(tmp_path / "dynamic-forward.revlog", *map(record, frames_of(run)))
    log = read(path)
    read_run = log.runs[0]

    assert (log.units, len(log.runs), read_run.test) == ("rotations", 1, "dynamic-forward")
    turn = 2 * np.pi
    count = len(read_run)
    assert count >= len(run) - 2
    np.testing.assert_allclose(read_run.velocity, turn * run.velocity[:count], atol=1e-4)
    np.testing.assert_allclose(read_run.position, turn * run.position[:count], atol=1e-3)
    np.testing.assert_allclose(read_run.voltage, run.voltage[:count], atol=0.02)
    assert {"conversion-factor"} <= {doubt.code for doubt in log.doubts}


def test_two_motors_are_two_logs(tmp_path, run):
    frames = b"".join([*frames_of(run, 3), *frames_of(run, 4, turned=-1.0)])
    logs = read_motors(write(tmp_path / "dynamic-forward.revlog", record(frames)))

    assert len(logs) == 2
    for log in logs.values():
        assert log.runs[0].voltage.mean() > 0


def test_frames_of_other_devices_and_unknown_records_are_ignored(tmp_path, run):
    other = struct.pack("<IIQ", 5, can_id(9, 0, maker=4), 1)
    encoder = struct.pack("<IIQ", 5, can_id(8, 0, kind=ENCODER), 1)
    firmware = record(struct.pack("<I6s", can_id(3, 0), b"\x1a\0\0\0\0\0"), kind=1)
    path = write(
        tmp_path / "dynamic-forward.revlog",
        firmware,
        record(other + encoder),
        record(b"later", kind=7),
        record(b"".join(frames_of(run))),
    )

    assert {entry.name.split("/")[1] for entry in list_entries(path)} == {"Spark-3"}
    assert len(read(path).runs) == 1


def test_entries_have_the_values_that_the_specification_gives(tmp_path):
    path = write(
        tmp_path / "one.revlog",
        record(status_0(2000, 5, -6.0, current=10.0) + status_2(2003, 5, -90.5, 1.25)),
    )
    entries = {entry.name: entry for entry in list_entries(path)}

    assert {name: entry.numbers()[0] for name, entry in entries.items()} == {
        "REV/Spark-5/APPLIED_OUTPUT": pytest.approx(-0.5, abs=DUTY),
        "REV/Spark-5/VOLTAGE": pytest.approx(12.0, abs=VOLT),
        "REV/Spark-5/CURRENT": pytest.approx(10.0, abs=AMPERE),
        "REV/Spark-5/PRIMARY_ENCODER_VELOCITY": -90.5,
        "REV/Spark-5/PRIMARY_ENCODER_POSITION": 1.25,
    }
    assert entries["REV/Spark-5/APPLIED_OUTPUT"].time[0] == 2_000_000
    assert entries["REV/Spark-5/PRIMARY_ENCODER_POSITION"].time[0] == 2_003_000


def test_a_file_whose_name_says_no_test_is_refused_with_advice(tmp_path, run):
    path = write(tmp_path / "REV_20260301.revlog", record(b"".join(frames_of(run))))

    with pytest.raises(Refusal) as refused:
        read(path)
    assert refused.value.advice


def test_a_cut_file_is_read_up_to_its_last_whole_record(tmp_path, run):
    content = b"".join(map(record, frames_of(run)))
    path = write(tmp_path / "dynamic-forward.revlog", content[:-5])
    log = read(path)

    assert "truncated" in {doubt.code for doubt in log.doubts}
    assert len(log.runs[0]) >= len(run) - 4


@given(st.binary(max_size=200))
def test_any_bytes_are_read_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("any") / "dynamic-forward.revlog"
    path.write_bytes(content or b"\x00")
    with pytest.raises(Refusal):
        read(path)
