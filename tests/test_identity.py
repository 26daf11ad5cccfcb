"""Whose numbers somebody worked on: the package says it, at home and where a class is graded."""

from html import unescape
from pathlib import Path

import pytest
from small_course import RIGHT, lay_out

from grader.classroom.identity import check_identities
from grader.classroom.secret import identify_secret, seal_identity
from grader.classroom.submissions import find_submissions
from grader.cli import run_command
from grader.course.progress import load_progress
from grader.exercise.exercise import list_exercises
from grader.notebook.submit import submit
from sim.core.errors import BadRequest

SECRET = b"0123456789abcdef-east"
MAKER = '''

def make_files(student):
    """Draws nothing; says for whom."""
    print(f"made for {student}")
    return {}
'''


def issue(course: Path, student: str, *, secret: bytes = SECRET) -> None:
    """Write what a class's package says about whose it is."""
    mark = seal_identity(secret, student=student, name="East")
    (course / ".course").mkdir(exist_ok=True)
    (course / ".course" / "class.toml").write_text(
        f'class = "East"\nstudent = "{student}"\nseal = "{mark}"\n', encoding="utf-8"
    )


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course whose exercise draws numbers."""
    lay_out(tmp_path / "course")
    checks = tmp_path / "course" / "exercises" / "exercise1" / "checks.py"
    checks.write_text(checks.read_text(encoding="utf-8") + MAKER, encoding="utf-8")
    monkeypatch.chdir(tmp_path / "course")
    return tmp_path / "course"


def hand_in(course: Path, place: Path, student: str) -> tuple:
    """Hand a whole course folder in, under a name."""
    there = place / student / "course" / "exercises" / "exercise1"
    there.mkdir(parents=True)
    (there / "answers.toml").write_text(RIGHT, encoding="utf-8")
    for name in ("class.toml", "progress.toml"):
        source = course / ".course" / name
        if source.is_file():
            target = place / student / "course" / ".course" / name
            target.parent.mkdir(exist_ok=True)
            target.write_bytes(source.read_bytes())
    return find_submissions(place, list_exercises(course))


def test_a_package_belongs_to_the_student_it_was_issued_to(course, capsys, reads):
    issue(course, "Zoë")

    assert run_command(["start", "--no-lab"]) == 0
    assert "made for Zoë" in capsys.readouterr().out
    assert load_progress(course)[0].student == "Zoë"
    assert run_command(["exercise1"]) == 2
    reads(capsys.readouterr().err)
    reads(str(submit(1, size=3)))


def test_practice_under_another_name_does_not_change_whose_package_it_is(course, capsys):
    issue(course, "Zoë")

    assert run_command(["start", "--no-lab", "--student", "practice"]) == 0
    assert run_command(["start", "--no-lab"]) == 0
    assert capsys.readouterr().out.rindex("made for Zoë") > 0


@pytest.mark.parametrize("spelled", ["ann", "ANN"])
def test_package_is_graded_under_its_student_on_the_roster(course, tmp_path, spelled):
    issue(course, spelled)
    (one,) = check_identities(
        hand_in(course, tmp_path / "in", "ann"), list_exercises(course), secret=SECRET
    )

    assert (one.problem, one.student, one.numbers_owner) == ("", "ann", "ann")


@pytest.mark.parametrize(
    ("owner", "secret"),
    [
        ("ben", SECRET),
        ("ann", SECRET + b"!"),
    ],
)
def test_another_students_or_class_package_is_reported(course, tmp_path, owner, secret, reads):
    issue(course, owner, secret=secret)
    (one,) = check_identities(
        hand_in(course, tmp_path / "in", "ann"), list_exercises(course), secret=SECRET
    )

    reads(one.problem)


def test_a_class_without_its_secret_is_refused(course, tmp_path, reads):
    issue(course, "ann")

    with pytest.raises(BadRequest) as refused:
        check_identities(
            hand_in(course, tmp_path / "in", "ann"), list_exercises(course), secret=None
        )
    reads(refused.value)


def test_student_without_a_name_is_graded_on_the_numbers_they_had(course, tmp_path, capsys, reads):
    assert run_command(["start", "--no-lab"]) == 0
    (course / ".course").mkdir(exist_ok=True)
    (course / ".course" / "progress.toml").write_text('student = "me"\n', encoding="utf-8")
    (one,) = check_identities(
        hand_in(course, tmp_path / "in", "ann"), list_exercises(course), secret=None
    )

    assert (one.problem, one.student, one.numbers_owner) == ("", "ann", "me")
    assert run_command(["class", str(tmp_path / "in")]) == 0
    reads(capsys.readouterr().err)


def test_a_folder_of_data_names_its_owner(course, tmp_path):
    place = tmp_path / "in" / "ann" / "exercises" / "exercise1"
    (place / "data" / "me").mkdir(parents=True)
    (place / "data" / "me" / "log.csv").write_text("", encoding="utf-8")
    (one,) = check_identities(
        find_submissions(tmp_path / "in", list_exercises(course)),
        list_exercises(course),
        secret=None,
    )

    assert one.numbers_owner == "me"


def test_a_course_started_under_another_name_is_reported(course, tmp_path, reads):
    (course / ".course").mkdir()
    (course / ".course" / "progress.toml").write_text('student = "ben"\n', encoding="utf-8")
    (one,) = check_identities(
        hand_in(course, tmp_path / "in", "ann"), list_exercises(course), secret=None
    )

    reads(one.problem)


def test_grading_one_student_without_a_secret_requires_an_option(course, tmp_path, capsys, reads):
    place = tmp_path / "in"
    place.mkdir()
    (place / "Ann Lee - answers.toml").write_text(RIGHT, encoding="utf-8")

    assert course.is_dir()
    assert run_command(["class", str(place)]) == 2
    reads(capsys.readouterr().err)
    assert not (tmp_path / "in-graded").exists()
    assert run_command(["class", str(place), "--self-study"]) == 0
    assert capsys.readouterr().out.startswith("Graded without a secret, on the numbers of self-")


def test_first_line_of_the_overview_names_the_secret(course, tmp_path, capsys):
    issue(course, "ann")
    hand_in(course, tmp_path / "in", "ann")
    (tmp_path / "secret").write_bytes(SECRET)

    assert run_command(["class", str(tmp_path / "in"), "--secret", str(tmp_path / "secret")]) == 0
    first = f"Graded with the secret {identify_secret(SECRET)}, on each student's numbers from it."
    assert capsys.readouterr().out.startswith(first)
    page = (tmp_path / "in-graded" / "index.html").read_text(encoding="utf-8")
    assert f"<p>{first}</p>" in unescape(page)


def test_partners_may_hand_in_the_package_of_one_of_them(course, tmp_path):
    issue(course, "ben")
    there = hand_in(course, tmp_path / "in", "ann")
    partners = {"ann": ("ben",), "ben": ("ann",)}
    (one,) = check_identities(there, list_exercises(course), secret=SECRET, partners=partners)

    assert (one.problem, one.student, one.numbers_owner) == ("", "ann", "ben")
