"""How the benchmark of reconcile judges: hand-made answers, and the acceptance's own script."""

from importlib import import_module

import pytest


@pytest.fixture
def modules(root, monkeypatch):
    """The benchmark's modules, by name."""
    monkeypatch.syspath_prepend(root / "tests" / "benchmarks")
    return lambda name: import_module(f"reconcile_{name}")


def answer(*found, verdict="explained", remainder=False, case="000"):
    """What the command says: effects, each with ``*`` behind it if it is a minor one."""
    findings = [
        {"effect": name.removesuffix("*"), "size": "minor" if name.endswith("*") else "major"}
        for name in found
    ]
    said = {
        "verdict": verdict, "findings": findings, "remainder": remainder,
        "noise_floor": 0.1, "gap_before": 0.4, "gap_after": 0.11,
    }  # fmt: skip
    return {"case": case, "said": said, "seconds": 2.0, "busy": 1.0, "memory": 100.0}


def truth(*effects, severity="real", dirty=False, shuffled=""):
    return {
        "effects": list(effects), "detail": list(effects), "severity": severity, "dirty": dirty,
        "shuffled": shuffled,
    }  # fmt: skip


JUDGED = {
    "right": (["drag"], answer("drag"), "right"),
    "right though minor": (["drag"], answer("drag*"), "right"),
    "right and more": (["drag"], answer("drag", "delay"), "right"),
    "second": (["drag"], answer("delay", "drag"), "wrong"),
    "another": (["drag"], answer("delay"), "wrong"),
    "none": (["drag"], answer(verdict="nothing-missing"), "silent"),
    "unexplained": (["drag"], answer(verdict="unexplained"), "silent"),
    "refused": (["drag"], answer() | {"said": None}, "crash"),
    "the same while it moves": (["asymmetric-friction"], answer("constant-load"), "right"),
    "a fault": (["encoder-slip"], answer("encoder-slip"), "right"),
    "complete": ([], answer(verdict="nothing-missing"), "right"),
    "complete, a minor name": ([], answer("cogging*", verdict="nothing-missing"), "right"),
    "complete, a major name": ([], answer("cogging"), "false alarm"),
    "complete, unexplained": ([], answer(verdict="unexplained"), "right"),
    "both": (["drag", "delay"], answer("delay", "drag"), "right"),
    "both and more": (["drag", "delay"], answer("delay", "cogging", "drag"), "right"),
    "one of two": (["drag", "delay"], answer("delay", "cogging"), "one of two"),
    "neither of two": (["drag", "delay"], answer("cogging"), "wrong"),
    "none of two": (["drag", "delay"], answer(verdict="unexplained"), "silent"),
    "flagged": (["unknown"], answer(verdict="unexplained"), "right"),
    "flagged beside": (["unknown"], answer("cogging*", remainder=True), "right"),
    "a name beside": (["unknown"], answer("cogging", remainder=True), "flagged, wrong name too"),
    "a name instead": (["unknown"], answer("cogging"), "wrong"),
    "passed over": (["unknown"], answer("cogging*", verdict="nothing-missing"), "silent"),
}


@pytest.mark.parametrize("name", JUDGED)
def test_an_answer_is_judged_as_the_acceptance_has_it(modules, name):
    effects, said, mark = JUDGED[name]

    (one,) = modules("scores").score([said], {"000": truth(*effects)})

    assert one.mark == mark
