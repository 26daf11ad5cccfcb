"""Gradescope's autograder and GitHub's workflow, run in plain folders as those systems run them."""

import base64
import io
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import yaml

from grader.classroom.autograder.submitter import find_submitter
from grader.classroom.release import pack_course_folder
from grader.cli import run_command
from grader.course.package_files import select_package_files
from grader.exercise.course_check import prepare_solved
from grader.exercise.exercise import find_exercise
from grader.student_data.variant import use_class_secret
from sim.core.errors import BadRequest

pytestmark = pytest.mark.slow

EMAIL = "zoë.o'neil@example.org"
SECRET = b"0123456789abcdef-east"
BASH = shutil.which("bash")
SCRIPTS = Path(sys.executable).parent  # where the command grade of this Python is
needs_bash = pytest.mark.skipif(
    sys.platform == "win32" or not BASH or not shutil.which("timeout"),
    reason="Gradescope and GitHub run Linux: this needs bash and timeout",
)


def perfect(root, name, student, folder):
    """The authored answer of an exercise: file name -> text; one language is enough."""
    solved = prepare_solved(find_exercise(name, root), student, folder)
    _, *others = solved.exercise.files
    return {file: text for file, text in solved.right.items() if file not in others}


@pytest.fixture
def export(root, tmp_path, monkeypatch):
    """Exports an autograder and lays it out as Gradescope does; the folder ``autograder``."""

    def export(*words, users=({"email": EMAIL, "id": 5, "name": "Zoë O'Neil"},)):
        monkeypatch.chdir(root)
        archive = tmp_path / "autograder.zip"
        assert run_command(["export", "gradescope", "-o", str(archive), *words]) == 0
        place = tmp_path / "auto gräder"
        with zipfile.ZipFile(archive) as opened:
            opened.extractall(place / "source")
        (place / "submission").mkdir()
        metadata = {"id": 1, "users": list(users)}
        (place / "submission_metadata.json").write_text(json.dumps(metadata), encoding="utf-8")
        return place

    return export


def grade(place, **environment):
    """Run it as Gradescope does; what it printed, and the results."""
    done = subprocess.run(
        [BASH, place / "source" / "run_autograder"],
        cwd=place,
        env={
            **os.environ,
            "AUTOGRADER_ROOT": str(place),
            "AUTOGRADER_PYTHON": sys.executable,
            **environment,
        },
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    return said, json.loads((place / "results" / "results.json").read_text(encoding="utf-8"))


@needs_bash
@pytest.mark.parametrize("name", ["exercise1", "exercise4"])
def test_perfect_answer_without_other_files_earns_every_point(root, export, tmp_path, name):
    place = export("--exercise", name)
    for file, text in perfect(root, name, EMAIL, tmp_path / "copy").items():
        (place / "submission" / file).write_text(text, encoding="utf-8")
    said, results = grade(place)
    checks = find_exercise(name, root).checks

    assert [one["max_score"] for one in results["tests"]] == [one.points for one in checks], said
    assert [one["output"] for one in results["tests"] if one["status"] != "passed"] == []
    assert sum(one["score"] for one in results["tests"]) == sum(one.points for one in checks)
    assert "Code of learners is:" in said


@needs_bash
def test_a_roster_names_the_student_and_a_secret_draws_the_numbers(root, export, tmp_path, capsys):
    (tmp_path / "roster.csv").write_text(f"student,mail\nann,a@b.c\nzoë,{EMAIL}\n", "utf-8")
    (tmp_path / "class.secret").write_bytes(SECRET + b"\n")
    place = export(
        "--exercise", "1", "--roster", str(tmp_path / "roster.csv"),
        "--secret", str(tmp_path / "class.secret"),
    )  # fmt: skip
    warned = capsys.readouterr().err
    assert (tmp_path / "autograder.zip").stat().st_mode & 0o077 == 0
    with use_class_secret(SECRET):
        answers = perfect(root, "exercise1", "zoë", tmp_path / "copy")
    for file, text in answers.items():
        (place / "submission" / file).write_text(text, encoding="utf-8")
    _, results = grade(place)

    assert "contains your class's secret. Code of students runs in Gradescope's container" in warned
    assert {one["status"] for one in results["tests"]} == {"passed"}
    metadata = place / "submission_metadata.json"
    metadata.write_text('{"users": [{"email": "who@b.c"}]}', encoding="utf-8")
    said, results = grade(place)
    assert "the roster does not contain 'who@b.c'" in said
    assert failed(results) == (
        "It is not known who handed this in; the reason stands at the end of the autograder's "
        "output."
    )


def failed(results):
    """What the instructor reads of a hand-in that could not be graded."""
    (test,) = results["tests"]
    assert results["score"] == 0
    assert "could not be graded" in results["output"]
    assert (results["visibility"], test["visibility"]) == ("visible", "hidden")
    return test["output"]


@needs_bash
def test_a_result_is_written_after_a_crash_and_a_timeout(export):
    place = export("--exercise", "4")
    _, late = grade(place, AUTOGRADER_SECONDS="0.1")
    (place / "source" / "course" / "exercises" / "exercise4" / "checks.py").write_text("1 / 0\n")
    _, crashed = grade(place)
    _, without = grade(place, AUTOGRADER_PYTHON=str(place / "no python"))

    assert "Grading took longer than it may" in failed(late)
    assert "Grading stopped with exit code" in failed(crashed)
    assert "not known who handed this in" in failed(without)


def test_the_autograder_holds_no_solutions_and_no_secret(root, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(root)
    words = ["export", "gradescope", "-o"]
    assert run_command([*words, str(tmp_path / "a.zip")]) == 0
    said = capsys.readouterr().err
    assert run_command([*words, str(tmp_path / "b.zip")]) == 0

    assert (tmp_path / "a.zip").read_bytes() == (tmp_path / "b.zip").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        names = archive.namelist()
        modes = {one.filename: one.external_attr >> 16 for one in archive.infolist()}
        wanted = archive.read("requirements.txt").decode().split()
        robot = archive.read("requirements-robot.txt").decode()
    assert {name for name in names if not name.startswith("course/")} == {
        "setup.sh", "run_autograder", "settings.sh", "requirements.txt", "requirements-robot.txt",
    }  # fmt: skip
    assert {name.removeprefix("course/") for name in names if name.startswith("course/")} == {
        *select_package_files(root).files
    }
    assert [name for name in names if "solutions" in name or "secret" in Path(name).suffix] == []
    assert modes["setup.sh"] == modes["run_autograder"] == 0o755
    assert "click>=8.1.7" in wanted
    assert not any(one.startswith(("jupyter", "ipywidgets")) for one in wanted)
    assert "wpilib==2026.*" in robot
    assert "without --secret, numbers depend only on the student's name" in said
    assert "14 exercises in one autograder: students have to hand in a zip file" in said


def test_grading_needs_none_of_the_packages_that_are_not_installed_there(root, tmp_path):
    """Neither JupyterLab nor widgets are imported by the command that grades a class."""
    code = (
        "import sys\n"
        "for name in ('jupyterlab', 'ipywidgets', 'IPython'): sys.modules[name] = None\n"
        "from grader.cli import run_command\n"
        "sys.exit(run_command(['class', sys.argv[1], '--student', 'ann', '--exercise', '4', '-o', "
        "sys.argv[2], '--export', 'gradescope']))"
    )
    place = root / "solutions" / "exercise4"
    done = subprocess.run([sys.executable, "-c", code, place, tmp_path], cwd=root, check=False)

    assert done.returncode == 0
    assert (tmp_path / "gradescope" / "ann" / "results.json").is_file()


@pytest.mark.parametrize(
    ("text", "by", "said"),
    [
        ("{", "email", "does not say who handed in"),
        ('{"users": []}', "email", "does not say who handed in"),
        ('{"users": ["ann"]}', "email", "does not say who handed in"),
        ('{"users": [{"email": null}]}', "email", "the student has no email"),
        ('{"users": [{"email": "a@b.c"}]}', "sid", "Export the autograder again"),
        ('{"users": [{"name": "a/b"}]}', "name", "path separator"),
    ],
)
def test_metadata_without_a_student_are_refused(tmp_path, text, by, said):
    path = tmp_path / "submission_metadata.json"
    path.write_text(text, encoding="utf-8")

    with pytest.raises(BadRequest, match=said):
        find_submitter(path, by=by, roster=None)


def test_submission_of_a_group_belongs_to_its_first_member(tmp_path):
    path = tmp_path / "submission_metadata.json"
    path.write_text('{"users": [{"sid": 17}, {"sid": 18}]}', encoding="utf-8")

    assert find_submitter(path, by="sid", roster=None) == "17"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["gradescope", "-o", "x.zip", "--secret", "{root}/class.secret"], "in the course folder"),
        (
            ["gradescope", "-o", "x.zip", "--secret", "{elsewhere}/gone"],
            "the file with the secret is missing",
        ),
        (["gradescope", "-o", "x.zip", "--roster", "gone.csv"], "gone.csv"),
        (["gradescope", "-o", "x.zip", "--exercise", "99"], "there is no exercise '99'"),
        (["github", "-o", "{root}/README.md/grade.yml"], "cannot be written"),
    ],
)
def test_impossible_export_is_refused_with_a_message(
    root, tmp_path, monkeypatch, capsys, *, words, said
):
    monkeypatch.chdir(root)
    filled = [word.format(root=root, elsewhere=tmp_path) for word in words]

    assert run_command(["export", *filled]) == 2
    assert said in capsys.readouterr().err
    assert not (root / "x.zip").exists()


@pytest.fixture
def workflow(root, tmp_path, monkeypatch):
    """A repository that students start from, with the workflow in it."""
    repository = tmp_path / "zoë's repository"
    archive = zipfile.ZipFile(io.BytesIO(pack_course_folder(select_package_files(root).files)))
    archive.extractall(tmp_path)
    (tmp_path / "course").rename(repository)
    monkeypatch.chdir(repository)
    path = Path(".github") / "workflows" / "grade.yml"
    assert (
        run_command(["export", "github", "-o", str(path), "--exercise", "4", "--exercise", "1"])
        == 0
    )
    return repository, yaml.safe_load(path.read_text(encoding="utf-8"))


def run_step(step, repository, folder):
    """Run a step of the workflow as GitHub does: the results that it hands on."""
    output = folder / "output"
    output.write_text("", encoding="utf-8")
    place = {"RUNNER_TEMP": str(folder), "GITHUB_OUTPUT": str(output), "STUDENT": "octo-cat"}
    place["PATH"] = f"{SCRIPTS}{os.pathsep}{os.environ['PATH']}"
    shell = [BASH, "-e", "-o", "pipefail", "-c", step["run"]]
    subprocess.run(shell, cwd=repository, env={**os.environ, **place}, check=True)
    name, _, text = output.read_text(encoding="utf-8").strip().partition("=")
    assert name == "result"
    return json.loads(base64.b64decode(text))


@needs_bash
def test_the_workflow_grades_and_hands_its_results_to_the_reporter(root, workflow, tmp_path):
    repository, parsed = workflow
    steps = parsed["jobs"]["grade"]["steps"]
    for name in ("exercise1", "exercise4"):
        for file, text in perfect(root, name, "octo-cat", tmp_path / "copy").items():
            (repository / "exercises" / name / file).write_text(text, encoding="utf-8")
    for step in steps:
        if "id" not in step:
            continue
        (tmp_path / step["id"]).unlink(missing_ok=True)
        results = run_step(step, repository, tmp_path)
        assert (results["status"], [one["name"] for one in results["tests"]]) == (
            "pass",
            [step["id"]],
        )
        assert sum(one["score"] for one in results["tests"]) == results["max_score"] > 0
    reporter = steps[-1]
    assert reporter["with"]["runners"] == "exercise1,exercise4"
    assert reporter["env"] == {
        f"{name.upper()}_RESULTS": f"${{{{ steps.{name}.outputs.result }}}}"
        for name in ("exercise1", "exercise4")
    }


def test_the_workflow_takes_nothing_from_github_into_its_shell_lines(workflow):
    _, parsed = workflow

    for step in parsed["jobs"]["grade"]["steps"]:
        assert "${{" not in step.get("run", "")
    assert parsed["permissions"] == {"contents": "read", "checks": "write"}


@needs_bash
def test_empty_submission_gets_zero_points(export):
    _, results = grade(export("--exercise", "4"))

    assert {one["score"] for one in results["tests"]} == {0.0}
    assert "nothing was handed in" in results["tests"][0]["output"]


@needs_bash
def test_the_workflow_reports_a_wrong_answer_and_does_not_stop(workflow, tmp_path):
    repository, parsed = workflow
    (step,) = [one for one in parsed["jobs"]["grade"]["steps"] if one.get("id") == "exercise4"]
    assert run_step(step, repository, tmp_path)["status"] == "fail"
