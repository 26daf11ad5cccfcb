"""What a learner is given, words for answers, changers of answers, and a class's own secret."""

import pytest

from grader.answers.choice_answer import check_choice, read_choice
from grader.checks.check import WrongAnswer
from grader.exercise.mistake import (
    change_number,
    exchange_numbers,
    make_wrong_answer,
    scale_numbers,
)
from grader.student_data.student_files import write_student_files
from sim.core.errors import BadRequest
from sim.support.student_names import make_folder_name

TYPES = ("Simple", "Arm", "Elevator")


def test_files_are_written_once_and_again_when_they_were_changed(tmp_path):
    exercise, said = tmp_path / "exercises" / "exercise5", []
    files = {"given.toml": "kS = 1\n", "log.csv": lambda path: path.write_bytes(b"rows")}
    told = {"exercise": exercise, "student": "Zoë", "say": said.append}
    write_student_files(files, **told)
    write_student_files(files, **told)
    made = exercise / "data" / make_folder_name("Zoë")
    (made / "log.csv").write_bytes(b"other")
    write_student_files(files, **told)

    assert (made / "given.toml").read_bytes() == b"kS = 1\n"
    assert (made / "log.csv").read_bytes() == b"rows"
    assert len(list(made.iterdir())) == 2
    assert [line.partition(": ")[0] for line in said] == [
        "Your own files for exercise 5",
        "Your files were changed, so they are made again",
    ]


def test_a_place_that_cannot_be_written_is_refused(tmp_path):
    (tmp_path / "exercise5").write_text("in the way", encoding="utf-8")

    with pytest.raises(BadRequest, match="your files cannot be written"):
        write_student_files(
            {"log.csv": ""}, exercise=tmp_path / "exercise5", student="ann", say=print
        )


@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ("arm", "Arm"),
        (" ARM ", "Arm"),
        ("new Arm(kS)", "Arm"),
        ("a.b.Arm", "Arm"),
        ("lift", "Elevator"),
    ],
)
def test_a_word_may_be_written_in_many_ways(given, meant):
    assert read_choice(given, TYPES, also={"lift": "Elevator"}) == meant


@pytest.mark.parametrize("given", [None, "", 3, True, ["Arm"], "Arms", "…"])
def test_missing_or_unknown_word_gets_the_list_of_words(given):
    with pytest.raises(WrongAnswer) as wrong:
        read_choice(given, TYPES)

    assert wrong.value.hint == "Choose one of: Simple, Arm, Elevator."


def test_wrong_word_gets_a_reason():
    check_choice("arm", "Arm", TYPES, why=lambda _: ("no", ""))
    with pytest.raises(WrongAnswer, match="no gravity") as wrong:
        check_choice("simple", "Arm", TYPES, why=lambda one: (f"{one} has no gravity", "M-R2"))

    assert wrong.value.misconception == "M-R2"


@pytest.mark.parametrize(
    ("change", "made"),
    [
        (scale_numbers(2, "kV"), "kS = 0.1\nkV = 4\n"),
        (exchange_numbers("kS", "kV"), "kS = 2\nkV = 0.1\n"),
        (change_number("kS", lambda all_: all_["kS"] + all_["kV"]), "kS = 2.1\nkV = 2\n"),
        (make_wrong_answer("kV", '"2 V"'), 'kS = 0.1\nkV = "2 V"\n'),
    ],
)
def test_answers_in_a_file_are_replaced(change, made):
    assert change("kS = 0.1\nkV = 2.0\n") == made


def test_change_without_effect_is_refused():
    with pytest.raises(ValueError, match="none of the numbers"):
        scale_numbers(1, "kV")("kV = 2\n")
    with pytest.raises(ValueError, match="no kA"):
        make_wrong_answer("kA", "1")("kV = 2\n")
