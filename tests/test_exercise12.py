"""Exercise 12: what is hidden in a mechanism of one's own, named, sized and shown."""

import re
import runpy
import sys
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from places import ROOT

from grader.exercise.exercise import Exercise
from sim.bench.mechanisms import MECHANISMS
from sim.core.units import find_unit
from sim.physics.effects import find_effect
from sim.reconcile import reconcile

pytestmark = pytest.mark.slow

OWN = Exercise("exercise12", ROOT / "exercises" / "exercise12")
ROOM = OWN.module
DRAWN = sys.modules[f"{ROOM.__name__}.drawn"]


def lines_of(parts, per):
    """Parameters as a learner writes them."""
    return "".join(
        f'"{part.effect}".{name} = "{one["value"]:.6g} {one["unit"]}"\n'
        for part in parts
        for name, one in part.to_json(per).items()
    )


@cache
def truth(student, *, names=None):
    """The answer of somebody who knows what is hidden; ``names`` changes only the list."""
    variant = ROOM.draw(student)
    parts = [part for part in variant.mechanism.hidden if part.effect in (names or variant.hidden)]
    listed = ", ".join(f'"{name}"' for name in names or variant.hidden)
    gaps = "".join(
        f"{name} = {gap:.3g}\n" for name, gap in measure_gaps(variant, parts, "held_out").items()
    )
    lines = lines_of(variant.mechanism.hidden, find_unit(variant.log.units))
    return f"effects = [{listed}]\n{lines}{gaps}"


def measure_gaps(variant, parts, log):
    """Both gaps of a log, by their names in the answers."""
    search = DRAWN.make_search(variant)
    fits = {"gap_before": search.fit(), "gap_after": search.fit_gains(parts)}
    return {name: search.measure_gap(one, log) for name, one in fits.items()}


def grade_answer(text, student, folder):
    path = folder / "answers.toml"
    path.write_text(text, encoding="utf-8")
    return {check.id: check for check in OWN.grade(path, student=student).checks}


def hiding(count):
    """A student with so many effects."""
    return next(
        name
        for name in (f"student {number}" for number in range(60))
        if len(ROOM.draw(name).hidden) == count
    )


def test_students_with_one_two_and_three_effects_have_an_answer_that_earns_everything(tmp_path):
    drawn = set()
    for number in (0, 2, 3):
        results = grade_answer(truth(f"student {number}"), f"student {number}", tmp_path)
        drawn.add(len(ROOM.draw(f"student {number}").hidden))

        assert [one for one in results.values() if one.status != "passed"] == []
        assert sum(one.max_points for one in results.values()) == 10  # as the course lists it
    assert drawn == {1, 2, 3}


@pytest.mark.parametrize(("kind", "effects"), DRAWN.HIDDEN)
def test_hidden_effects_are_physical_and_the_first_matters_most(kind, effects):
    for name, _ in effects:
        assert find_effect(name).reason_against(MECHANISMS[kind].scale) == ""

    variant = DRAWN.draw_recipe(np.random.default_rng(1), [(kind, effects)])
    search, truth = DRAWN.make_search(variant), variant.mechanism.model
    alone = [
        search.measure_gap(search.fit_near(replace(truth, parts=(part,)))) for part in truth.parts
    ]
    assert variant.hidden == tuple(name for name, _ in effects)
    assert min(alone) == alone[0]


def test_the_second_effect_named_first_costs_three_points(tmp_path):
    student = hiding(2)
    swapped = ROOM.draw(student).hidden[::-1]
    results = grade_answer(truth(student, names=swapped), student, tmp_path)

    assert results["first-effect"].status == "failed"
    assert "it is one of the hidden effects" in results["first-effect"].hint
    assert {results[one].status for one in ("all-effects", "held-out", "justified")} == {"passed"}


def test_naming_one_effect_of_three_earns_a_part(tmp_path):
    student = hiding(3)
    some = ROOM.draw(student).hidden[:1]
    results = grade_answer(truth(student, names=some), student, tmp_path)

    assert results["first-effect"].status == "passed"
    assert results["all-effects"].points == 1
    assert "still missing" in results["all-effects"].hint
    assert results["held-out"].points == 2  # most of the gap, not all of it
    assert "you are close. Is an effect missing" in results["held-out"].hint


@pytest.mark.parametrize("student", ["ada", "student 0"])
def test_names_count_only_with_parameters_that_narrow_the_held_out_gap(student, tmp_path):
    made_up = re.sub(
        r' = "([-+.\de]+) ', lambda one: f' = "{3.0 * float(one[1]):.6g} ', truth(student)
    )
    without = "\n".join(line for line in truth(student).splitlines() if not line.startswith('"'))

    assert sum(one.points for one in grade_answer(made_up, student, tmp_path).values()) == 0
    results = grade_answer(without, student, tmp_path)
    assert sum(one.points for one in results.values()) == 0
    assert "counts only with parameters" in results["first-effect"].seen


def test_the_gap_of_the_validation_is_not_that_of_the_held_out_log(tmp_path):
    variant = ROOM.draw("ada")
    gap = measure_gaps(variant, variant.mechanism.hidden, "validation")["gap_before"]
    text = re.sub("gap_before = .*", f"gap_before = {gap:.3g}", truth("ada"))

    result = grade_answer(text, "ada", tmp_path)["held-out"]

    assert (result.points, result.misconception) == (2.5, "M-HELD-OUT")


def test_a_parameter_that_an_effect_does_not_have_is_named(tmp_path):
    text = 'effects = ["delay"]\ndelay.late = 0.03\n'
    check = grade_answer(text, "ada", tmp_path)["held-out"]

    assert check.seen == "delay.late, which is not a parameter of delay"
    assert "It has delay.lag." in check.hint


@pytest.mark.parametrize("line", ["", 'stribeck.{} = ""\n'])
def test_a_parameter_that_an_effect_lacks_is_named(line, tmp_path):
    first, *rest = [one.name for one in find_effect("stribeck").parameters]
    text = f'effects = ["stribeck"]\nstribeck.{first} = 0.03\n{line.format(rest[0])}'
    check = grade_answer(text, "ada", tmp_path)["held-out"]

    assert check.seen == f"no stribeck.{rest[0]}"
    assert not check.is_unanswered


def test_trying_an_effect_shows_the_gaps_but_not_the_held_out_one(copy, monkeypatch, capsys):
    name = ROOM.draw("ada").hidden[0]
    script = str(copy.folder / "try_it.py")
    monkeypatch.setattr(sys, "argv", [script, "--student", "ada"])
    with pytest.raises(SystemExit):
        runpy.run_path(script, run_name="__main__")
    alone = capsys.readouterr().out
    monkeypatch.setattr(sys, "argv", [script, name, "--student", "ada", "--held-out"])
    with pytest.raises(SystemExit):
        runpy.run_path(script, run_name="__main__")
    tried = capsys.readouterr().out

    def wide(said, which):
        return float(re.search(rf"gap of the {which}: ([\d.e+]+)", said)[1])

    assert "gap_after" not in alone
    assert wide(tried, "validation") < 0.8 * wide(alone, "validation")
    assert "gap_after = " in tried
    assert f"{name}." in tried
    assert "position: explains" in alone
    page = next((copy.folder / "data").glob("*/gap.html")).read_text(encoding="utf-8")
    assert "worst run" in page or "<img" in page


def test_a_name_that_is_no_effect_gets_one_line_with_a_proposal(copy, monkeypatch):
    script = str(copy.folder / "try_it.py")
    monkeypatch.setattr(sys, "argv", [script, "filter", "--student", "ada"])

    with pytest.raises(SystemExit) as left:
        runpy.run_path(script, run_name="__main__")

    assert "Did you mean velocity-filter?" in str(left.value)


def test_texts_for_the_learner_do_not_name_the_hidden_effects():
    """The example in the README and the hints is an effect that nobody gets."""
    everybody = {name for _, effects in DRAWN.HIDDEN for name, _ in effects}
    shown = (OWN.folder / "README.md").read_text("utf-8")
    example = re.findall(r'effects = \["(.*?)"\]', shown)

    assert example == ["delay"]
    assert "delay" not in everybody
    said = shown + " ".join(OWN.hints) + (OWN.folder / "answers.toml").read_text("utf-8")
    assert everybody & set(re.findall(r"[a-z-]+", said)) == set()


def test_effects_that_a_log_does_not_determine_are_drawn_again():
    """A slightly late sensor hides behind a strong wave in the position."""
    drawn = sys.modules[OWN.module.draw.__module__]
    weak = ("drivetrain", (("cogging", 2.0), ("velocity-filter", 0.02)))

    assert not drawn.is_solvable(drawn.draw_recipe(np.random.default_rng(0), [weak]))
    assert drawn.is_solvable(OWN.module.draw("ada"))


def test_the_students_of_a_class_meet_many_effects():
    everybody = {name for _, effects in DRAWN.HIDDEN for name, _ in effects}

    assert len(everybody) >= 12


def test_gaps_that_were_made_up_cost_half_a_point(tmp_path):
    text = re.sub(r"gap_before = .*", "gap_before = 900", truth("ada"))

    assert grade_answer(text, "ada", tmp_path)["held-out"].points == 2.5


def test_reconcile_has_the_same_gap_and_the_same_first_effect():
    variant = ROOM.draw("student 10")
    story = reconcile(
        variant.log, validation=variant.validation, held_out=variant.held_out, type="simple"
    )
    hand = DRAWN.make_search(variant)
    fits = {"gap_before": hand.fit(), "gap_after": hand.fit(variant.hidden)}

    assert [one.effect for one in story.findings] == [*variant.hidden]
    for name, point in fits.items():
        gap = getattr(story, name) / story.noise_floor
        assert hand.measure_gap(point, "held_out") == pytest.approx(gap, rel=0.02)


@pytest.mark.parametrize(
    ("written", "ours", "same"),
    [(0.94, 0.77, True), (1.05, 1.0, True), (1.3, 1.0, False), (0.0, 0.8, False), (0.9, 5, False)],
)
def test_gaps_that_differ_by_less_than_the_noise_count_as_equal(written, ours, same):
    assert ROOM._is_same(written, ours) is same
