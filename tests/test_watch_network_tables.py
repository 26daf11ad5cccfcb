"""`sysid watch --nt`: a robot over NetworkTables, with all that happens to a connection."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli.log_reader import LogReader
from sim.cli.watch.live_fit import LiveFit
from sim.cli.watch.network_tables import INTERRUPTED, NetworkTablesSource
from sim.core.errors import BadRequest
from sim.core.vocabulary import FOUR_TESTS
from sim.fit import fit
from sim.io import list_entries, read, write
from sim.report.next_test import ENOUGH

pytestmark = pytest.mark.robot
pytest.importorskip("ntcore", reason="pyntcore is not installed")

READ = LogReader().read_file
PATIENCE = 60.0  # [s] for what takes a moment
SEVERAL = 3  # values of a topic, of which the first may have been there before


class Robot:
    """A robot of its own process that publishes runs of a log (``robot_on_network.py``).

    Its values come early, in no time at all, so that a test need not last as long as a run.
    """

    def __init__(self, port, path):
        script = Path(__file__).with_name("robot_on_network.py")
        self.process = subprocess.Popen(
            [sys.executable, str(script), str(port), str(path)], stdin=subprocess.PIPE
        )
        self.clock = 10.0  # [s] since it started, to which the times of the next run are moved

    def publish(self, run, *, share=1.0, ends=True):
        """Publish a run of the log, or its first part."""
        asked = {"run": run, "share": share, "ends": ends, "clock": self.clock}
        self.process.stdin.write(json.dumps(asked).encode() + b"\n")
        self.process.stdin.flush()
        self.clock += 20.0

    def stop(self):
        """The robot is switched off."""
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()


@pytest.fixture
def drive(tmp_path):
    """The four tests of a drivetrain, whose voltage is the same all through a step; their file."""
    log = simulate(MECHANISMS["drivetrain"], Routine(step=3.5), rng=np.random.default_rng(1))
    write(log, tmp_path / "drive.wpilog")
    return log


@pytest.fixture
def start(port, tmp_path, drive):  # noqa: ARG001 - the file of that log has to be there
    """Starts a robot; all are off in the end."""
    robots = []

    def make():
        robots.append(Robot(port, tmp_path / "drive.wpilog"))
        return robots[-1]

    yield make
    for one in robots:
        if one.process.poll() is None:
            one.stop()


@pytest.fixture
def watched(tmp_path, port):
    """A fit that follows what is on the port."""
    source = NetworkTablesSource(f"127.0.0.1:{port}", folder=tmp_path / "kept")
    yield LiveFit(source, READ)
    source.close()


def wait_for(condition, look):
    """Look until a condition holds; what it gave."""
    ends = time.monotonic() + PATIENCE
    while not (found := condition(look())):
        assert time.monotonic() < ends, "it never came"
        time.sleep(0.02)
    return found


def wait_for_values(live, *, times=1):
    """Wait until values come in one by one, for the first time or again."""

    def beats(_):
        recordings = live.source.poll()
        if len(recordings) < times:
            return False
        entries = {one.name: len(one) for one in list_entries(recordings[-1].path)}
        return entries.get("NT:/Drive/Heartbeat", 0) > SEVERAL

    wait_for(beats, lambda: None)


def disconnect(live):
    """Wait until the source knows that it is not connected any more."""
    wait_for(lambda _: live.source.status.startswith("waiting"), live.poll)


def test_a_constant_voltage_is_held_and_the_gains_are_those_of_the_kept_file(drive, start, watched):
    robot = start()
    wait_for_values(watched)
    said = []
    for number in range(4):
        robot.publish(number)
        update = wait_for(lambda one: one, watched.poll)
        said.append((update.tests, update.advice))

    (kept,) = watched.last.paths
    voltage = next(one for one in list_entries(kept) if one.name == "NT:/Drive/VoltageVolts")
    steps = sum(run.kind == "dynamic" for run in drive.runs)
    ramps = sum(len(run) for run in drive.runs if run.kind == "quasistatic")
    assert len(voltage) == ramps + steps  # a step has one value
    assert [tests for tests, _ in said] == [(test,) for test in FOUR_TESTS]
    assert said[-1][1] == ENOUGH
    assert watched.last.pooled.found.gains == fit(read(kept)).in_log_units().gains
    expected = fit(drive).in_log_units().gains
    assert watched.last.pooled.found.gains == pytest.approx(expected, rel=0.01)


def test_a_robot_that_starts_again_loses_the_test_that_was_running_and_no_other(start, watched):
    robot = start()
    wait_for_values(watched)
    robot.publish(0)
    wait_for(lambda one: one, watched.poll)
    robot.publish(1, share=0.5, ends=False)
    running = watched.source.poll()[0].growing.list_tests
    wait_for(lambda _: len(running()) > 1, watched.poll)
    robot.stop()
    disconnect(watched)
    robot = start()
    wait_for_values(watched, times=2)
    for number in (1, 2, 3):
        robot.publish(number)
        update = wait_for(lambda one: one, watched.poll)

    first, second = update.paths
    assert [run.test for run in read(first).runs] == ["quasistatic-forward"]
    assert [run.test for run in read(second).runs] == [*FOUR_TESTS[1:]]
    texts = next(one for one in list_entries(first) if "SysIdState" in one.name).texts()
    assert INTERRUPTED in texts
    assert sorted(run.test for run in update.log.runs) == sorted(FOUR_TESTS)
    assert update.advice == ENOUGH


def test_test_that_began_before_the_watch_does_not_count(start, port, tmp_path):
    robot = start()
    robot.clock = -60.0
    robot.publish(0, share=0.5, ends=False)
    source = NetworkTablesSource(f"127.0.0.1:{port}", folder=tmp_path / "late")
    live = LiveFit(source, READ)
    wait_for_values(live)
    robot.clock = 60.0
    robot.publish(1)
    update = wait_for(lambda one: one, live.poll)
    source.close()

    assert update.tests == ("quasistatic-reverse",)
    assert [run.test for run in update.log.runs] == ["quasistatic-reverse"]


@pytest.mark.parametrize("address", ["", "no such host", "http://x", "localhost:x", "99999"])
def test_invalid_network_address_is_refused(tmp_path, address):
    with pytest.raises(BadRequest, match="is not an address|no team"):
        NetworkTablesSource(address, folder=tmp_path)
