"""What import-linter and ruff cannot see: imports by name at run time, and functions too long."""

import ast
import re

import pytest
from ci_scripts import load_script
from places import ROOT

OURS = ("sim", "grader")
CATALOGUES = {  # these look into their own folder, or hand on a name when it is first asked for
    "sim/__init__.py",
    "sim/support/catalogue.py",
    "sim/cli/__init__.py",
    "sim/io/__init__.py",
    "sim/support/lazy_package.py",
    "grader/__init__.py",
    "grader/answers/answer_key.py",  # the module beside an exercise's checks
    "grader/classroom/exports/__init__.py",
    "grader/cli/__init__.py",
    "grader/robotcode/bench/__init__.py",
    "grader/robotcode/library/__init__.py",
    "grader/robotcode/python/imports.py",  # the learner's modules, and fakes
    "grader/robotcode/python/subject.py",  # the learner's module
}


def dynamic_imports(tree):
    """The calls that import a module by name, each with the name if it is written out."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module == "importlib":
            yield from (None for alias in node.names if alias.asname)
        if not isinstance(node, ast.Call):
            continue
        called = node.func.attr if isinstance(node.func, ast.Attribute) else None
        called = node.func.id if isinstance(node.func, ast.Name) else called
        if called in {"import_module", "__import__"}:
            first = node.args[0] if node.args else None
            yield first.value if isinstance(first, ast.Constant) else None


def hidden_imports(path, text):
    """Names of our own modules, or None for a name made at run time, that a file imports."""
    if path in CATALOGUES:
        return []
    return [
        name
        for name in dynamic_imports(ast.parse(text))
        if name is None or name.partition(".")[0] in OURS
    ]


def test_only_catalogues_import_our_modules_by_name():
    found = {}
    for folder in OURS:
        for path in (ROOT / folder).rglob("*.py"):
            name = path.relative_to(ROOT).as_posix()
            if hidden := hidden_imports(name, path.read_text(encoding="utf-8")):
                found[name] = hidden

    assert found == {}


@pytest.mark.parametrize(
    "text",
    [
        'import_module("sim.bench.mechanisms")',
        'importlib.import_module("sim.plot.story")',
        '__import__("grader.checks.check")',
        'import_module(f"sim.{name}")',
        "from importlib import import_module as load",
    ],
)
def test_import_check_finds_a_hidden_import_in_the_solver(text):
    assert hidden_imports("sim/reconcile/story.py", text)


LONGEST = 60  # lines of a function, its docstring included


@pytest.mark.parametrize("folder", [*OURS, "exercises"])
def test_no_function_is_longer_than_a_page(folder):
    long = {
        f"{path.relative_to(ROOT).as_posix()}: {node.name}"
        for path in (ROOT / folder).rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and node.end_lineno - node.lineno >= LONGEST
    }

    assert long == set()


PAGES = ("CONTRIBUTING.md", "sim/ARCHITECTURE.md", *(
    path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "sim" / "decisions").glob("*.md"))
))  # fmt: skip


def there(page, name):
    """Whether a file that a page names is there: beside it, or anywhere by the end of its path."""
    beside = (ROOT / page).parent / name
    return beside.exists() or any(
        path.as_posix().endswith(f"/{name}") for top in TOPS for path in (ROOT / top).rglob("*.py")
    )


TOPS = (*OURS, "tests", ".ci", "exercises", "solutions")


@pytest.mark.parametrize("page", PAGES)
def test_files_named_in_documents_exist(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    named = set(re.findall(r"`([\w./]+\.py)`", text)) - {"lessons/NN_name.py"}

    assert {name for name in named if not there(page, name)} == set()


@pytest.mark.parametrize(("folder", "contract"), load_script("check_addition").CONTRACTS.items())
def test_addition_check_names_existing_folders_and_tests(folder, contract):
    tests = [ROOT / "tests" / f"test_{one}.py" for one in contract.tests.split()]

    assert (ROOT / folder).is_dir()
    assert [path.name for path in tests if not path.is_file()] == []
    text = "\n".join(path.read_text(encoding="utf-8") for path in tests)
    assert [word for word in contract.words.split() if word not in text] == []


def test_names_of_the_architecture_page_are_in_the_code():
    text = (ROOT / "sim" / "ARCHITECTURE.md").read_text(encoding="utf-8")
    code = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "sim").rglob("*.py"))
    named = {name for one in re.findall(r"`([A-Za-z_.]+)`", text) for name in one.split(".")}

    assert {name for name in named - {"py"} if not re.search(rf"\b{name}\b", code)} == set()


SEARCHES = {  # how far and how finely they go decides on time, not on what is reported
    "backlash_phase.py", "candidates.py", "cross_validation.py", "forward_selection.py",
    "held_out.py", "local_minimum.py", "onset_scan.py", "search_effort.py", "two_body_starts.py",
}  # fmt: skip
SHOWING = {"story_text.py", "model_selection.py"}
HARMLESS = {0, 0.5, 1, 2}  # halves, doubles and counts


def test_thresholds_of_reconcile_are_in_one_file():
    found = {
        path.name
        for path in (ROOT / "sim/reconcile").rglob("*.py")
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.Assign)
        and any(
            isinstance(part, ast.Constant)
            and type(part.value) in {int, float}
            and part.value not in HARMLESS
            for part in ast.walk(node.value)
        )
        and not any(isinstance(part, ast.Call) for part in ast.walk(node.value))
    }

    assert found - SEARCHES - SHOWING <= {"thresholds.py", "damage.py"}
