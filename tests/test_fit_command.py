"""What `sysid fit` says and writes, in process: feedback on trial, sides, files, refusals."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import options, sysid
from sim.report.robot_code_snippet import SEASONS, TARGETS
from sim.support.command_line import run_command

SHORT = Routine(ramp=0.5, step=3.5, timeout=3.0)
DRIVE = MECHANISMS["drivetrain"]


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    path = tmp_path_factory.mktemp("logs") / "drive.wpilog"
    sim.write(simulate(DRIVE, SHORT, rng=np.random.default_rng(2)), path)
    return path


@pytest.fixture
def fit(capsys):
    """Run `sysid fit`: exit code, what it prints, and what it complains."""

    def ran(*arguments):
        capsys.readouterr()
        code = run_command(sysid, name="sysid", arguments=["fit", *map(str, arguments)])
        said = capsys.readouterr()
        return code, said.out, said.err

    return ran


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty folder to be in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_json_contains_the_gains_of_own_kp_and_own_kd(fit, drive):
    _, plain, _ = fit(drive, "--json")
    _, said, _ = fit(drive, "--json", "--own-kp", 2, "--own-kd", 0.01)

    own = json.loads(said)["own_feedback"]
    assert own.pop("reached_s") < own.pop("settled_s") < 1.0
    assert own == {
        "loop": "velocity", "kP": 2.0, "kD": 0.01, "verdict": "settles",
        "overshoot": pytest.approx(0.0, abs=0.05),
    }  # fmt: skip
    assert "own_feedback" not in json.loads(plain)


def test_a_suggestion_that_does_not_settle_is_a_warning(fit, tmp_path):
    arm = tmp_path / "arm.wpilog"
    sim.write(simulate(MECHANISMS["arm"], SHORT, rng=np.random.default_rng(2)), arm)

    _, said, _ = fit(arm, "--type", "arm", "--preset", "ctre-phoenix5")
    _, data, _ = fit(arm, "--type", "arm", "--preset", "ctre-phoenix5", "--json")

    assert "no good start; see the warning below" in said
    assert re.search(r"warning: Start the \w+ loop with kP \d", said) or "There is no good" in said
    assert said.count("kP -") == said.count("own suggestion, kP -")
    assert "unsettled-feedback" in [one["code"] for one in json.loads(data)["warnings"]]


def test_page_and_picture_are_written_beside_the_printed_table(fit, drive, tmp_path):
    html, plot = tmp_path / "drive.html", tmp_path / "drive.svg"

    code, said, err = fit(drive, "--html", html, "--plot", plot, "--json")

    assert (code, err) == (0, "")
    assert set(json.loads(said)["gains"]) == {"kS", "kV", "kA"}  # nothing but JSON
    assert '"name": "drive.wpilog"' in html.read_text(encoding="utf-8")
    assert plot.read_text(encoding="utf-8").count("quasistatic-forward") > 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["drive.html", "drive.svg"]


@pytest.mark.parametrize(
    "asked",
    [
        ["--html", "nowhere/drive.html"],
        ["--html", "drive.pdf"],
        ["--plot", "nowhere/drive.png"],
        ["--plot", "drive.gif"],
        ["--own-kd", 1],
        ["--loop", "position"],
        ["--own-kp", "nan"],
        ["--paste", "java", "--preset", "rev-brushless"],
        ["--paste", "java", "--own-kp", 2],
    ],
)
def test_request_that_cannot_be_met_is_refused_in_one_line(fit, drive, here, asked):
    code, out, err = fit(drive, *asked)

    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert list(here.iterdir()) == []


def test_a_direction_that_differs_is_reported_with_numbers(fit, tmp_path):
    # a sensor that reads a tenth too little in reverse: kV and kA are a tenth too large there
    log = simulate(DRIVE, SHORT, rng=np.random.default_rng(2))
    runs = tuple(
        replace(one, velocity=0.9 * one.velocity, position=0.9 * one.position)
        if one.direction == "reverse"
        else one
        for one in log.runs
    )
    sim.write(replace(log, runs=runs), tmp_path / "odd.wpilog")

    _, said, _ = fit(tmp_path / "odd.wpilog")
    _, data, _ = fit(tmp_path / "odd.wpilog", "--json")

    (doubt,) = [line for line in said.splitlines() if "kV is" in line]
    assert re.search(r"kV is 2\.52\d* ± [\d.]+ forward and 2\.80\d* ± [\d.]+ V·s/m reverse", doubt)
    assert "reverse, 11% apart" in doubt
    assert "directions-differ" not in [one["code"] for one in json.loads(data)["warnings"]]


def test_a_long_log_is_not_fitted_three_times_unless_for_a_page(fit, drive, tmp_path, monkeypatch):
    monkeypatch.setattr("sim.cli.fit.plausibility.LONG", 100)

    _, said, _ = fit(drive)
    _, patient, _ = fit(drive, "--html", tmp_path / "drive.html")

    assert "Forward and reverse were not compared" in said
    assert "not compared" not in patient


def test_units_that_contradict_the_file_are_reported_first(tmp_path, fit):
    arm = simulate(MECHANISMS["arm"], Routine(), rng=np.random.default_rng(1))
    path = tmp_path / "arm.wpilog"
    sim.write(replace(arm, units="rotations"), path)

    _, out, _ = fit(path, "--type", "arm", "--units", "radians")
    _, right, _ = fit(path, "--type", "arm")

    first = out.splitlines()[0]
    assert "the file says rotations" in first
    assert "but you chose radians" in first
    assert out.count("but you chose") == 1
    assert "the file says" not in right


def test_option_paste_offers_every_target_and_season():
    assert sorted(TARGETS) == options.TARGETS, "a row in TARGETS, and a template of its name"
    page = (options.SIM / "cli/open/page/index.html").read_text(encoding="utf-8")
    missing = [name for name in TARGETS if f'<option value="{name}">' not in page]
    assert not missing, f"index.html of sysid open has no option for {missing}"
    assert tuple(map(str, SEASONS)) == options.SEASONS
