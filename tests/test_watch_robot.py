"""The robot of exercise 6 runs its four tests in WPILib's simulation, and `sysid watch` follows."""

import json
import queue
import subprocess
import sys
import threading

import pytest
from sysid_process import START, run_sysid

from sim.core.vocabulary import FOUR_TESTS
from sim.report.next_test import ENOUGH

pytestmark = [pytest.mark.slow, pytest.mark.robot]
pytest.importorskip("commands2", reason="RobotPy is not installed")
pytest.importorskip("ntcore", reason="pyntcore is not installed")

PACE = 4.0  # times as fast as on a robot
PATIENCE = 60.0  # [s] for the next line


class Watch:
    """A `sysid watch --json` that runs, and its lines as they come."""

    def __init__(self, *arguments, cwd):
        self.process = subprocess.Popen(
            [sys.executable, "-c", START, "watch", "--json", *map(str, arguments)],
            cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
        )  # fmt: skip
        self.lines = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            self.lines.put(json.loads(line))

    def next(self):
        """What is said next."""
        return self.lines.get(timeout=PATIENCE)

    def end(self):
        """End it, and say what went wrong."""
        self.process.kill()
        return self.process.communicate()[1]


def run_robot(root, folder, *arguments, port):
    """Let the robot run its tests to their end."""
    script = root / "exercises" / "exercise6" / "robot.py"
    done = subprocess.run(
        [
            sys.executable, str(script), str(folder / "logs"), "--pace", str(PACE),
            "--port", str(port), *arguments,
        ],
        cwd=folder, capture_output=True, encoding="utf-8", check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


def test_growing_log_gives_after_each_test_the_gains_of_the_whole_file(root, tmp_path, port):
    (tmp_path / "logs").mkdir()
    watch = Watch(tmp_path / "logs", cwd=tmp_path)
    try:
        run_robot(root, tmp_path, "--wait", "3", port=port)
        said = [watch.next() for _ in FOUR_TESTS]
    finally:
        errors = watch.end()

    assert errors == ""
    assert [one["tests"] for one in said] == [[test] for test in FOUR_TESTS]
    assert said[1]["next"] == "dynamic-forward and dynamic-reverse are missing."
    assert said[-1]["next"] == ENOUGH
    assert said[-1]["recorded"] == list(FOUR_TESTS)
    (path,) = said[-1]["files"]
    assert (
        said[-1]["fit"]["gains"]
        == json.loads(run_sysid("fit", "--json", path, folder=tmp_path).stdout)["gains"]
    )
    assert said[-1]["fit"]["gains"] == pytest.approx(
        {"kS": 0.15, "kV": 2.5238, "kA": 0.1911}, rel=0.02
    )
