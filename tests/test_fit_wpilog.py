"""`sysid fit --wpilog`: measured, simulated and residual as a log, which reads back as written."""

import numpy as np
import pytest
from open_page import drive_log, slipped_log, write_log

from sim.bench.mechanisms import MECHANISMS
from sim.cli import sysid
from sim.fit import fit
from sim.fit.innovations import compute_innovations
from sim.fit.replay import replay_fit
from sim.io import list_entries, read
from sim.support.command_line import run_command

RESIDUAL = 1e-9  # [m/s] of a double after a division and a difference


def run(*words):
    """The exit code of the command."""
    return run_command(sysid, name="sysid", arguments=[str(word) for word in words])


def signal_of(path, kind, *, units="meters", top="/sysid"):
    """One kind of signals in such a file, read as a log of its own."""
    entries = {
        "voltage": f"{top}/voltage",
        "position": f"{top}/{kind}/position",
        "velocity": f"{top}/{kind}/velocity",
        "state": f"{top}/test",
    }
    return read(path, units=units, entries=entries)


@pytest.mark.parametrize("name", ["drive.csv", "drive.wpilog"])
def test_log_of_the_fit_has_measured_and_simulated_signals(tmp_path, name):
    file, out = write_log(drive_log(), tmp_path / name), tmp_path / "out.wpilog"
    assert run("fit", file, "--wpilog", out) == 0
    log = read(file)
    replays = replay_fit(fit(log), log)
    measured, simulated, residual = (
        signal_of(out, kind) for kind in ("measured", "simulated", "residual")
    )

    for k, replay in enumerate(replays):
        assert measured.runs[k].test == replay.run.test
        np.testing.assert_allclose(measured.runs[k].time, replay.run.time, atol=1e-6)
        np.testing.assert_array_equal(measured.runs[k].velocity, replay.run.velocity)
        np.testing.assert_allclose(simulated.runs[k].velocity, replay.velocity, atol=RESIDUAL)
        np.testing.assert_allclose(simulated.runs[k].position, replay.position, atol=RESIDUAL)
        np.testing.assert_allclose(
            residual.runs[k].velocity,
            measured.runs[k].velocity - simulated.runs[k].velocity,
            atol=RESIDUAL,
        )


def test_innovations_are_written_only_at_new_readings(tmp_path):
    file, out = write_log(drive_log(), tmp_path / "drive.csv"), tmp_path / "out.wpilog"
    assert run("fit", file, "--wpilog", out) == 0
    log = read(file)
    expected = np.concatenate([one.velocity for one in compute_innovations(fit(log), log)])
    (written,) = (one for one in list_entries(out) if one.name == "/sysid/innovation/velocity")

    np.testing.assert_array_equal(written.numbers(), expected)
    assert written.metadata == "meters per second"


def correlation(log, found):
    """How much each velocity's innovation says of the next, over all runs; 0 is white."""
    runs = [one.velocity for one in compute_innovations(found, log)]
    before, after = (
        np.concatenate([one[part] for one in runs]) for part in (np.s_[:-1], np.s_[1:])
    )
    return float(np.corrcoef(before, after)[0, 1])


@pytest.mark.parametrize("mechanism", ["drivetrain", "elevator", "arm"])
def test_innovations_are_white_and_as_large_as_the_noise_where_the_model_holds(mechanism):
    log = drive_log(mechanism=mechanism)
    found = fit(log)
    every = np.concatenate([one.velocity for one in compute_innovations(found, log)])

    assert np.std(every) == pytest.approx(MECHANISMS[mechanism].sensor.velocity_noise, rel=0.2)
    assert abs(correlation(log, found)) < 0.2


def test_faults_are_marked(tmp_path):
    file, out = write_log(slipped_log(), tmp_path / "drive.csv"), tmp_path / "out.wpilog"
    run("fit", file, "--wpilog", out)

    assert "/sysid/fault" in {entry.name for entry in list_entries(out)}
    assert b"encoder-slip" in out.read_bytes()


@pytest.mark.parametrize(
    ("name", "says"), [("out.csv", "End its name in .wpilog."), ("no/out.wpilog", "cannot be")]
)
def test_a_place_that_cannot_be_written_is_refused_in_one_line(tmp_path, capsys, name, says):
    file = write_log(drive_log(), tmp_path / "drive.csv")

    assert run("fit", file, "--wpilog", tmp_path / name) == 2
    said = capsys.readouterr().err
    assert says in said
    assert said.count("\n") == 1
