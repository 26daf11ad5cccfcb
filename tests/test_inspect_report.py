"""What ``sysid inspect`` prints: a paragraph for each kind of fault, and nothing that misleads."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from handmade import each

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli.inspect import LINES
from sim.cli.inspect import inspect as command
from sim.core.errors import BadRequest
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.io import write
from sim.physics.battery import Battery

GENTLE = Routine(ramp=0.5, step=3.5)


def bench(name="drivetrain", *, period=0.02, seed=0):
    return simulate(MECHANISMS[name], GENTLE, rng=np.random.default_rng(seed), period=period)


def browned_out(*, seed=5, step=3.5):
    """A weak battery under a drivetrain: the controller takes its motors off again and again."""
    weak = replace(MECHANISMS["drivetrain"], battery=Battery(11.6, 0.035))
    routine = Routine(ramp=1.0, step=step)
    return simulate(weak, routine, rng=np.random.default_rng(seed), electrical=True)


def printed(log, tmp_path):
    write(log, tmp_path / "log.csv")
    shown = CliRunner().invoke(command, [str(tmp_path / "log.csv")], standalone_mode=False)
    return shown.return_value, shown.output.splitlines()


# One paragraph for each kind


def test_many_faults_fit_on_a_screen(tmp_path):
    log = bench()
    for seed, (name, test) in enumerate(
        [("hard-stop", "dynamic-reverse"), ("encoder-slip", "quasistatic-reverse"),
         ("loop-overrun", "quasistatic-forward"), ("stuck-sensor", "quasistatic-forward"),
         ("noisy-standstill", "quasistatic-forward"), ("missing-test", "dynamic-forward")]
    ):  # fmt: skip
        log = contaminate(log, name, test=test, rng=np.random.default_rng(seed)).log
    log = log.join(log).join(log)

    code, lines = printed(log, tmp_path)

    kinds = {fault.fault for fault in inspect(log).faults}
    assert code == 1
    assert len(kinds) >= 5
    assert all(sum(line.startswith(f"{kind}: ") for line in lines) == 1 for kind in kinds)
    assert len(lines) <= LINES
    assert lines[-1] == "Add --json to list everything."
    assert max(len(line) for line in lines[1:]) <= 80


# Frames that repeat


# Brownouts


@pytest.mark.parametrize("seed", range(5))
def test_simulated_brownout_is_reported_as_brownout_only(seed):
    found = inspect(browned_out(seed=seed))

    assert {fault.fault for fault in found.faults} == {"brownout"}
    assert {fault.where.test for fault in found.faults} == {"dynamic-forward", "dynamic-reverse"}
    worst = found.group_by_kind()[0][0]
    assert "falls to 5.8 V" in worst.evidence
    assert "smaller step than 3.5 V" in worst.advice


def test_a_voltage_that_is_cut_again_and_again_is_a_brownout_without_the_bus():
    log = each(browned_out(), lambda run: replace(run, bus_voltage=None, current=None))

    assert {fault.fault for fault in inspect(log).faults} == {"brownout"}


def test_a_bus_that_stays_up_is_no_brownout():
    rng = np.random.default_rng(3)
    log = simulate(MECHANISMS["drivetrain"], GENTLE, rng=rng, electrical=True)
    cut = contaminate(log, "brownout", rng=np.random.default_rng(1)).log
    steady = each(cut, lambda run: replace(run, bus_voltage=np.full(len(run), 12.3)))

    assert "brownout" in {fault.fault for fault in inspect(cut).faults}
    assert "brownout" not in {fault.fault for fault in inspect(steady).faults}


# Runs that stand first, and teams that count the other way


def test_team_with_reversed_directions_gets_no_mislabelled_test():
    turned = {"forward": "reverse", "reverse": "forward"}
    log = each(bench(), lambda run: replace(run, test=f"{run.kind}-{turned[run.direction]}"))

    assert inspect(log).is_clean


# Advice from this log


# Several files


def inspected(folder, *options, **logs):
    """What the command prints about some logs, each in a file of its own."""
    for name, log in logs.items():
        write(log, folder / f"{name}.wpilog")
    files = [str(folder / f"{name}.wpilog") for name in logs]
    shown = CliRunner().invoke(command, [*files, *options], standalone_mode=False)
    return shown.return_value, shown.output


@pytest.mark.parametrize("fault", ["unit-error", "encoder-slip", "sign-flip"])
def test_several_files_get_the_same_faults_as_each_file_alone(fault, tmp_path):
    bad = contaminate(bench(), fault, rng=np.random.default_rng(1)).log
    _, alone = inspected(tmp_path, "--json", bad=bad)
    _, others = inspected(tmp_path, "--json", first=bench(seed=1), bad=bad, last=bench(seed=2))

    def listed(text, offset):
        return [
            (one["fault"], one["run"] + offset, one["start_s"], one["confidence"])
            for one in json.loads(text)["faults"]
        ]

    assert listed(alone, 4) == listed(others, 0) != []


def test_files_with_one_test_each_are_one_log(tmp_path):
    log = bench()
    parts = {run.test: replace(log, runs=(run,)) for run in log.runs}
    code, said = inspected(tmp_path, **parts)
    assert code == 0, said

    parts.pop("dynamic-reverse")
    _, said = inspected(tmp_path, **parts)
    assert said.count("missing-test") == 1
    assert "missing-test: dynamic-reverse" in said


def test_a_file_that_is_given_twice_is_refused(tmp_path):
    write(bench(), tmp_path / "log.wpilog")
    path = str(tmp_path / "log.wpilog")

    with pytest.raises(BadRequest, match=r"log\.wpilog: this file is given twice"):
        CliRunner().invoke(command, [path, path], standalone_mode=False, catch_exceptions=False)


# One wild reading
