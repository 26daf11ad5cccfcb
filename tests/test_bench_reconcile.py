"""The benchmark of reconcile: fresh cases, solved blind, scored as the acceptance has it."""

import json
import shlex
import subprocess
import sys
from collections import Counter
from importlib import import_module

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.core.log import Log, Run
from sim.physics.effects import EFFECTS

CONTROLS = 2
NOSY = """
import json, pathlib, sys
here = pathlib.Path(sys.argv[1]).resolve().parent
above = [here, *here.parents][:3]
seen = sorted({path.name for folder in above[:2] for path in folder.rglob("*") if path.is_file()})
said = {"verdict": "nothing-missing", "findings": [], "remainder": False, "noise_floor": 0.1}
print(json.dumps(said | {"gap_before": 0.2, "gap_after": 0.2, "argv": sys.argv[1:], "seen": seen}))
"""
"""A stand-in for the solver that finds nothing missing, and says what it was told and saw."""


@pytest.fixture(scope="session")
def benchmarks(root):
    return root / "tests" / "benchmarks"


@pytest.fixture
def modules(benchmarks, monkeypatch):
    """The benchmark's modules, by name."""
    monkeypatch.syspath_prepend(benchmarks)

    return lambda name: import_module(f"reconcile_{name}")


@pytest.fixture(scope="module")
def finished_run(benchmarks, tmp_path_factory):
    """What one whole run keeps and prints, and what making the same cases again leaves."""
    where = tmp_path_factory.mktemp("reconcile")
    (where / "nosy.py").write_text(NOSY, encoding="utf-8")
    solver = shlex.join([sys.executable, str(where / "nosy.py")])
    plan = ["--seed", "7", "--cases", "1", "--shuffled", str(CONTROLS)]
    whole = [*plan, "--keep", str(where / "kept"), "--json", "--command", solver]
    again = [*plan, "--out", str(where / "again"), "--key", str(where / "key.json")]

    def run(script, *words):  # one after the other: the first compiles the engine for both
        command = [sys.executable, str(benchmarks / script), *words]
        done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    run("reconcile_cases.py", *again)
    return where, json.loads(run("bench_reconcile.py", *whole))


@pytest.mark.slow
def test_benchmark_has_every_effect_in_every_group_and_mechanism(modules):
    plan = modules("plan")
    names = {*EFFECTS, "encoder-slip", "hard-stop"}
    able = {(n, m) for n in names for m in MECHANISMS if not plan.why_not(m, n)}

    cases = plan.plan(seed=3, cases=len(names))
    many = plan.plan(seed=3, cases=6 * len(names))

    for severity in ("real", "subtle"):
        for dirty in (False, True):
            group = [
                c.hidden[0] for c in cases
                if c.severity == severity and c.dirty == dirty and len(c.effects) == 1
                and c.effects != ("unknown",)
            ]  # fmt: skip
            assert Counter(group) == Counter(names)
    met = {(c.hidden[0], c.mechanism) for c in many if len(c.hidden) == 1}
    assert {pair for pair in met if pair[0] in names} == able
    assert set(modules("strangers").STRANGERS) <= {name for name, _ in met}


@pytest.mark.slow
def test_the_same_seed_makes_the_same_files_again(finished_run):
    where, _ = finished_run
    kept, again = (
        {path.relative_to(where / folder): path.read_bytes() for path in paths}
        for folder in ("kept", "again")
        for paths in [(where / folder).rglob("*.csv")]
    )

    assert len(kept) == 3 * (4 + 6 + CONTROLS)
    assert kept == again
    assert len(set(kept.values())) == len(kept)


@pytest.mark.slow
def test_a_case_says_what_a_team_knows_and_names_nothing_hidden(finished_run, modules):
    where, _ = finished_run
    names = (*EFFECTS, *modules("strangers").STRANGERS, "encoder-slip", "hard-stop", "dirty")
    for file in (where / "again").rglob("*"):
        if file.is_file():
            text = file.read_text(encoding="utf-8")
            assert file.name in {"train.csv", "validation.csv", "test.csv", "case.json"}
            assert not [name for name in names if name in text]
    known = json.loads(next((where / "again").rglob("case.json")).read_text(encoding="utf-8"))
    assert set(known) == {"type", "mechanism", "travel", "period_s"}


@pytest.mark.slow
def test_solver_gets_the_key_only_after_its_answers(finished_run):
    where, _ = finished_run
    answers = json.loads((where / "kept" / "answers.json").read_text(encoding="utf-8"))
    key = json.loads((where / "kept" / "key.json").read_text(encoding="utf-8"))
    allowed = {"--validation", "--held-out", "--type", "--travel", "--json"}

    assert {a["case"] for a in answers if not a["case"].startswith("shuffled")} == set(key)
    for each in answers:
        assert {word for word in each["said"]["argv"] if word.startswith("--")} <= allowed
        assert not [name for name in each["said"]["seen"] if "key" in name or "answer" in name]
    assert (where / "kept" / "shuffled" / "key.json").exists()


@pytest.mark.slow
def test_solver_that_names_nothing_is_right_only_for_complete_models(finished_run):
    _, told = finished_run

    marks = {one["case"]: (one["group"].split()[1], one["mark"]) for one in told["cases"]}

    assert Counter(marks.values()) == {
        ("complete", "right"): 2, ("unknown", "silent"): 2, ("two", "silent"): 2,
        ("realistic", "silent"): 2, ("subtle", "silent"): 2,
    }  # fmt: skip
    assert told["shuffled"] == {"nothing-missing": CONTROLS}


def four_tests():
    """Runs of different length whose voltages are all different."""
    runs, at = [], 0.0
    for place, test in enumerate(
        ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
    ):
        n = 40 + 10 * place
        time = at + 0.02 * np.arange(n)
        volts = (1.0 - 2.0 * (place % 2)) * (place + np.linspace(0.1, 0.9, n))
        runs.append(Run(test, time, volts, np.sin(time), np.cos(time)))
        at = float(time[-1]) + 1.0
    return Log(tuple(runs))


@pytest.mark.slow
def test_permuted_control_keeps_all_voltages_and_moves_nearly_all(modules):
    log = four_tests()

    shuffled = modules("recording").permuted(log, rng=np.random.default_rng(1))

    before, after = (np.concatenate([run.voltage for run in one.runs]) for one in (log, shuffled))
    assert np.array_equal(np.sort(before), np.sort(after))
    assert np.mean(before == after) < 0.05
    assert abs(np.corrcoef(before, after)[0, 1]) < 0.2
    for was, is_ in zip(log.runs, shuffled.runs, strict=True):
        assert np.array_equal(was.velocity, is_.velocity)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_in_an_exchanged_case_no_run_keeps_its_own_voltage(modules, seed):
    log = four_tests()

    shuffled = modules("recording").exchanged(log, rng=np.random.default_rng(seed))

    ends = [(float(run.voltage[0]), float(run.voltage[-1])) for run in log.runs]
    given = [ends.index((float(r.voltage[0]), float(r.voltage[-1]))) for r in shuffled.runs]
    assert sorted(given) == [0, 1, 2, 3]
    assert all(place != other for place, other in enumerate(given))
    assert given != [1, 0, 3, 2]  # all signs turned: damage that has a name


@pytest.fixture
def modules2(root, monkeypatch):
    """The benchmark's modules2, by name."""
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
def test_each_answer_of_a_solver_gets_the_expected_mark(modules2, name):
    effects, said, mark = JUDGED[name]

    (one,) = modules2("scores").score([said], {"000": truth(*effects)})

    assert one.mark == mark
