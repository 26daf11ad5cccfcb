"""What a release installs: `sysid` alone in a small environment, and the course outside a clone."""

import json
import os
import re
import shutil
import subprocess
import venv
import zipfile
from pathlib import Path
from urllib.request import urlopen

import pytest
from wheel import build_wheel

from grader.exercise.course_check import solve
from grader.exercise.exercise import find_exercise

pytestmark = pytest.mark.slow

LARGEST = 250.0  # [MB] of an environment with the bare install, pip and setuptools included
ANSWERED = "exercise1"


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    """The wheel."""
    return build_wheel(tmp_path_factory.mktemp("wheel"))


def make_environment(place, what, *options):
    """An environment into which pip installs something; skipped where pip cannot fetch it."""
    venv.create(place, with_pip=True)
    scripts = place / ("Scripts" if os.name == "nt" else "bin")
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    kept |= {"PATH": f"{scripts}{os.pathsep}{kept['PATH']}", "VIRTUAL_ENV": str(place)}
    kept |= {"COLUMNS": "200", "PYTHONUTF8": "1"}
    done = run(["python", "-m", "pip", "install", "--quiet", *options, what], kept, cwd=place)
    if done.returncode:
        pytest.skip(f"pip cannot install here: {done.stderr.strip()[-200:]}")
    return kept


def run(words, environment, *, cwd):
    """Run a command of an environment."""
    program = shutil.which(words[0], path=environment["PATH"])
    return subprocess.run(
        [program, *words[1:]], cwd=cwd, env=environment, capture_output=True, encoding="utf-8",
        check=False, timeout=900,
    )  # fmt: skip


@pytest.fixture(scope="module")
def bare(archive, tmp_path_factory):
    """An environment with `sysid` alone."""
    return make_environment(tmp_path_factory.mktemp("bare") / "env", str(archive))


@pytest.fixture(scope="module")
def whole(archive, tmp_path_factory):
    """An environment with the course; Python compiles what is imported, not everything."""
    place = tmp_path_factory.mktemp("whole") / "env"
    return make_environment(place, f"{archive}[course]", "--no-compile")


def test_the_wheel_holds_the_course_and_no_answers(archive):
    with zipfile.ZipFile(archive) as opened:
        names = set(opened.namelist())

    assert {
        "sysid_course/exercises/exercise4/README.md",
        "sysid_course/exercises/starters.toml",
        "sysid_course/lessons/00_guess_or_measure.ipynb",
        "sysid_course/pyproject.toml",
        "sim/cli/open/page/index.html",
    } <= names
    assert not {name for name in names if "/data/" in name or name.startswith("solutions")}


def test_the_bare_install_is_small_and_brings_neither_jupyterlab_nor_numba(bare):
    listed = run(["python", "-m", "pip", "list", "--format", "json"], bare, cwd=None)
    names = {one["name"].lower() for one in json.loads(listed.stdout)}
    everything = Path(bare["VIRTUAL_ENV"]).rglob("*")
    size = sum(path.lstat().st_size for path in everything if path.is_file())

    assert {"sysid-course", "numpy"} <= names
    assert not {"jupyterlab", "numba", "llvmlite", "scipy", "tree-sitter"} & names
    assert size / 1e6 <= LARGEST


def test_the_bare_install_simulates_fits_and_inspects(bare, tmp_path):
    for words in (
        ["sysid", "--version"],
        ["sysid", "simulate", "drivetrain", "--seed", "1", "-o", "drive.wpilog"],
        ["sysid", "inspect", "drive.wpilog"],
        ["sysid", "fit", "drive.wpilog", "--html", "drive.html", "--plot", "drive.png"],
    ):
        done = run(words, bare, cwd=tmp_path)
        assert (done.returncode, done.stderr) == (0, ""), words

    fitted = run(["sysid", "fit", "drive.wpilog", "--json"], bare, cwd=tmp_path)
    assert json.loads(fitted.stdout)["gains"]["kV"] == pytest.approx(2.5238, rel=1e-3)


def test_the_bare_install_opens_the_page(bare, tmp_path):
    run(["sysid", "simulate", "drivetrain", "--seed", "1", "-o", "drive.csv"], bare, cwd=tmp_path)
    program = shutil.which("sysid", path=bare["PATH"])
    with subprocess.Popen(
        [program, "open", "drive.csv", "--no-browser"], cwd=tmp_path, env=bare,
        stdout=subprocess.PIPE, encoding="utf-8",
    ) as page:  # fmt: skip
        try:
            address = page.stdout.readline().split()[-1]
            with urlopen(address, timeout=60) as answer:  # noqa: S310 - our own server's
                assert b"Drop a log." in answer.read()
            with urlopen(f"{address}logs/1/fit", timeout=120) as answer:  # noqa: S310 - the same
                gains = {one["name"]: one["value"] for one in json.load(answer)["gains"]}
        finally:
            page.terminate()

    assert gains["kV"] == pytest.approx(2.52, rel=0.01)


def test_the_bare_install_says_what_grading_needs(bare, tmp_path):
    done = run(["grade", "start", "course"], bare, cwd=tmp_path)

    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert 'python -m pip install "ipywidgets' in done.stderr
    assert run(["grade", "--version"], bare, cwd=tmp_path).stdout.startswith("grade, version ")


def test_an_exercise_is_solved_in_a_folder_that_grade_start_made(whole, tmp_path):
    words = ["grade", "start", "my course", "--no-lab", "--student", "ann"]
    started = run(words, whole, cwd=tmp_path)
    assert started.returncode == 0, started.stderr
    mine = tmp_path / "my course"
    assert "Next: open lessons/00_guess_or_measure.ipynb" in started.stdout
    before = run(["grade", ANSWERED], whole, cwd=mine)
    one = find_exercise(ANSWERED, mine)
    solution = Path(__file__).resolve().parents[1] / "solutions" / one.name
    for name, text in solve(one, one.folder / "data" / "ann", solution=solution).items():
        (one.folder / name).write_text(text, encoding="utf-8")
    after = run(["grade", ANSWERED, "--json"], whole, cwd=mine)

    assert before.returncode in {1, 2}
    assert json.loads(after.stdout)["status"] == "passed", after.stderr


def test_a_folder_that_grade_start_made_does_not_replace_the_installed_course(whole, tmp_path):
    run(["grade", "start", "mine", "--no-lab", "--student", "ann"], whole, cwd=tmp_path)
    mine = tmp_path / "mine"
    advice = run(["grade", "doctor"], whole, cwd=mine).stdout + (mine / "README.md").read_text(
        "utf-8"
    )

    assert "python -m pip install" in advice
    assert not re.search(r"""pip install\s+(-e\s+)?["']?\.""", advice)
    for options in ([], ["-e"]):
        done = run(["python", "-m", "pip", "install", "--no-deps", *options, "."], whole, cwd=mine)
        assert done.returncode, done.stdout
    assert run(["grade", "--version"], whole, cwd=tmp_path).returncode == 0


def test_a_folder_is_unpacked_once_and_nothing_else_is_written_over(whole, tmp_path):
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "diary.txt").write_text("mine", "utf-8")
    refused = run(["grade", "start", "taken", "--no-lab"], whole, cwd=tmp_path)

    assert refused.returncode == 2
    assert "this place already holds something else" in refused.stderr
    assert [path.name for path in (tmp_path / "taken").iterdir()] == ["diary.txt"]
