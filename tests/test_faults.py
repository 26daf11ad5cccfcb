"""Every fault of the catalogue: it keeps the contract, and is found where it struck.

The table at the end is the acceptance: 60 damaged logs for each fault, 200 sound ones. Pass ``-s``
to see it printed.
"""

import sys
from collections import Counter
from contextlib import suppress
from dataclasses import fields
from itertools import pairwise
from zlib import crc32

import numpy as np
import pytest

import sim.inspect.faults
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.inspect.fault import Fault
from sim.inspect.faults import FAULTS
from sim.support.catalogue import load_catalogue

pytestmark = pytest.mark.slow

SEEDS = 60  # damaged logs for each fault
CLEAN = 200  # sound logs
FOUND = 0.95  # of the damaged ones, at the right place
FALSE = 0.01  # of the sound ones, at most
OVERLAP = 0.5  # of the interval found and the true one

ROUTINES = (Routine(), Routine(ramp=0.5, step=3.5))  # WPILib's default, and a gentle one
PERIODS = (0.02, 0.005)  # [s] a robot program's loop, and a fast logger's
SIGNALS = ("time", "voltage", "position", "velocity")


def bench_log(seed, *, types=None):
    """A sound log of a mechanism drawn at random; routines and periods in turn.

    A new mechanism takes its share of the seeds, and changes no other log.
    """
    names = [name for name, built in MECHANISMS.items() if types is None or built.type in types]
    chosen = max(names, key=lambda name: crc32(f"{seed} {name}".encode()))
    rng = np.random.default_rng([20, seed])
    return simulate(
        MECHANISMS[chosen].draw(rng), ROUTINES[seed % 2], rng=rng, period=PERIODS[seed // 2 % 2]
    )


@pytest.fixture(scope="session")
def sound_logs():
    """Sound logs by seed, made when asked for and kept."""
    made: dict[tuple[int, tuple[str, ...] | None], Log] = {}

    def get(seed, types=None):
        if (seed, types) not in made:
            made[seed, types] = bench_log(seed, types=types)
        return made[seed, types]

    return get


@pytest.fixture(scope="session")
def table():
    """Rows of the acceptance table, printed when all are in."""
    rows: list[str] = []
    yield rows
    print("", *sorted(rows), sep="\n")  # noqa: T201 - the table is what this test is run to see


def damaged(log, name, *, seed, severity=1.0):
    return contaminate(log, name, severity=severity, rng=np.random.default_rng([3, seed]))


def same(one, other):
    """Whether two logs hold the same numbers."""
    return len(one.runs) == len(other.runs) and all(
        a.test == b.test and all(np.array_equal(getattr(a, s), getattr(b, s)) for s in SIGNALS)
        for a, b in zip(one.runs, other.runs, strict=True)
    )


def strays(spoilt, log):
    """How many readings differ, or are missing or too many."""
    count = abs(len(log.runs) - len(spoilt.runs))
    for a, b in zip(log.runs, spoilt.runs, strict=False):
        short = min(len(a), len(b))
        count += abs(len(a) - len(b)) + (a.test != b.test)
        count += sum(
            int(np.count_nonzero(getattr(a, s)[:short] != getattr(b, s)[:short])) for s in SIGNALS
        )
    return count


# The contract


@pytest.mark.parametrize("name", FAULTS)
def test_severity_zero_changes_nothing(name, sound_logs):
    log = sound_logs(0, FAULTS[name].types)

    spoilt = damaged(log, name, seed=0, severity=0.0)

    assert spoilt.log is log
    assert spoilt.where == ()


@pytest.mark.parametrize("name", FAULTS)
def test_same_random_state_gives_the_same_damage(name, sound_logs):
    log = sound_logs(2, FAULTS[name].types)

    one, two = (damaged(log, name, seed=2) for _ in range(2))

    assert one.where == two.where
    assert same(one.log, two.log)


@pytest.mark.parametrize("name", FAULTS)
@pytest.mark.parametrize("severity", [0.5, 1.0, 3.0])
def test_damage_leaves_a_log_that_can_be_worked_with(name, severity, sound_logs):
    log = sound_logs(2, FAULTS[name].types)
    before = [{s: getattr(run, s).copy() for s in SIGNALS} for run in log.runs]

    spoilt = damaged(log, name, seed=2, severity=severity)

    told = "each severity above 0 must change the log; DamagedLog(log, ()) says it would not show"
    assert strays(spoilt.log, log) > 0, told
    assert spoilt.where, told
    for field in fields(Log):  # its runs are damaged; what is known of it stays
        assert field.name == "runs" or getattr(spoilt.log, field.name) == getattr(log, field.name)
    for stretch in spoilt.where:
        assert stretch.start <= stretch.end
        if stretch.run is not None:
            run = spoilt.log.runs[stretch.run]
            assert run.test == stretch.test
            assert run.time[0] - 1e-9 <= stretch.start <= stretch.end <= run.time[-1] + 1e-9
    ends = [(run.time[0], run.time[-1]) for run in spoilt.log.runs]
    assert all(a[1] < b[0] for a, b in pairwise(ends))
    for run, kept in zip(log.runs, before, strict=True):  # and the log it came from is untouched
        assert all(np.array_equal(getattr(run, s), kept[s]) for s in SIGNALS)


GOOD = '''"""Gremlins: they bite.

Fingerprint: bites.
"""
from sim.inspect.fault import Fault, DamagedLog

FAULT = Fault(
    name="gremlins",
    summary="they bite",
    ordinary="3 bites",
    spoil=lambda log, blow, rng: DamagedLog(log, ()),
    detect=lambda features: (),
)
'''


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("FAULT = ", "FALT = "), "offers no FAULT = Fault(...)"),
        (('name="gremlins"', 'name="goblins"'), "has the name 'goblins' in it, and not 'gremlins'"),
        (("Fingerprint", "Looks"), "begins with Fingerprint:"),
        (('summary="they bite"', 'summary=""'), "has no summary of one line"),
        (('"they bite"', '"they\\nbite"'), "has no summary of one line"),
        (("3 bites", "many bites"), "says what severity 1 means without digits"),
        (("detect=", 'kinds=("static",), detect='), "strikes kinds ('static',)"),
        (("detect=", "kinds=(), detect="), "strikes no kind of test"),
        (("detect=", 'types=("crane",), detect='), "strikes types ('crane',)"),
        (("detect=", "when=(0.8, 0.2), detect="), "may start at (0.8, 0.2)"),
        (("detect=", 'about="mood", detect='), "is about 'mood'"),
    ],
    ids=lambda value: str(value)[:40] if isinstance(value, str) else "",
)
def test_a_bad_file_in_the_folder_is_refused_with_a_sentence_that_says_why(
    tmp_path, monkeypatch, change, said
):
    (tmp_path / "gremlins.py").write_text(GOOD.replace(*change), encoding="utf-8")
    monkeypatch.setattr(sim.inspect.faults, "__path__", [str(tmp_path)])
    monkeypatch.delitem(sys.modules, "sim.inspect.faults.gremlins", raising=False)

    with pytest.raises(BadRequest) as refused:
        load_catalogue(sim.inspect.faults, Fault, Fault.find_contract_breaches)

    sys.modules.pop("sim.inspect.faults.gremlins", None)
    assert said in str(refused.value)
    assert str(refused.value).startswith("sim/inspect/faults/gremlins.py: ")
    assert "\n" not in str(refused.value)


EVERY = ("quasistatic", "dynamic", "coast", "triangle", "multistep", "chirp")


@pytest.mark.parametrize("pace", [{}, {"ramp": 0.5, "step": 3.5}], ids=["ordinary", "gentle"])
@pytest.mark.parametrize("name", MECHANISMS)
def test_coasting_to_rest_or_onto_a_stop_is_sound(name, pace):
    rng = np.random.default_rng([4, list(MECHANISMS).index(name)])
    log = simulate(MECHANISMS[name].draw(rng), Routine(kinds=EVERY, **pace), rng=rng)

    found = inspect(log).damages

    assert {run.kind for run in log.runs} == set(EVERY)
    assert not found


# The acceptance


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_found_where_it_struck(name, sound_logs, table):
    tried = seed = 0
    others: Counter[str] = Counter()
    missed = []
    while tried < SEEDS:
        log = sound_logs(seed, FAULTS[name].types)
        seed += 1
        assert seed < 2 * SEEDS, f"{name} can hardly ever strike"
        with suppress(BadRequest):  # too brief for this log to show
            spoilt = None
            spoilt = damaged(log, name, seed=seed)
        if spoilt is None:
            continue
        tried += 1
        seen = inspect(spoilt.log).damages
        if not all(
            any(true.overlap(it.where) >= OVERLAP for it in seen if it.fault == name)
            for true in spoilt.where
        ):
            missed.append(seed)
        others.update({it.fault for it in seen} - {name})

    found = tried - len(missed)
    confused = ", ".join(f"{count} {other}" for other, count in others.most_common())
    table.append(f"{name:17} {found:4} of {tried} found; also said: {confused or 'nothing'}")
    assert found >= FOUND * tried, f"{table[-1]}; missed with the seeds {missed}"
    assert sum(others.values()) <= (1.0 - FOUND) * tried, table[-1]


def test_sound_logs_come_out_clean(sound_logs, table):
    alarms = [(seed, it.fault) for seed in range(CLEAN) for it in inspect(sound_logs(seed)).damages]

    logs = len({seed for seed, _ in alarms})
    table.append(f"{'(nothing wrong)':17} {logs:4} of {CLEAN} with a false alarm: {alarms}")
    assert logs < FALSE * CLEAN, alarms
