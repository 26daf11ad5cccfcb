"""The first sentence of an answer: which gains can be used, and what to record for the others."""

import io
import re
from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.doubt import Doubt
from sim.feedback import PRESETS
from sim.fit import fit
from sim.report.fit_terminal import show_fit
from sim.report.gain_verdicts import judge_gains, write_gain_verdict

LOG = simulate(MECHANISMS["drivetrain"], Routine(ramp=0.5, step=4.0), rng=np.random.default_rng(2))
FOUND = replace(
    fit(LOG),
    gains={"kS": 0.2, "kV": 2.0, "kA": 0.5},
    errors={"kS": 0.01, "kV": 0.02, "kA": 0.2},
)
USABLE = "kS usable (± 0.01 V), kV usable (± 1 %)"


def only(*tests):
    return replace(LOG, runs=tuple(run for run in LOG.runs if run.test in tests))


def weaker(log, factor):
    return replace(log, runs=tuple(replace(r, voltage=factor * r.voltage) for r in log.runs))


@pytest.mark.parametrize(
    ("log", "advice"),
    [
        (only("quasistatic-forward", "quasistatic-reverse"), "add a dynamic test"),
        (weaker(LOG, 0.25), "repeat the dynamic tests with a larger step than 1 V"),
        (LOG, "repeat the dynamic tests, and log every loop"),
    ],
)
def test_advice_for_ka_comes_from_the_log(log, advice):
    assert write_gain_verdict(FOUND, log) == f"{USABLE}; kA not usable (± 40 %): {advice}."


@pytest.mark.parametrize(
    ("log", "advice"),
    [
        (only("dynamic-forward"), "add a quasistatic test"),
        (only("quasistatic-forward"), "add the tests in reverse"),
        (weaker(LOG, 0.25), "let the quasistatic tests run beyond 1.2 V"),
        (LOG, "repeat the quasistatic tests with a slower ramp"),
    ],
)
def test_advice_for_kv_comes_from_the_log(log, advice):
    found = replace(FOUND, gains={"kV": 2.0}, errors={"kV": 1.0})

    assert write_gain_verdict(found, log) == f"kV not usable (± 50 %): {advice}."


@pytest.mark.parametrize(
    ("gains", "errors", "said"),
    [
        ({"kV": 2.0}, {"kV": 0.001}, "kV usable (± less than 0.1 %)."),
        ({"kV": -2.0}, {"kV": 0.01}, "kV not usable (not above zero)."),
        ({"kV": 2.0}, {"kV": float("nan")}, "kV not usable (its error is not known)."),
        ({"offset_rad": 1.0}, {"offset_rad": 0.02}, "angle usable (± 0.02 rad)."),
        ({"kG": 1.0}, {"kG": 1e-4}, "kG usable (± less than 0.001 V)."),
    ],
)
def test_each_gain_is_judged_in_its_own_measure(gains, errors, said):
    assert write_gain_verdict(replace(FOUND, gains=gains, errors=errors)) == said


def test_gain_that_a_warning_is_about_is_not_usable():
    errors = FOUND.errors | {"kA": 0.01}
    sure = replace(FOUND, errors=errors, doubts=(Doubt("x", "It is.", gains=("kA", "kG")),))

    said = write_gain_verdict(sure, LOG)

    assert said == f"{USABLE}; kA not usable (± 2 %): the warnings or the faults say why."
    assert judge_gains(sure) == "Check first"
    every = replace(sure, doubts=(Doubt("x", "It is.", gains=("kS", "kV", "kA")),))
    assert judge_gains(every) == "Not usable"


@pytest.mark.parametrize("width", [80, 120])
def test_a_fit_is_wrapped_and_colored_on_a_terminal(width):
    out = io.StringIO()
    doubts = (Doubt("x", "word " * 60, grave=True), Doubt("y", "so it is " * 30))
    console = Console(file=out, width=width, force_terminal=True, color_system="standard")

    show_fit(
        replace(FOUND, doubts=doubts), preset=PRESETS["default"], title="log.csv",
        notes=("All is even. " * 20,), console=console,
    )  # fmt: skip

    lines = [re.sub(r"\x1b\[[\d;]*m", "", line) for line in out.getvalue().splitlines()]
    assert max(map(len, lines)) <= width
    assert "\x1b[1;31mwrong:" in out.getvalue()
    assert "\x1b[33mwarning:" in out.getvalue()
    after = lines[next(k for k, line in enumerate(lines) if line.startswith("warning:")) + 1]
    assert after.startswith(" " * 9)
    assert not after.startswith(" " * 10)
