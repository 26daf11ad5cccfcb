"""The API reference: its examples run, and what lessons import is listed there."""

import ast
import doctest
import re
from importlib import import_module

import pytest
from places import ROOT

LISTED = re.findall(
    r"^::: ([\w.]+)$", (ROOT / "sim/docs/reference.md").read_text("utf-8"), re.MULTILINE
)
MODULES = sorted(
    {name if name == "sim.core.errors" else name.rpartition(".")[0] for name in LISTED}
)
CONSTANTS = re.compile(r"[A-Z][A-Z_0-9]*")  # explained where they stand


def resolve_name(name):
    """What a dotted name stands for."""
    if name == "sim.core.errors":
        return import_module(name)
    module, _, own = name.rpartition(".")
    return getattr(import_module(module), own)


@pytest.mark.parametrize("module", MODULES)
def test_examples_of_the_reference_run(module):
    found = doctest.testmod(import_module(module), optionflags=doctest.NORMALIZE_WHITESPACE)

    assert found.failed == 0


VERBS = (
    "sim.io.write",
    "sim.fit.fit",
    "sim.reconcile.reconcile",
    "sim.inspect.detect_faults.inspect",
    "sim.inspect.contaminate.contaminate",
    "sim.bench.simulate.simulate",
    "sim.physics.engine.simulate_run",
    "sim.physics.replay.replay_log",
)


@pytest.mark.parametrize("name", VERBS)
def test_the_main_functions_have_an_example_in_their_docstring(name):
    assert name in LISTED
    assert ">>>" in resolve_name(name).__doc__


@pytest.mark.parametrize("name", LISTED)
def test_listed_names_have_docstrings_that_explain_their_arguments(name):
    listed = resolve_name(name)

    assert listed.__doc__
    if isinstance(listed, type) or not callable(listed):
        return
    takes = listed.__code__.co_varnames[
        : listed.__code__.co_argcount + listed.__code__.co_kwonlyargcount
    ]
    named = re.findall(r"^\s+(\w+): ", listed.__doc__, re.MULTILINE)
    if len(takes) > 1:
        assert set(takes) <= set(named)


@pytest.mark.parametrize(
    "lesson", sorted((ROOT / "lessons").glob("*.py")), ids=lambda path: path.stem
)
def test_names_that_lessons_import_are_in_the_reference(lesson):
    listed = {id(resolve_name(name)) for name in LISTED}
    imported = {
        (node.module, alias.name)
        for node in ast.walk(ast.parse(lesson.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "sim"
        for alias in node.names
    }

    assert {
        f"{module}.{name}"
        for module, name in imported
        if not CONSTANTS.fullmatch(name) and id(getattr(import_module(module), name)) not in listed
    } == set()
