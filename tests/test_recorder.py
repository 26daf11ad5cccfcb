"""Recorders: the log has the device's rates and delays, and its gains are found all the same."""

from functools import cache

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.recorder import RECORDERS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.feedback import PRESETS
from sim.fit import fit
from sim.io import read
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
def test_the_delay_that_the_fit_reports_is_the_devices_and_the_wait_for_a_frame(name):
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
