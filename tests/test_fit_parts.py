"""Alike parts of one robot: each is fitted alone, they are compared, and their gains are pooled."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from old_tools import RUNS
from wpilog_file import Logger

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.core.errors import BadRequest
from sim.fit import fit
from sim.fit.pooled import pool_fits, pool_values
from sim.support.command_line import run_command

ROUTINE = Routine(ramp=0.5, step=4.0, timeout=4.0)
DRIVE = MECHANISMS["drivetrain"]
SIGNALS = ("voltage", "position", "velocity")
FRAME = 4  # [samples] between two readings of a sensor that is logged every loop


def recorded(mechanism=DRIVE, seed=4, period=0.02):
    return simulate(mechanism, ROUTINE, rng=np.random.default_rng(seed), period=period)


def in_frames(one, offset):
    """A run whose position and velocity come in frames of 20 ms and are logged every 5 ms."""
    held = np.maximum((np.arange(len(one)) - offset) // FRAME * FRAME + offset, 0)
    return replace(one, position=one.position[held], velocity=one.velocity[held])


def old_file(path, left, right):
    """A drivetrain as SysId wrote it until 2023."""
    document = {"test": "Drivetrain", "units": "Meters", "unitsPerRotation": 1.0, "sysid": True}
    for key, test in RUNS.items():
        (a,), (b,) = left.list_runs_of_test(test), right.list_runs_of_test(test)
        n = min(len(a), len(b))
        columns = (a.time, a.voltage, b.voltage, a.position, b.position, a.velocity, b.velocity)
        rows = [*(one[:n] for one in columns), np.zeros(n), np.zeros(n)]
        document[key] = np.transpose(rows).tolist()
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def motors_file(path, logs, *, state="sysid-test-state-Drive", entry="{signal}-{motor}-Drive"):
    """A WPILOG file with several motors, all at the same times."""
    logger = Logger()
    first = next(iter(logs.values()))
    if state:
        logger.start(state, "string", "")
    for motor in logs:
        for signal in SIGNALS:
            logger.start(entry.format(signal=signal, motor=motor), "double", "")
    for number, one in enumerate(first.runs):
        for n, time in enumerate((1e6 * one.time).astype(int).tolist()):
            if state:
                logger.put(state, time, one.test)
            for motor, log in logs.items():
                for signal in SIGNALS:
                    value = float(getattr(log.runs[number], signal)[n])
                    logger.put(entry.format(signal=signal, motor=motor), time, value)
        if state:
            logger.put(state, int(1e6 * one.time[-1]) + 20_000, "none")
    return logger.save(path)


@pytest.fixture
def fit_json(capsys):
    """Run `sysid fit --json`: its answer, or what it complains."""

    def ran(*arguments):
        capsys.readouterr()
        arguments = ["fit", "--json", *map(str, arguments)]
        code = run_command(sysid, name="sysid", arguments=arguments)
        said = capsys.readouterr()
        return json.loads(said.out) if code < 2 else said.err

    return ran


def within_parts(found):
    """No gain lies outside those of the parts."""
    assert len(found["parts"]) > 1
    for gain, value in found["gains"].items():
        own = [part["gains"][gain] for part in found["parts"].values()]
        assert min(own) <= value <= max(own), gain


def codes(found):
    return [one["code"] for one in found["warnings"]]


def test_two_sides_in_frames_of_their_own_have_the_gains_of_each(fit_json, tmp_path):
    left, right = (
        replace(log, runs=tuple(in_frames(one, offset) for one in log.runs))
        for log, offset in (
            (recorded(seed=4, period=0.005), 0),
            (recorded(seed=5, period=0.005), 2),
        )
    )

    found = fit_json(old_file(tmp_path / "drive.json", left, right))

    within_parts(found)
    assert list(found["parts"]) == ["left", "right"]
    for gain, value in fit(recorded(period=0.005)).gains.items():
        assert found["gains"][gain] == pytest.approx(value, rel=0.06, abs=0.02)


def test_four_modules_are_fitted_though_one_is_inverted(fit_json, tmp_path):
    logs = {name: recorded(seed=seed) for seed, name in enumerate(("fl", "fr", "bl", "br"))}
    turned = tuple(
        replace(one, voltage=-one.voltage, position=-one.position, velocity=-one.velocity)
        for one in logs["fr"].runs
    )
    logs["fr"] = replace(logs["fr"], runs=turned)

    found = fit_json(motors_file(tmp_path / "a.wpilog", logs), "--units", "meters")

    within_parts(found)
    assert list(found["parts"]) == ["fl", "fr", "bl", "br"]
    assert "mirrored-motor" in codes(found)
    assert found["gains"]["kA"] == pytest.approx(fit(recorded()).gains["kA"], rel=0.05)


def test_files_of_one_test_each_are_joined_module_by_module(fit_json, tmp_path):
    logs = {name: recorded(seed=seed) for seed, name in enumerate(("Left", "Right"))}
    files = []
    for number, one in enumerate(logs["Left"].runs):
        some = {name: replace(log, runs=(log.runs[number],)) for name, log in logs.items()}
        files.append(
            motors_file(
                tmp_path / f"{one.test}.wpilog",
                some,
                state="",
                entry="/Base/{motor}/Wheel_{signal}",
            )
        )

    found = fit_json(*files, "--units", "meters")

    within_parts(found)
    assert list(found["parts"]) == ["/Base/Left/wheel", "/Base/Right/wheel"]
    for gain, value in fit(recorded()).gains.items():
        assert found["gains"][gain] == pytest.approx(value, rel=0.05, abs=0.02)


def test_whole_recordings_are_parts_of_their_own(fit_json, tmp_path):
    files = []
    for seed in range(3):
        files.append(tmp_path / f"day{seed}.csv")
        sim.write(recorded(seed=seed), files[-1])

    found = fit_json(*files)

    within_parts(found)
    assert list(found["parts"]) == ["day0", "day1", "day2"]


def test_parts_that_differ_are_doubted_and_the_error_says_how_far(fit_json, tmp_path):
    heavy = replace(DRIVE, drag=DRIVE.drag + 0.3)

    found = fit_json(old_file(tmp_path / "drive.json", recorded(), recorded(heavy)))

    within_parts(found)
    assert "sides-differ" in codes(found)
    own = [part["gains"]["kV"] for part in found["parts"].values()]
    assert found["errors"]["kV"] > 0.4 * (max(own) - min(own))


def test_a_side_that_cannot_be_fitted_is_left_out_by_name(fit_json, tmp_path):
    still = recorded()
    runs = tuple(
        replace(one, position=np.zeros(len(one)), velocity=np.zeros(len(one))) for one in still.runs
    )

    found = fit_json(old_file(tmp_path / "a.json", replace(still, runs=runs), recorded()))

    assert "part-left-out" in codes(found)
    (said,) = [one["message"] for one in found["warnings"] if one["code"] == "part-left-out"]
    assert "side 'left'" in said
    assert found["gains"]["kV"] == pytest.approx(fit(recorded()).gains["kV"], rel=0.02)


def test_an_angle_and_a_length_have_no_common_gains():
    length, angle = fit(recorded()), fit(recorded(MECHANISMS["shooter"]))

    with pytest.raises(BadRequest, match="cannot be converted into"):
        pool_fits({"a": length, "b": angle})


SIZES = st.floats(1e-6, 1e3)


@given(st.lists(st.tuples(st.floats(-1e3, 1e3), SIZES), min_size=1, max_size=6))
def test_a_pooled_value_lies_within_its_parts(parts):
    values, errors = (list(column) for column in zip(*parts, strict=True))

    value, error = pool_values(values, errors)

    assert min(values) <= value <= max(values)
    assert error >= 0.99 * min(errors) / len(errors) ** 0.5
