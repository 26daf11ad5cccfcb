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


def test_html_in_a_name_is_escaped():
    scene = Scene(TIME, (Motion("</script><b>", velocity=SPEED),))
    html = animated(scenes=scene, alt='"<i>').html
    assert html.count("</script>") == 2
    assert "<i>" not in html


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


def test_data_of_a_page_is_json_with_short_numbers():
    knob = Knob("kS", "kS [V]", low=0.0, high=1.0, step=0.1, value=0.2)
    scene = Scene(TIME, (Motion("robot", gains=GAINS | {"kS": Gain("kS")}, voltage=SPEED),))
    found = json.loads(json.dumps(animated(scenes=scene, knobs=(knob,)).data, allow_nan=False))
    (motion,) = found["scenes"][""]["motions"]
    assert motion["gains"]["kS"] == {"knob": "kS", "times": 1.0, "plus": 0.0}
    assert max(len(str(value)) for value in motion["voltage"]) <= 9
