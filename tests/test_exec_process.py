"""A program in our place: its exit code is ours, and it does not outlive us."""

import os
import signal
import subprocess
import sys
import time

import pytest

from grader.setup.exec_process import run_process


@pytest.mark.parametrize("code", [0, 1, 2, 77])
def test_exit_code_of_the_program_is_returned(code):
    assert run_process([sys.executable, "-c", f"raise SystemExit({code})"]) == code


def test_program_runs_in_the_given_folder_with_the_given_arguments(tmp_path):
    program = "import os; open('found', 'w').write(os.environ['COLOR'])"

    assert (
        run_process(
            [sys.executable, "-c", program], cwd=tmp_path, env={**os.environ, "COLOR": "red"}
        )
        == 0
    )
    assert (tmp_path / "found").read_text(encoding="utf-8") == "red"


@pytest.mark.skipif(os.name == "nt", reason="Windows ends a process without telling it")
def test_ending_the_process_ends_the_one_that_it_started(root):
    child = "import os, time; print(os.getpid(), flush=True); time.sleep(60)"
    outer = (
        "import sys; from grader.setup.exec_process import run_process; "
        "sys.exit(run_process([sys.executable, '-c', {!r}]))"
    )
    ours = subprocess.Popen(
        [sys.executable, "-c", outer.format(child)],
        cwd=root,
        stdout=subprocess.PIPE,
        encoding="utf-8",
    )
    pid = int(ours.stdout.readline())

    ours.send_signal(signal.SIGTERM)

    assert ours.wait(30) == 130
    ours.stdout.close()
    for _ in range(100):
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.1)
    pytest.fail("the program is still running")
