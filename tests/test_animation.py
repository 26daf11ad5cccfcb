"""Animations: whole in themselves, sized to their scenes, and refused where numbers do not fit."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.bench.simulate import move_gains_only
from sim.core.errors import BadRequest
from sim.plot.animation import (
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Scene,
    TestPlan,
    animate_mechanism,
    read_script,
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


def test_the_html_needs_nothing_from_elsewhere_and_says_what_is_seen():
    html = animated().html
    assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)|@import|\bimport ", html)
    assert 'aria-label="A robot drives."' in html
    assert "<p>A robot drives.</p>" in html
    assert html.count("<script") == html.count("</script>") == 2
    assert str(animated()) == "A robot drives."


def test_no_name_ends_the_data_or_becomes_a_tag():
    scene = Scene(TIME, (Motion("</script><b>", velocity=SPEED),))
    html = animated(scenes=scene, alt='"<i>').html
    assert html.count("</script>") == 2
    assert "<i>" not in html


def test_axes_hold_all_scenes_and_what_is_given_stays():
    scenes = {
        (name,): Scene(TIME, (Motion("robot", velocity=factor * SPEED),))
        for name, factor in (("slow", 1.0), ("fast", 3.0))
    }
    found = animated(
        scenes=scenes,
        choices=(Choice("drive", ("slow", "fast")),),
        panels=(VELOCITY, Panel("position", "[cm]", low=-7.0, scale=100.0)),
    ).data
    speed, place = found["panels"]
    assert 3.0 < speed["high"] < 3.5
    assert place["low"] == -7.0
    farthest = max(found["scenes"]["fast"]["motions"][0]["position"])
    assert 100 * farthest < place["high"] < 120 * farthest
    assert found["stage"]["high"] > farthest


@settings(max_examples=20, deadline=None)
@given(mark=st.floats(0.1, 3.0), reaction=st.floats(0.0, 0.5))
def test_a_plan_is_off_when_the_mark_has_passed_and_a_thumb_has_reacted(mark, reaction):
    plan = TestPlan(step=Gain("step"), mark=mark, reaction=reaction)
    motion = Motion("step", gains=GAINS, plan=plan)
    time = np.arange(0.0, 5.0, 0.02)
    volts = motion.curve("voltage", Scene(time, (motion,)), {"step": 3.5})
    place, _ = move_gains_only(GAINS, time=time, voltage=np.full(time.size, 3.5))
    passed = time[int(np.argmax(place > mark))]
    assert set(volts.tolist()) == {0.0, 3.5}
    np.testing.assert_array_equal(volts > 0.0, time < passed + reaction)


@pytest.mark.parametrize(
    ("mistake", "says"),
    [
        ({"kind": "boat"}, "no drawing of 'boat'"),
        ({"scenes": Scene(TIME, (Motion("robot", velocity=SPEED[1:]),))}, "99 values for 100"),
        ({"scenes": Scene(TIME, (), target=SPEED[:3])}, "the target has 3 values"),
        ({"choices": (Choice("drive", ("fast",)),)}, "no scene for fast"),
    ],
)
def test_what_does_not_fit_is_refused(mistake, says):
    with pytest.raises(BadRequest, match=says):
        animated(**mistake)


@pytest.mark.skipif(NODE is None, reason="needs Node.js, which runs the page's script")
def test_the_script_is_one_module_without_a_fault(tmp_path):
    script = tmp_path / "script.mjs"
    script.write_text(read_script(), encoding="utf-8")
    done = subprocess.run([NODE, "--check", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_error_is_against_what_was_asked_for():
    asked = Motion("target", position=TIME, asked=True)
    late = Motion("robot", position=TIME - 0.25)
    scene = Scene(TIME, (asked, late))
    assert asked.curve("error", scene, {}) is None
    np.testing.assert_allclose(late.curve("error", scene, {}), -0.25)


def test_data_of_a_page_is_json_with_short_numbers():
    knob = Knob("kS", "kS [V]", low=0.0, high=1.0, step=0.1, value=0.2)
    scene = Scene(TIME, (Motion("robot", gains=GAINS | {"kS": Gain("kS")}, voltage=SPEED),))
    found = json.loads(json.dumps(animated(scenes=scene, knobs=(knob,)).data, allow_nan=False))
    (motion,) = found["scenes"][""]["motions"]
    assert motion["gains"]["kS"] == {"knob": "kS", "times": 1.0, "plus": 0.0}
    assert max(len(str(value)) for value in motion["voltage"]) <= 9
