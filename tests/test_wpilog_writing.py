"""WPILOG logs that are written: what stands in them, and that all of it comes back."""

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from wpilog_file import records

import sim
from sim.core.errors import BadRequest
from sim.core.log import TESTS, Log, Run
from sim.core.units import UNITS

OPTIONAL = ("current", "bus_voltage")


def run(test: str = "dynamic-forward", begin: float = 0.0, size: int = 3, **more: object) -> Run:
    steps = np.arange(size)
    return Run(test, begin + 0.02 * steps, 7.0 + 0 * steps, steps**2 / 10, steps / 10, **more)


def written(tmp_path: Path, *runs: Run, **more: object) -> tuple[Log, Path]:
    path = tmp_path / "log.wpilog"
    sim.write(Log(runs, **more), path)
    return sim.read(path), path


def test_every_record_is_the_one_that_a_robot_would_write(tmp_path: Path) -> None:
    _, path = written(tmp_path, run(begin=1.5, size=2), units="rotations", mechanism="Arm")

    found = list(records(path.read_bytes()))
    turn = 2 * np.pi
    assert found[:4] == [
        (0, 1_500_000, b"\0\x01\0\0\0\x0f\0\0\0voltage-arm-Arm\x06\0\0\0double\x04\0\0\0Volt"),
        (0, 1_500_000, b"\0\x02\0\0\0\x10\0\0\0position-arm-Arm\x06\0\0\0double\x08\0\0\0Rotation"),
        (
            0,
            1_500_000,
            b"\0\x03\0\0\0\x10\0\0\0velocity-arm-Arm\x06\0\0\0double\x13\0\0\0Rotation per Second",
        ),
        (0, 1_500_000, b"\0\x04\0\0\0\x14\0\0\0sysid-test-state-Arm\x06\0\0\0string\0\0\0\0"),
    ]
    assert found[4:] == [
        (1, 1_500_000, struct.pack("<d", 7.0)),
        (2, 1_500_000, struct.pack("<d", 0.0)),
        (3, 1_500_000, struct.pack("<d", 0.0)),
        (4, 1_500_000, b"dynamic-forward"),
        (1, 1_520_000, struct.pack("<d", 7.0)),
        (2, 1_520_000, struct.pack("<d", 0.1 / turn)),
        (3, 1_520_000, struct.pack("<d", 0.1 / turn)),
        (4, 1_520_000, b"dynamic-forward"),
        (4, 1_540_000, b"none"),
    ]


@pytest.mark.parametrize(
    ("begins", "ends_up"),
    [
        ((1.0, 2.0, 5.0), (1.0, 2.0, 5.0)),
        ((0.0, 0.0, 0.0), (0.0, 1.040001, 2.080002)),
        ((5.0, 1.0, 20.0), (5.0, 6.040001, 20.0)),
        ((0.0, 0.04, 0.08), (0.0, 1.040001, 2.080002)),
        ((0.0, 0.06, 0.12), (0.0, 0.06, 0.12)),
        ((-3.0, 7.0, 8.0), (0.0, 7.0, 8.0)),
    ],
)
def test_runs_are_laid_one_behind_the_other(
    tmp_path: Path, begins: tuple[float, ...], ends_up: tuple[float, ...]
) -> None:
    log, _ = written(tmp_path, *(run(begin=begin) for begin in begins))

    assert [one.time[0] for one in log.runs] == pytest.approx(ends_up, abs=1e-9)
    for one in log.runs:
        np.testing.assert_allclose(np.diff(one.time), 0.02, atol=1e-9)


@pytest.mark.parametrize(
    ("log", "what"),
    [
        pytest.param(Log(()), "no runs", id="no runs"),
        pytest.param(Log((run(), run(size=0))), "no samples", id="a run without samples"),
    ],
)
def test_a_log_of_nothing_is_refused_and_leaves_no_file(
    tmp_path: Path, log: Log, what: str
) -> None:
    path = tmp_path / "log.wpilog"

    with pytest.raises(BadRequest, match=f"{what}.*in which every run has samples"):
        sim.write(log, path)
    assert not list(tmp_path.iterdir())


@st.composite
def any_run(draw: st.DrawFn) -> Run:
    """A run of any test at any time, negative and tiny steps included."""
    size = draw(st.integers(2, 12))
    step = st.floats(1e-5, 100.0)
    steps = draw(st.lists(step, min_size=size, max_size=size))
    values = st.lists(st.floats(-1e6, 1e6), min_size=size, max_size=size)
    return Run(
        draw(st.sampled_from(TESTS)),
        draw(st.floats(-1e6, 1e6)) + np.cumsum(steps),
        *(draw(values) for _ in range(3)),
        *(draw(st.none() | values) for _ in OPTIONAL),
    )


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    several=st.lists(any_run(), min_size=1, max_size=6),
    units=st.sampled_from(list(UNITS)),
    mechanism=st.sampled_from(("Arm", "drive-left", "/a/voltage-b", "Flügel", "")) | st.text(),
)
def test_any_log_is_read_back_unchanged(
    tmp_path: Path, several: list[Run], units: str, mechanism: str
) -> None:
    log, _ = written(tmp_path, *several, units=units, mechanism=mechanism)

    assert log.doubts == ()
    assert (log.units, log.mechanism) == (units, mechanism or "Mechanism")
    assert [one.test for one in log.runs] == [one.test for one in several]
    exact = UNITS[units].si == 1.0
    for ours, theirs in zip(several, log.runs, strict=True):
        np.testing.assert_allclose(
            theirs.time - theirs.time[0], ours.time - ours.time[0], rtol=0, atol=1.1e-6
        )
        assert np.array_equal(ours.voltage, theirs.voltage)
        for name in ("position", "velocity"):
            mine, back = getattr(ours, name), getattr(theirs, name)
            np.testing.assert_allclose(back, mine, rtol=0 if exact else 4e-16, atol=1e-300)
        for name in OPTIONAL:
            mine, back = getattr(ours, name), getattr(theirs, name)
            assert (mine is None) == (back is None)
            assert mine is None or np.array_equal(mine, back)
