"""Parts of a log that a fit does not use, named as on the command line."""

import json

import numpy as np
import pytest
from open_page import drive_log, slipped_log, write_log

from sim.cli import sysid
from sim.core.errors import BadRequest
from sim.core.leave_out import LeftOutPart, leave_out
from sim.support.command_line import run_command


def test_a_run_is_split_where_its_middle_is_left_out():
    log = drive_log()
    run = log.runs[0]
    part = LeftOutPart.parse(f"{run.test}:3-3.5")

    left = leave_out({"": log}, [part])[""]

    before, after = left.runs[:2]
    assert (before.test, after.test) == (run.test, run.test)
    assert before.time[-1] < 3.0
    assert after.time[0] > 3.5
    assert len(before) + len(after) == len(run) - np.count_nonzero(part.find(run))
    assert left.runs[2:] == log.runs[1:]


def test_rest_of_a_run_that_stands_still_is_left_out_too():
    log = drive_log(1, "arm")
    run = log.runs[0]
    first = run.time[run.moving][0]

    left = leave_out({"": log}, [LeftOutPart.parse(f"{run.test}:{first - 0.1:.3f}-99")])[""]

    assert left.runs == log.runs[1:]


@pytest.mark.parametrize(("until", "warns"), [(4.0, False), (8.0, True)])
def test_a_test_of_which_little_is_left_has_a_warning(until, warns):
    log = drive_log()
    run = log.runs[0]
    end = run.time[0] + until / 10.0 * (run.time[-1] - run.time[0])

    left = leave_out({"": log}, [LeftOutPart(run.test, 0.0, float(end))])[""]

    said = [doubt.message for doubt in left.doubts if doubt.code == "little-left"]
    assert bool(said) == warns
    assert all("of quasistatic-forward. What" in one for one in said)


def test_parts_that_overlap_are_left_out_together():
    log = drive_log()
    parts = [
        LeftOutPart("quasistatic-forward", 3.0, 4.0),
        LeftOutPart("quasistatic-forward", 3.2, 3.4),
    ]

    assert len(leave_out({"": log}, parts)[""].runs) == 5


@pytest.mark.parametrize(
    "text", ["", "forward", "dynamic-forward:5", "dynamic-forward:6-5", "dynamic-forward:1..2-3"]
)
def test_a_part_that_is_spelled_wrongly_is_refused(text):
    with pytest.raises(BadRequest) as refused:
        LeftOutPart.parse(text)

    assert "dynamic-forward:5.5-6" in refused.value.advice


def test_a_part_that_the_log_does_not_have_is_refused():
    log = drive_log()

    with pytest.raises(BadRequest) as absent:
        leave_out({"": log}, [LeftOutPart("dynamic-forward", 900.0, 901.0)])
    with pytest.raises(BadRequest) as empty:
        leave_out({"": log}, [LeftOutPart(run.test) for run in log.runs])

    assert "no samples of dynamic-forward, 900.00 to 901.00 s" in absent.value.what
    assert "nothing of the log is left" in empty.value.what


def fit(capsys, path, *options):
    """Exit code, output and error of `sysid fit`."""
    code = run_command(sysid, name="sysid", arguments=["fit", str(path), *options])
    said = capsys.readouterr()
    return code, said.out, said.err


def test_a_fit_without_the_slip_has_no_warning(tmp_path, capsys):
    path = write_log(slipped_log(), tmp_path / "slipped.csv")
    left_out = ("--leave-out", "quasistatic-forward:5.5-6")

    _, slipped, _ = fit(capsys, path, "--json")
    code, left, _ = fit(capsys, path, "--json", *left_out)
    _, said, _ = fit(capsys, path, *left_out)

    assert code == 0
    assert [one["code"] for one in json.loads(slipped)["warnings"]] == ["small-misfit"]
    assert json.loads(left)["warnings"] == []
    assert "Left out: quasistatic-forward, 5.50 to 6.00 s." in said


def test_robot_code_of_a_page_names_what_was_left_out(tmp_path, capsys):
    path, page = write_log(drive_log(), tmp_path / "log.csv"), tmp_path / "page.html"
    asked = ["fit", str(path), "--leave-out", "quasistatic-forward:3-3.5", "--html", str(page)]

    assert run_command(sysid, name="sysid", arguments=asked) == 0

    assert "// Left out: quasistatic-forward, 3.00 to 3.50 s" in page.read_text(encoding="utf-8")
    capsys.readouterr()


def test_a_fit_refuses_a_part_it_does_not_know(tmp_path, capsys):
    path = write_log(drive_log(), tmp_path / "drive.csv")

    code, _, said = fit(capsys, path, "--leave-out", "dynamic-forward:900-901")

    assert code == 2
    assert "cannot be left out" in said
