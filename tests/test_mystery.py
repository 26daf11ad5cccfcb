"""``grade mystery``: fresh logs with a hidden trouble, graded as exercises 7 and 12 do."""

from functools import cache

import numpy as np
import pytest
from places import ROOT

from grader.cli import run_command
from grader.exercise.mystery import (
    HIGHEST,
    MysteryState,
    draw_mystery,
    find_mystery_folder,
    grade_mystery_answer,
    load_state,
)
from grader.student_data.variant import use_class_secret
from sim.io import read

FAULTS, EFFECTS = 1, 2  # the numbers of mysteries whose turn it is
SEEDS = {FAULTS: range(20), EFFECTS: range(HIGHEST)}  # to draw effects takes seconds


@cache
def drawn(number, seed, level):
    return draw_mystery(ROOT, MysteryState(number, level, seed))


def grade_answer(mystery, answer):
    return grade_mystery_answer(mystery, answer, student="ann")


@pytest.mark.parametrize("number", [FAULTS, EFFECTS])
def test_the_right_answer_to_a_mystery_earns_everything_and_a_wrong_one_never(number):
    for seed in SEEDS[number]:
        mystery = drawn(number, seed, level=1 + seed % HIGHEST)
        wrong = "sign-flip, whole, rerun" if number == FAULTS else "hysteresis"

        assert grade_answer(mystery, mystery.solution).status == "passed", (seed, mystery.solution)
        assert grade_answer(mystery, wrong).status == "failed", seed
        assert grade_answer(mystery, "").score == 0.0
        assert grade_answer(mystery, "no idea at all").score == 0.0


def test_the_same_seed_draws_the_same_mystery_whatever_the_class():
    free = drawn(FAULTS, 3, 1)
    with use_class_secret(b"a class"):
        bound = drawn.__wrapped__(FAULTS, 3, 1)

    assert free.solution == bound.solution
    for one, other in zip(free.logs["log"].runs, bound.logs["log"].runs, strict=True):
        assert np.array_equal(one.velocity, other.velocity)


def test_a_fault_in_the_wrong_place_earns_a_part_and_gets_a_hint():
    every = (drawn(FAULTS, seed, 1) for seed in SEEDS[FAULTS])
    mystery = next(one for one in every if " to " in one.solution)
    fault, test, _, action = mystery.solution.split(", ")
    result = grade_answer(mystery, f"{fault}, {test}, 0 to 0.02, {action}")

    assert 0.0 < result.score < result.max_score
    assert "not the place" in result.checks[0].hint


def test_two_effects_in_the_wrong_order_keep_the_points_for_the_names():
    mystery = drawn(EFFECTS, 2, level=3)
    first, second = mystery.solution.split(", ")
    result = grade_answer(mystery, f"{second} {first}")

    assert [one.status for one in result.checks] == ["failed", "passed"]


def test_a_mystery_is_drawn_answered_and_the_next_one_is_harder(all_exercises, capsys):
    folder = find_mystery_folder(all_exercises, "ann")
    assert run_command(["mystery", "--student", "ann"]) == 0
    task = capsys.readouterr().out
    state = load_state(folder)
    mystery = draw_mystery(all_exercises, state)
    assert "Mystery 1, level 1 of 5: log.wpilog in mystery/ann" in task
    assert task.splitlines()[-1].startswith("Next: grade mystery ")
    assert read(folder / "log.wpilog").runs

    assert run_command(["mystery", "--student", "ann", "clean"]) == 1
    assert "give up" in capsys.readouterr().out.splitlines()[-1]
    assert load_state(folder) == state
    assert run_command(["mystery", "--student", "ann", *mystery.solution.split()]) == 0
    assert capsys.readouterr().out.endswith("Next: grade mystery\n")
    assert load_state(folder) == MysteryState(2, 2)

    assert run_command(["mystery", "--student", "ann"]) == 0
    assert "Mystery 2, level 2 of 5: log.wpilog, validation.wpilog" in capsys.readouterr().out
    assert {one.name for one in folder.glob("*.wpilog")} == {"log.wpilog", "validation.wpilog"}


def test_giving_up_shows_the_answer_and_the_next_one_is_easier(all_exercises, capsys):
    folder = find_mystery_folder(all_exercises, "me")
    run_command(["mystery"])
    (folder / "mystery.toml").write_text("number = 7\nlevel = 3\nseed = 5\n", "utf-8")
    mystery = draw_mystery(all_exercises, load_state(folder))
    capsys.readouterr()

    assert run_command(["mystery", "--give-up"]) == 0
    assert " ".join(capsys.readouterr().out.split()).startswith(
        f"The answer was: {mystery.solution}"
    )
    assert load_state(folder) == MysteryState(8, 2)


@pytest.mark.parametrize("text", ["", "number = [", "number = 1\nlevel = 9\n", "level = 'x'\n"])
def test_damaged_file_starts_a_new_series(tmp_path, text):
    (tmp_path / "mystery.toml").write_text(text, "utf-8")

    assert load_state(tmp_path) == MysteryState()


def test_an_answer_without_a_mystery_gets_one_line(all_exercises, capsys):
    assert all_exercises.is_dir()
    assert run_command(["mystery", "clean"]) == 2
    assert "Draw one: grade mystery" in capsys.readouterr().err


def test_mystery_levels_get_harder():
    several = [drawn(EFFECTS, seed, level=1 + seed).solution for seed in SEEDS[EFFECTS]]
    easy, hard = (
        {drawn(FAULTS, seed, level).solution.split(",")[0] for seed in SEEDS[FAULTS]}
        for level in (1, HIGHEST)
    )

    assert [len(one.split(", ")) for one in several] == [1, 1, 2, 2, 3]
    assert easy <= {"encoder-slip", "brownout", "hard-stop", "loop-overrun"}
    assert len(hard) > len(easy)
    assert "clean" in hard
    assert "clean" not in easy
