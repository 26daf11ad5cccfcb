"""What carries the project to other machines: workflows, container, constraints, first cells."""

import json
import re
import shlex
import subprocess
import sys
import tomllib

import click
import nbformat
import pytest
import yaml
from ci_scripts import load_script
from nbclient import NotebookClient
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from places import ROOT

from grader.__main__ import NEWEST
from grader.cli import grade
from sim.cli import sysid

WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
PINNED = {  # the actions we trust, each at the major version that its documentation names
    "actions/checkout": "v4",
    "actions/setup-python": "v5",
    "actions/upload-artifact": "v4",
    "actions/download-artifact": "v4",
    "actions/upload-pages-artifact": "v3",
    "actions/deploy-pages": "v4",
    "pypa/gh-action-pypi-publish": "release/v1",
}
ELSEWHERE = {"pip", "build"}  # modules that are not the project's
OURS = {"sysid": sysid, "grade": grade}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
LOCKED = [
    Requirement(line)
    for line in (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    if line and not line.startswith("#")
]


def steps(workflow):
    """Every step of a workflow."""
    return [step for job in workflow["jobs"].values() for step in job["steps"]]


def lost_parts(command):
    """What a command line names that the project does not have."""
    first, *rest = shlex.split(command)
    if first == "python" and rest[0] == "-m":
        module = rest[1]
        known = module in ELSEWHERE or (ROOT / module / "__main__.py").is_file()
        return [] if known else [module]
    if first == "python":
        return [] if (ROOT / rest[0]).is_file() else [rest[0]]
    if first == "mkdocs":
        return [] if (ROOT / rest[rest.index("-f") + 1]).is_file() else ["the site's settings"]
    if first not in OURS:
        return [first]
    group = OURS[first]
    found = group.get_command(click.Context(group), rest[0])
    if found is None:
        return [rest[0]]
    options = {name for one in found.params for name in (*one.opts, *one.secondary_opts)}
    return [word for word in rest[1:] if word.startswith("-") and word not in options]


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_uses_pinned_actions_and_commands_that_exist(path):
    workflow = yaml.safe_load(path.read_text("utf-8"))

    assert workflow[True]  # YAML reads the word `on` so
    assert workflow["permissions"] == {"contents": "read"}
    for job in workflow["jobs"].values():
        assert job["timeout-minutes"] <= 30
    for step in steps(workflow):
        if "uses" in step:
            name, _, version = step["uses"].partition("@")
            assert PINNED[name] == version
        else:
            assert lost_parts(step["run"]) == [], step["run"]


@pytest.mark.parametrize(
    ("command", "lost"),
    [
        ("python -m grader start", []),
        ("python -m gradr start", ["gradr"]),
        ("python .ci/gone.py", [".ci/gone.py"]),
        ("mkdocs build -f gone.yml", ["the site's settings"]),
        ("sysid fitt drive.wpilog", ["fitt"]),
        ("sysid fit drive.wpilog --htm x", ["--htm"]),
        ("grade start course --no-lob", ["--no-lob"]),
        ("make site", ["make"]),
    ],
)
def test_check_finds_a_command_that_does_not_exist(command, lost):
    assert lost_parts(command) == lost


def test_only_the_job_that_publishes_may_ask_for_a_token_and_it_builds_nothing():
    workflow = yaml.safe_load((ROOT / ".github/workflows/release.yml").read_text("utf-8"))
    jobs = workflow["jobs"]
    holders = [name for name, job in jobs.items() if "id-token" in job.get("permissions", {})]

    assert holders == ["publish"]
    assert jobs["publish"]["needs"] == "try"
    assert jobs["try"]["needs"] == "build"
    assert not [step for step in jobs["publish"]["steps"] if "run" in step]
    assert workflow[True] == {"push": {"tags": ["v*"]}}


@pytest.mark.parametrize(
    ("tag", "heading", "said"),
    [
        ("v1.2.0", "## 1.2.0 (2026-02-14)", ""),
        ("v1.2.1", "## 1.2.0 (2026-02-14)", "has to be v1.2.0"),
        ("1.2.0", "## 1.2.0 (2026-02-14)", "has to be v1.2.0"),
        ("v1.2.0", "## 1.2.0 (not released yet)", "no date"),
        ("v1.2.0", "## 1.1.0 (2026-02-14)", "no date"),
    ],
)
def test_a_tag_is_published_only_with_its_version_and_its_date(tag, heading, said):
    problem = load_script("check_release").find_problem(
        tag,
        pyproject='[project]\nversion = "1.2.0"\n',
        changelog=f"# Changelog\n\n{heading}\n",
    )

    assert said in problem
    assert bool(problem) == bool(said)


def test_the_changelog_has_a_heading_for_the_version():
    headings = re.findall(r"^## (\S+) ", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)

    assert headings[0] == PROJECT["version"]


def test_the_container_opens_with_the_readmes_first_command():
    opened = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text("utf-8"))

    assert opened["postCreateCommand"] == "python -m grader start --no-lab"
    assert lost_parts(opened["postCreateCommand"]) == []
    version = opened["image"].rpartition(":")[2]
    assert f"Programming Language :: Python :: {version}" in PROJECT["classifiers"]


def wanted(extra):
    """The requirements of an extra, those of the extras that it includes among them."""
    for line in PROJECT["optional-dependencies"][extra]:
        requirement = Requirement(line)
        if requirement.name == PROJECT["name"]:
            for other in requirement.extras:
                yield from wanted(other)
        else:
            yield requirement


def unlocked(requirements, locked):
    """Requirements of which no version, or one that does not satisfy them, is locked."""
    for one in requirements:
        versions = [
            next(iter(other.specifier)).version
            for other in locked
            if canonicalize_name(other.name) == canonicalize_name(one.name)
        ]
        if not versions or not all(one.specifier.contains(version) for version in versions):
            yield str(one)


@pytest.mark.parametrize("extra", [None, *PROJECT["optional-dependencies"]])
def test_every_requirement_is_locked_at_a_version_that_satisfies_it(extra):
    requirements = wanted(extra) if extra else map(Requirement, PROJECT["dependencies"])

    assert list(unlocked(requirements, LOCKED)) == []


def test_every_locked_version_is_exact():
    assert [str(one) for one in LOCKED if [part.operator for part in one.specifier] != ["=="]] == []


def test_check_finds_a_missing_and_an_old_locked_version():
    requirements = [Requirement("click>=8.1.7"), Requirement("numpy>=1.26")]

    assert list(unlocked(requirements, [Requirement("click==8.0")])) == [
        "click>=8.1.7",
        "numpy>=1.26",
    ]


@pytest.mark.parametrize(
    "lesson", sorted((ROOT / "lessons").glob("*.ipynb")), ids=lambda path: path.stem
)
def test_a_notebook_begins_with_a_folded_cell_that_installs_the_course(lesson):
    first, title = nbformat.read(lesson, 4).cells[:2]

    assert f'%pip install --quiet "{PROJECT["name"]}[course] @ git+{{address}}"' in first.source
    assert first.metadata["jupyter"] == {"source_hidden": True}
    assert title.source.startswith("# Lesson ")


@pytest.mark.filterwarnings("ignore:Proactor event loop:RuntimeWarning")
@pytest.mark.parametrize(("found", "said"), [(True, ""), (False, "install --quiet")])
def test_the_first_cell_installs_only_where_the_course_is_missing(tmp_path, found, said):
    told = load_script("derive_notebooks").INSTALL
    listen = "@get_ipython().register_magic_function\ndef pip(line):\n    print(line)\n"
    listen += "input = 'https://github.com/{}'.format\n"
    if not found:
        told = told.replace('"grader"', '"no_such_package"')
    cells = [nbformat.v4.new_code_cell(source) for source in (listen, told)]
    notebook = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(notebook, resources={"metadata": {"path": str(tmp_path)}}).execute(
        stderr=subprocess.DEVNULL
    )

    assert "".join(one.text for one in notebook.cells[1].outputs).startswith(said)
    assert bool(notebook.cells[1].outputs) == bool(said)


@pytest.mark.parametrize("name", ["sysid", "grade"])
def test_a_command_says_its_version(name):
    module = {"sysid": "sim.cli", "grade": "grader.cli"}[name]
    done = subprocess.run(
        [sys.executable, "-c", f"from {module} import main; main()", "--version"],
        capture_output=True, encoding="utf-8", check=True, cwd=ROOT,
    )  # fmt: skip

    assert done.stdout.strip().endswith(f"version {PROJECT['version']}")


def test_the_newest_python_is_the_same_everywhere():
    newest = ".".join(map(str, NEWEST))
    classified = [one.rpartition(" ")[2] for one in PROJECT["classifiers"] if "3." in one]

    assert classified[-1] == newest
    assert f"Python 3.11 to {newest}" in (ROOT / "README.md").read_text("utf-8")
    assert "<" not in PROJECT["requires-python"]  # pip would silently look for an older release
