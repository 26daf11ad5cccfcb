"""Numbers as people write them, the bands they are judged by, and the slips behind wrong ones."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from places import ROOT

from grader.answers.asked_number import BANDS, FAST_KA, ask_gains
from grader.answers.number_answer import judge_number, read_answer_number
from grader.answers.quantity import NotAUnitError, read_number, read_unit
from grader.answers.wrong_number import AnswerKey, Lookalike, Scene, WrongNumber
from grader.checks.check import WrongAnswer
from grader.checks.misconception import MISCONCEPTIONS
from grader.checks.texts import read_texts

TURN = 2 * math.pi
GAINS = {"kS": 0.15, "kV": 2.4, "kA": 0.3}
KEY = AnswerKey(ask_gains(GAINS, position="m"), Scene(ratio=8.46, motors=4, ramp=0.5, period=0.02))
FLYWHEEL = {"kS": 0.10, "kV": 0.13, "kA": 0.035}
FLYWHEEL_KEY = AnswerKey(
    ask_gains(FLYWHEEL, position="rot"), Scene(angular=True, motors=2, ramp=0.5, period=0.02)
)


def wrong(name, given_, key=KEY, *, points=2):
    with pytest.raises(WrongAnswer) as caught:
        judge_number(name, given_, key, points=points)
    return caught.value


@pytest.mark.parametrize(
    "text",
    [
        "V·s²/m",
        "V*s^2/m",
        "V s² / m",
        "V·s²·m⁻¹",
        "Vs²/m",
        "V/(m/s²)",
        "V/(m/s^2)",
        "V·s**2/m",
        "volt-seconds squared per meter",
        "V per m/s²",
    ],
)
def test_a_unit_may_be_written_in_any_way(text):
    assert read_unit(text) == read_unit("V·s²/m")


@pytest.mark.parametrize(
    ("text", "factor"),
    [
        ("V·s/rad", 1.0),
        ("V·s/rot", 1 / TURN),
        ("V·s/deg", 180 / math.pi),
        ("V/rpm", 60 / TURN),
        ("V/rps", 1 / TURN),
        ("mV·s/rad", 0.001),
        ("V·min/rot", 60 / TURN),
    ],
)
def test_unit_is_parsed_to_its_size_in_si(text, factor):
    assert read_unit(text).factor == pytest.approx(factor)


@pytest.mark.parametrize(
    ("text", "same", "times"),
    [
        ("N·m", "kg·m²/s²", 1.0),
        ("Nm", "newton meter", 1.0),
        ("lb·in²", "kg·m²", 0.45359237 * 0.0254**2),
        ("g·m^2", "kg·m²", 1e-3),
        ("mA", "amps", 1e-3),
    ],
)
def test_torque_inertia_and_current_have_units(text, same, times):
    one, other = read_unit(text), read_unit(same)

    assert one.powers == other.powers
    assert one.factor / other.factor == pytest.approx(times)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("V·x/m", "x"),
        ("V/(m/s", "("),
        ("", "nothing"),
        ("V %", "%"),
        ("((min^9)^9)^9", "a power of 81"),
    ],
)
def test_text_that_is_no_unit_is_named(text, part):
    with pytest.raises(NotAUnitError) as caught:
        read_unit(text)

    assert part in str(caught.value)


@pytest.mark.parametrize(
    ("raw", "value"),
    [
        (2.4, 2.4),
        (2, 2.0),
        ("2.4", 2.4),
        ("2,4", 2.4),
        (" 2.4 ", 2.4),
        (".5", 0.5),
        ("1e-3", 0.001),
        ("−2.4", -2.4),
        ("2.4 V·s/m", 2.4),
        ("2.4V*s/m", 2.4),
        ("2,4 V/(m/s)", 2.4),
        ("0.73152 V·s/ft", 2.4),
        ("2400 mV·s/m", 2.4),
        ("0.04 V·min/m", 2.4),
    ],
)
def test_a_number_is_read_as_people_write_it(raw, value):
    assert read_answer_number(raw, KEY.asked["kV"]) == pytest.approx(value)


@pytest.mark.parametrize(
    ("raw", "seen"),
    [
        (math.nan, "nan"),
        (math.inf, "infinity"),
        (10**400, "infinity"),
        ("1e999", "infinity"),
        (True, "true, which is not a number"),
        ([2.4], "a list"),
        ({"value": 2.4}, "a dict"),
        ("", "nothing yet"),
        (None, "nothing yet"),
        ("about 2", "not one number"),
        ("1,234.5", "not one number"),
        ("2.4 2.5", "not one number"),
        ("2.4 V/m/s", "which is not a unit of kV"),
        ("6.19 ± 0.065 kg·m²", "more than a number and its unit"),
        ("0.613/√2", "more than a number and its unit"),
        ("5.357 m/s = 17.6 ft/s", "more than a number and its unit"),
        ("64-65 A", "more than a number and its unit"),
        ("2.4 V·s/rad", "which is not a unit of kV"),
        ("2.4 furlongs", "'furlongs' is not known"),
    ],
    ids=str,
)
def test_text_that_is_no_number_is_named_with_advice(raw, seen):
    with pytest.raises(WrongAnswer) as caught:
        read_answer_number(raw, KEY.asked["kV"])

    assert seen in caught.value.seen
    assert caught.value.hint


@given(st.text(max_size=30))
def test_any_text_is_a_number_or_is_refused(text):
    try:
        value = read_answer_number(text, KEY.asked["kV"])
    except WrongAnswer:
        return
    assert math.isfinite(value)


@given(
    st.floats(allow_nan=False, allow_infinity=False, min_value=-1e6, max_value=1e6),
    st.sampled_from([".", ","]),
)
def test_printed_number_is_read_back(value, mark):
    assert read_number(f"{value!r}".replace(".", mark)) == (value, "")


@pytest.mark.parametrize(
    ("name", "share", "earned"),
    [
        ("kV", 1.029, 2),
        ("kV", 0.971, 2),
        ("kV", 1.031, 1),
        ("kV", 0.921, 1),
        ("kV", 1.081, 0),
        ("kA", 1.149, 2),
        ("kA", 1.151, 1),
        ("kA", 1.31, 0),
        ("kS", 0.81, 2),  # 0.03 V is more than 15 % of 0.15 V
        ("kS", 0.79, 1),
        ("kS", 0.46, 0),
    ],
)
def test_bands_give_full_half_or_no_credit(name, share, earned):
    answers = {name: GAINS[name] * share}
    if earned == 2:
        assert judge_number(name, answers, KEY, points=2) is None
    else:
        assert wrong(name, answers).earned == earned


def test_a_fast_mechanism_gets_wider_bands_for_ka():
    slow = ask_gains({"kV": 2.0, "kA": 0.101}, position="m")
    fast = ask_gains({"kV": 2.0, "kA": 0.099}, position="m")

    assert (slow["kA"].band, fast["kA"].band) == (BANDS["kA"], FAST_KA)


@pytest.mark.parametrize(
    ("name", "answers", "misconception"),
    [
        ("kV", {"kV": 0.13 / TURN}, "M-UNITS"),
        ("kV", {"kV": 0.13 * TURN}, "M-UNITS"),
        ("kV", {"kV": 0.13 / 60}, "M-UNITS"),
        ("kV", {"kV": 0.13 * 60}, ""),  # it is near 1/0.13, too
        ("kV", {"kV": 0.13 / (180 / math.pi)}, "M-UNITS"),
        ("kV", {"kV": 0.13 / 360}, "M-UNITS"),
        ("kV", {"kV": 0.13 / 12}, "M-DUTY"),
        ("kV", {"kV": 0.13 * 12}, "M-DUTY"),
        ("kS", {"kS": 0.10 / 12}, "M-DUTY"),
        ("kS", {"kS": 100.0}, "M-UNITS"),
        ("kV", {"kV": -0.13}, ""),
        ("kA", {"kA": 0.035 * 50}, ""),
        ("kS", {"kS": 0.10 + 0.035 / 0.13 * 0.5}, "M-KS-INTERCEPT"),
        ("kV", {"kV": 0.035, "kA": 0.13}, ""),
    ],
)
def test_a_known_mistake_is_named(name, answers, reads, misconception):
    caught = wrong(name, answers, FLYWHEEL_KEY)

    reads(caught.hint)
    assert caught.misconception == misconception
    assert misconception in {"", *MISCONCEPTIONS}


@pytest.mark.parametrize(
    ("factor", "said"),
    [
        (0.3048, "feet"),
        (0.0254, "inches"),
        (100, "100 cm"),
        (1 / 8.46, "the gear ratio"),
        (8.46, "the gear ratio"),
        (4, "4 motors"),
        (2, "a diameter is 2 times a radius"),
    ],
)
def test_a_slip_in_the_unit_of_time_or_length_is_named(factor, said):
    assert said in wrong("kV", {"kV": 2.4 * factor}).hint


def test_result_of_a_wrong_recipe_is_recognized():
    slip = WrongNumber("recipe", "it comes from the wrong recipe", "M-NOISE-AVERAGES")
    key = AnswerKey(KEY.asked, Scene(lookalikes={"kA": (Lookalike(0.22, slip),)}))

    assert "the wrong recipe" in wrong("kA", {"kA": 0.221}, key).hint
    assert "the wrong recipe" not in wrong("kA", {"kA": 0.235}, key).hint


def test_right_number_is_not_blamed_on_a_swap():
    key = AnswerKey(ask_gains({"kS": 0.2488, "kV": 2.4, "kA": 0.2239}, position="m"), KEY.scene)

    assert "swap" not in wrong("kS", {"kS": 0.2, "kA": 0.2239}, key).hint
    assert "swap" in wrong("kS", {"kS": 0.2, "kA": 0.27}, key).hint


def test_two_possible_mistakes_are_both_named():
    caught = wrong("kV", {"kV": 0.26}, FLYWHEEL_KEY)

    assert "radius" in caught.hint
    assert "2 motors" in caught.hint
    assert not caught.misconception


def test_slip_that_two_numbers_share_is_the_only_one_named():
    alone = wrong("kA", {"kA": 0.035 / 60}, FLYWHEEL_KEY).hint
    shared = wrong("kA", {"kA": 0.035 / 60, "kV": 0.13 / 60}, FLYWHEEL_KEY).hint

    assert "degrees" in alone
    assert "rpm" in shared
    assert "degrees" not in shared


@pytest.mark.parametrize(
    "value",
    [
        2.4 * 1.05,
        2.4 * 1.12,
        2.4 * 1.6,
        -17.0,
    ],
)
def test_a_wrong_number_without_a_known_slip_gets_the_band_only(value, reads):
    reads(wrong("kV", {"kV": value}).hint)


def test_the_hint_shows_a_band_of_volts_in_volts():
    assert "±0.03 V" in wrong("kS", {"kS": 0.4}).hint


def test_converted_answer_gets_a_note_with_both_units():
    note = judge_number("kV", {"kV": "0.73152 V·s/ft"}, KEY, points=2)

    assert note == "0.73152 V·s/ft is 2.4 V·s/m"


@given(st.floats(min_value=-50, max_value=50, allow_nan=False))
def test_no_message_contains_the_right_answer(value):
    key = AnswerKey(ask_gains({"kS": 0.1537, "kV": 2.4371, "kA": 0.3191}, position="m"), KEY.scene)
    try:
        judge_number("kV", {"kV": value}, key, points=1)
    except WrongAnswer as caught:
        told = caught.seen + caught.hint
        if not math.isclose(abs(value), 2.4371, rel_tol=1e-3):  # what was typed is repeated
            assert "2.437" not in told


@pytest.mark.parametrize("number", [1, 2, 3, 9, 11, 13])
def test_a_slip_that_only_a_number_suggests_is_asked_not_said(number):
    texts = read_texts(ROOT / "exercises" / f"exercise{number}" / "slips.toml")
    tables = [texts, *(one for one in texts.values() if isinstance(one, dict))]
    said = {code: one for t in tables for code, one in t.items() if isinstance(one, str)}

    assert said
    assert [code for code, one in said.items() if code != "sign" and "?" not in one] == []
    assert [code for code, one in said.items() if re.match("(this|that) is ", one)] == []
