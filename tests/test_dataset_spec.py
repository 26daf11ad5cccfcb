"""Specs that are refused: one line that names the file, the place in it, the key, and a way out."""

import pytest
from dataset_made import DAMAGED, PLAIN, SECRET, spec, sysid

from sim.bench.dataset.spec import read_spec
from sim.bench.dataset.table import NumberRange
from sim.core.errors import BadRequest

FAULT = '[[logs.faults]]\nname = "loop-overrun"\n'
EFFECT = '[[logs.effects]]\nname = "stribeck"\n'


@pytest.fixture
def refusal(tmp_path, capsys):
    """What the command says of a spec, in one line, before it makes anything."""

    def refuse(path):
        assert sysid("dataset", path, "-o", tmp_path / "data") == 2
        said = capsys.readouterr().err
        assert said.count("\n") == 1
        assert not (tmp_path / "data").exists()
        return said.removeprefix(f"sysid: {path}").strip()

    return refuse


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("seed = 1", "sed = 1"),
        ("seed = 1", "qqq = 1"),
        ('name = "week3"', ""),
        ('"week3"', "3"),
        ('"week3"', '" "'),
        ("seed = 1", "seed = -1"),
        ("seed = 1", "seed = true"),
        ("seed = 1", "seed = 1\nsecret = 'x.secret'"),
        (
            "seed = 1",
            "formats = 'hoot'",
        ),
        ("seed = 1", "formats = []"),
        ("seed = 1", "formats = ['csv', 'csv']"),
        ("[[logs]]", "[logs]"),
        ("[[logs]]", "[[log]]"),
        ("timeout", "time_out"),
        ("1.0", "-1.0"),
        ("1.0", "'long'"),
        ("1.0", "nan"),
        (
            "step = 3.0",
            "step = 13.0",
        ),
        ("step = 3.0", "period = 9.0"),
        ("step = 3.0", "tests = 'wobble'"),
        ("count = 2", "count = 0"),
        ("count = 2", "count = 2.5"),
        ("count = 2", "count = 90000"),
        ("count = 2", "drawn = 'yes'"),
        ("shooter", "shoter"),
        ("mechanisms", "mechanism"),
        ("count = 2", "routine = 3"),
        (
            "count = 2",
            "effects = 3",
        ),
    ],
)
def test_invalid_entry_of_a_spec_is_refused_with_its_name_and_place(
    tmp_path, old, new, refusal, reads
):
    assert old in PLAIN

    reads(refusal(spec(tmp_path, PLAIN.replace(old, new))))


@pytest.mark.parametrize(
    "part",
    [
        FAULT.replace("overrun", "overun"),
        FAULT + "severity = 3.5",
        FAULT + "severity = [2, 1]",
        FAULT + "severity = [1, 2, 3]",
        FAULT + "severity = [1]",
        FAULT + "severity = inf",
        FAULT + "chance = 1.5",
        FAULT + "size = 1.0",
        FAULT + "at = 1.5",  # the timeout is 1 s
        FAULT + "at = -1",
        FAULT + 'test = "dynamic"',
        FAULT + 'test = "coast-forward"',
        "[[logs.faults]]\n",
    ],
)
def test_an_impossible_fault_is_refused_before_anything_is_made(tmp_path, part, refusal, reads):
    reads(refusal(spec(tmp_path, PLAIN + part)))


def test_a_fault_needs_a_test_that_is_run(tmp_path, refusal, reads):
    text = PLAIN.replace("step = 3.0", 'tests = ["dynamic-forward", "dynamic-reverse"]')
    fault = FAULT + 'test = "quasistatic-forward"'

    reads(refusal(spec(tmp_path, text + fault)))


def test_refusal_counts_tables_of_the_same_name(tmp_path, refusal):
    second = '[[logs]]\nmechanisms = "shooter"\n' + FAULT + FAULT + "at = -9.0"

    assert refusal(spec(tmp_path, PLAIN + second)).startswith(
        ", [[logs]] number 2, [[logs.faults]] number 2: at is -9.0."
    )


@pytest.mark.parametrize(
    "part",
    [
        EFFECT.replace("beck", "bek"),
        EFFECT + "size = -1",
        EFFECT.replace("stribeck", "gravity-cosine"),
        EFFECT + "size = 'big'",
        EFFECT + "size = [2.0, 1.0]",
        EFFECT + "severity = 1.0",
    ],
)
def test_an_impossible_effect_is_refused_before_anything_is_made(tmp_path, part, refusal, reads):
    found = refusal(spec(tmp_path, PLAIN + part))

    assert found.startswith(", [[logs]] number 1")
    reads(found)


def test_an_effect_cannot_be_hidden_twice_in_one_log(tmp_path, refusal, reads):
    second = EFFECT.replace('"stribeck"', '["drag", "stribeck"]\nchance = 0.1')

    reads(refusal(spec(tmp_path, PLAIN + EFFECT + second)))


def test_a_spec_that_is_no_toml_says_in_which_line(tmp_path, refusal):
    said = refusal(spec(tmp_path, PLAIN + "[[logs]\n"))

    assert "is not TOML" in said
    assert "line 10" in said


def test_a_spec_that_is_not_there_says_how_to_get_one(tmp_path, refusal, reads):
    path = tmp_path / "none.toml"

    reads(refusal(path))


def test_spec_in_utf_16_is_refused(tmp_path, refusal, reads):
    (tmp_path / "spec.toml").write_bytes(PLAIN.encode("utf-16"))

    reads(refusal(tmp_path / "spec.toml"))


def test_a_secret_in_clear_is_refused_and_not_repeated(tmp_path, refusal, reads):
    said = refusal(spec(tmp_path, DAMAGED.replace('"class.secret"', f'"{SECRET}"')))

    reads(said)
    assert SECRET not in said


@pytest.mark.parametrize(
    ("text", "kept", "around"),
    [
        (DAMAGED.replace('secret = "class.secret"', ""), "", ""),
        (DAMAGED, "short", ""),
        (DAMAGED, SECRET, SECRET + "!"),
        (DAMAGED, " ", ""),
    ],
    ids=["none", "too short", "two that differ", "empty"],
)
def test_empty_or_malformed_secret_is_refused(  # noqa: PLR0917 - pytest passes them by name
    tmp_path, monkeypatch, capsys, text, kept, around, reads
):
    monkeypatch.setenv("SYSID_SECRET", around)
    path = spec(tmp_path, text, secret=kept)

    assert sysid("dataset", path, "-o", tmp_path / "data") == 2

    shown = capsys.readouterr().err
    reads(shown)
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
        (
            '"roster.csv"',
            "name\nann\n",
            "roster.csv: the first line names no column student. Name one",
        ),
        ('"roster.csv"', "", "roster.csv: the first line names no column student. Name one"),
        ('"roster.csv"', "student\n\n", "roster.csv: there is no student in this table."),
        ('"roster.csv"', "student\nann\nAnn\n", "line 3: 'Ann' and 'ann' are the same student."),
        ('"roster.csv"', "student,x\n,1\n", "roster.csv, line 2: the student's name is empty."),
        ('"roster.csv"', "student\n../bo\n", "line 2: the student's name '../bo' has a path sepa"),
        ('["ann", "ann"]', None, ", students: 'ann' and 'ann' are the same student."),
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


def test_log_table_inherits_the_routine_and_overrides_parts_of_it(tmp_path):
    path = spec(tmp_path, PLAIN + "routine = { step = 2.0, period = 0.01 }\n")

    (logs,) = read_spec(path).logs

    assert (logs.routine.timeout, logs.routine.step, logs.routine.period) == (1.0, 2.0, 0.01)


def test_a_number_is_fixed_or_drawn_between_two(tmp_path):
    path = spec(tmp_path, PLAIN + FAULT + "severity = [0.5, 2]\nat = 0.25\n")

    (fault,) = read_spec(path).logs[0].faults

    assert (fault.severity, fault.at) == (NumberRange(0.5, 2.0), NumberRange(0.25, 0.25))
