"""What cannot be reconciled is refused in one line: what, where, and what to record instead."""

import math
from dataclasses import replace

import numpy as np
import pytest
from handmade import change_signals
from reconcile_made import bench, logs, session

import sim
from sim.cli import sysid
from sim.core.errors import BadRequest, NotIdentifiable, Refusal
from sim.core.log import Log
from sim.inspect.dropout_intervals import find_dropout_intervals
from sim.reconcile import DamagedInterval, reconcile
from sim.reconcile.input_checks import check_logs
from sim.reconcile.recordings import Recordings
from sim.support.command_line import run_command

DRIVE = logs("drivetrain")
LOG = replace(DRIVE["log"], source="drive.csv")
OTHER = replace(DRIVE["validation"], source="other.csv")


def short(log, *, count, runs=4):
    """Its first runs, of so many samples."""
    arrays = ("time", "voltage", "position", "velocity")
    cut = [replace(r, **{name: getattr(r, name)[:count] for name in arrays}) for r in log.runs]
    return replace(log, runs=tuple(cut[:runs]))


def stepped(one):
    return np.full(len(one), 4.0 if one.test.endswith("forward") else -4.0)


ALONE = {
    "one run": (short(LOG, count=10**6, runs=1), NotIdentifiable),
    "ten samples": (short(LOG, count=10, runs=1), NotIdentifiable),
    "three samples of each": (short(LOG, count=3), NotIdentifiable),
    "no runs": (Log((), units="meters", source="drive.csv"), NotIdentifiable),
    "the same voltage all along": (change_signals(LOG, voltage=stepped), NotIdentifiable),
    "no voltage": (change_signals(LOG, voltage=lambda one: 0.0 * one.voltage), Refusal),
    "no motion": (change_signals(LOG, velocity=lambda one: 0.0 * one.velocity), Refusal),
    "plus is minus": (change_signals(LOG, voltage=lambda one: -one.voltage), BadRequest),
}
SHOOTER = replace(session(bench("shooter"), "validation"), units="meters", source="other.csv")
BESIDE = {
    "of a shooter": SHOOTER,
    "in an angle": session(bench("turret"), "validation"),
    "in feet that pass for meters": change_signals(
        OTHER, velocity=lambda r: r.velocity / 0.3048, position=lambda r: r.position / 0.3048
    ),
    "the other way round": change_signals(OTHER, voltage=lambda one: -one.voltage),
    "that never moves": change_signals(OTHER, velocity=lambda one: 0.001 * one.velocity),
    "of three samples": short(OTHER, count=3),
    "without a voltage": change_signals(OTHER, voltage=lambda one: 0.0 * one.voltage),
    "with an empty run": replace(OTHER, runs=(*OTHER.runs, *short(OTHER, count=0, runs=1).runs)),
}


@pytest.mark.parametrize(("log", "kind"), ALONE.values(), ids=ALONE)
def test_log_that_cannot_answer_is_refused_in_one_line(log, kind):
    with pytest.raises(kind) as refused:
        reconcile(log, type="simple")

    assert refused.value.where == "drive.csv"
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("role", ["validation", "held_out"])
@pytest.mark.parametrize("log", BESIDE.values(), ids=BESIDE)
def test_second_log_that_cannot_be_compared_is_refused_by_its_name(role, log):
    with pytest.raises(Refusal) as refused:
        reconcile(LOG, type="simple", **{role: log})

    assert str(refused.value).startswith(log.source)


@pytest.mark.parametrize(
    "words",
    [
        {"type": "arm"}, {"type": "turret"}, *({"travel": one} for one in (0.5, -1.0, math.nan)),
    ],
)  # fmt: skip
def test_impossible_type_or_travel_is_refused(words):
    with pytest.raises(BadRequest):
        reconcile(LOG, **{"type": "simple", **words})


@pytest.mark.parametrize("other", [OTHER, DRIVE["held_out"], short(OTHER, count=10**6, runs=1)])
def test_other_runs_of_the_same_mechanism_are_accepted_as_held_out(other):
    check_logs(Recordings(LOG, other, other, type="simple"), travel=None)


def test_shuffled_voltages_are_not_refused():
    # the verdict on them is "unexplained": a refusal would say that another file is wrong
    rng = np.random.default_rng(1)
    mixed = change_signals(LOG, voltage=lambda one: rng.permutation(one.voltage))

    check_logs(Recordings(mixed, OTHER, OTHER, type="simple"), travel=None)


@pytest.mark.parametrize("name", ["validation", "held_out"])
def test_log_without_usable_samples_is_refused(name):
    damages = [
        DamagedInterval(n, 0.0, 1e6, "voltage-dropout", 1.0, "It was lost.", "Check it.")
        for n in range(len(OTHER.runs))
    ]

    with pytest.raises(NotIdentifiable) as refused:
        reconcile(LOG, **{name: OTHER}, type="simple", damages={name: damages})

    assert refused.value.where == "other.csv"


def test_runs_that_were_recorded_once_are_counted_once():
    repeats = replace(OTHER, runs=(*OTHER.runs, LOG.runs[2]))
    recordings = Recordings(LOG, repeats, LOG, type="simple")

    assert Recordings(LOG, None, OTHER, type="simple").count_repeated_runs("held_out") == 0
    assert recordings.count_repeated_runs("validation") == 1
    assert recordings.count_repeated_runs("held_out") == 4
    twice = replace(LOG, runs=(*LOG.runs, *LOG.runs[:2]))
    assert Recordings(LOG, None, None, type="simple").count_repeated_runs("log") == 0
    assert Recordings(twice, None, None, type="simple").count_repeated_runs("log") == 2


# -- drop-outs -----------------------------------------------------------------------------------


def dropped(one, *, felt):
    """A run in which the voltage falls to a third for 20 ms every 0.4 s, with or without motion."""
    low = np.flatnonzero((np.arange(len(one)) % 20 == 10) & (one.time - one.time[0] > 1.0))
    volts, speed = one.voltage.copy(), one.velocity.copy()
    volts[low] /= 3.0
    if felt:
        speed[low + 1] *= 0.7
    return replace(one, voltage=volts, velocity=speed), [
        float(one.time[place]) for place in low[:-1]
    ]


def test_samples_between_true_voltage_dropouts_are_used():
    spoilt, low = dropped(LOG.runs[2], felt=True)

    found = find_dropout_intervals(spoilt, start=low[0], end=low[-1])

    assert [start for start, _ in found] == low
    time = spoilt.time.tolist()  # the speed falls one sample later, and is back after another one
    assert [time.index(end) - time.index(start) for start, end in found] == [2] * len(low)


def test_a_record_that_lost_its_voltage_is_left_out_from_the_first_to_the_last():
    spoilt, low = dropped(LOG.runs[2], felt=False)

    assert find_dropout_intervals(spoilt, start=low[0], end=low[-1]) == ((low[0], low[-1]),)


# -- command -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Logs as files: a good one, one with a number that is none, one of ten samples."""
    folder = tmp_path_factory.mktemp("logs")
    sim.write(LOG, folder / "good.csv")
    sim.write(ALONE["ten samples"][0], folder / "ten.csv")
    lines = (folder / "good.csv").read_text(encoding="utf-8").splitlines()
    for name in ("nan", "inf"):
        cells = lines[100].split(",")
        spoilt = [*lines[:100], ",".join([*cells[:-1], name]), *lines[101:]]
        (folder / f"{name}.csv").write_text("\n".join(spoilt) + "\n", encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    "arguments",
    [
        ["ten.csv"],
        ["nan.csv"],
        ["good.csv", "--held-out", "inf.csv"],
        ["good.csv", "--validation", "none.csv"],
        ["good.csv", "--travel", "0"],
    ],
)
def test_command_refuses_in_one_line_and_exits_with_2(files, capsys, arguments):
    named = [str(files / one) if one.endswith(".csv") else one for one in arguments]

    code = run_command(sysid, name="sysid", arguments=["reconcile", *named, "--json"])

    shown = capsys.readouterr()
    assert (code, shown.out) == (2, "")
    assert shown.err.count("\n") == 1
    assert arguments[-1].removeprefix("0") in shown.err
