"""Pictures: each says in words and numbers what it shows, and is the same every time."""

import ast
import os
import subprocess
import sys
from dataclasses import replace
from functools import cache
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from html_tags import Tags

import sim
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.inspect.fault import Damage, LogInterval
from sim.plot import (
    Line,
    Picture,
    plot_acceleration_velocity,
    plot_time_series,
    plot_voltage_velocity,
)
from sim.plot.picture import make_panels

ROUTINE = sim.Routine(ramp=0.5, step=3.5)


def _log(name):
    return simulate(sim.MECHANISMS[name], ROUTINE, rng=np.random.default_rng(1))


DRIVE, SHOOTER = _log("drivetrain"), _log("shooter")
PICTURES = {
    "time series": lambda: plot_time_series(DRIVE),
    "the first second of steps": lambda: plot_time_series(DRIVE, dynamic_seconds=1.0),
    "time series in rotations": lambda: plot_time_series(SHOOTER),
    "one test only": lambda: plot_time_series(replace(DRIVE, runs=DRIVE.runs[:1])),
    "voltage against velocity": lambda: plot_voltage_velocity(DRIVE),
    "with lines": lambda: plot_voltage_velocity(
        DRIVE, lines={"a": Line(0.2, 2.5), "b": Line(0.1, 2.4)}
    ),
    "time series with damage": lambda: plot_time_series(
        DRIVE,
        damages=[
            Damage(LogInterval(0, DRIVE.runs[0].test, 2.0, 2.5), 0.9, "", "", fault="overrun")
        ],
    ),
    "acceleration against velocity": lambda: plot_acceleration_velocity(DRIVE),
}
each_picture = pytest.mark.parametrize("name", PICTURES)


@cache
def drawn(name):
    """Each picture is drawn once for all the questions about it."""
    picture = PICTURES[name]()
    return picture, picture.svg, picture._repr_mimebundle_()


@each_picture
def test_picture_is_drawn_and_has_alt_text(name):
    picture, svg, bundle = drawn(name)
    assert len(picture.alt) > 40
    assert picture.alt.endswith(".")
    root = ET.fromstring(svg)  # noqa: S314 - our own drawing
    assert root.tag.endswith("svg")
    tags = Tags(bundle["text/html"])
    assert tags.open == []
    (image,) = tags.all("img")
    assert image["alt"] == picture.alt
    assert image["src"].startswith("data:image/svg+xml;base64,")


@each_picture
def test_picture_loads_nothing_from_outside(name):
    _, svg, bundle = drawn(name)
    assert "http" not in bundle["text/html"]
    for element in ET.fromstring(svg).iter():  # noqa: S314 - our own drawing
        for key, value in element.attrib.items():
            assert not (key.endswith("href") and not value.startswith("#"))


@each_picture
def test_the_same_picture_is_the_same_text(name):
    assert PICTURES[name]().svg == drawn(name)[1]


@pytest.mark.parametrize(
    "draw",
    [
        lambda: plot_time_series(replace(DRIVE, runs=())),
        lambda: plot_voltage_velocity(replace(DRIVE, runs=DRIVE.runs[2:])),
    ],
    ids=["an empty log", "no ramp"],
)
def test_impossible_picture_is_refused_with_advice(draw):
    with pytest.raises(BadRequest) as refused:
        draw()
    assert refused.value.advice


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf", "PNG"])
def test_a_picture_is_saved_whole_and_the_same_again(suffix, tmp_path):
    one, two = tmp_path / f"one.{suffix}", tmp_path / f"two.{suffix}"
    PICTURES["one test only"]().save(one)
    PICTURES["one test only"]().save(two)
    assert one.read_bytes() == two.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == [one.name, two.name]


@pytest.mark.parametrize(
    ("name", "advice"),
    [("log.gif", "End its name in one of: .svg, .png, .pdf"), ("no/log.svg", "Choose a folder")],
)
def test_a_picture_that_cannot_be_saved_leaves_nothing_behind(name, advice, tmp_path):
    with pytest.raises(BadRequest, match=advice):
        PICTURES["one test only"]().save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_matplotlib_is_imported_in_sim_plot_only(root):
    for path in (root / "sim").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [node.module] if isinstance(node, ast.ImportFrom) else []
            names += [name.name for name in node.names] if isinstance(node, ast.Import) else []
            if any(name and name.startswith("matplotlib") for name in names):
                assert path.parent.name == "plot", path
                assert not any("pyplot" in str(name) for name in names)


def test_drawing_needs_no_backend_and_keeps_no_figure(root):
    code = (
        "import sys, sim.plot\n"
        "assert 'matplotlib' not in sys.modules\n"  # half of the time of a lesson's first cell
        "sim.plot.plot_gap_bars({'a': {'log': 2.0}}).svg\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        cwd=root,
        check=True,
        env=os.environ | {"MPLBACKEND": "qtagg", "PYTHONPATH": str(root)},  # and no Qt anywhere
    )


@pytest.mark.filterwarnings("error")
def test_a_name_that_the_font_lacks_stays_text_without_a_warning():
    figure, ((axes,),) = make_panels(1, 1)
    axes.set_title("王小明")

    assert ">王小明</text>" in Picture(figure, "a name").svg
    axes.set_title("ann")
    assert "<text" not in Picture(figure, "a name").svg
