"""Which of a student's files are graded: one rule, and nothing that was handed in is forgotten."""

import base64
import csv
import hashlib
import io
import json
import os
import shutil
import tarfile
import zipfile
from itertools import product
from xml.etree import ElementTree as ET

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from small_course import HALF, RIGHT, lay_out, put

from grader.checks.check import Result, Status
from grader.classroom.grading import GradedStudent, GradingJob, grade_student
from grader.classroom.submissions import find_submissions, read_submission
from grader.cli import run_command
from grader.course.package_files import read_listed_files
from grader.exercise.exercise import Grade, find_exercise, list_exercises

STARTER = "size = 0\nmore = 1\n"
JAVA_STARTER = "public class ExampleSubsystem {}\n"
JAVA = "package frc;\npublic class {name} {{ int answer; }}\n"


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A course of two exercises, of numbers and of code, with the list of their starters."""
    top = tmp_path_factory.mktemp("course")
    lay_out(top)
    first = top / "exercises" / "exercise1"
    second = top / "exercises" / "exercise2"
    shutil.copytree(first, second)
    checks = (second / "checks.py").read_text(encoding="utf-8")
    files = '("ExampleSubsystem.java", "example_subsystem.py")'
    checks = checks.replace('("answers.toml",)', files)
    assert files in checks
    (second / "checks.py").write_text(checks, encoding="utf-8")
    starters = {"exercise1": {"answers.toml": STARTER},
                "exercise2": {"ExampleSubsystem.java": JAVA_STARTER,
                              "example_subsystem.py": "pass\n"}}  # fmt: skip
    lines = []
    for exercise, those in starters.items():
        lines.append(f"[{exercise}]")
        for name, text in those.items():
            lines.append(f'"{name}" = "{hashlib.sha256(text.encode()).hexdigest()}"')
    (top / "exercises" / "starters.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    read_listed_files.cache_clear()
    return top


def read(course, folder, files):
    put(folder, files)
    return read_submission(folder, list_exercises(course), student="ann")


@pytest.mark.parametrize(
    ("files", "graded"),
    [
        ({"exercise1/answers.toml": STARTER, "exercise1/answers (1).toml": RIGHT}, "answers.toml"),
        ({"exercise1/answers.toml": STARTER, "exercise1/mine.toml": RIGHT}, "mine.toml"),
        ({"exercise1/answers.toml": STARTER, "exercise1/final/answers.toml": RIGHT},
         "answers.toml"),
        ({"exercise1/answers.toml": STARTER, "my work/exercise1/answers.toml": RIGHT},
         "answers.toml"),
        ({"exercise1/answers.toml": RIGHT, "old/exercise1/answers - Copy.toml": RIGHT},
         "answers.toml"),
        ({"exercise1/answers.toml": STARTER, "exercise1.toml": RIGHT}, "exercise1.toml"),
        ({"exercise1/ANSWERS (2).TOML.txt": RIGHT}, "answers.toml"),
        ({"exercise1-1/answers.toml": RIGHT}, "answers.toml"),
    ],
)  # fmt: skip
def test_the_one_file_that_was_filled_in_is_graded(course, tmp_path, files, graded):
    one = read(course, tmp_path / "ann", files)

    assert one.problems == {}
    assert one.unused == ()
    assert one.files["exercise1"][graded] == RIGHT.encode()


@pytest.mark.parametrize(
    "files",
    [
        {"exercise1/answers.toml": HALF, "exercise1/final/answers.toml": RIGHT},
        {"exercise1/answers.toml": HALF, "exercise1/answers (1).toml": RIGHT},
        {"exercise1/answers.toml": HALF, "exercise1/mine.toml": RIGHT},
        {"a/exercise1/mine.toml": HALF, "b/exercise1/yours.toml": RIGHT},
    ],
)
def test_two_different_answer_files_are_both_listed_and_neither_is_graded(course, tmp_path, files):
    one = read(course, tmp_path / "ann", files)

    assert one.problems["exercise1"].startswith(
        "there are 2 different files that may be the answer"
    )
    assert all(name in one.problems["exercise1"] for name in files)


def test_answer_in_the_exercise_folder_is_graded_and_another_is_listed(course, tmp_path):
    one = read(course, tmp_path / "ann", {"exercise1/answers.toml": RIGHT, "exercise1.toml": HALF})

    assert one.files["exercise1"] == {"answers.toml": RIGHT.encode()}
    assert one.unused == (
        "exercise1.toml was not graded: exercise1 is graded from exercise1/answers.toml",
    )


def test_another_java_file_is_graded_beside_an_untouched_starter(course, tmp_path):
    drive = JAVA.format(name="DriveSubsystem")
    one = read(course, tmp_path / "ann", {
        "exercise2/ExampleSubsystem.java": JAVA_STARTER, "exercise2/example_subsystem.py": "pass\n",
        "exercise2/DriveSubsystem.java": drive,
    })  # fmt: skip

    assert one.files == {"exercise2": {"DriveSubsystem.java": drive.encode()}}
    assert (one.problems, one.unused) == ({}, ())


def test_a_java_file_counts_as_the_class_that_it_declares(course, tmp_path):
    mine, other = JAVA.format(name="ExampleSubsystem"), JAVA.format(name="Constants")
    one = read(course, tmp_path / "ann", {
        "exercise2/ExampleSubsystem.java": JAVA_STARTER, "exercise2/Mine.java": mine,
        "exercise2/Constants.java": other,
    })  # fmt: skip

    assert one.files == {
        "exercise2": {"ExampleSubsystem.java": mine.encode(), "Constants.java": other.encode()}
    }


def test_python_beside_a_graded_java_file_is_listed(course, tmp_path):
    one = read(course, tmp_path / "ann", {
        "exercise2/ExampleSubsystem.java": JAVA.format(name="ExampleSubsystem"),
        "exercise2/robot.py": "print()\n",
    })  # fmt: skip

    assert list(one.files["exercise2"]) == ["ExampleSubsystem.java"]
    assert one.unused[0].startswith("exercise2/robot.py was not graded")


def test_the_program_of_a_flat_folder_is_graded_whole(course, tmp_path):
    mine, other = JAVA.format(name="ExampleSubsystem"), JAVA.format(name="Constants")
    put(tmp_path / "ann", {"ExampleSubsystem.java": mine, "Constants.java": other})
    _, second = exercises = list_exercises(course)
    one = read_submission(tmp_path / "ann", exercises, asked=[second], student="ann")

    assert set(one.files["exercise2"]) == {"ExampleSubsystem.java", "Constants.java"}
    assert (one.problems, one.unused) == ({}, ())


def test_a_whole_course_folder_with_its_environment_is_read(course, tmp_path):
    with zipfile.ZipFile(tmp_path / "ann.zip", "w") as archive:
        for number in range(21_000):
            archive.writestr(f"course/.venv/lib/site-packages/p{number}/__init__.py", "")
        archive.writestr("course/exercises/exercise1/answers.toml", RIGHT)
    one = read_submission(tmp_path / "ann.zip", list_exercises(course), student="ann")

    assert (one.problem, one.files) == ("", {"exercise1": {"answers.toml": RIGHT.encode()}})


@pytest.mark.parametrize("ending", [".tar.gz", ".rar", ".7z"])
def test_an_archive_that_cannot_be_read_is_listed_by_its_student(course, tmp_path, ending):
    (tmp_path / "in").mkdir()
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w:gz") as archive:
        archive.addfile(tarfile.TarInfo("exercise1/answers.toml"))
    (tmp_path / "in" / f"ann{ending}").write_bytes(stream.getvalue())
    (one,) = find_submissions(tmp_path / "in", list_exercises(course))

    assert one.student == "ann"
    assert "it is an archive, but no zip file" in one.problem


needs_rights = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root reads everything"
)


@needs_rights
def test_a_folder_that_cannot_be_opened_is_not_taken_for_an_empty_one(course, tmp_path):
    put(tmp_path / "ann", {"exercise1/answers.toml": RIGHT})
    (tmp_path / "ann" / "exercise1").chmod(0)
    try:
        one = read_submission(tmp_path / "ann", list_exercises(course), student="ann")
    finally:
        (tmp_path / "ann" / "exercise1").chmod(0o700)

    assert "cannot be read: Permission denied" in one.problem


@needs_rights
@pytest.mark.parametrize(("closed", "given"), [
    ("mine/answers.toml", "mine/answers.toml"), ("mine", "mine/answers.toml"), ("mine", "mine"),
    ("mine/answers.toml", "mine"),
])  # fmt: skip
def test_learner_file_that_cannot_be_opened_is_not_graded(course, tmp_path, closed, given):
    put(tmp_path, {"mine/answers.toml": RIGHT})
    (tmp_path / closed).chmod(0)
    try:
        grade = find_exercise("exercise1", course).grade(tmp_path / given, student="ann")
    finally:
        (tmp_path / closed).chmod(0o700)

    assert (grade.status, grade.score) == ("ungradable", 0)
    assert "cannot be opened" in grade.reason
    assert "right to read it" in grade.reason


@needs_rights
@pytest.mark.parametrize("mode", [0, 0o400])
def test_a_class_that_cannot_be_opened_gets_one_line(course, tmp_path, monkeypatch, capsys, mode):
    monkeypatch.chdir(course)
    put(tmp_path / "in", {"ann/exercise1/answers.toml": RIGHT})
    (tmp_path / "in").chmod(mode)
    try:
        assert run_command(["class", str(tmp_path / "in"), "--self-study"]) == 2
    finally:
        (tmp_path / "in").chmod(0o700)

    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "our mistake" not in said


@pytest.mark.skipif(not hasattr(os, "symlink") or os.name == "nt", reason="links need a right")
def test_file_that_becomes_a_link_after_the_check_is_not_followed(tmp_path):
    from grader.classroom.submitted_files import list_submitted_files  # noqa: PLC0415 - only here

    place = tmp_path / "ann"
    put(place, {"exercise1/answers.toml": HALF})
    put(tmp_path, {"secret.toml": RIGHT})
    (found,) = [one for one in list_submitted_files(place) if _exchange(place, tmp_path)]

    with pytest.raises(OSError, match="symbolic link|Bad file descriptor"):
        found.content(100)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="links need a right, and pipes a system")
def test_a_zip_file_that_is_a_link_or_a_pipe_is_not_read(course, tmp_path):
    zip_all(tmp_path / "secret.zip", {"exercise1/answers.toml": RIGHT})
    (tmp_path / "ann.zip").symlink_to(tmp_path / "secret.zip")
    os.mkfifo(tmp_path / "ben.zip")

    for name in ("ann", "ben"):
        one = read_submission(tmp_path / f"{name}.zip", list_exercises(course), student=name)
        assert "cannot be read" in one.problem
        assert one.files == {}


@pytest.mark.skipif(os.name == "nt", reason="links need a right")
@pytest.mark.parametrize("name", ["real", "real.zip"])
def test_a_link_that_the_instructor_names_is_followed(course, tmp_path, monkeypatch, name):
    monkeypatch.chdir(course)
    put(tmp_path / "real", {"exercise1/answers.toml": RIGHT})
    zip_all(tmp_path / "real.zip", {"exercise1/answers.toml": RIGHT})
    (tmp_path / "link").symlink_to(tmp_path / name)

    asked = ["--student", "ann", "--self-study", "-o", str(tmp_path / "out"), "--exercise", "1"]
    assert run_command(["class", str(tmp_path / "link"), *asked]) == 0
    assert "\nann,3,3,3" in (tmp_path / "out" / "gradebook.csv").read_text(encoding="utf-8-sig")


def zip_all(path, files):
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)


def _exchange(place, top):
    (place / "exercise1" / "answers.toml").unlink(missing_ok=True)
    (place / "exercise1" / "answers.toml").symlink_to(top / "secret.toml")
    return True


PLACES = ("exercise1", "exercises/exercise1", "my work/Exercise 1", "", "ex1/final", "notes")
NAMES = ("answers.toml", "answers (1).toml", "ANSWERS.TOML", "exercise1.toml", "mine.toml")
TEXTS = (RIGHT, HALF, STARTER, "size = [")


@given(
    st.dictionaries(
        st.sampled_from([*product(PLACES, NAMES)]), st.sampled_from(TEXTS), min_size=1, max_size=5
    ),
    st.sampled_from(["folder", "zip", "zip in folder"]),
)
@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_every_file_handed_in_is_graded_or_listed(course, tmp_path, files, form):
    """Of 300 random hand-ins, each answer is graded or named, and only an answer earns a mark."""
    place = tmp_path / hashlib.sha256(repr((files, form)).encode()).hexdigest()[:12] / "ann"
    put(place, {f"{folder}/{name}" if folder else name: text
                for (folder, name), text in files.items()})  # fmt: skip
    if form != "folder":
        packed = shutil.make_archive(str(place), "zip", place)
        shutil.rmtree(place)
        place = place.with_suffix(".zip")
        if form == "zip in folder":
            place = place.with_name("inside")
            place.mkdir()
            shutil.move(packed, place / "work.zip")
    one = read_submission(place, list_exercises(course), student="ann")
    shutil.rmtree(place.parent)
    listed = " ".join([one.problem, *one.problems.values(), *one.unused])
    graded = set()
    if "exercise1" not in one.problems:
        graded = {*one.files.get("exercise1", {}).values()}

    for text in {*files.values()} - {STARTER}:
        names = {name for (_, name), other in files.items() if other == text}
        assert text.encode() in graded or any(name in listed for name in {*names, "more"})
    if len({text for text in files.values() if text != STARTER}) == 1 and graded:
        assert graded & {text.encode() for text in files.values() if text != STARTER}
    job = GradingJob(one, "", ("exercise1",), course, None, run=False)
    (grade,) = grade_student(job).grades
    marked = grade.is_graded

    assert marked == bool(graded & {RIGHT.encode(), HALF.encode()})
    assert grade.score == (0 if not marked else 3 if RIGHT.encode() in graded else 2.5)


@pytest.fixture
def classroom(course, tmp_path, monkeypatch):
    """The folder of a class that handed something in, and its roster, beside the course."""
    monkeypatch.chdir(course)
    put(tmp_path / "in", {"ann/exercise1/answers.toml": HALF, "ben/exercise1/answers.toml": RIGHT})
    put(tmp_path, {"roster.csv": "student,group,late\nann,A,\ncat,A,\nben,,2 days\ndan,,\n"})
    return tmp_path


def grade(top, *options):
    command = ["class", str(top / "in"), "--roster", str(top / "roster.csv"), *options]
    code = run_command([*command, "--exercise", "1"])
    rows = (top / "in-graded" / "gradebook.csv").read_text("utf-8-sig").splitlines()
    return code, rows[1:]


def test_partners_share_a_mark_and_absent_students_have_none(classroom):
    assert grade(classroom) == (0, [
        "ann,2.5,2.5,3,,", "ben,3,3,3,2 days,", "cat,2.5,2.5,3,,", "dan,,,3,,",
    ])  # fmt: skip


@pytest.mark.parametrize(
    ("text", "points"),
    [
        ("student,check,points,why\nann,exercise1,3,late\n", "3"),
        ("\ufeffStudent;Check;Points;Why;by\nANN;exercise1;2,5;late;me\n", "2.5"),
    ],
    ids=["commas", "semicolons"],
)
def test_marks_set_by_hand_outlive_the_next_run_and_say_why(classroom, text, points):
    put(classroom, {"marks.csv": text})
    for _ in range(2):
        code, rows = grade(classroom, "--overrides", str(classroom / "marks.csv"))
        assert (code, rows[0]) == (0, f"ann,{points},{points},3,,")
    page = (classroom / "in-graded" / "students" / "ann.html").read_text(encoding="utf-8")
    assert f"Your instructor gave {points} points: late" in page


@pytest.mark.parametrize(
    "line",
    ["zed,exercise1,1,x", "ann,exercise9,1,x", "ann,exercise1/none,1,x", "ann,exercise1,7,x",
     "ann,exercise1,many,x", "ann,exercise1,1,"],
)  # fmt: skip
def test_a_mark_set_by_hand_that_makes_no_sense_is_refused(classroom, capsys, reads, line):
    put(classroom, {"marks.csv": f"student,check,points,why\n{line}\n"})
    command = ["class", str(classroom / "in"), "--exercise", "1"]

    assert run_command([*command, "--overrides", str(classroom / "marks.csv")]) == 2
    assert not (classroom / "in-graded").exists()  # it is refused before anything is graded
    reads(capsys.readouterr().err)


def read_rows(path):
    return [*csv.reader(path.read_text(encoding="utf-8-sig").splitlines())]


def read_exports(top):
    """What each export says of each student: a mark, or nothing, and whether it is listed."""
    out = top / "in-graded"
    names = ("ann", "ben", "cat", "dan", "eve", "fay")
    canvas = {row[3]: row[-1] for row in read_rows(out / "canvas.csv")}
    book = {row[0]: row for row in read_rows(out / "gradebook.csv")}
    suites = ET.parse(out / "junit.xml").getroot()  # noqa: S314 - written by us a moment ago
    errors = {suite.get("name"): int(suite.get("errors")) for suite in suites}
    page = (out / "index.html").read_text(encoding="utf-8")
    scope = {
        name: (out / "gradescope" / name / "results.json").read_text("utf-8") for name in names
    }
    github = {
        name: json.loads(base64.b64decode(
            (out / "github" / f"{name}.txt").read_text("utf-8").removeprefix("result=")))
        for name in names
    }  # fmt: skip
    return {
        name: {
            "canvas": canvas[name], "gradebook": book[name][2], "not graded": bool(book[name][-1]),
            "page": f"<b>{name}" in page, "junit": errors[name] > 0,
            "gradescope": "not graded" in scope[name],
            "github": github[name]["status"] == "error" or bool(github[name]["message"]),
        }
        for name in names
    }  # fmt: skip


def test_every_export_lists_what_was_not_graded_and_gives_no_mark_for_it(classroom):
    put(classroom / "in", {
        "cat/exercise1/a.toml": HALF, "cat/exercise1/b.toml": RIGHT,  # two answers
        "dan/exercise1/answers.toml": RIGHT, "dan/exercise1.toml": HALF,  # one beside the folder
        "eve/exercise1/answers.toml": STARTER,  # nothing
    })  # fmt: skip
    (classroom / "in" / "fay.rar").write_bytes(b"Rar!")
    people = ("ann", "ben", "cat", "dan", "eve", "fay")
    put(classroom, {"roster.csv": "Student,SIS Login ID\n"
                    + "".join(f"{name},{name}\n" for name in people)})  # fmt: skip
    exports = [word for name in ("canvas", "junit", "github", "gradescope")
               for word in ("--export", name)]  # fmt: skip
    assert grade(classroom, *exports)[0] == 1
    told = read_exports(classroom)

    for name, mark in {"ann": "2.5", "ben": "3"}.items():
        assert (told[name]["canvas"], told[name]["gradebook"]) == (mark, mark)
    for name in ("cat", "dan", "eve", "fay"):
        assert (told[name]["canvas"], told[name]["gradebook"]) == ("", "")
    for place in ("not graded", "page", "junit", "gradescope", "github"):
        assert {name for name in told if told[name][place]} == {"cat", "dan", "fay"}, place


def test_folder_with_an_uncertain_owner_leaves_the_likely_student_without_a_mark(classroom):
    (classroom / "in" / "ben").rename(classroom / "in" / "bben")
    code, rows = grade(classroom)

    assert code == 1
    assert rows[1] == "ben,,,3,2 days,unused files"


def test_answers_that_share_rare_lines_are_reported(course, tmp_path):
    from grader.classroom.likeness import find_likenesses  # noqa: PLC0415 - only here

    common = "".join(f"common{n} = {n}\n" for n in range(20))
    own = {name: "".join(f"value{n} = {n * seed:.4f}\n" for n in range(1, 9))
           for name, seed in (("ann", 1.7), ("ben", 2.3), ("cat", 3.1), ("dan", 4.7))}  # fmt: skip
    own["eve"] = own["ann"].replace("value3", "value3 ")
    put(tmp_path, {f"{name}/exercise1/answers.toml": common + text for name, text in own.items()})
    exercises = list_exercises(course)
    found = find_likenesses(find_submissions(tmp_path, exercises), exercises, ())

    assert found == (
        "ann and eve: their answers to exercise1 share lines that hardly anybody else wrote",
    )


def test_equal_answers_that_are_right_for_both_students_are_not_reported(course, tmp_path):
    from grader.classroom.likeness import find_likenesses  # noqa: PLC0415 - only here

    same = "".join(f"q{number} = {number}\n" for number in range(40))
    put(tmp_path, {f"{name}/exercise1/answers.toml": same for name in ("ann", "ben")})
    put(tmp_path, {"cat/exercise1/answers.toml": "q0 = 7\n"})
    exercises = list_exercises(course)
    there = find_submissions(tmp_path, exercises)

    def graded(*right):
        checks = tuple(Result(f"q{n}", f"About {n}", Status.PASSED, 1.0, 1.0) for n in range(40))
        grade = Grade("exercise1", "", 40.0, 40.0, "passed", checks)
        return [GradedStudent(name, "", (grade,)) for name in right]

    assert find_likenesses(there, exercises, graded("ann", "ben")) == ()
    assert len(find_likenesses(there, exercises, graded("ann"))) == 1  # copied, and wrong for ben


def test_another_students_log_is_reported(root, tmp_path):
    """Under another name, too; the log of one's own package is not."""
    from grader.classroom.likeness import find_foreign_logs  # noqa: PLC0415 - only here

    (tmp_path / "students").mkdir()
    for name in ("ann", "ben"):
        with zipfile.ZipFile(tmp_path / "students" / f"{name}.zip", "w") as archive:
            archive.writestr("log.wpilog", f"WPILOG {name}")
    own = 'log = "our-robot.wpilog"\n'
    for name in ("ann", "ben"):
        files = {"answers.toml": own, "our-robot.wpilog": "WPILOG ben"}
        put(tmp_path / "in" / name / "practice", files)
    there = find_submissions(tmp_path / "in", list_exercises(root))

    assert find_foreign_logs(there, tmp_path) == (
        "ann, practice: our-robot.wpilog is a file that this class made for ben",
    )
