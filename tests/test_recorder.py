"""Recorders: each kind of logging leaves its own marks on a velocity."""

from functools import cache

import numpy as np
import pytest
from handmade import change_signals
from hypothesis import given
from hypothesis import strategies as st

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.recorder import RECORDERS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.cli.log_reader import LogReader
from sim.core.log import Log, Run
from sim.feedback import PRESETS
from sim.fit import fit
from sim.inspect.detect_faults import inspect
from sim.io import read
from sim.io.motion import find_landing, find_truncation, mend_motion
from sim.reconcile import reconcile
from sim.support.command_line import run_command

PUBLISHED = {
    "talonfx": "ctre-phoenix6", "phoenix5": "ctre-phoenix5", "sparkmax": "rev-brushless",
    "sparkmax-encoder": "rev-brushed", "venom": "venom",
}  # fmt: skip


@cache
def recorded(name):
    recorder = RECORDERS[name]
    built = recorder.record(MECHANISMS["shooter"])
    rng = np.random.default_rng(4)
    return simulate(built, Routine(timeout=5.0), rng=rng, period=recorder.period)


@cache
def fitted(name):
    return fit(recorded(name), type="simple")


@pytest.mark.parametrize("name", RECORDERS)
def test_the_gains_of_a_shooter_are_found_whatever_records_it(name):
    found, truth = fitted(name), MECHANISMS["shooter"].gains

    assert found.gains["kV"] == pytest.approx(truth["kV"], rel=0.002)
    assert found.gains["kA"] == pytest.approx(truth["kA"], rel=0.01)


@pytest.mark.parametrize("name", RECORDERS)
def test_reported_delay_is_that_of_the_device_plus_the_wait_for_a_frame(name):
    recorder = RECORDERS[name]
    late = recorder.latency + 0.5 * recorder.filter

    found = fitted(name).velocity_delay

    assert late - 2e-3 <= found <= late + recorder.frame + 2e-3


@pytest.mark.parametrize(("name", "preset"), PUBLISHED.items())
def test_the_published_delay_is_that_of_the_feedback_preset(name, preset):
    assert 0.5 * RECORDERS[name].filter == pytest.approx(PRESETS[preset].delay, abs=1e-9)


def test_the_command_records_as_asked(tmp_path, capsys):
    asked = ["simulate", "shooter", "--seed", "1", "-o", str(tmp_path / "a.csv")]

    code = run_command(sysid, name="sysid", arguments=[*asked, "--recorder", "signal-logger"])
    refused = run_command(sysid, name="sysid", arguments=[*asked, "--recorder", "hoot"])

    assert (code, refused) == (0, 2)
    assert "Choose one of: roborio," in capsys.readouterr().err
    assert np.median(np.diff(read(tmp_path / "a.csv").runs[0].time)) == pytest.approx(
        0.004, rel=0.02
    )


KA = 0.1  # [share] by which a coarse recorder may change kA


@pytest.fixture(scope="module")
def drive() -> Log:
    return simulate(MECHANISMS["drivetrain"], Routine(), rng=np.random.default_rng(3))


def write_columns(log: Log, path, header: str, *, scale: float = 1.0, restart: bool = False):
    """Write a log as another program would: with other names, units of time, and clocks."""
    rows = [header]
    for run in log.runs:
        time = (run.time - run.time[0] * restart) * scale
        signals = (time, run.voltage, run.position, run.velocity)
        rows += [
            ",".join([repr(t), run.test, *map(repr, rest)])
            for t, *rest in zip(*(signal.tolist() for signal in signals), strict=True)
        ]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def assert_same_gains(found, expected, *, ka: float = KA) -> None:
    for gain in ("kV", "kG"):
        if gain in expected.gains:
            assert found.gains[gain] == pytest.approx(expected.gains[gain], rel=0.02)
    assert found.gains["kA"] == pytest.approx(expected.gains["kA"], rel=ka)


@pytest.mark.parametrize(
    ("header", "scale", "restart"),
    [
        ("t,test,voltage,position,velocity", 1.0, False),
        ("time_ms,state,volts,position_m,velocity_mps", 1e3, False),
        ("timestamp,test,voltage,position,velocity", 1e6, True),
        ("Time (ms),Test,Voltage (V),Position (m),Velocity (m/s)", 1e3, True),
    ],
)
def test_columns_are_found_under_any_known_name_and_unit(tmp_path, drive, header, scale, restart):
    path = write_columns(drive, tmp_path / "log.csv", header, scale=scale, restart=restart)

    read = sim.read(path)

    assert [run.test for run in read.runs] == [run.test for run in drive.runs]
    for mine, true in zip(read.runs, drive.runs, strict=True):
        assert np.allclose(np.diff(mine.time), np.diff(true.time), atol=2e-6)
        assert np.array_equal(mine.velocity, true.velocity)


@pytest.mark.parametrize("missing", ["position", "velocity"])
def test_missing_signal_is_computed_from_the_other(tmp_path, drive, missing):
    sim.write(drive, tmp_path / "log.csv")
    rows = (tmp_path / "log.csv").read_text("utf-8").splitlines()
    place = rows[0].split(",").index(missing)
    left = [",".join(cells[:place] + cells[place + 1 :]) for cells in (r.split(",") for r in rows)]
    (tmp_path / "log.csv").write_text("\n".join(left) + "\n", encoding="utf-8")

    read = LogReader().read_joined([tmp_path / "log.csv"])

    assert [doubt.code for doubt in read.doubts] == [f"no-{missing}"]
    assert_same_gains(fit(read), fit(drive))


@pytest.mark.parametrize("signal", ["position", "velocity"])
def test_signal_that_never_changes_is_replaced_and_named(drive, signal):
    still = change_signals(drive, **{signal: lambda run: np.zeros(len(run))})

    mended = mend_motion(still)

    assert [doubt.code for doubt in mended.doubts] == [f"{signal}-still"]
    assert f"{signal}-still" in {doubt.code for doubt in inspect(still).doubts}
    assert_same_gains(fit(mended), fit(drive))


def test_arm_without_a_position_is_refused(tmp_path, capsys):
    path = tmp_path / "arm.csv"
    path.write_text("test,time_s,voltage,velocity\ndynamic-forward,0,1,0\n", encoding="utf-8")

    assert run_command(sysid, name="sysid", arguments=["fit", str(path), "--type", "arm"]) == 2
    assert "arm.csv" in capsys.readouterr().err


@pytest.mark.parametrize("share", [0.03, 0.12])
@pytest.mark.parametrize("name", ["drivetrain", "shooter", "elevator", "arm"])
def test_a_truncated_velocity_is_reported_and_fitted(name, share):
    log = simulate(MECHANISMS[name], Routine(), rng=np.random.default_rng(2))
    step = share * log.top_speed
    cut = change_signals(log, velocity=lambda run: np.trunc(run.velocity / step) * step)

    mended = mend_motion(cut)

    assert find_truncation(log) == 0.0
    assert find_truncation(cut) == pytest.approx(step)
    assert {doubt.code for doubt in inspect(cut).doubts} >= {"velocity-truncated"}
    assert not {"scales-differ", "unit-error"} & {doubt.code for doubt in inspect(cut).doubts}
    assert_same_gains(fit(mended, type=log.type), fit(log, type=log.type))


def test_wrong_scale_makes_no_gain_usable_and_prints_no_code(tmp_path, capsys, drive):
    sim.write(change_signals(drive, velocity=lambda run: run.velocity / 60.0), tmp_path / "log.csv")
    arguments = ["fit", str(tmp_path / "log.csv")]

    assert run_command(sysid, name="sysid", arguments=arguments) == 1
    said = capsys.readouterr().out
    assert "--velocity-scale 60" in said
    assert "Verdict: Do not use these gains" in said
    assert run_command(sysid, name="sysid", arguments=[*arguments, "--paste", "java"]) == 2
    assert not capsys.readouterr().out


@pytest.mark.parametrize("command", ["fit", "inspect"])
def test_every_command_picks_a_mechanism_by_its_number(shared, capsys, command):
    path = shared / "data" / "field-cases" / "two_mechanisms.wpilog"
    if not path.exists():
        pytest.skip("the field cases are not here")

    assert run_command(sysid, name="sysid", arguments=[command, str(path), "--pick", "1"]) == 0
    assert run_command(sysid, name="sysid", arguments=[command, str(path)]) == 2
    assert "--pick 1" in capsys.readouterr().err


def test_arm_that_falls_onto_its_stop_shows_its_spring(shared):
    path = shared / "data" / "field-cases" / "arm_drops_onto_its_stop.csv"
    if not path.exists():
        pytest.skip("the field cases are not here")
    log = LogReader(type="arm", units="radians").read_joined([path])

    story = reconcile(log, type="arm")

    assert "falls-first" in {doubt.code for doubt in log.doubts}
    assert [part.effect for part in story.model.parts] == ["spring"]
    assert story.gains["kG"].value == pytest.approx(1.509, abs=0.01)


@pytest.mark.parametrize(("name", "step"), [("arm", 7.0), ("elevator", 7.0), ("turret", 3.0)])
def test_frames_of_a_motor_controller_are_no_missing_effect(name, step):
    recorder = RECORDERS["talonfx"]
    robot = recorder.record(MECHANISMS[name])
    log = simulate(robot, Routine(step=step), rng=np.random.default_rng(5), period=recorder.period)

    story = reconcile(log, type=robot.type)

    assert {one.effect for one in story.findings} <= {"delay"}
    assert story.gap_after < 2.0 * story.noise_floor


@pytest.mark.parametrize("seed", [2, 3])
def test_lag_that_differs_by_run_does_not_hide_backlash(seed):
    robot = MECHANISMS["turret"].hide("backlash", 1.0)
    log = simulate(robot, Routine(step=4.0), rng=np.random.default_rng(seed))
    assert fit(log, type=robot.type).lag_differs  # runs that begin in the play are late

    story = reconcile(log, type=robot.type)

    assert [one.effect for one in story.findings] == ["backlash"]


def test_elevator_that_stays_on_its_stop_in_a_test_is_fitted_by_the_others():
    weak = Routine(step=0.2)
    log = simulate(MECHANISMS["elevator"], weak, rng=np.random.default_rng(1))

    found = fit(log, type="elevator")

    assert [doubt.code for doubt in found.doubts] == ["still-run"]
    for gain, value in MECHANISMS["elevator"].gains.items():
        assert abs(found.gains[gain] - value) < 3.0 * found.errors[gain]


@given(st.integers(0, 12), st.integers(0, 9), st.sampled_from([-1.0, 0.2, 1.0]), st.integers(0, 9))
def test_search_for_a_landing_accepts_any_fall_and_rest(fall, rest, push, length):
    velocity = np.array([0.0, *[-0.1] * fall, *[0.0] * rest, *[push] * length])
    time = 0.02 * np.arange(velocity.size)
    run = Run("dynamic-forward", time, np.ones(velocity.size), 0.02 * np.cumsum(velocity), velocity)

    assert 0 <= find_landing(run) < len(run)
