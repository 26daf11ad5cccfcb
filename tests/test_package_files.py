"""Students get the authored course: nobody's answers, no notes, and never the class's secret."""

import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from grader.cli import run_command
from grader.course.package_files import find_imported_modules, select_package_files, strip_notebook
from grader.exercise.exercise import find_exercise
from sim.core.errors import BadRequest

pytestmark = pytest.mark.slow

SECRET = b"0123456789abcdef-east"
NOT_COPIED = shutil.ignore_patterns("data", "__pycache__", ".*")


def copy_course(root, place):
    """A course folder without the packages grader and sim."""
    for name in ("exercises", "lessons"):
        shutil.copytree(root / name, place / name, ignore=NOT_COPIED)
    for name in ("LICENSE", "README.md", "pyproject.toml"):
        shutil.copy(root / name, place / name)
    return place


@pytest.fixture
def course(root, tmp_path, monkeypatch):
    place = tmp_path / "my course"
    place.mkdir()
    monkeypatch.chdir(copy_course(root, place))
    return place


def test_the_list_of_starters_is_up_to_date(root):
    done = subprocess.run(
        [sys.executable, root / ".ci" / "list_starters.py", "--check"],
        capture_output=True,
        text=True,
        check=False,
    )

    assert (done.returncode, done.stdout + done.stderr) == (0, "")


def test_every_authored_file_is_packed_and_nothing_is_left_out(root, course):
    packed = select_package_files(course)

    assert packed.left_out == ()
    for top in ("exercises", "lessons", "grader", "sim"):
        there = {
            path.relative_to(root).as_posix()
            for path in (root / top).rglob("*")
            if path.is_file() and not {"data", "__pycache__"} & {*path.relative_to(root).parts}
        }
        assert {name for name in packed.files if name.startswith(f"{top}/")} == {
            name for name in there if "/." not in name
        }


def test_packages_of_the_course_folder_go_before_the_installed_ones(course):
    installed = select_package_files(course).files["grader/__init__.py"]
    (course / "grader").mkdir()
    (course / "grader" / "__init__.py").write_bytes(b"# mine\n")
    (course / "grader" / "notes.txt").write_bytes(b"ann: 3\n")
    packed = select_package_files(course)

    assert installed != packed.files["grader/__init__.py"] == b"# mine\n"
    assert "sim/core/log.py" in packed.files
    assert packed.left_out == ("grader/notes.txt",)


def test_stray_files_are_not_packed_and_are_reported(course, capsys):
    stray = (
        "exercises/exercise4/alt.java",
        "exercises/exercise9/anns_fit.py",
        "exercises/hand-ins.zip",
        "lessons/class notes.md",
        "lessons/ann.ipynb",
    )
    private = ("exercises/exercise9/data/ann/log.csv", "lessons/.ipynb_checkpoints/00.ipynb",
               ".course/progress.toml", "notes/marks.csv", "roster.csv")  # fmt: skip
    for name in (*stray, *private):
        (course / name).parent.mkdir(parents=True, exist_ok=True)
        (course / name).write_bytes(b"private")

    assert select_package_files(course).left_out == tuple(sorted(stray))
    assert not any(text == b"private" for text in select_package_files(course).files.values())
    assert run_command(["release", "-o", "../out"]) == 0
    assert (
        f"left out, as no part of the course: {', '.join(sorted(stray))}" in capsys.readouterr().err
    )


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right of their own on Windows")
def test_a_link_is_never_followed(course, tmp_path):
    (tmp_path / "notes.md").write_bytes(b"private")
    for name in ("README.md", "notes.md"):
        path = course / "exercises" / "exercise4" / name
        path.unlink(missing_ok=True)
        path.symlink_to(tmp_path / "notes.md")

    assert {"exercises/exercise4/README.md", "exercises/exercise4/notes.md"} == {
        *select_package_files(course).left_out
    }


@pytest.mark.parametrize(
    "name",
    ["exercise9/answers.toml", "exercise9/fit.py", "exercise4/ExampleSubsystem.java",
     "exercise12/try_it.py"],
)  # fmt: skip
def test_a_solved_starter_is_refused_by_name(course, capsys, name, reads):
    path = course / "exercises" / name
    path.write_bytes(path.read_bytes() + b"\n# my answer")

    assert run_command(["release", "-o", "../out"]) == 2
    reads(capsys.readouterr().err)
    assert not (course.parent / "out").exists()


def test_windows_line_ends_do_not_change_a_starter(course):
    path = course / "exercises" / "exercise9" / "answers.toml"
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))

    assert "exercises/exercise9/answers.toml" in select_package_files(course).files


def test_a_missing_or_unlisted_starter_is_refused(course):
    (course / "exercises" / "exercise9" / "fit.py").unlink()
    with pytest.raises(BadRequest, match="exercise9/fit.py: students need it, and it"):
        select_package_files(course)
    (course / "exercises" / "starters.toml").write_text("[exercise9]\n", encoding="utf-8")
    with pytest.raises(BadRequest, match=r"has a starter answers.toml that is not listed"):
        select_package_files(course)
    (course / "exercises" / "starters.toml").write_bytes(b"\xff")
    with pytest.raises(BadRequest, match="the list of starters cannot be read"):
        select_package_files(course)


def test_a_notebook_that_was_run_is_packed_as_it_was_derived(course):
    path = course / "lessons" / "01_motor_model.ipynb"
    derived = path.read_bytes()
    notebook = json.loads(derived)
    for cell in notebook["cells"]:
        cell["metadata"] |= {"trusted": True}
        if cell["cell_type"] == "code":
            cell["execution_count"] = 7
            cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": ["private"]}]
    blank = {"cell_type": "code", "id": "new", "metadata": {}, "source": [], "outputs": []}
    notebook["cells"].append(blank)  # Jupyter adds one after the last cell was run
    path.write_text(json.dumps(notebook), encoding="utf-8")

    assert select_package_files(course).files["lessons/01_motor_model.ipynb"] == derived


def test_a_notebook_with_edited_cells_is_refused(course, capsys, reads):
    path = course / "lessons" / "01_motor_model.ipynb"
    notebook = json.loads(path.read_bytes())
    notebook["cells"][0]["source"] = ["my notes about ann"]
    path.write_text(json.dumps(notebook), encoding="utf-8")

    assert run_command(["release", "-o", "../out"]) == 2
    reads(capsys.readouterr().err)
    with pytest.raises(BadRequest, match="edited"):
        strip_notebook(b"[]", name="x.ipynb", course=Path())


@pytest.mark.parametrize("given", ["class.secret", "exercises/../k.py", "{course}/class.secret"])
def test_a_secret_in_the_course_folder_is_refused(course, capsys, given):
    (course.parent / "r.csv").write_text("student\nann\n", encoding="utf-8")
    secret = given.format(course=course)
    command = ["release", "-o", "../out", "--roster", "../r.csv", "--secret", secret]

    assert run_command(command) == 2
    said = capsys.readouterr().err
    assert "the secret is in the course folder, and everybody would get it" in said
    assert "Keep it outside: --secret ../".replace("/", os.sep) in said


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right of their own on Windows")
def test_a_secret_that_a_link_leads_to_is_refused_in_both_directions(course, capsys):
    (course.parent / "r.csv").write_text("student\nann\n", encoding="utf-8")
    (course / "inside").write_bytes(SECRET)
    (course.parent / "link").symlink_to(course / "inside")
    (course.parent / "outside").write_bytes(SECRET)
    (course / "link").symlink_to(course.parent / "outside")
    (course.parent / "elsewhere").symlink_to(course)
    command = ["release", "-o", "../out", "--roster", "../r.csv", "--secret"]

    for secret in ("../link", "link", "../elsewhere/inside"):
        assert run_command([*command, secret]) == 2
        assert "the secret is in the course folder" in capsys.readouterr().err


def test_a_file_that_holds_the_secret_is_refused(course, capsys, reads):
    (course.parent / "r.csv").write_text("student\nann\n", encoding="utf-8")
    (course.parent / "class.secret").write_bytes(SECRET + b"\n")
    readme = course / "README.md"
    readme.write_bytes(readme.read_bytes() + SECRET)
    command = ["release", "-o", "../out", "--roster", "../r.csv", "--secret", "../class.secret"]

    assert run_command(command) == 2
    reads(capsys.readouterr().err)


def test_modules_imported_by_imported_modules_are_found(tmp_path):
    for name, text in {
        "checks.py": "from .a import x\nimport os\nfrom grader.checks import check\n",
        "a.py": "def f():\n    from . import b\n",
        "b.py": "from .a import f\nfrom .gone import g\n",
        "c.py": "",
    }.items():
        (tmp_path / name).write_text(text, encoding="utf-8")

    assert {path.name for path in find_imported_modules(tmp_path / "checks.py")} == {
        "checks.py", "a.py", "b.py",
    }  # fmt: skip


def test_exercise_in_the_working_directory_is_loaded_before_the_installed_one(course):
    """Also where only exercises are laid out, as for drawing a class's numbers."""
    path = course / "exercises" / "exercise4" / "checks.py"
    path.write_text(path.read_text(encoding="utf-8") + "\nMARK = 1\n", encoding="utf-8")
    shutil.rmtree(course / "lessons")
    practice = find_exercise("practice", course).module

    assert practice.FOURTH.MARK == 1


def installed(root, place):
    """What pip makes of the wheel: the packages, and no course around them."""
    hatch = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]
    wheel = hatch["build"]["targets"]["wheel"]
    for name in set(wheel["only-include"]) - set(wheel["sources"]):
        shutil.copytree(root / name, place / name, ignore=NOT_COPIED)
    return place


def grade_installed(place, folder, *words):
    """The command of an installation that is not editable, typed in a folder."""
    code = "import sys; from grader.cli import main; main()"
    return subprocess.run(
        [sys.executable, "-P", "-c", code, *words],  # -P: the folder's own packages do not count
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(place)},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )


def test_other_code_in_the_course_folder_is_reported_in_one_line(root, tmp_path):
    place = installed(root, tmp_path / "site-packages")
    course = tmp_path / "course"
    course.mkdir()
    copy_course(root, course)
    installed(root, course)
    same = grade_installed(place, course, "4")
    log = course / "sim" / "core" / "log.py"
    log.write_text(log.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    other = grade_installed(place, course, "4")

    assert (same.returncode, same.stderr) == (1, "")
    assert other.returncode == 1
    assert other.stderr.strip() == (
        f"grade: the grader and sim that run are those in {place}, and {course} holds other ones. "
        "To run those of the folder: python -m grader"
    )
