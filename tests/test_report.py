"""Pages and pictures: whole, alone, for everybody, and written as a whole or not at all."""

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from page_flaws import page_flaws
from test_class_exports import student

from grader.classroom.result_pages import write_pages
from grader.classroom.results import ClassResults
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.fit import fit
from sim.report.fit_picture import write_picture
from sim.report.page_file import choose_page_path, write_page_file

pytestmark = pytest.mark.slow

SHORT = Routine(ramp=0.5, step=3.5, timeout=3.0)


@pytest.fixture(scope="module")
def whole():
    """The page of a student."""
    results = ClassResults("Robotics 1", (student("Ada", [1.0]),), ("exercise1",))
    with TemporaryDirectory() as folder:
        write_pages(results, Path(folder))
        return next(Path(folder).glob("students/*.html")).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def drive():
    """A fit of a drivetrain, and its log of one run."""
    log = simulate(MECHANISMS["drivetrain"], SHORT, rng=np.random.default_rng(2))
    found = fit(log).in_log_units()
    return found, replace(log, runs=log.runs[:1])


def test_fit_page_loads_nothing_and_is_accessible(whole):
    assert page_flaws(whole) == []


def write_page(_drive, path):
    """Write any page."""
    write_page_file("<p>a page", choose_page_path(path))


def draw(drive, path):
    """Write the picture of a fit."""
    write_picture(*drive, path)


def test_a_page_is_written_whole(tmp_path):
    there = tmp_path / "drive.html"
    there.write_text("the old one", encoding="utf-8")

    with pytest.raises(UnicodeEncodeError):
        write_page_file("\ud800", there)  # no file can hold it

    assert there.read_text(encoding="utf-8") == "the old one"
    assert list(tmp_path.iterdir()) == [there]


@pytest.mark.parametrize("write", [write_page, draw])
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("nowhere/drive{}", "Choose a folder that exists"),
        ("folder{}", "Choose a folder that exists"),
        ("drive.docx", "End its name in"),
        ("drive", "End its name in"),
    ],
)
def test_page_that_cannot_be_written_is_refused_in_one_line(drive, tmp_path, write, name, said):
    suffix = ".html" if write is write_page else ".svg"
    (tmp_path / f"folder{suffix}").mkdir()

    with pytest.raises(BadRequest, match=said):
        write(drive, tmp_path / name.format(suffix))

    assert [path.name for path in tmp_path.iterdir()] == [f"folder{suffix}"]


@pytest.mark.parametrize(
    ("suffix", "begins"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")]
)
def test_the_picture_is_of_the_kind_its_name_says(drive, tmp_path, suffix, begins):
    draw(drive, tmp_path / f"drive{suffix}")

    content = (tmp_path / f"drive{suffix}").read_bytes()
    assert content.startswith(begins)
    if suffix == ".svg":
        text = content.decode("utf-8")
        assert "<title>quasistatic-forward: measured and simulated" in text
        assert "<script" not in text
        for word in ("residual [m/s]", "voltage [V]"):
            assert word in text


def test_fit_with_nothing_to_draw_is_refused(drive, tmp_path):
    found = replace(drive[0], gains={"kS": 0.1, "kV": 2.5, "kA": -0.2})

    with pytest.raises(BadRequest, match="nothing to draw"):
        write_picture(found, drive[1], tmp_path / "drive.png")
