"""Signals in WPILOG logs: their time base, and what is said when one is missing.

The logs come from the little robot in ``wpilog_file``.
"""

from pathlib import Path

import numpy as np
import pytest
from wpilog_file import FOUR, Logger, Motor, codes, motion, routine, saved

import sim
from sim.core.errors import MissingSignal

METERS = ("volt", "meter", "meters_per_second")


@pytest.mark.parametrize(
    ("late", "state_late"),
    [((0, 0, 0), 0), ((0, 30, 60), 90)],
    ids=["all at one time", "each value at a time of its own"],
)
def test_a_log_of_changes_only_reads_as_the_whole_one(
    tmp_path: Path, late: tuple[int, int, int], state_late: int
) -> None:
    """A step's voltage is logged once there, so SysId's own rule would leave one sample."""
    motor = Motor("main", late=late)
    whole = sim.read(saved(tmp_path, Motor("main"), state_late=state_late))
    changes = sim.read(saved(tmp_path, motor, changes_only=True, state_late=state_late))

    assert codes(changes) == ["change-only"]
    assert [run.test for run in changes.runs] == list(FOUR)
    for ours, theirs in zip(changes.runs, whole.runs, strict=True):
        np.testing.assert_allclose(ours.time, theirs.time + late[2] / 1e6, atol=1e-9)
        assert np.array_equal(ours.voltage, theirs.voltage)
        assert np.array_equal(ours.velocity, theirs.velocity)


def test_a_slow_sensor_is_no_log_of_changes_only(tmp_path: Path) -> None:
    slow = Motor("main", units=METERS, every=(1, 1, 5))
    log = sim.read(saved(tmp_path, slow, tests=("quasistatic-forward",)))

    (run,) = log.runs
    assert codes(log) == ["uneven-rates"]
    v = [motion("quasistatic-forward", loop)[1] for loop in (0, 5)]
    assert run.velocity[2] == pytest.approx(v[0] + (v[1] - v[0]) * 2 / 5)
    assert run.time[-1] == pytest.approx(1.0 + 0.02 * 38)  # the line reaches a little further


def test_what_lies_beyond_a_signal_is_not_made_up(tmp_path: Path) -> None:
    """Lines are drawn between samples, not for seconds past the last of them."""
    logger = Logger()
    for name in ("voltage", "position", "velocity"):
        logger.start(f"{name}-m-Arm", "double", {"voltage": "volt"}.get(name, "meter"))
    logger.start("sysid-test-state-Arm", "string")
    for loop in range(100):
        logger.put("voltage-m-Arm", loop * 20_000, 1.0)
        logger.put("position-m-Arm", loop * 20_000, float(loop))
        if loop < 60:
            logger.put("velocity-m-Arm", loop * 20_000, float(loop))
        logger.put("sysid-test-state-Arm", loop * 20_000, "dynamic-forward")

    log = sim.read(logger.save(tmp_path / "log.wpilog"), units="meters")

    assert len(log.runs[0]) == 60
    assert "short-signal" in codes(log)
    assert any("40 of 100 samples" in doubt.message for doubt in log.doubts)


@pytest.mark.parametrize(
    ("leave_out", "expected"),
    [
        (("voltage",), "voltage-main-Arm"),
        (("position", "velocity"), "position-main-Arm"),
        (("voltage", "position", "velocity"), "voltage-<motor>-Arm"),
    ],
)
def test_missing_entry_is_named(tmp_path: Path, leave_out: tuple[str, ...], expected: str) -> None:
    logger = Logger()
    logger.start("/Arm/AppliedVolts")
    logger.put("/Arm/AppliedVolts", 1, 1.0)
    routine(logger, Motor("main", leave_out=leave_out))

    with pytest.raises(MissingSignal) as caught:
        sim.read(logger.save(tmp_path / "log.wpilog"))

    assert f"'{expected}' (double)" in caught.value.what
    assert "'/Arm/AppliedVolts'" in caught.value.what


def foreign(tmp_path: Path) -> Path:
    """The log of a logger with names of its own."""
    logger = Logger()
    routine(logger, Motor("main"))
    content = b"".join(logger.parts)
    for ours, theirs in (
        (b"sysid-test-state-Arm", b"/RealOutputs/Arm/Sys"),
        (b"voltage-main-Arm", b"/Arm/AppliedVolt"),
        (b"position-main-Arm", b"/Arm/Encoder/Angle"[:17]),
        (b"velocity-main-Arm", b"/Arm/Encoder/Speed"[:17]),
    ):
        content = content.replace(ours, theirs)
    path = tmp_path / "log.wpilog"
    path.write_bytes(content)
    return path


ENTRIES = {
    "state": "/RealOutputs/Arm/Sys",
    "voltage": "/Arm/AppliedVolt",
    "position": "/Arm/Encoder/Angl",
    "velocity": "/Arm/Encoder/Spee",
}


def test_an_entry_given_wins_over_one_found(tmp_path: Path) -> None:
    logger = Logger()
    routine(logger, Motor("main"))
    routine(logger, Motor("main", sign=-1), mechanism="Other", begin=1_000_000, tests=FOUR[:1])
    path = logger.save(tmp_path / "log.wpilog")

    log = sim.read(
        path, entries={"voltage": "voltage-main-Other", "state": "sysid-test-state-Other"}
    )

    assert log.runs[0].voltage[-1] < 0
    log = sim.read(path, entries={"voltage": "voltage-main-Arm", "state": "sysid-test-state-Other"})
    assert log.runs[0].voltage[-1] > 0


@pytest.mark.parametrize(
    ("signal", "name"),
    [
        pytest.param("voltage", "/Arm/Applied", id="nearly"),
        pytest.param("velocity", "??", id="not at all"),
        pytest.param("position", "/RealOutputs/Arm/Sys", id="of another type"),
        pytest.param("state", "/Arm/AppliedVolt", id="no string"),
    ],
)
def test_an_entry_that_cannot_be_used_is_refused(tmp_path: Path, signal: str, name: str) -> None:
    with pytest.raises(MissingSignal) as caught:
        sim.read(foreign(tmp_path), entries=ENTRIES | {signal: name})

    assert caught.value.advice
