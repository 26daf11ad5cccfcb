"""A story as everybody meets it: sentences, terminal, page, pictures, JSON, and the command."""

import io
import json
import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console
from story_made import (
    DRAG,
    FOOT,
    NOISE,
    PLACE,
    REMAINS,
    RIGHT,
    SLIP,
    STORIES,
    TRIED,
    WRONG,
    gap_of,
    story,
)

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.cli.open.reconcile_job import describe_story
from sim.physics.effects import EFFECTS
from sim.plot.story import (
    make_findings_table,
    plot_remaining_gap,
)
from sim.reconcile.story_text import (
    format_estimate,
    list_gain_doubts,
    list_outcomes,
    write_headline,
)
from sim.report.story_terminal import show_story
from sim.support.command_line import run_command

pytestmark = pytest.mark.slow

BEFORE, AFTER = 16.2, 1.01  # [noises] of the story's log, worked out in the first test
EXPLAINED = STORIES["explained"]


def told(one):
    """What a terminal of eighty columns shows of a story."""
    out = io.StringIO()
    show_story(one, title="drive.csv", console=Console(file=out, width=80, highlight=False))
    return out.getvalue()


# -- sentences -----------------------------------------------------------------------------------


def test_the_numbers_of_the_story_are_those_of_its_log():
    log = EXPLAINED.shown

    # the base model is 1/0.9 - 1 = 11% too fast, of speeds about 1.6 m/s, in noises of 0.01 m/s
    assert gap_of(log, WRONG) * FOOT / NOISE == pytest.approx(BEFORE, rel=0.01)
    assert gap_of(log, RIGHT) * FOOT / NOISE == pytest.approx(AFTER, rel=0.01)


@pytest.mark.parametrize(
    ("value", "error", "said"),
    [
        (0.11234, 0.0021, ("0.1123", "0.0021")),
        (-12.3456, 0.4, ("−12.35", "0.4")),
        (8.152, None, ("8.152", "chosen, not searched")),
        (8.152, math.nan, ("8.152", "not known")),
        (0.0, 0.01, ("0.0", "0.01")),
        (1.2, 15.0, ("1.2", "15")),
        (0.201, 5.9e-7, ("0.20100", "< 0.01% of it")),
    ],
)
def test_number_has_the_digits_that_its_error_allows(value, error, said):
    estimate = replace(DRAG.parameters["drag"], value=value, error=error)

    assert format_estimate(estimate) == said


# -- terminal ------------------------------------------------------------------------------------


# -- page ----------------------------------------------------------------------------------------


def test_the_page_gets_every_part_of_the_story():
    data = describe_story(STORIES["damage and drag"])

    assert [one["name"] for one in data["findings"]] == ["encoder-slip", "drag", "battery-sag"]
    assert data["findings"][1]["parameters"] == ["drag 0.1123 ± 0.0021 V·s²/ft²"]
    assert SLIP.inspect in data["findings"][0]["look"][0]
    assert [one["name"] for one in data["gaps"]] == ["base model", "+ drag"]
    assert data["how"] == STORIES["damage and drag"].how
    assert set(STORIES["damage and drag"].notes) <= set(data["remarks"])
    assert any(TRIED[-1].why in one for one in data["tried"])
    assert PLACE.sentence in data["places"]
    (unsure,) = STORIES["ambiguous"].findings
    assert describe_story(STORIES["ambiguous"])["next"] == [unsure.separating_test]
    assert REMAINS["remains"] in describe_story(STORIES["unexplained"])["remarks"]
    assert "may be off by more" in describe_story(STORIES["unexplained"])["caution"]


def test_gains_that_move_far_while_the_gap_hardly_shrinks_are_doubted():
    kv = EXPLAINED.gains_without["kV"]
    far = replace(kv, value=kv.value + 10.0 * kv.error)
    moved = replace(EXPLAINED, gains=EXPLAINED.gains | {"kV": far})

    assert list_gain_doubts(moved) == ()  # the gap shrinks with them
    wide = replace(moved, gap_after=0.9 * moved.gap_before)
    (doubt,) = list_gain_doubts(wide)
    assert doubt.gains == ("kV",)
    assert describe_story(wide)["why_unticked"]
    still = replace(wide, gains=EXPLAINED.gains_without)
    assert list_gain_doubts(still) == ()


@pytest.mark.parametrize("name", ["nothing missing", "explained", "unexplained"])
def test_a_stopped_search_says_so_first_and_denies_no_cause(name):
    stopped = replace(STORIES[name], complete=False)
    headline, page = write_headline(stopped), json.dumps(describe_story(stopped))

    assert headline.startswith("The search ended before it had tried every effect. ")
    assert "known effect" not in headline
    assert "is missing." not in headline  # nothing is said to be complete
    assert "effect of the catalogue explains" not in page
    assert stopped.to_json()["complete"] is False
    assert ("missing drag" in headline) is (name == "explained")


def test_a_simulation_that_grew_without_limit_is_described_in_words():
    away = tuple(np.full_like(track, np.inf) for track in WRONG)
    base, last = EXPLAINED.chapters
    mad = replace(
        EXPLAINED,
        chapters=(replace(base, tracks=away, gap=math.inf), last),
        gap_before=math.inf,
        findings=(replace(DRAG, gap_before=math.inf),),
    )

    page = json.dumps(describe_story(mad), allow_nan=False)
    said = json.loads(json.dumps(mad.to_json(), allow_nan=False))

    assert (said["gap_before"], said["findings"][0]["gap_before"]) == (None, None)
    assert "grew without limit" in page
    assert "inf " not in told(mad)


# -- notebook ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("probability", "size", "missing"),
    [
        (1.0, "major, over 99 % likely", "is missing drag"),
        (0.9, "major, 90 % likely", "is missing drag"),
        (0.6, "major, 60 % likely", "is probably missing drag"),
    ],
)
def test_a_finding_says_how_likely_it_is(probability, size, missing):
    unsure = story(replace(DRAG, probability=probability))

    assert make_findings_table(unsure).rows[0][1] == size
    assert missing in write_headline(unsure)
    assert unsure.to_json()["findings"][0]["probability"] == probability


# -- command -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    """The four tests of a drivetrain, short, in a file."""
    path = tmp_path_factory.mktemp("logs") / "drive.csv"
    routine = Routine(ramp=1.0, step=4.0, timeout=2.0)
    sim.write(simulate(MECHANISMS["drivetrain"], routine, rng=np.random.default_rng(2)), path)
    return path


@pytest.fixture
def reconcile(capsys, monkeypatch):
    """Run `sysid reconcile` with a solver that tells one story: exit code, output, complaints."""

    def ran(one, *arguments):
        asked = []

        def solve(log, **how):
            asked.append(how | {"log": log})
            return one

        monkeypatch.setattr("sim.cli.open.reconcile_job.reconcile", solve)
        capsys.readouterr()
        code = run_command(sysid, name="sysid", arguments=["reconcile", *map(str, arguments)])
        said = capsys.readouterr()
        return code, said.out, said.err, asked

    return ran


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("nothing missing", 0),
        ("a little missing", 0),
        ("explained", 0),
        ("only damage", 0),
        ("ambiguous", 1),
        ("unexplained", 1),
        ("explained, and something remains", 1),
    ],
)
def test_the_exit_code_says_whether_work_is_left(reconcile, drive, name, code):
    assert reconcile(STORIES[name], drive)[0] == code


def test_the_json_is_what_others_read(reconcile, drive):
    one = STORIES["damage and drag"]

    _, said, err, _ = reconcile(one, drive, "--json")

    data = json.loads(said)
    assert err == ""
    assert set(data) >= {
        "verdict", "findings", "remainder", "noise_floor", "gap_before", "gap_after", "where",
    }  # fmt: skip
    assert [found["effect"] for found in data["findings"]] == [
        "encoder-slip",
        "drag",
        "battery-sag",
    ]
    assert data["findings"][1]["parameters"]["drag"] == {
        "value": 0.11234, "error": 0.0021, "unit": "V·s²/ft²",
    }  # fmt: skip
    assert data["where"][0]["where"] == "dynamic-reverse, 0.2 to 0.4 s"


def test_every_log_is_read_and_inspected(reconcile, drive, tmp_path):
    other = tmp_path / "other.csv"
    other.write_bytes(drive.read_bytes())

    _, _, _, (asked,) = reconcile(
        EXPLAINED, drive, "--validation", other, "--held-out", drive, "--type", "elevator",
        "--travel", 1.5, "--units", "feet", "--json",
    )  # fmt: skip

    assert (asked["type"], asked["travel"]) == ("elevator", 1.5)
    assert {asked[name].units for name in ("log", "validation", "held_out")} == {"feet"}
    assert asked["validation"].source == str(other)
    assert set(asked["damages"]) == {"log", "validation", "held_out"}


def test_solver_is_asked_about_damage_with_fault_advice_and_confidence(reconcile, drive, tmp_path):
    spoilt = tmp_path / "spoilt.csv"
    code = run_command(
        sysid, name="sysid",
        arguments=["contaminate", str(drive), "--fault", "unit-error:3", "-o", str(spoilt)],
    )  # fmt: skip
    assert code == 0

    _, _, _, (asked,) = reconcile(EXPLAINED, spoilt, "--json")

    faults = {one.fault: one for one in asked["damages"]["log"]}
    assert "unit-error" in faults
    assert faults["unit-error"].advice
    assert 0.0 < faults["unit-error"].confidence <= 1.0


def test_a_page_is_written_beside_the_printed_story(reconcile, drive, tmp_path):
    path = tmp_path / "drive.html"

    code, said, err, _ = reconcile(EXPLAINED, drive, "--html", path)

    assert (code, err) == (0, "")
    page = path.read_text(encoding="utf-8")
    assert "The model is missing drag" in page
    assert '"name": "drive.csv"' in page
    assert str(drive.parent) not in page  # a page travels; folders are private
    assert "The model is missing drag" in said


UNSEEN = """
import sys
from sim.cli import sysid
from sim.cli.open.reconcile_job import describe_story
from sim.support.command_line import run_command
run_command(sysid, name="sysid", arguments=["reconcile", {path!r}, "--json"])
seen = [name for name in ("matplotlib", "IPython") if name in sys.modules]
print(seen, file=sys.stderr)
"""


def test_json_output_loads_no_drawing_library(drive):
    ran = subprocess.run(
        [sys.executable, "-c", UNSEEN.format(path=str(drive))],
        capture_output=True, check=True, encoding="utf-8",
    )  # fmt: skip

    assert json.loads(ran.stdout)["verdict"] in {"nothing-missing", "explained", "ambiguous",
                                                  "unexplained"}  # fmt: skip
    assert ran.stderr.splitlines()[-1] == "[]"


def test_the_pictures_show_a_gap_before_and_only_noise_after():
    before, after = plot_remaining_gap(EXPLAINED)

    assert "of the gap beyond noise shows in no plot" in before.alt
    assert "with drag: At least 90 % of this is noise." in after.alt


def test_outcome_of_each_effect_is_what_happened_to_it():
    alike = replace(DRAG, ambiguous_with=("heating",))
    outcomes = list_outcomes(story(alike))
    first = story(alike).chapters[0]
    without = list_outcomes(story(alike, chapters=1, complete=False))
    gone = story(alike)
    later = replace(gone.chapters[1], tried=())
    dropped = list_outcomes(replace(gone, chapters=(first, later)))

    assert outcomes["added"] == ["drag"]
    assert outcomes["cannot be told apart from drag"] == ["heating"]
    assert outcomes["widens the gap beside drag"] == ["stribeck"]
    assert "spring" in outcomes["not tried: promised too little"]
    assert "battery-sag" in without["fits better, but is too unlikely"]
    assert "spring" in without["not tried before the search ended"]
    assert dropped["makes no difference beside drag"] == ["battery-sag"]
    assert sorted(name for some in outcomes.values() for name in some) == sorted(EFFECTS)
