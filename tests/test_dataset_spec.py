"""Specs that are refused: one line that names the file, the place in it, the key, and a way out."""

import pytest
from dataset_made import DAMAGED, PLAIN, SECRET, spec, sysid

from sim.bench.dataset.spec import read_spec
from sim.bench.dataset.table import NumberRange
from sim.core.errors import BadRequest

FAULT = '[[logs.faults]]\nname = "loop-overrun"\n'
EFFECT = '[[logs.effects]]\nname = "stribeck"\n'
WHOLE = '[[logs.faults]]\nname = "sign-flip"\n'


@pytest.fixture(autouse=True)
def _no_secret_around(monkeypatch):
    monkeypatch.delenv("SYSID_SECRET", raising=False)


def refusal(path):
    """What is said of a spec."""
    with pytest.raises(BadRequest) as caught:
        read_spec(path)
    said = str(caught.value)
    assert "\n" not in said
    return said.removeprefix(str(path))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("seed = 1", "sed = 1", ': unknown key "sed". Did you mean "seed"?'),
        ("seed = 1", "qqq = 1", ': unknown key "qqq". Choose one of: name, seed, secret, students'),
        ('name = "week3"', "", ': name is missing. Add, for example: name = "week3"'),
        ('"week3"', "3", ': name is 3. Give a text: name = "week3"'),
        ('"week3"', '" "', ': name is " ". Give a text'),
        ('"week3"', f'"{"w" * 65}"', "Give a name of 1 to 64 characters."),
        ("seed = 1", "seed = -1", ": seed is -1. Give a whole number from 0 to"),
        ("seed = 1", "seed = true", ": seed is true. Give a whole number"),
        ("seed = 1", "seed = 1\nsecret = 'x.secret'", ": both seed and secret are there."),
        (
            "seed = 1",
            "formats = 'hoot'",
            ': formats "hoot" is unknown. Choose one of: wpilog, csv.',
        ),
        ("seed = 1", "formats = []", ": formats is []. Give texts"),
        ("seed = 1", "formats = ['csv', 'csv']", ': formats names "csv" twice. Name each once.'),
        ("[[logs]]", "[logs]", ": logs is {"),
        ("[[logs]]", "[[log]]", ': unknown key "log". Did you mean "logs"?'),
        ("timeout", "time_out", ', routine: unknown key "time_out". Did you mean "timeout"?'),
        ("1.0", "-1.0", ", routine: a timeout of -1 s. Choose a number above 0"),
        ("1.0", "'long'", ', routine: timeout is "long". Give a number.'),
        ("1.0", "nan", ", routine: timeout is NaN. Give a number."),
        (
            "step = 3.0",
            "step = 13.0",
            ", routine: a step of 13 V. Choose a number above 0, at most",
        ),
        ("step = 3.0", "period = 9.0", ", routine: period is 9.0. Give 0.0005 to 0.5 s"),
        ("step = 3.0", "tests = 'wobble'", ', routine: tests "wobble" is unknown. '),
        ("count = 2", "count = 0", ", [[logs]] number 1: count is 0. Give a whole number from 1"),
        ("count = 2", "count = 2.5", ", [[logs]] number 1: count is 2.5. Give a whole number"),
        ("count = 2", "count = 90000", ": 180000 logs are requested. Split it: one dataset has at"),
        ("count = 2", "drawn = 'yes'", ', [[logs]] number 1: drawn is "yes". Give true or false'),
        ("shooter", "shoter", '[[logs]] number 1: mechanisms "shoter" is unknown. Did you mean'),
        ("mechanisms", "mechanism", 'number 1: unknown key "mechanism". Did you mean "mechanisms"'),
        ("count = 2", "routine = 3", ", [[logs]] number 1, routine: 3 is in the place of keys and"),
        (
            "count = 2",
            "effects = 3",
            ", [[logs]] number 1: effects is 3. Begin each with a line [[",
        ),
    ],
)
def test_what_cannot_be_meant_is_refused_by_its_name_and_place(tmp_path, old, new, said):
    assert old in PLAIN

    assert said in refusal(spec(tmp_path, PLAIN.replace(old, new)))


@pytest.mark.parametrize(
    ("part", "said"),
    [
        (FAULT.replace("overrun", "overun"), 'name "loop-overun" is unknown. Did you mean "loop-o'),
        (FAULT + "severity = 3.5", "severity is 3.5. Give a number from 0 to 3, or the two to"),
        (FAULT + "severity = [2, 1]", "severity is [2, 1]. Give a number from 0 to 3"),
        (FAULT + "severity = [1, 2, 3]", "severity is [1, 2, 3]. Give a number from 0 to 3"),
        (FAULT + "severity = [1]", "severity is [1]. Give a number from 0 to 3"),
        (FAULT + "severity = 0", "severity is 0. Leave the fault out, or give a number above 0."),
        (FAULT + "severity = inf", "severity is Infinity. Give a number"),
        (FAULT + "chance = 0", "chance is 0. Give a number above 0, at most 1."),
        (FAULT + "chance = 1.5", "chance is 1.5. Give a number above 0, at most 1."),
        (FAULT + "size = 1.0", 'unknown key "size". '),
        (FAULT + "at = 1.5", "at is 1.5. Give a number from 0 to 1"),  # the timeout is 1 s
        (FAULT + "at = -1", "at is -1. Give a number from 0 to 1"),
        (FAULT + 'test = "dynamic"', "test 'dynamic' is not run. Did you mean \"dynamic-"),
        (FAULT + 'test = "coast-forward"', "test 'coast-forward' is not run. "),
        (WHOLE + "at = 0.5", "sign-flip spoils a whole test, so at means nothing. Leave out at."),
        ("[[logs.faults]]\n", "name is missing. Add, for example: name ="),
    ],
)
def test_an_impossible_fault_is_refused_before_anything_is_made(tmp_path, part, said):
    assert f", [[logs]] number 1, [[logs.faults]] number 1: {said}" in refusal(
        spec(tmp_path, PLAIN + part)
    )


def test_a_fault_needs_a_test_that_is_run(tmp_path):
    text = PLAIN.replace("step = 3.0", 'tests = ["dynamic-forward", "dynamic-reverse"]')
    fault = FAULT + 'test = "quasistatic-forward"'

    assert "test 'quasistatic-forward' is not run." in refusal(spec(tmp_path, text + fault))


def test_the_second_of_a_kind_is_counted(tmp_path):
    second = '[[logs]]\nmechanisms = "shooter"\n' + FAULT + FAULT + "at = 9.0"

    assert refusal(spec(tmp_path, PLAIN + second)).startswith(
        ", [[logs]] number 2, [[logs.faults]] number 2: at is 9.0."
    )


@pytest.mark.parametrize(
    ("part", "said"),
    [
        (EFFECT.replace("beck", "bek"), 'name "stribek" is unknown. Did you mean "stribeck"?'),
        (EFFECT + "size = -1", "stribeck of size -1. Choose 0 to 5"),
        (EFFECT + "size = 0", "size is 0. Leave the effect out"),
        (EFFECT.replace("stribeck", "gravity-cosine"), "a drivetrain cannot have gravity-cosine: "),
        (EFFECT + "size = 'big'", 'size is "big". Give a number, or the two to draw between'),
        (EFFECT + "size = [2.0, 1.0]", "size is [2.0, 1.0]. Give a number, or the two"),
        (EFFECT + "severity = 1.0", 'unknown key "severity". Choose one of: name, size, chance'),
    ],
)
def test_an_impossible_effect_is_refused_before_anything_is_made(tmp_path, part, said):
    where = ", [[logs]] number 1, [[logs.effects]] number 1: "

    found = refusal(spec(tmp_path, PLAIN + part))

    assert found.startswith(where)
    assert said in found


def test_an_effect_cannot_be_hidden_twice_in_one_log(tmp_path):
    second = EFFECT.replace('"stribeck"', '["drag", "stribeck"]\nchance = 0.1')

    assert ", [[logs]] number 1: effect 'stribeck' might be hidden twice" in refusal(
        spec(tmp_path, PLAIN + EFFECT + second)
    )


def test_a_spec_that_is_no_toml_says_in_which_line(tmp_path):
    said = refusal(spec(tmp_path, PLAIN + "[[logs]\n"))

    assert "is not TOML" in said
    assert "line 10" in said


def test_a_spec_that_is_not_there_says_how_to_get_one(tmp_path):
    path = tmp_path / "none.toml"

    assert refusal(path) == (
        f": there is no such file. Write an example there with: sysid dataset --example {path}"
    )


def test_a_spec_in_the_encoding_of_an_old_shell_is_refused(tmp_path):
    (tmp_path / "spec.toml").write_bytes(PLAIN.encode("utf-16"))

    assert "is not UTF-8. Save it as UTF-8." in refusal(tmp_path / "spec.toml")


def test_a_secret_in_clear_is_refused_and_not_repeated(tmp_path):
    said = refusal(spec(tmp_path, DAMAGED.replace('"class.secret"', f'"{SECRET}"')))

    assert "secret is not the name of a file that ends in .secret. Write secret = " in said
    assert SECRET not in said


@pytest.mark.parametrize(
    ("text", "kept", "around", "said"),
    [
        (DAMAGED.replace('secret = "class.secret"', ""), "", "", "says neither secret nor seed."),
        (DAMAGED, "short", "", "the secret has fewer than 16 characters"),
        (DAMAGED, SECRET, SECRET + "!", "the file of the secret and SYSID_SECRET differ."),
        (DAMAGED, " ", "", "the file of the secret is empty"),
    ],
    ids=["none", "too short", "two that differ", "empty"],
)
def test_a_secret_that_is_none_is_refused(  # noqa: PLR0917 - pytest passes them by name
    tmp_path, monkeypatch, capsys, text, kept, around, said
):
    monkeypatch.setenv("SYSID_SECRET", around)
    path = spec(tmp_path, text, secret=kept)

    assert sysid("dataset", path, "-o", tmp_path / "data") == 2

    shown = capsys.readouterr().err
    assert said in shown
    assert shown.count("\n") == 1
    assert not (tmp_path / "data").exists()


@pytest.mark.parametrize(
    ("students", "content", "found"),
    [
        ('"roster.csv"', "student\nann\nbo\n", ("ann", "bo")),
        ('"roster.csv"', "\ufeffName;Student\nA. Nn;ann\n\nB. O;bo\n", ("ann", "bo")),
        ('"roster.csv"', 'student,note\r\nann,"a\r\nb"\r\nbo,\r\n', ("ann", "bo")),
        (
            '{ file = "roster.csv", column = "SIS Login ID" }',
            'Student,ID,SIS Login ID\n    Points Possible,,\n"Nn, A",7,ann\n"O, B",8,bo\n',
            ("ann", "bo"),
        ),
        ('["Zoë", "ann"]', "", ("Zoë", "ann")),
    ],
    ids=["one column", "semicolons", "quoted lines", "Canvas", "in the spec"],
)
def test_students_come_from_a_list_or_a_roster(tmp_path, students, content, found):
    (tmp_path / "roster.csv").write_bytes(content.encode())

    path = spec(tmp_path, PLAIN.replace("seed = 1", f"seed = 1\nstudents = {students}"))

    assert read_spec(path).students == found


@pytest.mark.parametrize(
    ("students", "content", "said"),
    [
        ('"roster.csv"', None, "roster.csv: the roster cannot be read (No such file"),
        ('"roster.csv"', "name\nann\n", "roster.csv: no column 'student' in its first line."),
        ('"roster.csv"', "", "roster.csv: no column 'student' in its first line."),
        ('"roster.csv"', "student\nann\nAnn\n", "line 3: 'Ann' and 'ann' are one student."),
        ('"roster.csv"', "student,x\n,1\n", "roster.csv, line 2: the student's name is empty."),
        ('"roster.csv"', "student\n../bo\n", "line 2: the student's name '../bo' has a path sepa"),
        ('["ann", "ann"]', None, ", students: 'ann' and 'ann' are one student."),
        ("[1, 2]", None, ": students is [1, 2]. Give texts"),
        ("7", None, ": students is 7. Give a text"),
        ('{ colum = "x" }', None, ', students: unknown key "colum". Did you mean "column"?'),
    ],
)
def test_a_roster_that_is_wrong_is_refused_with_its_line(tmp_path, students, content, said):
    if content is not None:
        (tmp_path / "roster.csv").write_text(content, encoding="utf-8")
    path = spec(tmp_path, PLAIN.replace("seed = 1", f"seed = 1\nstudents = {students}"))

    with pytest.raises(BadRequest) as caught:
        read_spec(path)

    assert said in str(caught.value)


def test_logs_take_the_routine_of_the_top_but_for_what_they_change(tmp_path):
    path = spec(tmp_path, PLAIN + "routine = { step = 2.0, period = 0.01 }\n")

    (logs,) = read_spec(path).logs

    assert (logs.settings.routine.timeout, logs.settings.routine.step, logs.settings.period) == (
        1.0,
        2.0,
        0.01,
    )


def test_a_number_is_fixed_or_drawn_between_two(tmp_path):
    path = spec(tmp_path, PLAIN + FAULT + "severity = [0.5, 2]\nat = 0.25\n")

    (fault,) = read_spec(path).logs[0].faults

    assert (fault.severity, fault.at) == (NumberRange(0.5, 2.0), NumberRange(0.25, 0.25))
