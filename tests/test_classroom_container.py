"""``grade class --in docker``: the command that is composed, by a stand-in that runs it here."""

import json
import os
import sys
from itertools import pairwise
from pathlib import Path

import pytest
from small_course import RIGHT, lay_out

from grader.classroom.container import BUILD, DOCKERFILE, find_engines
from grader.cli import run_command

posix = pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a script")
pytestmark = posix

STAND_IN = """#!/bin/sh
'''exec' "{python}" "$0" "$@"
' '''  # for the shell, since a path with a space cannot stand behind #!
import json, os, subprocess, sys
from pathlib import Path
words = sys.argv[1:]
Path({log!r}).write_text(json.dumps(words), encoding="utf-8")
if {code}:
    sys.exit({code})
if words[0] == "info":
    sys.exit(0)
places = {{}}
for mount in words:
    if mount.startswith("type=bind,"):
        parts = dict(part.partition("=")[::2] for part in mount.split(","))
        places[parts["target"]] = parts["source"]
inner = words[words.index("sysid-course") + 2 :]
inner = [places.get(word, word) for word in inner]
sys.exit(subprocess.call([sys.executable, *inner], cwd=places["/course"]))
"""


@pytest.fixture
def engine(tmp_path, monkeypatch):
    """Puts a stand-in on PATH; returns what it was asked."""
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).resolve().parents[1]))

    def place(name="docker", *, code=0):
        log, program = tmp_path / "asked.json", tmp_path / "bin" / name
        program.parent.mkdir(exist_ok=True)
        text = STAND_IN.format(python=sys.executable, log=str(log), code=code)
        program.write_text(text, "utf-8")
        program.chmod(0o755)
        monkeypatch.setenv("PATH", str(program.parent))
        return lambda: json.loads(log.read_text("utf-8"))

    return place


@pytest.fixture
def handed_in(tmp_path, monkeypatch):
    """A small course, and what ann handed in, in folders with a space in their names."""
    lay_out(tmp_path / "the course")
    monkeypatch.chdir(tmp_path / "the course")
    answer = tmp_path / "hand ins" / "ann" / "exercise1" / "answers.toml"
    answer.parent.mkdir(parents=True)
    answer.write_text(RIGHT, "utf-8")
    (tmp_path / "roster.csv").write_text("student\nann\nben\n", "utf-8")
    return answer.parents[2]


def mounts(asked):
    return [word for before, word in pairwise(asked) if before == "--mount"]


def test_class_is_graded_inside_the_container_and_results_are_written_outside(
    tmp_path, engine, handed_in
):
    asked = engine()
    options = ["--roster", str(tmp_path / "roster.csv"), "--name", "Our class", "--processes", "1"]

    code = run_command(["class", str(handed_in), "--in", "docker", "--export", "junit", *options])

    graded = handed_in.with_name("hand ins-graded")
    assert code == 0
    assert "Our class" in (graded / "index.html").read_text("utf-8")
    assert (graded / "gradebook.csv").is_file()
    words = asked()
    assert words[words.index("--network") + 1] == "none"
    assert {"--rm", "--read-only", "no-new-privileges"} <= {*words}
    assert mounts(words) == [
        f"type=bind,source={tmp_path / 'the course'},target=/course,readonly",
        f"type=bind,source={graded},target=/out",
        f"type=bind,source={handed_in},target=/given/folder/hand ins,readonly",
        f"type=bind,source={tmp_path / 'roster.csv'},target=/given/roster/roster.csv,readonly",
    ]
    assert words[words.index("sysid-course") :] == [
        *("sysid-course", "python", "-m", "grader", "class", "/given/folder/hand ins"),
        *("--roster", "/given/roster/roster.csv", "--export", "junit", "--name", "Our class"),
        *("--processes", "1", "--output", "/out"),
    ]


def test_secret_never_appears_on_a_command_line(engine, handed_in, monkeypatch):
    asked = engine("podman")
    monkeypatch.setenv("SYSID_SECRET", "a secret of the whole class, thirty two bytes")
    run_command(["class", str(handed_in), "--in", "podman", "--no-run", "--processes", "1"])

    words = asked()
    assert words[words.index("SYSID_SECRET") - 1] == "--env"
    assert "--no-run" in words
    assert not [word for word in words if "of the whole class" in word]


@pytest.mark.parametrize("code", [125, 127])
def test_container_engine_without_an_image_says_how_to_make_it(engine, handed_in, capsys, code):
    engine(code=code)

    assert run_command(["class", str(handed_in), "--in", "docker"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "docker could not start the image 'sysid-course'" in said
    assert BUILD.format(engine="docker") in said


def test_a_missing_container_engine_is_reported(handed_in, capsys, monkeypatch):
    monkeypatch.setenv("PATH", os.devnull)

    assert run_command(["class", str(handed_in), "--in", "podman"]) == 2
    assert "podman is not installed" in capsys.readouterr().err
    assert find_engines() == []


def test_a_cluster_and_a_container_exclude_each_other(engine, handed_in, capsys):
    engine()

    assert run_command(["class", str(handed_in), "--in", "docker", "--cluster", "tcp://a:1"]) == 2
    assert "cannot be used together" in capsys.readouterr().err


@pytest.mark.parametrize(("code", "found"), [(0, ["docker"]), (1, [])])
def test_a_container_engine_counts_if_it_answers(engine, code, found):
    engine(code=code)

    assert find_engines() == found


@pytest.mark.parametrize(("code", "says"), [(0, "docker found"), (1, "neither docker nor")])
def test_the_doctor_says_whether_an_engine_answers(engine, handed_in, capsys, code, says):  # noqa: ARG001 - it stands in the course
    engine(code=code)
    run_command(["doctor"])

    assert says in " ".join(capsys.readouterr().out.split())


def test_container_image_holds_the_packages_but_not_the_course():
    assert "COPY" not in DOCKERFILE
    assert 'pip install --no-cache-dir "/build[course,robot]"' in DOCKERFILE
    assert "pip uninstall -y sysid-course" in DOCKERFILE
