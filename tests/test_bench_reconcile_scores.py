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


def test_shares_are_of_their_own_group(modules):
    key = {
        "0": truth("drag"), "1": truth("drag"), "2": truth("delay"), "3": truth("spring"),
        "4": truth("drag", dirty=True, severity="subtle"), "5": truth("drag", "delay"),
        "6": truth("drag", "delay"), "7": truth("unknown"), "8": truth(severity=None),
    }  # fmt: skip
    said = [
        answer("drag", case="0"), answer("delay", case="1"), answer(case="2"),
        answer("spring", case="3"), answer("drag", case="4"), answer("drag", "delay", case="5"),
        answer("drag", "delay", "cogging", case="6"), answer("cogging", case="7"),
        answer("cogging", case="8"),
    ]  # fmt: skip

    found = modules("scores").shares(modules("scores").score(said, key))

    assert found == {
        "clean realistic": {"n": 4, "right": 0.5, "wrong": 0.25, "silent": 0.25},
        "dirty subtle": {"n": 1, "right": 1.0},
        "clean two": {"n": 2, "right": 1.0, "extra": 0.5},
        "clean unknown": {"n": 1, "right": 0.0, "wrong": 1.0},
        "clean complete": {"n": 1, "right": 0.0, "false alarm": 1.0},
    }


def test_the_table_says_what_was_named_for_what_and_which_goal_is_missed(modules):
    key = {str(n): truth("drag") for n in range(10)} | {"c": truth(shuffled="permuted")}
    said = [answer("drag", case=str(n)) for n in range(9)]
    said += [answer("delay", case="9"), answer(verdict="unexplained", case="c")]
    scored = modules("scores").score(said, key)
    verdicts = modules("scores").controls(said, key)

    met = {goal.name: goal.met for goal in modules("table").goals(scored, verdicts)}
    text = "\n".join(modules("table").lines(scored, verdicts))

    assert modules("scores").confusion(scored) == {"drag": {"drag": 9, "delay": 1}}
    assert met["clean realistic: right effect first"] is False  # 0.90, and 0.92 is asked for
    assert met["clean realistic: wrong effect first"] is False  # 0.10, and 0.03
    assert met["shuffled voltage: unexplained"] is True
    assert met["dirty subtle: right effect first"] is None
    assert "9 clean realistic, drag: wrong, said delay (gap 4.00 to 1.1)" in text
    assert "4 noise floors before, 1.1 after" in text
