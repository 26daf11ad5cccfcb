"""Whatever is read and fitted comes to gains, to a refusal, or to an error of ours.

Few examples, always the same, in the gate. For a long hunt, with other examples each time:

    SYSID_FUZZ=5000 pytest tests/test_fuzz.py
"""

import json
import math
import os
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.core.log import LARGEST, Log, Run
from sim.core.vocabulary import METHODS, TESTS, TYPES
from sim.fit import fit

pytestmark = pytest.mark.slow

FEW = 40
LONG = int(os.environ.get("SYSID_FUZZ", "0"))
hunt = settings(
    max_examples=LONG or FEW,
    derandomize=not LONG,
    database=None,
    phases=(Phase.explicit, Phase.generate),  # a fit is too slow to look for a smaller example
    suppress_health_check=list(HealthCheck),
)
SIGNALS = ("time", "voltage", "position", "velocity")
TOOLS = ("slow-forward", "slow-backward", "fast-forward", "fast-backward")
SHORT = Routine(ramp=2.0, step=4.0, timeout=1.6)
NASTY = (
    b"nan",
    b"inf",
    b"-1e400",
    b"1e308",
    b"1e-320",
    b"",
    b"0",
    b",",
    b"\n",
    b"\x00",
    b"\xff",
    b'"',
)

numbers = st.one_of(
    st.floats(-12.0, 12.0),
    st.floats(allow_nan=True, allow_infinity=True),
    st.sampled_from([0.0, -0.0, 1e-320, 1e-9, 1e9, -1e9, LARGEST * 0.999, 1e308]),
)


def recorded(kind="elevator"):
    """A short log of a mechanism; every test that is fuzzed begins from one."""
    return simulate(MECHANISMS[kind], SHORT, rng=np.random.default_rng(1))


LOGS = {kind: recorded(kind) for kind in ("drivetrain", "elevator", "arm")}


def in_json(log):
    """The same log as SysId of 2023 would have written it."""
    rows = {
        tool: np.column_stack([getattr(run, name) for name in SIGNALS]).tolist()
        for tool, run in zip(TOOLS, log.runs, strict=True)
    }
    words = {"test": "Elevator", "units": "Meters", "unitsPerRotation": 1.0, "sysid": True}
    return json.dumps(rows | words).encode()


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Suffix -> the bytes of a sound file."""
    folder = tmp_path_factory.mktemp("sound")
    sound = {".json": in_json(LOGS["elevator"])}
    for suffix in (".wpilog", ".csv"):
        path = folder / f"log{suffix}"
        sim.write(LOGS["elevator"], path)
        sound[suffix] = path.read_bytes()
    return sound


def or_refusal(action, *given, **how):
    """What an action comes to: its result, or a refusal, which is one line with an advice."""
    try:
        return action(*given, **how)
    except Refusal as refused:
        outcome = refused
    assert "\n" not in str(outcome)
    assert outcome.advice.endswith((".", "?"))
    return outcome


def is_right_or_refused(log, **how):
    """Fit, and look at everything that would be shown."""
    found = or_refusal(fit, log, **how)
    if isinstance(found, Refusal):
        return
    for numbers in (found.gains, found.errors):
        assert all(math.isfinite(value) for value in numbers.values()), numbers
    json.dumps(found.in_log_units().to_json(), allow_nan=False)


def damaged(content, edits, keep):
    """Bytes after some edits, cut off after a share of them."""
    for at, cut, put in edits:
        place = int(at * len(content))
        content = content[:place] + put + content[place + cut :]
    return content[: int(keep * len(content))]


EDITS = st.lists(
    st.tuples(
        st.floats(0.0, 1.0),
        st.integers(0, 40),
        st.one_of(st.binary(max_size=8), st.sampled_from(NASTY)),
    ),
    max_size=6,
)
KEEP = st.one_of(st.just(1.0), st.floats(0.0, 1.0))


@pytest.mark.parametrize("suffix", [".wpilog", ".csv", ".json"])
@pytest.mark.parametrize("method", METHODS)
@hunt
@given(edits=EDITS, keep=KEEP)
def test_a_damaged_file_is_fitted_or_refused(  # noqa: PLR0917 - given by name
    tmp_path_factory, files, suffix, method, edits, keep
):
    path = tmp_path_factory.getbasetemp() / f"damaged{suffix}"
    path.write_bytes(damaged(files[suffix], edits, keep))
    log = or_refusal(sim.read, path)
    if isinstance(log, Refusal):
        assert str(path) in str(log)
        return
    is_right_or_refused(log, method=method)


@hunt
@given(
    rows=st.lists(
        st.tuples(st.sampled_from(TESTS[:4]), numbers, numbers, numbers, numbers), max_size=60
    ),
    type_=st.sampled_from(TYPES),
    steady=st.booleans(),
)
def test_any_table_in_a_csv_is_fitted_or_refused(tmp_path_factory, rows, type_, steady):
    path = tmp_path_factory.getbasetemp() / "table.csv"
    rows = sorted(rows, key=lambda row: row[0])
    lines = [
        ",".join([test, str(0.02 * index if steady else t), *map(str, rest)])
        for index, (test, t, *rest) in enumerate(rows)
    ]
    path.write_text("\n".join(["test,time_s,voltage,position,velocity", *lines]), encoding="utf-8")
    log = or_refusal(sim.read, path, type=type_)
    if isinstance(log, Refusal):
        return
    for method in METHODS:
        is_right_or_refused(log, method=method)


def scaled(values, amount, _):
    return values * 10.0 ** (6.0 * amount)


def standing(values, _, at):
    values[at:] = values[at]
    return values


def stepped(values, amount, _):
    size = max(10.0 ** (3.0 * amount) * float(np.ptp(values)), 1e-12)
    return size * np.round(values / size)


def kicked(values, amount, at):
    values[at] += 1e3 * amount
    return values


def turned(values, *_):
    return values[::-1].copy()


def noisy(values, amount, at):
    return values + 10.0 ** (4.0 * amount) * np.random.default_rng(at).standard_normal(values.size)


def leveled(values, amount, _):
    return np.full_like(values, amount)


def shifted(values, _, at):
    return np.roll(values, at)


DISTORTIONS = (scaled, standing, stepped, kicked, turned, noisy, leveled, shifted)


def distorted(run, changes):
    """A run with some of its signals changed, its time kept one that runs on."""
    signals = {name: np.array(getattr(run, name)) for name in SIGNALS}
    for signal, change, amount, where in changes:
        values = signals[signal].copy()
        values = change(values, amount, int(where * (values.size - 1)))
        values = np.clip(values, -0.99 * LARGEST, 0.99 * LARGEST)
        if signal != "time" or np.all(np.diff(values) > 0.0):
            signals[signal] = values
    return replace(run, **signals, current=None, bus_voltage=None)


CHANGES = st.lists(
    st.tuples(
        st.sampled_from(SIGNALS),
        st.sampled_from(DISTORTIONS),
        st.floats(-1.0, 1.0),
        st.floats(0.0, 1.0),
    ),
    max_size=4,
)


@pytest.mark.parametrize("method", METHODS)
@hunt
@given(
    kind=st.sampled_from(tuple(LOGS)),
    type_=st.sampled_from(TYPES),
    every=CHANGES,
    one=CHANGES,
    which=st.integers(0, 3),
    runs=st.lists(st.integers(0, 3), min_size=1, max_size=5),
    parts=st.tuples(st.floats(0.0, 1.0), st.integers(1, 9)),
)
def test_any_distortion_of_a_log_is_fitted_or_refused(  # noqa: PLR0917 - given by name
    method, kind, type_, every, one, which, runs, parts
):
    log = LOGS[kind]
    made = [
        distorted(distorted(run, every), one if index == which else ())
        for index, run in enumerate(log.runs)
    ]
    begin, stride = int(0.5 * parts[0] * min(map(len, made))), parts[1]
    cut = [Run(run.test, *(getattr(run, name)[begin::stride] for name in SIGNALS)) for run in made]
    chosen = [cut[index] for index in (range(4) if which == 0 else runs)]
    is_right_or_refused(
        Log(tuple(chosen), units="radians" if type_ == "arm" else log.units),
        type=type_,
        method=method,
    )
