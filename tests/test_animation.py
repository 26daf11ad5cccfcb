"""Animations: whole in themselves, sized to their scenes, and refused where numbers do not fit."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest

from sim.core.errors import BadRequest
from sim.plot.animation import (
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Scene,
    animate_mechanism,
    read_script,
)
from sim.plot.animation.charts import (
    Chart,
    Curve,
    animate_charts,
    chart_bands,
    chart_curves,
    chart_gain_errors,
    chart_hold_angles,
    chart_hold_window,
    chart_line_errors,
    compare_values,
)

TIME = np.arange(0.0, 2.0, 0.02)
SPEED = np.sin(TIME)
GAINS = {"kS": 0.15, "kV": 2.5, "kA": 0.2}
VELOCITY = Panel("velocity", "velocity [m/s]")
NODE = shutil.which("node")


def animated(kind="drivetrain", scenes=None, **more):
    scene = Scene(TIME, (Motion("robot", velocity=SPEED),))
    return animate_mechanism(
        kind, scenes or scene, **{"panels": (VELOCITY,), "alt": "A robot drives."} | more
    )


def test_animation_loads_nothing_and_has_a_description():
    html = animated().html
    assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)|@import|\bimport ", html)
    assert 'aria-label="A robot drives."' in html
    assert "<p>A robot drives.</p>" in html
    assert html.count("<script") == html.count("</script>") == 2
    assert str(animated()) == "A robot drives."


def test_html_in_a_name_is_escaped():
    scene = Scene(TIME, (Motion("</script><b>", velocity=SPEED),))
    html = animated(scenes=scene, alt='"<i>').html
    assert html.count("</script>") == 2
    assert "<i>" not in html


@pytest.mark.parametrize(
    ("mistake", "says"),
    [
        ({"kind": "boat"}, "unknown drawing 'boat'"),
        ({"scenes": Scene(TIME, (Motion("robot", velocity=SPEED[1:]),))}, "99 values for 100"),
        ({"scenes": Scene(TIME, (), target=SPEED[:3])}, "the target has 3 values"),
        ({"choices": (Choice("drive", ("fast",)),)}, "no scene for fast"),
    ],
)
def test_animation_with_mismatched_arguments_is_refused(mistake, says):
    with pytest.raises(BadRequest, match=says):
        animated(**mistake)


@pytest.mark.skipif(NODE is None, reason="needs Node.js, which runs the page's script")
def test_animation_script_is_one_module_without_syntax_errors(tmp_path):
    script = tmp_path / "script.mjs"
    script.write_text(read_script(), encoding="utf-8")
    done = subprocess.run([NODE, "--check", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_data_of_a_page_is_json_with_short_numbers():
    knob = Knob("kS", "kS [V]", low=0.0, high=1.0, step=0.1, value=0.2)
    scene = Scene(TIME, (Motion("robot", gains=GAINS | {"kS": Gain("kS")}, voltage=SPEED),))
    found = json.loads(json.dumps(animated(scenes=scene, knobs=(knob,)).data, allow_nan=False))
    (motion,) = found["scenes"][""]["motions"]
    assert motion["gains"]["kS"] == {"knob": "kS", "times": 1.0, "plus": 0.0}
    assert max(len(str(value)) for value in motion["voltage"]) <= 9


def ask_line(kind, slope):
    """A line of a kind, with a gap; no line falls."""
    if slope < 0.0:
        raise BadRequest("a line that falls", advice="Choose a slope above 0.")
    line = Curve("line", [0.0, 1.0, 2.0], [0.0, float("nan"), 2.0 * slope], kind, 0)
    return Chart("x [m]", "y [V]", (line,))


def lines():
    return animate_charts(
        ask_line,
        choices=(Choice("kind", ("line", "dots"), value="dots"),),
        knobs=(Knob("slope", "slope [V/m]", low=-0.5, high=1.0, step=0.5, value=0.5),),
    )


def test_charts_hold_the_curves_of_every_option_and_position_once():
    data = json.loads(json.dumps(lines().data, allow_nan=False))
    frames = [[(data["axes"][axes], *curves) for axes, *curves in one] for one in data["frames"]]
    assert len(frames) == 2 * 4  # the last slider changes first
    assert len(data["axes"]) == 2  # of the refusal, and of all lines
    assert len(data["curves"]) == 2 * 3
    ((axes, number),) = frames[4 + 3]
    assert data["curves"][number]["y"] == [0.0, None, 2.0]
    assert data["curves"][number]["style"] == "dots"
    low, high = axes["y"]
    assert -0.2 < low < 0.0
    assert 2.0 < high < 2.2
    ((refused,),) = frames[0]
    assert "a line that falls" in refused["title"]


def test_charts_are_described_as_first_shown():
    assert str(lines()) == "With kind = dots, slope [V/m] = 0.5: y [V] over x [m] (line)."


def test_compared_values_are_rows_with_their_numbers():
    chart = compare_values({"kS": 1.5, "kV": 1.0}, truth=1.0, xlabel="", spreads={"kS": 0.1})
    spread, truth, dots = chart.curves
    assert spread.x == pytest.approx([1.4, 1.6])
    assert spread.y == [0, 0]
    assert truth.x == [1.0, 1.0]
    assert list(zip(chart.rows, dots.notes, strict=True)) == [("kS", "1.50"), ("kV", "1.00")]


def test_gain_with_an_error_as_large_as_itself_is_unknown():
    chart = chart_gain_errors({"kS": float("inf"), "kV": 0.004})
    assert [curve.notes[1] for curve in chart.curves] == ["unknown", "± 0.400 %"]
    assert [curve.x for curve in chart.curves] == [[0.0, 100.0], [0.0, pytest.approx(0.4)]]


def test_number_is_drawn_on_its_band_and_the_last_band_is_open():
    bands = {"low": 0.0, "fine": 8.0, "stop": 20.0}
    chart = chart_bands({"a": -50.0, "b": 33.0}, bands, xlabel="kV above theory [%]")
    *curves, dots = chart.curves
    named = {one.name: one.x for one in curves if one.name}
    assert named == {"low": [-50.0, 0.0], "fine": [0.0, 8.0], "stop": [8.0, 33.0]}
    assert list(zip(chart.rows, dots.x, strict=True)) == [("a", -50.0), ("b", 33.0)]


def test_marks_lie_on_the_window_that_holds_an_elevator():
    chart = chart_hold_window([1.0, 3.0], [-0.2, 0.1], window=(1.76, 2.26), marks={"mine": 1.77})
    stays, speed, mark = chart.curves
    assert (min(stays.x), max(stays.x)) == (1.76, 2.26)
    assert (list(speed.y), mark.x, mark.notes) == ([-0.2, 0.1], [1.77], ["1.77 V"])


def test_range_of_volts_that_hold_an_arm_is_as_wide_at_every_angle():
    chart = chart_hold_angles([(0.0, 1.26, 1.76)], kg=1.51, ks=0.25)
    area, cosine, falls, rises = chart.curves
    count = len(cosine.x)
    np.testing.assert_allclose(area.y[:count] - area.y[count:][::-1], 0.5)
    assert max(cosine.y) == pytest.approx(1.51, abs=1e-3)
    assert (falls.y, rises.y) == ((1.26,), (1.76,))


def test_curves_have_their_levels_and_marks():
    chart = chart_curves(
        [0, 2], {"up": [1, 3]}, xlabel="x", ylabel="y", levels={"most": 3.0}, marks={"here": (1, 2)}
    )
    up, most, here = chart.curves
    assert (up.y, most.x, most.y) == ([1, 3], [0, 2], [3.0, 3.0])
    assert (here.x, here.y, here.style) == ([1], [2], "dots")


def test_error_of_a_line_is_drawn_at_each_point_and_its_squares_are_summed():
    x, y = np.array([1.0, 2.0]), np.array([2.0, 5.0])
    chart = chart_line_errors(x, y, intercept=0.0, slope=2.0, xlabel="x [m]", ylabel="y [V]")
    _, errors, samples = chart.curves
    np.testing.assert_array_equal(errors.y, [2.0, 2.0, np.nan, 4.0, 5.0, np.nan])
    assert list(samples.y) == [2.0, 5.0]
    assert "is 1.00." in chart.title
