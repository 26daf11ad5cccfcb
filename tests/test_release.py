"""What students get: no solutions, no keys, nothing that lets a class's numbers be drawn again."""

import io
import tomllib
import zipfile

import pytest

from grader.classroom.bundle import pack_course
from grader.classroom.release import StudentPackage, make_student_package, pack_course_folder
from grader.cli import run_command
from grader.course.package_files import select_package_files
from grader.course.progress import find_course
from grader.exercise.exercise import find_exercise
from grader.student_data.variant import use_class_secret
from sim.core.errors import BadRequest

pytestmark = pytest.mark.slow

SECRET = b"0123456789abcdef-east"
PRIVATE = ("course/solutions/", "course/tests/", ".git", ".ci/", ".course", "__pycache__", "/data/")


@pytest.fixture(scope="module")
def course(root):
    return find_course(root)


@pytest.fixture(scope="module")
def packed(course):
    return pack_course(course)


@pytest.fixture(scope="module")
def anns(packed):
    """What ann gets, unpacked: name -> content."""
    student, content = make_student_package(StudentPackage("ann", SECRET, "East", packed))
    assert student == "ann"
    return read(content)


def read(content):
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def lay_out(folder, *packages):
    for files in packages:
        for name, content in files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    return folder / "course"


def test_the_common_package_holds_the_course_and_nothing_private(course):
    files = read(pack_course_folder(select_package_files(course).files))

    for name in ("README.md", "pyproject.toml", "grader/__main__.py", "sim/core/log.py"):
        assert f"course/{name}" in files
    assert "course/exercises/exercise4/README.md" in files
    assert any(name.startswith("course/lessons/") for name in files)
    assert [name for name in files for part in PRIVATE if part in name] == []
    assert [name for name in files if "mistakes" in name or "solve.py" in name] == []


def test_a_students_package_holds_data_and_a_seal_and_no_secret(anns):
    told = tomllib.loads(anns["course/.course/class.toml"].decode())

    assert (told["class"], told["student"]) == ("East", "ann")
    assert told["seal"]
    assert "course/exercises/exercise9/data/ann/class.toml" in anns
    assert "course/exercises/exercise9/data/ann/log.csv" in anns
    assert not any(SECRET in content for content in anns.values())


def test_a_class_has_numbers_of_its_own_and_the_same_again(packed, anns):
    again = read(make_student_package(StudentPackage("ann", SECRET, "East", packed))[1])
    west = read(make_student_package(StudentPackage("ann", SECRET + b"!", "East", packed))[1])
    ben = read(make_student_package(StudentPackage("ben", SECRET, "East", packed))[1])
    log = "course/exercises/exercise9/data/ann/log.csv"

    assert again == anns
    assert west[log] != anns[log]
    assert ben[log.replace("/ann/", "/ben/")] != anns[log]


def test_class_numbers_can_only_be_graded_by_the_instructor(
    course, anns, tmp_path, monkeypatch, capsys
):
    place = lay_out(tmp_path, read(pack_course_folder(select_package_files(course).files)), anns)
    monkeypatch.chdir(place)
    answers = place / "exercises" / "exercise9" / "answers.toml"
    answers.write_text('kS = 0.1\nkV = ""\n', encoding="utf-8")
    log = place / "exercises" / "exercise9" / "data" / "ann" / "log.csv"
    before = log.read_bytes()

    assert run_command(["9"]) == 2
    said = capsys.readouterr()
    assert "answers.toml: 1 of 2 answered\n  kS = 0.1" in said.out
    assert "has numbers of East, which only your instructor can grade. Hand it in." in said.err
    assert run_command(["start", "--no-lab"]) == 0
    assert log.read_bytes() == before  # nothing is drawn over what the class issued
    log.unlink()
    assert run_command(["start", "--no-lab"]) == 2
    assert "log.csv is missing, and only East can make it" in capsys.readouterr().err
    log.write_bytes(before)
    assert run_command(["9", "--student", "practice"]) == 1  # other numbers, with feedback
    assert log.read_bytes() == before
    assert run_command(["4"]) == 1  # the same task for everybody is graded anywhere


def test_the_instructor_grades_what_the_class_issued(course, anns, tmp_path, monkeypatch):
    """The truth drawn with the secret is what the student's data were made from."""
    monkeypatch.chdir(course)
    exercise = find_exercise("9", course)
    with use_class_secret(SECRET):
        right = exercise.module.draw("ann").asked
    text = "".join(f"{name} = {one.expected:.6g}\n" for name, one in right.items())
    for folder in ("in", "in2"):
        (tmp_path / folder / "ann" / "exercise9").mkdir(parents=True)
        (tmp_path / folder / "ann" / "exercise9" / "answers.toml").write_text(text, "utf-8")
    secret = tmp_path / "class.secret"
    secret.write_bytes(SECRET + b"\n")
    command = ["class", str(tmp_path / "in"), "--exercise", "9", "--secret", str(secret)]
    alone = ["class", str(tmp_path / "in2"), "--exercise", "9", "--self-study"]

    def points(folder):
        rows = (tmp_path / folder / "gradebook.csv").read_text("utf-8-sig").splitlines()
        return float(rows[1].split(",")[1])

    assert run_command(command) == 0
    assert run_command(alone) == 0
    assert points("in-graded") >= 4  # kS, kV and kA
    assert points("in2-graded") < 4
    assert "course/exercises/exercise9/data/ann/log.csv" in anns


@pytest.fixture
def empty_course(tmp_path, monkeypatch):
    """A course with nothing in it, a roster, and a secret that is too short."""
    (tmp_path.parent / "short").write_bytes(b"abc")
    (tmp_path / "r.csv").write_text("student\nann\n", encoding="utf-8")
    (tmp_path / "in" / "ann").mkdir(parents=True)
    for name in ("exercises", "lessons"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path)


@pytest.mark.usefixtures("empty_course")
@pytest.mark.parametrize(
    ("command", "said"),
    [
        (["release"], "Missing option '-o' / '--output'"),
        (["release", "-o", "out", "--roster", "r.csv"], "to give each student own numbers"),
        (
            ["release", "-o", "out", "--roster", "r.csv", "--secret", "out/s"],
            "everybody would get it",
        ),
        (
            ["release", "-o", "out", "--roster", "r.csv", "--secret", "../short"],
            "fewer than 16 characters",
        ),
        (["class", "in", "--secret", "nowhere"], "the file with the secret is missing"),
    ],
)
def test_release_that_cannot_be_made_gets_a_one_line_error(capsys, command, said):
    assert run_command(command) == 2
    assert said in capsys.readouterr().err


@pytest.mark.usefixtures("empty_course")
@pytest.mark.parametrize("text", ["student,mail,team,id\n", "student\nann bauer\nben\n"])
def test_table_in_place_of_a_secret_is_refused(tmp_path_factory, capsys, text):
    roster = tmp_path_factory.mktemp("class") / "roster.csv"
    roster.write_text(text, encoding="utf-8")
    command = ["release", "-o", "out", "--roster", str(roster), "--secret", str(roster)]

    assert run_command(command) == 2
    assert capsys.readouterr().err == (
        f"grade: {roster}: this file holds no secret: a secret is one line without commas. "
        "Name the file with the secret. To get a new secret, name a file that does not exist.\n"
    )
    assert roster.read_text(encoding="utf-8") == text


def test_incomplete_course_is_not_released(tmp_path):
    with pytest.raises(BadRequest, match="not the whole course"):
        select_package_files(tmp_path)


def test_a_secret_is_made_once_for_its_owner_only(course, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(course)
    (tmp_path / "r.csv").write_text("student\nann\n", encoding="utf-8")
    secret = tmp_path / "class.secret"
    command = ["release", "-o", str(tmp_path / "out"), "--roster", str(tmp_path / "r.csv"),
               "--secret", str(secret)]  # fmt: skip

    assert run_command(command) == 0
    assert "a new secret. Keep this file" in capsys.readouterr().err
    kept, first = secret.read_bytes(), (tmp_path / "out" / "students" / "ann.zip").read_bytes()
    assert run_command(command) == 0
    assert secret.read_bytes() == kept
    assert (tmp_path / "out" / "students" / "ann.zip").read_bytes() == first
