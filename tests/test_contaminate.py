"""Damage on purpose: asked for in words, refused in words, and written whole or not at all."""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sysid_process import run_sysid

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.core.log import TESTS, Log, Run
from sim.inspect.contaminate import FaultRequest, contaminate, parse_fault_request
from sim.inspect.fault import MOST
from sim.inspect.faults import FAULTS
from sim.io import read, write


def rng(seed=0):
    return np.random.default_rng(seed)


@pytest.fixture(scope="module")
def drive():
    return simulate(MECHANISMS["drivetrain"], Routine(ramp=0.5, step=3.5), rng=rng())


@pytest.fixture(scope="module")
def elevator():
    return simulate(MECHANISMS["elevator"], Routine(ramp=0.5, step=3.5), rng=rng())


@pytest.mark.parametrize(
    ("text", "asked"),
    [
        ("brownout", FaultRequest("brownout")),
        ("brownout:2", FaultRequest("brownout", severity=2.0)),
        ("brownout:1e-1", FaultRequest("brownout", severity=0.1)),
        ("brownout@dynamic-forward", FaultRequest("brownout", test="dynamic-forward")),
        (
            "encoder-slip:0.5@dynamic-forward+0.4",
            FaultRequest("encoder-slip", severity=0.5, test="dynamic-forward", at=0.4),
        ),
        (
            " brownout : 2 @ dynamic-forward + 1 ",
            FaultRequest("brownout", 2.0, "dynamic-forward", 1.0),
        ),
    ],
)
def test_request_for_faults_is_parsed(text, asked):
    assert parse_fault_request(text) == asked


@given(st.text(max_size=40))
def test_any_text_is_parsed_as_faults_or_refused(text):
    try:
        assert isinstance(parse_fault_request(text), FaultRequest)
    except BadRequest as refused:
        assert refused.advice  # noqa: PT017 - either answer is right


@pytest.mark.parametrize(
    ("name", "how"),
    [
        ("gremlin", {}),
        ("brownout", {"severity": -0.1}),
        ("brownout", {"severity": MOST + 0.01}),
        ("brownout", {"severity": math.nan}),
        ("brownout", {"severity": math.inf}),
        ("brownout", {"test": "static"}),
        ("brownout", {"test": "coast-forward"}),
        ("wheel-slip", {"test": "quasistatic-forward"}),
        ("brownout", {"test": "dynamic-forward", "at": 99.0}),
        ("brownout", {"test": "dynamic-forward", "at": -1.0}),
        ("brownout", {"test": "dynamic-forward", "at": math.nan}),
        ("brownout", {"test": "quasistatic-forward", "at": 0.0, "severity": 0.1}),
    ],
    ids=lambda value: str(value)[:50],
)
def test_impossible_damage_gets_one_line_with_advice(drive, name, how):
    with pytest.raises(BadRequest) as refused:
        contaminate(drive, name, rng=rng(), **how)

    assert refused.value.advice
    assert "\n" not in str(refused.value)


def short(count, test="dynamic-forward"):
    time = np.arange(count) * 0.02
    return Log((Run(test, time, np.full(count, 3.0), time, np.ones(count)),))


@pytest.mark.parametrize("name", FAULTS)
@pytest.mark.parametrize(
    "log",
    [
        Log(()),
        short(1),
        short(9),
        short(30),
        short(30, "coast-forward"),
    ],
    ids=["no run", "1", "9", "30 samples", "another test"],
)
def test_tiny_log_is_damaged_or_refused_with_a_message(name, log):
    try:
        assert contaminate(log, name, rng=rng()).where
    except BadRequest as refused:
        assert refused.advice  # noqa: PT017 - either answer is right


@given(
    name=st.sampled_from(sorted(FAULTS)),
    severity=st.floats(0.0, MOST),
    test=st.sampled_from([None, *TESTS[:4]]),
    share=st.one_of(st.none(), st.floats(0.0, 0.999)),
    seed=st.integers(0, 10),
)
def test_any_requested_damage_is_done_or_refused(drive, *, name, severity, test, share, seed):
    at = None
    if share is not None and test is not None:
        run = drive.list_runs_of_test(test)[0]
        at = share * float(run.time[-1] - run.time[0])
    try:
        spoilt = contaminate(drive, name, severity=severity, test=test, at=at, rng=rng(seed))
    except BadRequest as refused:
        assert refused.advice  # noqa: PT017 - either answer is right
        return
    assert (spoilt.log is drive) == (severity == 0.0)


def test_fault_damages_the_given_place(drive):
    spoilt = contaminate(drive, "brownout", test="quasistatic-reverse", at=6.0, rng=rng())

    (where,) = spoilt.where
    assert (where.run, where.test) == (1, "quasistatic-reverse")
    assert where.start == pytest.approx(drive.runs[1].time[0] + 6.0)
    for index in (0, 2, 3):
        assert np.array_equal(spoilt.log.runs[index].velocity, drive.runs[index].velocity)


@pytest.mark.parametrize("suffix", [".csv", ".wpilog"])
def test_contaminate_writes_a_readable_log_and_reports_where_the_damage_is(tmp_path, drive, suffix):
    write(drive, tmp_path / "drive.csv")

    made = run_sysid(
        "contaminate", "drive.csv", "--fault", "encoder-slip:1@dynamic-forward+0.5",
        "--fault", "loop-overrun@quasistatic-reverse", "--seed", 3, "-o", f"bad{suffix}",
        folder=tmp_path,
    )  # fmt: skip

    assert made.returncode == 0, made.stderr
    slip, overrun, _ = made.stdout.splitlines()
    assert slip.startswith("encoder-slip: dynamic-forward")
    assert overrun.startswith("loop-overrun: quasistatic-reverse")
    bad = read(tmp_path / f"bad{suffix}")
    assert [run.test for run in bad.runs] == [run.test for run in drive.runs]
    assert len(bad.runs[1]) < len(drive.runs[1])


@pytest.mark.parametrize(
    "arguments",
    [
        ["drive.csv", "--fault", "gremlin", "-o", "x.csv"],
        ["drive.csv", "--fault", "brownout", "-o", "no/x.csv"],
        ["drive.csv", "-o", "x.csv"],
        ["nowhere.csv", "--fault", "brownout", "-o", "x.csv"],
    ],
    ids=" ".join,
)
def test_damage_that_cannot_be_done_gets_one_line_and_no_file(tmp_path, drive, arguments):
    write(drive, tmp_path / "drive.csv")

    refused = run_sysid("contaminate", *arguments, folder=tmp_path)

    assert refused.returncode == 2
    assert refused.stdout == ""
    assert refused.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["drive.csv"]


def test_the_catalogue_is_listed_for_people_and_for_programs(tmp_path):
    people = run_sysid("faults", folder=tmp_path)
    programs = run_sysid("faults", "--json", folder=tmp_path)

    assert [line.split()[0] for line in people.stdout.splitlines()] == list(FAULTS)
    assert max(len(line) for line in people.stdout.splitlines()) <= 100
    rows = json.loads(programs.stdout)
    assert [row["name"] for row in rows] == list(FAULTS)
    assert {"name", "summary", "ordinary", "kinds", "types", "whole"} == set(rows[0])
