"""Inspection: one account of what many detectors say, of any log, for people and for programs."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import sim.inspect.detect_faults
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import FOUR_TESTS, Run
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.inspect.fault import Damage, DamagedLog, Fault, LogInterval


def rng(seed=0):
    return np.random.default_rng(seed)


@cache
def bench(name):
    return simulate(MECHANISMS[name], Routine(ramp=0.5, step=3.5), rng=rng())


@pytest.fixture(scope="module")
def drive():
    return bench("drivetrain")


# Which explanation is believed


def fake(name, *, whole=False, about="motion", says=()):
    """A fault that says what it is told to."""
    return Fault(
        name=name,
        summary=name,
        ordinary="1",
        spoil=lambda log, _blow, _rng: DamagedLog(log, ()),
        detect=lambda _features: [
            Damage(LogInterval(run, "dynamic-forward", start, end), sure, "seen", "act")
            for run, start, end, sure in says
        ],
        whole=whole,
        about=about,
    )


@pytest.mark.parametrize(
    ("faults", "left"),
    [
        ([fake("a", says=[(0, 1, 2, 0.9)]), fake("b", says=[(0, 1, 2, 0.8)])], ["a"]),
        ([fake("a", says=[(0, 1, 2, 0.8)]), fake("b", says=[(0, 1, 2, 0.9)])], ["b"]),
        ([fake("a", says=[(0, 1, 2, 0.9)]), fake("b", says=[(0, 1, 9, 0.8)])], ["b"]),
        ([fake("a", says=[(0, 1, 2, 0.8)]), fake("b", says=[(0, 1.5, 1.5, 0.9)])], ["a"]),
        ([fake("a", says=[(0, 1, 2, 0.9)]), fake("b", says=[(0, 3, 4, 0.8)])], ["a", "b"]),
        ([fake("a", says=[(0, 1, 2, 0.9)]), fake("b", says=[(1, 1, 2, 0.8)])], ["a", "b"]),
        ([fake("a", says=[(0, 1, 3, 0.9), (0, 2, 4, 0.8)])], ["a", "a"]),
        ([fake("a", says=[(0, 1, 2, 0.9)]), fake("b", whole=True, says=[(0, 0, 9, 0.8)])], "ba"),
        ([fake("a", says=[(0, 1, 2, 0.9)]), fake("b", about="time", says=[(0, 1, 2, 0.8)])], "ab"),
        ([fake("a", says=[(1, 1, 2, 0.9)]), fake("b", says=[(None, 0, 0, 1.0)])], ["b", "a"]),
    ],
    ids=[
        "the surer one",
        "whichever comes first",
        "the one that explains more",
        "a single sample within a longer one",
        "two moments, two causes",
        "two runs, two causes",
        "one fault does not rival itself",
        "a whole run's fault stands beside a moment's",
        "what is wrong with time stands beside what is wrong with motion",
        "the whole log comes first",
    ],
)
def test_likelier_of_two_faults_at_the_same_time_is_reported(monkeypatch, drive, faults, left):
    monkeypatch.setattr(
        sim.inspect.detect_faults, "FAULTS", {fault.name: fault for fault in faults}
    )

    assert [damage.fault for damage in inspect(drive).damages] == list(left)


# Whatever log there is


@pytest.mark.parametrize("keep", [["quasistatic-forward"], ["dynamic-forward"], FOUR_TESTS[:2]])
@pytest.mark.parametrize("name", ["encoder-slip", "hard-stop", "loop-overrun"])
def test_no_fault_is_made_up_where_tests_are_missing(keep, name, drive):
    """Only that they are missing; and what can be seen in a single run is seen."""
    part = replace(drive, runs=tuple(run for run in drive.runs if run.test in keep))

    assert {damage.fault for damage in inspect(part).damages} <= {"missing-test"}
    if name != "encoder-slip":
        spoilt = contaminate(part, name, rng=rng()).log
        assert name in {damage.fault for damage in inspect(spoilt).damages}


HURTS = {
    "nothing": lambda run: run,
    "no voltage": lambda run: replace(run, voltage=0.0 * run.voltage),
    "no motion": lambda run: replace(run, velocity=0.0 * run.velocity),
    "huge": lambda run: replace(run, velocity=1e6 * run.velocity, position=1e4 * run.position),
    "tiny": lambda run: replace(run, velocity=1e-12 * run.velocity),
    "backward": lambda run: replace(run, velocity=-run.velocity[::-1], position=-run.position),
    "noise": lambda run: replace(run, velocity=rng().standard_normal(len(run))),
    "steps": lambda run: replace(run, velocity=np.round(run.velocity)),
    "other test": lambda run: replace(run, test="chirp-forward"),
    "none": lambda run: Run(run.test, *(getattr(run, s)[:0] for s in SIGNALS)),
    "one": lambda run: Run(run.test, *(getattr(run, s)[:1] for s in SIGNALS)),
    "few": lambda run: Run(run.test, *(getattr(run, s)[:7] for s in SIGNALS)),
    "sparse": lambda run: Run(run.test, *(getattr(run, s)[::40] for s in SIGNALS)),
    "first half": lambda run: Run(run.test, *(getattr(run, s)[: len(run) // 2] for s in SIGNALS)),
}
SIGNALS = ("time", "voltage", "position", "velocity")


@settings(max_examples=100)
@given(
    name=st.sampled_from(list(MECHANISMS)),
    hurts=st.lists(st.sampled_from(list(HURTS)), min_size=4, max_size=4),
    gone=st.integers(0, 4),
)
@example(name="elevator", hurts=["nothing", "steps", "nothing", "nothing"], gone=0)
def test_every_damaged_run_can_be_inspected(name, hurts, gone):
    log = bench(name)
    runs = [HURTS[hurt](run) for hurt, run in zip(hurts, log.runs, strict=True)]

    found = inspect(replace(log, runs=tuple(runs[gone:])))

    json.dumps(found.to_json(), allow_nan=False)
    for damage in found.damages:
        assert 0.0 < damage.confidence <= 1.0
        assert damage.evidence.endswith(".")
        assert str(damage.advice).endswith(".")
        assert damage.where.start <= damage.where.end


@pytest.mark.parametrize("step", [1e-9, 1e-6, 5.0, 20.0])
def test_an_impossible_clock_is_reported_and_no_fault_made_up_from_it(step, drive):
    odd = replace(
        drive,
        runs=tuple(replace(run, time=np.arange(len(run)) * step) for run in drive.runs),
    )

    found = inspect(odd)

    (doubt,) = found.doubts
    assert (doubt.code, doubt.grave) == ("odd-clock", True)
    assert doubt.message.endswith("Give times in seconds.")
    assert not found.damages
    assert not found.is_clean


# The command
