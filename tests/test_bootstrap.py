"""`python -m grader` in a fresh clone: it installs what is missing, once, and says so."""

import ast
import os
import subprocess
import sys
import sysconfig
import tomllib
from pathlib import Path
from types import SimpleNamespace

import pytest
from places import ROOT

from grader import __main__ as bootstrap

# All that runs before the installation.
STANDALONE = ("__init__.py", "__main__.py", "setup/__init__.py", "setup/exec_process.py")
OLD = (3, 8)


@pytest.fixture
def world(tmp_path, monkeypatch):
    """A fresh clone, in which every started process is noted and none is run."""
    (tmp_path / "pyproject.toml").write_bytes((ROOT / "pyproject.toml").read_bytes())
    world = SimpleNamespace(
        root=tmp_path, quiet=[], foreground=[], missing=["click", "numpy"], says="", code=0
    )

    def run(command, **_more):
        world.quiet.append(command)
        failed = bool(world.says) and "pip" in command
        return SimpleNamespace(returncode=int(failed), stdout=world.says, stderr="")

    class Process:
        def __init__(self, command, cwd=None, env=None):
            world.foreground.append((command, cwd, env or {}))

        def wait(self):
            return world.code

    monkeypatch.setattr(bootstrap, "ROOT", tmp_path)
    monkeypatch.setattr(bootstrap, "find_missing_packages", lambda _command: world.missing)
    monkeypatch.setattr(bootstrap.subprocess, "run", run)
    monkeypatch.setattr(bootstrap.subprocess, "Popen", Process)
    monkeypatch.setattr(bootstrap, "is_in_environment", lambda: False)
    monkeypatch.delenv(bootstrap.HOPPED, raising=False)
    monkeypatch.delenv(bootstrap.INSTALLED, raising=False)
    return world


def inside(monkeypatch):
    monkeypatch.setattr(bootstrap, "is_in_environment", lambda: True)


@pytest.mark.parametrize("file", STANDALONE)
def test_an_old_python_can_read_this_file(file):
    source = (ROOT / "grader" / file).read_text("utf-8")

    ast.parse(source, feature_version=OLD)


@pytest.mark.parametrize("file", STANDALONE)
def test_bootstrap_needs_only_the_standard_library(file):
    tree = ast.parse((ROOT / "grader" / file).read_text("utf-8"))
    top = [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
    names = {
        name.split(".")[0]
        for node in top
        for name in ([node.module] if isinstance(node, ast.ImportFrom) else [node.names[0].name])
    }

    assert names <= {*sys.stdlib_module_names, "grader"}


def test_an_old_python_gets_the_version_to_install(world, monkeypatch, capsys):
    monkeypatch.setattr(sys, "version_info", (3, 8, 18))

    assert bootstrap.main(["start"]) == 2
    said = capsys.readouterr().err
    assert "needs 3.11 or newer" in said
    assert said.count("\n") == 1
    assert world.quiet == []


def test_with_all_packages_the_module_runs_grade(world, monkeypatch):
    world.missing = []
    given = []
    monkeypatch.setattr("grader.cli.run_command", lambda arguments: given.append(arguments) or 1)

    assert bootstrap.main(["exercise4", "--json"]) == 1
    assert given == [["exercise4", "--json"]]
    assert world.quiet == world.foreground == []


def test_all_tests_run_on_all_cores(world):
    world.missing, world.code = [], 0

    assert bootstrap.main(["test"]) == 0
    (command, *_), *_ = world.foreground
    everywhere = ["pytest", "-n", "logical", "--dist", "loadscope", "--no-loadscope-reorder"]
    assert command[2:] == [*everywhere, "-m", "not slow"]
    assert bootstrap.main(["test", "--all"]) == 0
    assert world.foreground[-1][0][2:] == everywhere


def test_fresh_clone_gets_an_environment_and_continues_in_it(world, capsys):
    world.code = 1

    assert bootstrap.main(["start", "--no-lab"]) == 1
    assert world.quiet == [[sys.executable, "-m", "venv", "--clear", str(world.root / ".venv")]]
    (command, _, environment), *_ = world.foreground
    assert Path(command[0]).is_relative_to(world.root / ".venv")
    assert command[1:] == ["-m", "grader", "start", "--no-lab"]
    assert environment[bootstrap.HOPPED]
    assert "Making a place" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "what"),
    [(["start"], ".[course]"), (["exercise4"], ".[course]"), (["test", "-q"], ".[test]")],
)
def test_inside_an_environment_the_module_installs_into_that(
    world, monkeypatch, capsys, arguments, what
):
    inside(monkeypatch)

    assert bootstrap.main(arguments) == 0
    (pip,) = world.quiet
    assert pip[:4] == [sys.executable, "-m", "pip", "install"]
    assert pip[-2:] == ["-e", what]
    (command, _, environment), *_ = world.foreground
    assert command == [sys.executable, "-m", "grader", *arguments]
    assert environment[bootstrap.INSTALLED]
    said = capsys.readouterr().err
    assert said.startswith("Installing what the course needs")
    assert said.endswith("\nInstalled.\n")
    assert said.count("\n") == 2


def test_failing_pip_gets_its_last_lines_and_a_next_step(world, monkeypatch, capsys, reads):
    inside(monkeypatch)
    chatter = "\n".join(f"  Downloading {number}" for number in range(50))
    world.says = f"{chatter}\nERROR: Could not find a version that satisfies click\n"

    assert bootstrap.main(["start"]) == 2
    said = capsys.readouterr().err
    reads(said)
    assert "Downloading" not in said
    assert said.splitlines()[-1].startswith("grade: pip could not install the course")
    assert world.foreground == []


def test_without_venv_the_message_names_the_package_to_install(world, monkeypatch, capsys, reads):
    monkeypatch.setattr(bootstrap, "find_spec", lambda _name: None)

    assert bootstrap.main(["start"]) == 2
    reads(capsys.readouterr().err)
    assert world.foreground == []


def test_folder_that_is_no_environment_is_left_alone(world, capsys):
    (world.root / ".venv").mkdir()
    (world.root / ".venv" / "diary.txt").write_text("mine", "utf-8")

    assert bootstrap.main(["start"]) == 2
    assert "Move it away." in capsys.readouterr().err
    assert (world.root / ".venv" / "diary.txt").is_file()


@pytest.mark.parametrize("command", [["start"], ["test"], ["exercise4"], []])
def test_missing_packages_are_those_that_the_project_requires(monkeypatch, command):
    def nothing(name):
        raise bootstrap.PackageNotFoundError(name)

    monkeypatch.setattr(bootstrap, "distribution", nothing)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    names = bootstrap.find_missing_packages(command)

    assert len(project["dependencies"]) <= len(names)
    assert {"click", "numpy", "jupyterlab"} <= set(names)
    assert ("pytest" in names) == (command == ["test"])
    assert ("sysid-course" in names) == (command in (["start"], ["test"]))


def test_python_without_packages_reaches_the_installation(tmp_path, reads):
    """A real process without any package: it starts, sees what is missing, and makes a place."""
    clone = tmp_path / "clone"
    for name in STANDALONE:
        (clone / "grader" / name).parent.mkdir(parents=True, exist_ok=True)
        (clone / "grader" / name).write_bytes((ROOT / "grader" / name).read_bytes())
    (clone / "pyproject.toml").write_bytes((ROOT / "pyproject.toml").read_bytes())
    (clone / ".venv").mkdir()
    (clone / ".venv" / "in the way").write_text("", "utf-8")
    base = Path(sys.base_prefix) / Path(sysconfig.get_path("scripts", vars={"base": ""})).name
    python = next((p for p in base.glob("python3*") if p.name[7:].replace(".", "").isdigit()), None)
    if python is None:
        pytest.skip(f"no Python without packages found in {base}")
    # ``python -m grader test`` may have installed the course for the process that runs this test
    marks = {bootstrap.HOPPED, bootstrap.INSTALLED}
    environment = {name: value for name, value in os.environ.items() if name not in marks}
    done = subprocess.run(
        [str(python), "-s", "-S", "-m", "grader", "start"],
        cwd=clone,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )

    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    reads(done.stderr)
