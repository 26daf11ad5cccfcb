"""sysid watch: what it follows, and what it says."""

import math
import os
import signal
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_course import HALF, RIGHT, answer
from sysid_process import START, run_sysid

from grader.cli import run_command
from grader.exercise.exercise import list_exercises
from grader.exercise.watch import watch_exercise
from grader.setup import doctor
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli.log_reader import LogReader
from sim.cli.watch.live_fit import LiveFit
from sim.cli.watch.recordings import FileSource
from sim.core.errors import BadRequest, UnreadableFile
from sim.core.vocabulary import FOUR_TESTS
from sim.feedback import Plant
from sim.feedback.following import follow_profile
from sim.feedback.profile import STEP, make_brisk_profile, make_return_profile
from sim.fit import fit
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.io import read, write
from sim.io.entries.state import NO_END
from sim.io.formats.wpilog.growing import GrowingLog
from sim.plot.consequence import Trace, make_profile_traces, plot_consequence
from sim.report.next_test import ENOUGH, advise_next, find_settled_step, find_voltage_limit

READ = LogReader().read_file


def drive_log(seed=1, **routine):
    """The four tests of a drivetrain."""
    rng = np.random.default_rng(seed)
    return simulate(MECHANISMS["drivetrain"], Routine(**{"step": 3.5, **routine}), rng=rng)


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    """The bytes of a log of four tests."""
    path = tmp_path_factory.mktemp("whole") / "drive.wpilog"
    write(drive_log(), path)
    return path.read_bytes()


def grow(path, content, share):
    """Let a file have a share of its content."""
    path.write_bytes(content[: round(share * len(content))])


@settings(max_examples=20)
@given(cuts=st.lists(st.floats(0.0, 1.0), max_size=6))
def test_growing_log_has_the_tests_of_the_whole_at_any_length(tmp_path_factory, content, cuts):
    path = tmp_path_factory.mktemp("grows") / "drive.wpilog"
    path.write_bytes(b"")
    growing = GrowingLog(path)
    before = ()
    for share in [*sorted(cuts), 1.0]:
        with path.open("ab") as stream:
            stream.write(content[path.stat().st_size : round(share * len(content))])
        tests = growing.list_tests()
        finished = [one for one in tests if one.end != NO_END]
        assert list(before) == finished[: len(before)]  # nothing that was complete changes
        assert len(tests) - len(finished) <= 1
        before = finished

    assert [one.test for one in before] == list(FOUR_TESTS)
    assert [one.begin for one in before] == [one.begin for one in GrowingLog(path).list_tests()]


def test_each_test_is_reported_once_and_the_gains_are_those_of_the_file(tmp_path, content):
    path = tmp_path / "drive.wpilog"
    grow(path, content, 0.0)
    live = LiveFit(FileSource(path), READ)
    reported = []
    for share in np.linspace(0.0, 1.0, 41):
        grow(path, content, share)
        update = live.poll()
        reported += [] if update is None else [(update.tests, update.advice)]

    assert [tests for tests, _ in reported] == [(test,) for test in FOUR_TESTS]
    assert reported[0][1] == "quasistatic-reverse, dynamic-forward and dynamic-reverse are missing."
    assert reported[2][1] == "dynamic-reverse is missing."
    assert reported[3][1] == ENOUGH
    assert live.last.pooled.found.gains == fit(read(path)).in_log_units().gains
    assert live.poll() is None


def test_a_test_that_still_runs_is_left_out(tmp_path, content):
    whole = tmp_path / "whole.wpilog"
    whole.write_bytes(content)
    path = tmp_path / "drive.wpilog"
    grow(path, content, 0.9)  # in the middle of the last test
    live = LiveFit(FileSource(path), READ)
    update = live.poll()

    assert [run.test for run in update.log.runs] == list(FOUR_TESTS[:3])
    assert not {one.code for one in update.log.doubts} & {"truncated", "unfinished-run"}
    log = read(whole)
    expected = fit(replace(log, runs=log.runs[:3]))
    assert update.pooled.found.gains == expected.in_log_units().gains


def test_watching_continues_after_a_file_is_renamed(tmp_path, content):
    path = tmp_path / "FRC_TBD_1.wpilog"
    grow(path, content, 0.6)
    live = LiveFit(FileSource(path), READ)
    first = live.poll()
    path = path.rename(tmp_path / "FRC_20260214_153000.wpilog")
    with path.open("ab") as stream:
        stream.write(content[path.stat().st_size :])
    second = live.poll()

    assert len(first.tests) + len(second.tests) == 4
    assert second.paths == (path,)
    assert len(second.log.runs) == 4


def test_file_that_starts_again_adds_to_the_finished_tests(tmp_path, content):
    path = tmp_path / "robot.wpilog"
    grow(path, content, 0.6)
    live = LiveFit(FileSource(path), READ)
    done = live.poll().tests
    other = tmp_path / "other" / "robot.wpilog"
    other.parent.mkdir()
    log = drive_log(seed=2)
    write(replace(log, runs=log.runs[2:]), other)
    grow(path, b"", 0.0)
    assert live.poll() is None
    path.write_bytes(other.read_bytes())
    update = live.poll()

    assert update.tests == FOUR_TESTS[2:]
    assert [run.test for run in update.log.runs] == [*done, *FOUR_TESTS[2:]]


def test_in_a_folder_logs_of_another_day_do_not_count(tmp_path, content):
    old = tmp_path / "old.wpilog"
    old.write_bytes(content)
    live = LiveFit(FileSource(tmp_path), READ)
    assert live.poll() is None
    assert live.source.status == f"waiting for a log that grows in the folder {tmp_path}"
    new = tmp_path / "new.wpilog"
    grow(new, content, 0.6)
    first = live.poll()
    restarted = tmp_path / "restarted.wpilog"
    restarted.write_bytes(content)
    second = live.poll()

    assert (first.paths, second.paths) == ((new,), (new, restarted))
    assert second.tests == FOUR_TESTS
    assert len(second.log.runs) == len(first.log.runs) + 4


def test_missing_file_or_non_log_is_refused(tmp_path):
    with pytest.raises(UnreadableFile, match="no such file or folder"):
        FileSource(tmp_path / "missing.wpilog")
    foreign = tmp_path / "foreign.wpilog"
    foreign.write_text("this is a text and no log at all", encoding="utf-8")
    with pytest.raises(UnreadableFile, match="does not begin with WPILOG"):
        LiveFit(FileSource(foreign), READ).poll()


# ---- what to do next


def advise(log, *, last):
    """The advice about a log whose last test is named."""
    return advise_next(log, found=fit(log), inspection=inspect(log), last=(last,))


def test_a_run_that_is_damaged_is_repeated_before_others_are_asked_for():
    log = contaminate(
        drive_log(), "encoder-slip", severity=1.0, test="quasistatic-forward", at=4.5,
        rng=np.random.default_rng(1),
    ).log  # fmt: skip
    log = replace(log, runs=log.runs[:2])

    assert advise(log, last="quasistatic-forward").startswith("Repeat quasistatic-forward: ")
    assert advise(log, last="quasistatic-reverse") == (
        "dynamic-forward and dynamic-reverse are missing."
    )


def test_step_cut_by_a_current_limit_is_repeated_with_a_smaller_voltage():
    robot = replace(MECHANISMS["drivetrain"], stator=40.0)
    log = simulate(robot, Routine(step=5.0), rng=np.random.default_rng(1), electrical=True)
    run = log.list_runs_of_test("dynamic-forward")[0]
    lasts, volts = find_voltage_limit(run)
    said = advise(log, last="dynamic-forward")
    freed = simulate(
        robot, Routine(step=float(said.split()[-2])), rng=np.random.default_rng(1), electrical=True
    )

    assert 0.02 <= lasts < 0.5
    assert volts < 3.0
    assert said.startswith("dynamic-forward met a current limit or a weak battery: for ")
    assert find_voltage_limit(freed.list_runs_of_test("dynamic-forward")[0]) is None


def test_step_that_hit_its_stop_is_repeated_with_a_smaller_voltage():
    log = drive_log()
    log = contaminate(
        log, "hard-stop", severity=1.0, test="dynamic-forward", at=0.4,
        rng=np.random.default_rng(1),
    ).log  # fmt: skip
    said = advise(log, last="dynamic-forward")

    assert said.startswith("dynamic-forward reached its end after ")
    assert 0.0 < float(said.split("with ")[1].split()[0]) < 3.5


@given(
    kv=st.floats(0.05, 10.0), ka=st.floats(0.01, 2.0), ks=st.floats(0.0, 1.0),
    way=st.floats(0.01, 10.0),
)  # fmt: skip
def test_a_settled_step_has_95_percent_of_its_speed_at_the_end_of_the_way(kv, ka, ks, way):
    volts = find_settled_step({"kS": ks, "kV": kv, "kA": ka}, way)
    time_ = np.linspace(0.0, 3.0 * ka / kv, 2001)
    speed = (volts - ks) / kv * -np.expm1(-time_ * kv / ka)
    gone = float(np.sum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time_)))

    assert gone == pytest.approx(way, rel=1e-4)
    assert speed[-1] / ((volts - ks) / kv) == pytest.approx(0.95, abs=0.001)


# ---- the command


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "Give either a log or folder, or --nt ADDRESS"),
        (["a.wpilog", "--nt", "localhost"], "Give either a log or folder, or --nt ADDRESS"),
        (["a.wpilog", "--save", "kept"], "--save keeps what NetworkTables sends"),
        (["missing.wpilog"], "missing.wpilog: there is no such file or folder. Give the .wpilog"),
    ],
)
def test_file_that_cannot_be_watched_is_refused_in_one_line(tmp_path, arguments, said):
    done = run_sysid("watch", *arguments, folder=tmp_path)

    assert (done.returncode, done.stdout) == (2, "")
    assert said in done.stderr
    assert done.stderr.count("\n") == 1


def test_without_pyntcore_one_line_says_what_to_install(tmp_path):
    hidden = "import sys; sys.modules['ntcore'] = None"
    done = run_sysid("watch", "--nt", "localhost", folder=tmp_path, before=hidden)

    assert (done.returncode, done.stdout) == (2, "")
    assert 'needs pyntcore. Install it with: python -m pip install "pyntcore' in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.skipif(os.name == "nt", reason="Windows sends Ctrl-C to all of a console")
def test_ctrl_c_ends_the_watch_with_the_gains_of_the_file(tmp_path, content):
    path = tmp_path / "drive.wpilog"
    path.write_bytes(content)
    code = (  # whatever started these tests may have it ignore Ctrl-C
        f"import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n{START}"
    )
    running = subprocess.Popen(
        [sys.executable, "-c", code, "watch", str(path)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
    )  # fmt: skip
    said = []
    while "  Next: " not in "".join(said[-1:]):
        said.append(running.stdout.readline())
        assert said[-1], running.stderr.read()
    running.send_signal(signal.SIGINT)
    rest, errors = running.communicate(timeout=60)
    found = run_sysid("fit", path)

    assert (running.returncode, errors) == (0, "")
    assert rest[rest.index("Verdict") :].strip() == found.stdout.strip()


DRIVE = {"kS": 0.15, "kV": 2.5, "kA": 0.2}
LIFT = {"kS": 0.25, "kV": 4.5, "kA": 0.2, "kG": 2.0}
ARM = {"kS": 0.25, "kV": 1.2, "kA": 0.08, "kG": 1.5, "offset_rad": 0.3}
UP = make_return_profile(0.5, rising=0.25, steady=0.75, still=1.0, start=0.5)
PLANTS = {"simple": DRIVE, "elevator": LIFT, "arm": ARM}


def followed(kind, *, wanted=UP, **changes):
    """A mechanism of a kind under a feedforward with some gains changed."""
    plant, believed = Plant(kind, PLANTS[kind]), Plant(kind, {**PLANTS[kind], **changes})
    place = {"simple": "way", "elevator": "height", "arm": "angle"}[kind]
    return follow_profile(
        plant, believed, wanted, name="mechanism", symbol="m", place=place, stops=(0.0, 1.3)
    )


@pytest.mark.parametrize("kind", PLANTS)
def test_right_gains_follow_the_profile(kind, reads):
    one = followed(kind)
    off = np.abs(np.subtract(one.position, one.target.position)).max()

    assert off < 0.015 * 0.5  # of the way
    reads(one.description)


@pytest.mark.parametrize("factor", [0.5, 1.0, 1.7])
def test_the_steady_speed_is_in_proportion_to_kv(factor):
    one = followed(
        "simple", wanted=make_brisk_profile(Plant("simple", DRIVE)), kV=factor * DRIVE["kV"]
    )
    place = one.target.cruise_end

    free = follow_profile(
        Plant("simple", DRIVE), Plant("simple", {**DRIVE, "kV": factor * DRIVE["kV"]}), one.target,
        name="mechanism", symbol="m",
    )  # fmt: skip
    assert free.velocity[place] == pytest.approx(factor * one.target.velocity[place], rel=1e-3)


def test_an_elevator_without_kg_falls_as_its_gains_say():
    one = followed("elevator", kG=0.0)
    at = int(0.5 / STEP)

    assert one.velocity[at] == pytest.approx(-(2.0 - 0.25) / 4.5, rel=1e-3)  # -(kG - kS)/kV
    assert min(one.position) == 0.0  # its stop


@pytest.mark.parametrize(
    ("kind", "changes"),
    [
        ("elevator", {"kG": 0.0}),
        ("elevator", {"kG": 5.5}),
        ("elevator", {"kG": 9.0}),
        ("elevator", {"kG": 2.2}),
        ("elevator", {"kV": 4.5 / 6.28}),
        ("elevator", {"kV": 0.0, "kS": 0.0}),
        ("elevator", {"kV": -4.5}),
        ("elevator", {"kV": 60.0}),
        ("simple", {"kA": 0.0}),
        ("simple", {"kA": 0.6}),
        ("arm", {"offset_rad": 0.3 - math.pi}),
    ],
)
def test_a_wrong_gain_is_described_by_its_effect_on_the_motion(kind, changes, reads):
    reads(followed(kind, **changes).description)


def test_consequence_that_cannot_be_drawn_is_refused(reads):
    short = Trace("thing", "way [m]", (0.0, 1.0), (0.0, 1.0), {"what it does": (0.0,)})

    with pytest.raises(BadRequest) as refused:
        plot_consequence([short], words="")
    reads(refused.value)
    with pytest.raises(BadRequest) as refused:
        plot_consequence([], words="")
    reads(refused.value)


def test_picture_shows_the_wanted_and_the_resulting_motion():
    one = followed("elevator", kG=0.0)

    drawn = plot_consequence(make_profile_traces(one), words=one.description)

    speed, height = drawn.figure.axes
    wanted, done = height.get_lines()
    assert one.description in drawn.alt
    assert speed.get_ylabel() == "velocity [m/s]"
    assert wanted.get_ydata()[0] == done.get_ydata()[0] == 0.5
    assert done.get_ydata().min() == 0.0 < wanted.get_ydata().min()


def saves(course, *texts):
    """Somebody who saves one text after another while the watch waits."""
    left = list(texts)

    def wait(_seconds):
        if not left:
            raise KeyboardInterrupt
        text = left.pop(0)
        if text:
            answer(course, text)

    return wait


def test_file_is_graded_at_each_save_until_all_is_right(course, monkeypatch, capsys):
    monkeypatch.setattr("time.sleep", saves(course, "", "", HALF, "size = [\n", RIGHT))
    monkeypatch.setattr(
        "grader.exercise.watch.watch_exercise.__kwdefaults__", {"wait": __import__("time").sleep}
    )

    assert run_command(["watch"]) == 0
    said = capsys.readouterr()
    assert [line for line in said.out.splitlines() if " points, " in line] == [
        "✗ exercise1: 0 of 3 points, not all right yet  (answers.toml)",
        "✗ exercise1: 2.5 of 3 points, not all right yet  (answers.toml)",
        "✓ exercise1: 3 of 3 points, all right  (answers.toml)",
    ]
    assert "cannot be read" in said.err  # half a file, saved on the way
    assert "Waiting for exercises/exercise1/answers.toml to be saved" in said.out
    assert said.out.endswith("Everything here is done.\n")


def test_the_watch_ends_at_once_when_asked(course):
    (one,) = list_exercises(course)
    grades = []

    with pytest.raises(KeyboardInterrupt):
        watch_exercise(one, grade=lambda: grades.append(1) or 1, wait=saves(course))
    assert grades == [1]


def test_watching_waits_for_a_file_that_is_briefly_missing(course):
    (one,) = list_exercises(course)
    path = one.folder / "answers.toml"
    codes = [1, 1, 0]
    steps = [path.unlink, lambda: answer(course, RIGHT)]

    assert watch_exercise(one, grade=lambda: codes.pop(0), wait=lambda _: steps.pop(0)()) == 0
    assert codes == []


def test_plain_output_of_grade_has_words_in_place_of_symbols(course, capsys):
    answer(course, HALF)
    run_command(["1", "--plain"])
    out = capsys.readouterr().out

    assert out.splitlines()[:3] == [
        "not right yet: exercise1: 2.5 of 3 points, not all right yet  (answers.toml)",
        "",
        "right: The size is 3, 2 of 2 points",
    ]
    assert not set("✓✗–") & set(out)
    run_command(["--plain"])
    assert "exercise1, Measure: 2.5 of 3\n" in capsys.readouterr().out


def test_a_finished_exercise_shows_where_the_solution_is(course, capsys):
    answer(course, RIGHT)
    run_command(["1"])
    assert "for comparison" not in capsys.readouterr().out  # a class's package has none
    (course / "solutions" / "exercise1").mkdir(parents=True)
    run_command(["1"])
    assert "A solution, for comparison: solutions/exercise1" in capsys.readouterr().out
    answer(course, HALF)
    run_command(["1"])
    assert "for comparison" not in capsys.readouterr().out


@pytest.mark.usefixtures("course")
def test_doctor_finds_no_problem_on_this_machine(capsys):
    assert run_command(["doctor"]) == 0
    out = capsys.readouterr().out
    for what in ("Python", "packages", "simulation", "course", "learners' code", "RobotPy"):
        assert what in out
    assert "isolated" in out or "limited" in out


def test_the_doctor_says_what_is_missing_and_what_to_do(course, capsys, monkeypatch):
    monkeypatch.setattr(doctor, "NEEDED", ("numpy", "no-such-package"))
    monkeypatch.setattr(doctor, "ROBOT", ("no-such-robot",))

    assert run_command(["doctor"]) == 1
    out = capsys.readouterr().out
    assert "no-such-package is not installed" in out
    assert 'python -m pip install "ipywidgets' in out
    assert "– RobotPy         no-such-robot is not installed" in out
    assert course.is_dir()
