"""What happens once: at its moment on one clock, and over by the next log, or there for good."""

from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import bench, session, told

from sim.effects import EFFECTS
from sim.evidence import clocks, gather
from sim.log import Log, Run
from sim.model import Part
from sim.reconcile.lanes import ended_after, in_a_row, lanes

PERIOD, LATER = 0.02, 1e6  # [s]
JOINS = 0.6  # [1] of kA


def log_of(starts, *, lasts=1.0):
    time = np.arange(0.0, lasts + 0.5 * PERIOD, PERIOD)
    runs = (
        Run("dynamic-forward", start + time, np.full(time.size, 3.0), time**2, 2.0 * time)
        for start in starts
    )
    return Log(tuple(runs), units="meters", type="simple")


@pytest.mark.parametrize(
    ("first", "later"),
    [
        ([5.0, 9.0, 12.0], [1.0, 4.0, 7.5]),  # each log with a clock of its own
        ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),  # each run begins at zero
    ],
    ids=["a clock", "no clock"],
)
def test_two_logs_in_a_row_have_the_clock_of_their_lanes(first, later):
    one, other = log_of(first), log_of(later)

    row = in_a_row(one, other)

    begun = [lane.clock for lane in lanes(one)]
    begun += [lane.clock for lane in lanes(other, session=1, since=ended_after(one))]
    assert clocks(row) == pytest.approx(begun, abs=1e-5)
    assert begun[3] == pytest.approx(begun[2] + 1.0)  # no pause between the logs


def drives(*, onset, until):
    """Something joins at a moment of the log; what ends with its run is not in the others."""
    plain = bench("drivetrain")
    extra = JOINS * plain.gains["kA"]
    part = Part("inertia-change", {"extra": extra, "onset": onset, "until": until, "shared": 1.0})
    after = replace(part, parameters={**part.parameters, "onset": 0.0})
    once = replace(plain, hidden=(part,))
    others = plain if until < LATER else replace(plain, hidden=(after,))
    return extra, {
        "log": session(once, "log"),
        "validation": session(others, "validation"),
        "held_out": session(others, "held_out"),
    }


@pytest.fixture(scope="module")
def third():
    """Beginning of the third run of a plain log, on the log's clock."""
    return float(clocks(session(bench("drivetrain"), "log"))[2])


@pytest.mark.parametrize("until", [2.9, LATER], ids=["with its run", "for good"])
def test_what_joins_in_a_run_is_found_to_the_sample(third, until):
    onset = third + 0.513
    extra, sessions = drives(onset=onset, until=third + until if until < LATER else LATER)

    story = told(sessions)

    found = story.findings[0]
    assert found.effect == "inertia-change"
    assert found.parameters["onset"].value == pytest.approx(onset, abs=PERIOD)
    assert found.parameters["extra"].value == pytest.approx(extra, rel=0.15)
    assert story.gap_after < 1.2 * story.noise_floor


def test_a_drop_between_two_samples_is_where_the_search_begins(third):
    extra, sessions = drives(onset=third + 0.513, until=LATER)
    log = sessions["log"]
    evidence = gather(log, dict(bench("drivetrain").gains), type="simple")

    first, second, *_ = EFFECTS["inertia-change"].starts(evidence)

    assert first["onset"] == second["onset"] == pytest.approx(third + 0.513, abs=PERIOD)
    assert first["extra"] == pytest.approx(extra, rel=0.35)
    assert {first["shared"], second["shared"]} == {1.0}
    assert first["until"] < second["until"] == LATER


def test_a_run_without_a_drop_gives_no_such_start():
    log = session(bench("drivetrain"), "log")
    evidence = gather(log, dict(bench("drivetrain").gains), type="simple")

    first = next(iter(EFFECTS["inertia-change"].starts(evidence)))

    assert first["shared"] == 0.0
