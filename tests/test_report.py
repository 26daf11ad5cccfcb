"""The page and the picture of a fit: whole, alone, for everybody, and true."""

import math
import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest
from page_flaws import page_flaws

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.feedback import PRESETS, Feedback
from sim.fit import fit
from sim.fit.feedback_trial import OwnGains, try_feedback_gains
from sim.report import Report, render_page, write_page, write_picture

SHORT = Routine(ramp=0.5, step=3.5, timeout=3.0)
DEFAULT = PRESETS["default"]


@pytest.fixture(scope="module")
def drive():
    """A report of a drivetrain with the learner's own gains in it."""
    log = simulate(MECHANISMS["drivetrain"], SHORT, rng=np.random.default_rng(2))
    found = fit(log).in_log_units()
    own = OwnGains("position", Feedback(300.0, 0.0))
    return Report("drive.wpilog", found, log, DEFAULT, try_feedback_gains(found, DEFAULT, own=own))


@pytest.fixture(scope="module")
def brief(drive):
    """The same of one run, where the runs are not what matters."""
    return replace(drive, log=replace(drive.log, runs=drive.log.runs[:1]), tried=drive.tried[:1])


@pytest.fixture(scope="module")
def whole(drive):
    return render_page(drive)


def test_the_page_is_alone_and_for_everybody(whole):
    assert page_flaws(whole) == []


@pytest.mark.parametrize(
    ("planted", "seen"),
    [
        ('<script src="https://cdn.example/plot.js"></script>', "<script>"),
        ('<img src="https://example.org/a.png" alt="a picture of all four runs">', "points to"),
        ('<img src="data:image/png;base64,AA" alt="">', "a picture without words"),
        ('<link rel="stylesheet" href="style.css">', "points to style.css"),
        ('<p onclick="alert(1)">x</p>', "runs onclick"),
        ("<style>@import 'x.css';</style>", "a style from elsewhere"),
        ("<p>kA = nan V·s²/m</p>", "says 'nan'"),
        ("<td>-inf</td>", "says '-inf'"),
        ("<h4>too deep</h4>", "<h4> after"),
        ("<th>kS</th>", "a header of nothing"),
        ('<a href="#nowhere">there</a>', "a link to nothing"),
        ("<div>", "stays open"),
    ],
)
def test_a_planted_flaw_is_seen(whole, planted, seen):
    flawed = whole.replace("<section", f"{planted}<section", 1)

    assert any(seen in flaw for flaw in page_flaws(flawed)), page_flaws(flawed)


@pytest.mark.parametrize(("what", "seen"), [(' lang="en"', "no language"), ("title>", "no title")])
def test_a_page_without_what_a_reader_needs_is_seen(whole, what, seen):
    without = whole.replace(what, "" if what.startswith(" ") else "b>")

    assert seen in page_flaws(without)


def test_every_run_is_there_with_its_numbers(drive, whole):
    runs = re.findall(r"<h3>Run \d+: (\S+)</h3>", whole)

    assert runs == [run.test for run in drive.log.runs]
    assert len(re.findall(r"<img ", whole)) == len(runs) + 1  # and the step responses
    for run in drive.log.runs:
        assert f"{run.test}: measured and simulated velocity and position" in whole


def test_the_gains_on_the_page_are_those_of_the_fit(drive, whole):
    for name in ("kS", "kV", "kA"):
        value = re.search(rf'<th scope="row">{name}</th><td class="number">([\d.]+)<', whole)[1]
        assert float(value) == pytest.approx(drive.found.gains[name], rel=1e-4)


def test_every_controller_and_every_snippet_is_there(whole):
    said = unescape(whole)
    for preset in PRESETS.values():
        assert f"{preset.name}<br>" in said
    for language in ("Java", "Python"):
        for season in (2026, 2027):
            assert f"<summary>{language}, WPILib {season}</summary>" in said
    assert "new SimpleMotorFeedforward(kS, kV, kA)" in said
    assert "SimpleMotorFeedforwardMeters(kS, kV, kA)" in said


def test_the_learners_own_gains_are_told_on_the_page(whole):
    assert "The position loop with your own gains oscillates" in whole


def test_the_same_fit_gives_the_same_page(drive, whole):
    assert render_page(replace(drive)) == whole


def test_what_a_file_is_called_is_no_code(brief):
    hostile = "<script>alert(1)</script>.wpilog"
    doubt = Doubt("x", "the motor '<img src=x onerror=alert(1)>' was left out")

    told = render_page(
        replace(brief, title=hostile, found=replace(brief.found, doubts=(doubt,)), notes=("<b>",))
    )

    assert page_flaws(told) == []
    assert "&lt;script&gt;alert(1)" in told


def test_doubts_stand_on_the_page_the_gravest_first(brief):
    doubts = (Doubt("a", "Only a look."), Doubt("b", "It cannot be.", grave=True))

    told = render_page(
        replace(brief, found=replace(brief.found, doubts=doubts), notes=("All is even.",))
    )

    assert (
        0 < told.index("<b>Wrong:</b> It cannot be.") < told.index("<b>Warning:</b> Only a look.")
    )
    assert "All is even." in told
    assert (
        "no code is printed, because the gains cannot be right" in told
    )  # in place of each snippet


@pytest.mark.parametrize(
    "changes",
    [
        {"errors": {"kS": math.nan, "kV": math.inf, "kA": 0.01}},
        {"errors": {}},
        {"simulated_velocity_r2": -math.inf, "simulated_velocity_rmse": math.inf},
        {"gains": {"kS": 0.1, "kV": 2.5, "kA": -0.2}},
        {"gains": {"kS": -0.1, "kV": 2.5, "kA": 0.2}},
    ],
    ids=["error unknown", "no errors", "ran away", "kA below zero", "kS below zero"],
)
def test_what_is_not_known_is_said_in_words(brief, changes):
    found = replace(brief.found, **changes)

    told = render_page(replace(brief, found=found, tried=try_feedback_gains(found, DEFAULT)))

    assert page_flaws(told) == []


def test_an_arm_has_its_angle_and_its_gravity():
    log = simulate(MECHANISMS["arm"], SHORT, rng=np.random.default_rng(2))
    found = fit(log).in_log_units()

    told = render_page(
        Report("arm.wpilog", found, log, DEFAULT, try_feedback_gains(found, DEFAULT))
    )

    assert page_flaws(told) == []
    assert "kG·cos(angle from horizontal)" in told
    assert "new ArmFeedforward(kS, kG, kV, kA)" in unescape(told)


@pytest.mark.shared
def test_a_real_arm_has_a_page_that_says_what_to_doubt(shared):
    log = sim.read(shared / "data" / "real" / "sciborgs-2023-wrist-arm.json")
    found = fit(log).in_log_units()

    told = render_page(
        Report("wrist.json", found, log, DEFAULT, try_feedback_gains(found, DEFAULT))
    )

    assert page_flaws(told) == []
    assert told.count("<h3>Run ") == len(log.runs)
    assert "<b>Warning:</b> A simulation with these gains has a velocity error of" in told


def test_a_page_is_written_whole(brief, tmp_path, monkeypatch):
    there = tmp_path / "drive.html"
    there.write_text("the old one", encoding="utf-8")
    monkeypatch.setattr("sim.report.render_page", lambda _: "\ud800")  # no file can hold it

    with pytest.raises(UnicodeEncodeError):
        write_page(brief, there)

    assert there.read_text(encoding="utf-8") == "the old one"
    assert list(tmp_path.iterdir()) == [there]


@pytest.mark.parametrize("write", [write_page, write_picture])
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("nowhere/drive{}", "Choose a folder that exists"),
        ("folder{}", "Choose a folder that exists"),
        ("drive.docx", "End its name in"),
        ("drive", "End its name in"),
    ],
)
def test_what_cannot_be_written_is_refused_in_one_line(brief, tmp_path, write, name, said):
    suffix = ".html" if write is write_page else ".svg"
    (tmp_path / f"folder{suffix}").mkdir()

    with pytest.raises(BadRequest, match=said):
        write(brief, tmp_path / name.format(suffix))

    assert [path.name for path in tmp_path.iterdir()] == [f"folder{suffix}"]


@pytest.mark.parametrize(
    ("suffix", "begins"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")]
)
def test_the_picture_is_of_the_kind_its_name_says(brief, tmp_path, suffix, begins):
    write_picture(brief, tmp_path / f"drive{suffix}")

    content = (tmp_path / f"drive{suffix}").read_bytes()
    assert content.startswith(begins)
    if suffix == ".svg":
        text = content.decode("utf-8")
        assert "<title>quasistatic-forward: measured and simulated" in text
        assert "<script" not in text
        for word in ("residual [m/s]", "voltage [V]", "velocity loop"):
            assert word in text


def test_nothing_to_draw_is_refused(drive, tmp_path):
    found = replace(drive.found, gains={"kS": 0.1, "kV": 2.5, "kA": -0.2})

    with pytest.raises(BadRequest, match="nothing to draw"):
        write_picture(replace(drive, found=found, tried=()), tmp_path / "drive.png")
