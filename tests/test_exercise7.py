"""Exercise 7: twelve logs of one's own, judged by eye."""

import importlib.util
import re
import subprocess
import sys
from collections import Counter
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from places import ROOT

from grader.checks.check import WrongAnswer
from grader.exercise.exercise import Exercise
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import FOUR_TESTS, Log, Run
from sim.inspect.detect_faults import inspect
from sim.inspect.fault import LogInterval
from sim.inspect.faults import FAULTS
from sim.io import read, write

pytestmark = pytest.mark.slow

OWN = Exercise("exercise7", ROOT / "exercises" / "exercise7")
CHECKS = OWN.module
DRAWN, LINE, SCORING, FEEDBACK = (
    sys.modules[f"{CHECKS.__name__}.{name}"] for name in ("drawn", "line", "scoring", "feedback")
)


def right(case):
    """The line that earns everything, from the truth."""
    said = []
    for one in case.damage:
        tests = ", ".join(dict.fromkeys(part.test for part in one.where))
        first, begin = one.where[0], case.log.runs[one.where[0].run].time[0]
        times = "" if one.whole else f"{first.start - begin:.2f} to {first.end - begin:.2f}"
        said.append(f"{one.fault}, {tests}, {times}, {FEEDBACK.list_actions(one.fault)[0]}")
    return " + ".join(said) or "clean"


def graded(folder, lines, *, student="ann"):
    """The grade of twelve lines."""
    path = folder / "answers.toml"
    text = (f'log{number:02} = "{line}"\n' for number, line in enumerate(lines, start=1))
    path.write_text("".join(text), "utf-8")
    return OWN.grade(path, student=student)


def case(*damage):
    """A log of four quiet tests, each of 4 s, and one fault for each (name, run, start, end)."""
    runs = []
    for index, test in enumerate(FOUR_TESTS):
        time = 10.0 * index + 1.0 + 0.02 * np.arange(201)
        runs.append(Run(test, time, np.ones(201), np.zeros(201), np.zeros(201)))
    return DRAWN.Case(
        Log(tuple(runs)),
        tuple(
            DRAWN.Damaged(
                name, (LogInterval(run, FOUR_TESTS[run], start, end),), FAULTS[name].whole
            )
            for name, run, start, end in damage
        ),
    )


SLIP = ("encoder-slip", 2, 22.0, 23.0)  # dynamic-forward, from 1 to 2 s after its beginning
SIGN = ("sign-flip", 3, 31.0, 35.0)  # all of dynamic-reverse


def test_ten_students_get_twelve_solvable_logs_and_all_of_the_faults_come_up(tmp_path):
    seen = Counter()
    for number in range(10):
        student = f"student {number}"
        cases = CHECKS.draw(student)
        seen.update(one.fault for case in cases for one in case.damage)

        assert len(cases) == 12
        assert sum(not case.damage for case in cases) in {2, 3}
        assert sum(len(case.damage) == 2 for case in cases) == 1
        assert len(cases[0].damage) == 1
        grade = graded(tmp_path, [right(case) for case in cases], student=student)
        assert (grade.status, grade.score) == ("passed", 24)
    assert set(seen) == set(LINE.FAULTS)


@pytest.mark.parametrize(
    "taken_for",
    [
        "loop-overrun, whole, rerun",
        "stuck-sensor, whole, rerun",
        "clean",
        "stale-samples, whole, rerun",
    ],
)
@pytest.mark.parametrize("student", ["ann", "ben", "zoë"])
def test_repeated_readings_taken_for_another_fault_get_a_hint(student, taken_for, reads, tmp_path):
    cases = CHECKS.draw(student)
    (place,) = (
        n for n, one in enumerate(cases) if [d.fault for d in one.damage] == ["stale-samples"]
    )
    lines = [right(one) for one in cases]
    lines[place] = taken_for

    check = graded(tmp_path, lines, student=student).checks[place]

    assert check.status == "failed"
    reads(check.hint)


def test_the_files_hold_the_logs_and_not_the_answers(copy):
    said, folder = [], copy.folder
    copy.prepare("ann", say=said.append)
    files = sorted((folder / "data" / "ann").iterdir())

    assert len(files) == 24
    assert said == ["Your own files for exercise 7: exercises/exercise7/data/ann/log01.wpilog"]
    words = [form for name in FAULTS for form in (name, name.replace("-", "_"))]
    for file in files:
        text = file.read_bytes().lower()
        assert [word for word in words if word.encode() in text] == []
    for number, case in enumerate(CHECKS.draw("ann"), start=1):
        for suffix in (".wpilog", ".csv"):
            found = inspect(read(folder / "data" / "ann" / f"log{number:02}{suffix}"))
            assert {one.fault for one in found.damages} == {one.fault for one in case.damage}


@pytest.mark.parametrize(
    ("line", "damage", "points"),
    [
        ("clean", (), 2.0),
        ("encoder-slip, dynamic-forward, 1 to 2, rerun", (), 0.0),  # a false alarm
        ("clean", (SLIP,), 0.0),
        ("encoder-slip, dynamic-forward, 1 to 2, rerun", (SLIP,), 2.0),
        ("Encoder slip: dynamic forward from 1,0 s to 2,0 s; ", (SLIP,), 1.5),
        ("rerun encoder_slip dynamic-forward 2.00-1.00", (SLIP,), 2.0),
        ("encoder-slip, dynamic-forward, 22 to 23, trim", (SLIP,), 2.0),  # the log's own time
        ("encoder-slip, 22 to 23, trim", (SLIP,), 2.0),
        ("encoder-slip, 1 to 2, trim", (SLIP,), 1.5),  # no test: the log's own time
        ("encoder-slip, dynamic-forward, 1 to 3, trim", (SLIP,), 2.0),  # half is shared
        ("encoder-slip, dynamic-forward, 1 to 3.1, trim", (SLIP,), 1.5),
        ("encoder-slip, dynamic-forward, 1 to 2, filter", (SLIP,), 1.5),
        ("encoder-slip", (SLIP,), 1.0),
        ("wheel-slip, dynamic-forward, 1 to 2, rerun", (SLIP,), 0.5),  # seen, and mistaken
        ("wheel-slip, dynamic-reverse, 1 to 2, rerun", (SLIP,), 0.0),
        ("encoder-slip, dynamic-forward, 1 to 2, rerun + sign-flip, reverse", (SLIP,), 1.5),
        ("sign-flip, dynamic-reverse, fix-config", (SIGN,), 2.0),
        ("sign-flip, dynamic-reverse, 0.5 to 1, fix config", (SIGN,), 2.0),  # the test counts
        ("sign-flip, reverse, fix-config", (SIGN,), 2.0),  # half of what it says
        ("sign-flip, whole, fix-config", (SIGN,), 1.5),
        ("sign-flip, dynamic-reverse, fix-config", (SLIP, SIGN), 1.0),
        ("sign-flip dynamic-reverse fix-config + encoder-slip 22 to 23 trim", (SLIP, SIGN), 2.0),
        ("brownout 22 to 23 + sign-flip dynamic-reverse fix-config", (SLIP, SIGN), 1.25),
        ("encoder-slip 22 23 trim + brownout 1 2 + hard-stop 1 2 + wheel-slip 1 2", (SLIP,), 0.5),
    ],
)
def test_line_of_claims_earns_the_expected_points(line, damage, points):
    claims = LINE.read_claims(line)
    result = SCORING.score_claims(claims, case(*damage), points=2.0)

    assert result.points == pytest.approx(points)
    assert (result.hint == "") == (points == 2.0)


def test_a_brownout_ends_where_the_motor_is_on_again_and_not_where_the_speed_is_back():
    cut = case(("brownout", 2, 22.0, 22.4))

    claims = LINE.read_claims("brownout, dynamic-forward, 1 to 1.9, rerun")
    result = SCORING.score_claims(claims, cut, points=2.0)

    assert result.points == 1.5
    assert "begins to fall until it begins to rise" in result.hint


def test_half_a_sample_off_is_forgiven_where_damage_is_short():
    short = case(("wheel-slip", 2, 21.0, 21.12))

    for line, points in (("0.04 to 0.2", 2.0), ("0.3 to 0.42", 1.5)):
        claims = LINE.read_claims(f"wheel-slip dynamic-forward {line} rerun")
        assert SCORING.score_claims(claims, short, points=2.0).points == points


@pytest.mark.parametrize(
    ("raw", "says"),
    [
        ("", "nothing yet"),
        (None, "nothing yet"),
        (7, "which is not text in quotes"),
        ([1], "which is not text in quotes"),
        ("the belt is loose", 'in which "belt" is not known'),
        ("rerun", "with no faults in it"),
        ("brownout sign-flip", "with 2 faults in it"),
        ("brownout 1.2", "with one time in it"),
        ("brownout rerun trim", "with 2 actions"),
        ("brownout 1200 to 1660 ms", "ms"),
        ("clean + brownout", "and a fault"),
        (" + ", "0 faults"),
        (" + ".join(LINE.FAULTS), "13 faults"),
    ],
)
def test_a_line_that_cannot_be_read_gets_the_reason(raw, says):
    with pytest.raises(WrongAnswer) as wrong:
        LINE.read_claims(raw)

    assert says in wrong.value.seen
    assert wrong.value.hint


@pytest.mark.parametrize("name", [*LINE.FAULTS, "clean"])
def test_every_accepted_word_is_explained_in_the_task(name):
    (claim,) = LINE.read_claims(f"{name.replace('-', ' ')}, whole")

    assert claim == LINE.Claim(name, ("whole",), None, "")
    assert f"| {name} |" in (OWN.folder / "README.md").read_text("utf-8")


def test_no_feedback_names_the_right_fault():
    for said, really in product(LINE.FAULTS, repeat=2):
        words = re.compile(rf"\b{really.replace('-', '[ -]')}\b")
        assert not words.search(FEEDBACK.explain_overlooked(really))
        assert said == really or not words.search(FEEDBACK.explain_mixed_up(said, really))


def test_calling_all_logs_clean_or_all_the_same_earns_little(tmp_path):
    for line in ("clean", "encoder-slip whole rerun", "brownout dynamic trim"):
        assert graded(tmp_path, [line] * 12).score <= 8


def test_a_log_is_drawn_whole_and_close_up(copy):
    folder = copy.folder
    copy.prepare("ann", say=lambda _: None)

    def look(*arguments):
        return subprocess.run(
            [sys.executable, str(folder / "look.py"), *arguments, "--student", "ann"],
            capture_output=True,
            encoding="utf-8",
            check=False,
        )

    assert look("4").returncode == 0
    whole = (folder / "data" / "ann" / "log04.svg").read_bytes()
    part = look("4", "dynamic-forward", "0.1", "0.6")
    assert "dynamic-forward" in part.stdout
    close = folder / "data" / "ann" / "log04-dynamic-forward-0.1-0.6.svg"
    assert str(close) in part.stdout
    assert close.read_bytes() != whole
    assert (folder / "data" / "ann" / "log04.svg").read_bytes() == whole
    assert look("13").returncode == 1
    assert look("13", "--page").returncode == 1
    assert look("4", "dynamic-forward", "--page").returncode == 2
    assert look(str(folder / "data" / "ann" / "log07.csv")).returncode == 0
    assert (folder / "data" / "ann" / "log07.svg").is_file()


def load_look():
    """The script that draws logs."""
    spec = importlib.util.spec_from_file_location("_look", OWN.folder / "look.py")
    look = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(look)
    return look


def test_a_little_jitter_and_noise_look_little_in_a_picture():
    look = load_look()
    rng = np.random.default_rng(3)
    clean = simulate(MECHANISMS["drivetrain"], Routine(1.0, 1.8, 5.0), rng=rng, period=0.02)
    runs = tuple(
        replace(run, time=run.time + rng.uniform(-0.001, 0.001, len(run))) for run in clean.runs
    )
    log = replace(clean, runs=runs)
    whole = look.draw_signals(log, log.runs).figure.axes
    close = look.draw_signals(log, log.runs[:1], begin=0.0, end=0.1).figure.axes
    tests = len(log.runs)

    for row in range(4):
        assert len({axes.get_ylim() for axes in whole[row * tests : (row + 1) * tests]}) == 1
    for axes in (whole[-1], close[-1]):
        assert axes.get_ylim()[0] == 0.0
        assert axes.get_ylim()[1] >= 2.4 * 20.0  # ±1 ms is a twentieth of it
    top = max(np.abs(run.velocity).max() for run in log.runs)
    assert np.diff(close[1].get_ylim()) >= 0.1 * top


@pytest.mark.parametrize(
    ("place", "line"),
    [
        ("exercise7/me/log04.csv", 'log04 = "WHAT, dynamic-forward, 1.20 to 1.66, WHAT-TO-DO"'),
        ("exercise8/data/me/log.wpilog", 'dynamic_forward = "1.20 to 1.66"'),
        ("mystery/log.wpilog", "WHAT, dynamic-forward, 1.20 to 1.66, WHAT-TO-DO"),
    ],
)  # fmt: skip
def test_the_page_writes_a_line_as_the_exercise_reads_it(place, line, monkeypatch, tmp_path):
    look = load_look()
    seen = []
    monkeypatch.setattr(look, "serve_page", lambda files, *, view: seen.append((files, view)))
    (tmp_path / place).parent.mkdir(parents=True)
    write(simulate(MECHANISMS["turret"], Routine(), rng=np.random.default_rng(1)), tmp_path / place)
    look.main.callback(str(tmp_path / place), "", 0.0, look.ALL, "me", page=True)
    (files, view), text = seen[0], seen[0][1].span_text
    words = {"test": "dynamic-forward", "key": "dynamic_forward", "begin": "1.20", "end": "1.66"}

    assert files == [tmp_path / place]
    assert view.raw
    assert (text.before + text.span + text.after).format(log="log04", **words) == line


def test_the_line_of_the_page_is_understood_once_its_words_are_filled_in():
    text = load_look().FAULTS
    words = {"test": "dynamic-forward", "begin": "1.20", "end": "1.66"}
    line = text.between.join(
        [text.span.replace("WHAT-TO-DO", "trim").replace("WHAT", "hard-stop").format(**words)] * 2
    )

    assert [(one.fault, one.places, one.times, one.action) for one in LINE.read_claims(line)] == [
        ("hard-stop", ("dynamic-forward",), (1.2, 1.66), "trim")
    ] * 2
