"""What cannot be reconciled is refused in one line: what, where, and what to record instead."""

from dataclasses import replace

import numpy as np
import pytest
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


def changed(log, **change):
    """A log whose every run has something else for some of its arrays."""
    return replace(
        log,
        runs=tuple(
            replace(one, **{name: f(one) for name, f in change.items()}) for one in log.runs
        ),
    )


def short(log, *, count, runs=4):
    """Its first runs, of so many samples."""
    arrays = ("time", "voltage", "position", "velocity")
    cut = [replace(r, **{name: getattr(r, name)[:count] for name in arrays}) for r in log.runs]
    return replace(log, runs=tuple(cut[:runs]))


def stepped(one):
    return np.full(len(one), 4.0 if one.test.endswith("forward") else -4.0)


RECORD = "Record the four SysId tests, and repeat them with another step."
ALONE = {
    "one run": (
        short(LOG, count=10**6, runs=1),
        f"drive.csv: 1 run with 199 samples cannot show what a model lacks. {RECORD}",
    ),
    "ten samples": (
        short(LOG, count=10, runs=1),
        f"drive.csv: 1 run with 10 samples cannot show what a model lacks. {RECORD}",
    ),
    "three samples of each": (
        short(LOG, count=3),
        f"drive.csv: runs of three samples or fewer do not show what a model lacks. {RECORD}",
    ),
    "no runs": (
        Log((), units="meters", source="drive.csv"),
        f"drive.csv: runs of three samples or fewer do not show what a model lacks. {RECORD}",
    ),
    "the same voltage all along": (
        changed(LOG, voltage=stepped),
        (
            "drive.csv: the voltage is 4 V whenever it moves, so friction, speed and inertia "
            "cannot be told apart. Add a quasistatic test, or a step of another size."
        ),
    ),
    "no voltage": (
        changed(LOG, voltage=lambda one: 0.0 * one.voltage),
        (
            "drive.csv: the voltage is 0 V from beginning to end. Log the voltage that is applied "
            "to the motor."
        ),
    ),
    "no motion": (
        changed(LOG, velocity=lambda one: 0.0 * one.velocity),
        (
            "drive.csv: the mechanism hardly moves in this log. Run the tests with a higher "
            "voltage, or hold the button longer."
        ),
    ),
    "plus is minus": (
        changed(LOG, voltage=lambda one: -one.voltage),
        (
            "drive.csv: a positive voltage drives it backward. Invert the encoder or the motor, so "
            "that a positive voltage gives a positive velocity, and record again."
        ),
    ),
}
SAME = "Give logs of one mechanism, in the same units."
FOUR = "Use a log with the four tests, recorded with another step."
BESIDE = {
    "of a shooter": (
        replace(session(bench("shooter"), "validation"), units="meters", source="other.csv"),
        r"other\.csv: a speed takes none of the voltage that it takes in drive\.csv\. " + SAME,
    ),
    "in an angle": (
        session(bench("turret"), "validation"),
        r"positions in degrees, where drive\.csv has meters\. Give logs of one mechanism\.",
    ),
    "in feet that pass for meters": (
        changed(
            OTHER, velocity=lambda r: r.velocity / 0.3048, position=lambda r: r.position / 0.3048
        ),
        r"other\.csv: a speed takes 0\.\d+ times the voltage that it takes in drive\.csv\. " + SAME,
    ),
    "the other way round": (
        changed(OTHER, voltage=lambda one: -one.voltage),
        r"other\.csv: it goes the other way than drive\.csv at the same voltage\. " + SAME,
    ),
    "that never moves": (
        changed(OTHER, velocity=lambda one: 0.001 * one.velocity),
        r"other\.csv: the mechanism hardly moves in this log\. " + FOUR,
    ),
    "of three samples": (
        short(OTHER, count=3),
        r"other\.csv: the mechanism hardly moves in this log\. " + FOUR,
    ),
    "without a voltage": (
        changed(OTHER, voltage=lambda one: 0.0 * one.voltage),
        r"other\.csv: the voltage is 0 V from beginning to end\. Log the voltage",
    ),
}


@pytest.mark.parametrize("name", ALONE)
def test_a_log_that_cannot_answer_is_refused_in_one_line(name):
    log, said = ALONE[name]

    with pytest.raises(Refusal) as refused:
        reconcile(log, type="simple")

    assert str(refused.value) == said


@pytest.mark.parametrize("role", ["validation", "held_out"])
@pytest.mark.parametrize("name", BESIDE)
def test_a_log_of_something_else_is_refused_beside_a_good_one(role, name):
    log, said = BESIDE[name]

    with pytest.raises(Refusal, match=said):
        reconcile(LOG, type="simple", **{role: log})


@pytest.mark.parametrize(
    ("type_", "travel", "said"),
    [
        ("arm", None, "an arm's position must be an angle, and this log is in meters. Add --units"),
        (
            "simple",
            0.5,
            "and the travel is 0.5. Give the distance from stop to stop, in the log's un",
        ),
        ("simple", -1.0, "and the travel is -1. Give the distance"),
        ("simple", float("nan"), "and the travel is nan. Give the distance"),
    ],
)
def test_a_wrong_word_about_a_log_is_refused(type_, travel, said):
    with pytest.raises(BadRequest, match=said):
        reconcile(LOG, type=type_, travel=travel)


@pytest.mark.parametrize("other", [OTHER, DRIVE["held_out"], short(OTHER, count=10**6, runs=1)])
def test_other_runs_of_the_same_mechanism_are_welcome(other):
    check_logs(Recordings(LOG, other, other, type="simple"), travel=None)


def test_voltages_of_other_moments_are_not_refused_for_they_are_no_mechanism_s():
    # the verdict on them is "unexplained": a refusal would say that another file is wrong
    rng = np.random.default_rng(1)
    mixed = changed(LOG, voltage=lambda one: rng.permutation(one.voltage))

    check_logs(Recordings(mixed, OTHER, OTHER, type="simple"), travel=None)


CUT = "after the damaged parts are cut out, "


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("validation", f"other.csv: {CUT}no run is left to predict. "),
        ("held_out", f"other.csv: {CUT}nothing is left to show the gap on. "),
    ],
)
def test_a_log_of_which_nothing_is_left_is_refused(name, said):
    damages = [
        DamagedInterval(n, 0.0, 1e6, "voltage-dropout", 1.0, "It was lost.", "Check it.")
        for n in range(len(OTHER.runs))
    ]

    with pytest.raises(NotIdentifiable) as found:
        reconcile(LOG, **{name: OTHER}, type="simple", damages={name: damages})

    assert str(found.value) == said + "Inspect the log, and record it again."


def test_a_run_without_samples_is_refused():
    empty = replace(OTHER, runs=(*OTHER.runs, *short(OTHER, count=0, runs=1).runs))

    with pytest.raises(NotIdentifiable) as found:
        reconcile(LOG, validation=empty, type="simple")

    assert str(found.value) == (
        "other.csv: run 5 (quasistatic-forward) has no samples. Leave this run out."
    )


def test_a_type_that_is_none_is_refused():
    with pytest.raises(BadRequest) as found:
        reconcile(LOG, type="turret")

    assert str(found.value) == ("unknown type 'turret'. Choose one of: simple, elevator, arm.")


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


def test_between_drop_outs_that_the_motor_felt_a_log_is_believed():
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
    ("arguments", "said"),
    [
        (["ten.csv"], "1 run with 10 samples cannot show what a model lacks. Record the four"),
        (["nan.csv"], "nan.csv, line 101: velocity is nan. Write a number there, or remove the l"),
        (["good.csv", "--held-out", "inf.csv"], "inf.csv, line 101: velocity is inf. Write a n"),
        (["good.csv", "--validation", "none.csv"], "none.csv: there is no such file."),
        (["good.csv", "--held-out", "ten.csv"], "the mechanism hardly moves in this log. Use a"),
        (["good.csv", "--travel", "0"], "and the travel is 0. Give the distance from stop to stop"),
    ],
)
def test_the_command_says_it_in_one_line_and_exits_with_2(files, capsys, arguments, said):
    named = [str(files / one) if one.endswith(".csv") else one for one in arguments]

    code = run_command(sysid, name="sysid", arguments=["reconcile", *named, "--json"])

    shown = capsys.readouterr()
    assert (code, shown.out) == (2, "")
    assert shown.err.count("\n") == 1
    assert said in shown.err


def test_what_is_refused_is_refused_as_what_it_is():
    for name, kind in (("one run", NotIdentifiable), ("plus is minus", BadRequest)):
        with pytest.raises(kind):
            reconcile(ALONE[name][0], type="simple")
