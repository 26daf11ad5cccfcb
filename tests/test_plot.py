"""Pictures: each says in words and numbers what it shows, and is the same every time."""

import ast
import os
import subprocess
import sys
from dataclasses import replace
from functools import cache
from xml.etree import ElementTree as ET

import ipywidgets
import numpy as np
import pytest
from html_tags import Tags
from test_plot_gravity import PICTURES as GRAVITY
from test_plot_motor import PICTURES as MOTOR

import sim
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.inspect.fault import Damage, LogInterval
from sim.plot import (
    Line,
    Picture,
    plot_acceleration_velocity,
    plot_choices,
    plot_curves,
    plot_misses,
    plot_time_series,
    plot_timesteps,
    plot_voltage_velocity,
    show_interactive,
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
        damages=[Damage("overrun", LogInterval(0, DRIVE.runs[0].test, 2.0, 2.5), 0.9, "", "")],
    ),
    "timesteps": lambda: plot_timesteps(DRIVE),
    "acceleration against velocity": lambda: plot_acceleration_velocity(DRIVE),
    "choices": lambda: plot_choices({"a": 1.0, "b": 3.0}, truth=2.0, name="kA", unit="V·s²/m"),
    "choices with spreads": lambda: plot_choices(
        {"a": 1.0}, truth=2.0, name="kA", spreads={"a": 0.1}
    ),
    "curves": lambda: plot_curves(
        range(20), {"up": range(20)}, xlabel="x", ylabel="y", levels={"l": 3}, marked=(3.0, 3.0)
    ),
    "misses": lambda: plot_misses(
        [1, 2], [2, 5], intercept=0, slope=2, xlabel="x [m]", ylabel="y [V]"
    ),
}
PICTURES |= GRAVITY | MOTOR
each_picture = pytest.mark.parametrize("name", PICTURES)


@cache
def drawn(name):
    """Each picture is drawn once for all the questions about it."""
    picture = PICTURES[name]()
    return picture, picture.svg, picture._repr_mimebundle_()


@each_picture
def test_a_picture_is_drawn_and_says_in_words_what_it_shows(name):
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
def test_a_picture_reaches_for_nothing_outside(name):
    _, svg, bundle = drawn(name)
    assert "http" not in bundle["text/html"]
    for element in ET.fromstring(svg).iter():  # noqa: S314 - our own drawing
        for key, value in element.attrib.items():
            assert not (key.endswith("href") and not value.startswith("#"))


@each_picture
def test_the_same_picture_is_the_same_text(name):
    assert PICTURES[name]().svg == drawn(name)[1]


def test_choices_say_by_how_much_each_is_off():
    picture = plot_choices({"low": 1.5, "near": 2.002, "high": 3.0}, truth=2.0, name="kA")
    assert [row[2] for row in picture.table.rows] == ["−25 %", "+0.1 %", "+50 %"]


@pytest.mark.parametrize(
    "draw",
    [
        lambda: plot_choices({}, truth=1.0, name="kA"),
        lambda: plot_curves([1, 2], {}, xlabel="", ylabel=""),
        lambda: plot_curves([1, 2], {"a": [1]}, xlabel="", ylabel=""),
        lambda: plot_time_series(replace(DRIVE, runs=())),
        lambda: plot_voltage_velocity(replace(DRIVE, runs=DRIVE.runs[2:])),
    ],
    ids=["no choices", "no curves", "a short curve", "an empty log", "no ramp"],
)
def test_what_cannot_be_drawn_is_refused_with_advice(draw):
    with pytest.raises(BadRequest) as refused:
        draw()
    assert refused.value.advice


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf", "PNG"])
def test_a_picture_is_saved_whole_and_the_same_again(suffix, tmp_path):
    one, two = tmp_path / f"one.{suffix}", tmp_path / f"two.{suffix}"
    PICTURES["choices"]().save(one)
    PICTURES["choices"]().save(two)
    assert one.read_bytes() == two.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == [one.name, two.name]


@pytest.mark.parametrize(
    ("name", "advice"),
    [("log.gif", "End its name in one of: .svg, .png, .pdf"), ("no/log.svg", "Choose a folder")],
)
def test_a_picture_that_cannot_be_saved_leaves_nothing_behind(name, advice, tmp_path):
    with pytest.raises(BadRequest, match=advice):
        PICTURES["choices"]().save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_turning_a_knob_draws_the_picture_that_plain_code_draws():
    def draw(slope):
        return plot_misses([1, 2], [2, 5], intercept=0, slope=slope, xlabel="x", ylabel="y")

    knob = ipywidgets.FloatSlider(value=1.0, min=0.0, max=4.0)
    panel = show_interactive(draw, slope=knob)
    assert panel.children[-1].value == draw(1.0).html
    knob.value = 2.5
    assert panel.children[-1].value == draw(2.5).html


def test_a_knob_that_asks_for_what_cannot_be_drawn_says_so():
    def draw(ramp):
        return plot_time_series(
            simulate(
                sim.MECHANISMS["drivetrain"], sim.Routine(ramp=ramp), rng=np.random.default_rng(1)
            )
        )

    knob = ipywidgets.FloatText(value=1.0)
    panel = show_interactive(draw, ramp=knob)
    knob.value = -1.0
    assert "Choose a number above 0" in panel.children[-1].value


def test_matplotlib_is_used_here_and_nowhere_else(root):
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
        "sim.plot.plot_choices({'a': 1.0}, truth=1.0, name='kA').svg\n"
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


def test_the_axes_of_a_picture_that_is_drawn_again_stand_still():
    drawn, again = (plot_choices({"a": value}, truth=2.0, name="kA") for value in (1.0, 1e6))
    assert drawn.svg
    again.place_as(drawn)
    assert again.svg

    first, second = (picture.figure.axes[0].get_position().bounds for picture in (drawn, again))
    assert first == pytest.approx(second)
