"""The frame of both commands: what a person sees when something goes wrong, and the exit code."""

import os
import subprocess
from dataclasses import replace

import click
import numpy as np
import pytest

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.core.errors import BadRequest
from sim.support.command_line import quote_path, run_command


def command(outcome):
    """A command that does what ``outcome`` does."""
    return click.Command("try", callback=outcome)


def raiser(error):
    def outcome():
        raise error

    return outcome


@pytest.mark.parametrize(
    ("outcome", "code"),
    [(lambda: None, 0), (lambda: 0, 0), (lambda: 1, 1), (raiser(KeyboardInterrupt()), 130)],
    ids=["nothing said", "done", "not right", "Ctrl+C"],
)
def test_exit_code_of_a_command_reports_its_result(outcome, code, capsys):
    assert run_command(command(outcome), name="try", arguments=[]) == code
    assert capsys.readouterr().err.strip() == ""  # click ends the line of a typed ^C


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (
            BadRequest("too  much", where="x.csv", advice="Ask\nless."),
            "try: x.csv: too much. Ask less.",
        ),
        (MemoryError(), "try: this needs more memory than there is. Try a smaller file."),
        (ZeroDivisionError("by zero"), "try: our mistake, not yours (ZeroDivisionError: by zero)."),
        (click.ClickException("No."), "try: No."),
    ],
    ids=lambda value: type(value).__name__,
)
def test_an_error_gets_one_line_and_exit_code_2(error, said, capsys):
    assert run_command(command(raiser(error)), name="try", arguments=[]) == 2

    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith(said)
    assert shown.err.count("\n") == 1


@pytest.mark.parametrize(
    "arguments",
    [
        ("contaminate", "robot.wpilog", "--fault", "sign-flip", "-o", "robot.wpilog"),
        ("contaminate", "robot.wpilog", "--fault", "sign-flip", "-o", "../logs/robot.wpilog"),
        ("contaminate", "robot.wpilog", "--fault", "sign-flip", "-o", "link.wpilog"),
        ("fit", "robot.wpilog", "--wpilog", "robot.wpilog"),
        ("fit", "robot.wpilog", "--html", "robot.wpilog"),
        ("fit", "robot.wpilog", "--plot", "robot.wpilog"),
        ("fit", "other.wpilog", "robot.wpilog", "--wpilog", "robot.wpilog"),
        ("fit", "other.wpilog", "--straight", "robot.wpilog", "--mass", "9", "--plot=robot.wpilog"),
        ("reconcile", "other.wpilog", "--held-out", "robot.wpilog", "--html", "robot.wpilog"),
        ("simulate", "drivetrain", "-o", "new.csv", "--truth", "new.csv"),
    ],
    ids=" ".join,
)
def test_no_command_overwrites_what_it_reads(arguments, tmp_path, monkeypatch, capsys):
    folder = tmp_path / "logs"
    folder.mkdir()
    monkeypatch.chdir(folder)
    log = simulate(MECHANISMS["drivetrain"], Routine(timeout=1.0), rng=np.random.default_rng(1))
    for name in ("robot.wpilog", "other.wpilog"):
        sim.write(log, folder / name)
    (folder / "link.wpilog").hardlink_to(folder / "robot.wpilog")
    before = {path: path.read_bytes() for path in folder.iterdir()}

    assert run_command(sysid, name="sysid", arguments=list(arguments)) == 2

    said = capsys.readouterr()
    assert said.out == ""
    assert "this would overwrite" in said.err
    assert said.err.count("\n") == 1
    assert {path: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.skipif(os.sep != "/", reason="what a POSIX shell reads")
@pytest.mark.parametrize("name", ["a b", "$HOME", 'a"b', "a`b", "a\\b", "a\\$b", "it's"])
def test_quoted_path_survives_a_posix_shell(name):
    shown = subprocess.run(
        ["/bin/sh", "-c", f"printf %s {quote_path(name)}"],
        capture_output=True, encoding="utf-8", check=True, timeout=20,
    )  # fmt: skip

    assert shown.stdout == name


def test_the_next_command_quotes_a_name_with_a_space(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    made = ["simulate", "drivetrain", "-o", "my log.csv", "--seed", "1", "--timeout", "2"]
    damaged = ["contaminate", "my log.csv", "--fault", "missing-test@dynamic-reverse"]

    assert run_command(sysid, name="sysid", arguments=made) == 0
    assert 'Next: sysid fit "my log.csv"' in capsys.readouterr().out
    assert run_command(sysid, name="sysid", arguments=[*damaged, "-o", "less of it.csv"]) == 0
    said = capsys.readouterr().out
    assert said.splitlines()[0] == "missing-test: dynamic-reverse"
    assert 'Next: sysid inspect "less of it.csv"' in said


@pytest.mark.parametrize("suffix", ["wpilog", "csv"])
def test_a_number_that_no_mechanism_has_is_refused(suffix, tmp_path, capsys):
    log = simulate(MECHANISMS["drivetrain"], Routine(timeout=2.0), rng=np.random.default_rng(1))
    path = tmp_path / f"log.{suffix}"
    sim.write(log, path)

    assert run_command(sysid, name="sysid", arguments=["fit", str(path), "--pick", "3"]) == 2
    said = capsys.readouterr().err
    assert "it holds one mechanism, so there is no number 3. Leave out --pick." in said
    assert run_command(sysid, name="sysid", arguments=["fit", str(path), "--pick", "1"]) == 0


def change_runs(**change):
    """A drivetrain's log with a signal times a factor."""
    log = simulate(MECHANISMS["drivetrain"], Routine(step=3.5), rng=np.random.default_rng(1))
    runs = (
        replace(run, **{name: factor * getattr(run, name) for name, factor in change.items()})
        for run in log.runs
    )
    return replace(log, runs=tuple(runs))


def test_times_in_milliseconds_get_the_advice_of_seconds_and_no_other(tmp_path, capsys):
    path = tmp_path / "log.csv"
    sim.write(change_runs(time=1000.0), path)

    assert run_command(sysid, name="sysid", arguments=["fit", str(path)]) == 2
    said = capsys.readouterr().err
    assert said.strip().endswith("Give times in seconds.")
    assert "--velocity-scale" not in said
    assert run_command(sysid, name="sysid", arguments=["inspect", str(path)]) == 1
    assert capsys.readouterr().out.splitlines()[0].endswith("4 runs, not inspected.")


@pytest.mark.parametrize("name", ["", *sysid.list_commands(click.Context(sysid))])
def test_every_command_has_help_that_fits_a_screen(name, capsys):
    assert run_command(sysid, name="sysid", arguments=[*name.split(), "--help"]) == 0

    assert max(map(len, capsys.readouterr().out.splitlines())) <= 100


def test_wrong_option_names_the_help_to_read(capsys):
    assert run_command(command(lambda: None), name="try", arguments=["--wrong"]) == 2

    assert "'try --help'" in capsys.readouterr().err
