"""The frame of both commands: what a person sees when something goes wrong, and the exit code."""

import click
import numpy as np
import pytest

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.core.errors import BadRequest
from sim.support.command_line import run_command


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
def test_a_command_leaves_with_the_code_its_work_earned(outcome, code, capsys):
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
def test_whatever_goes_wrong_is_one_line_and_exit_code_2(error, said, capsys):
    assert run_command(command(raiser(error)), name="try", arguments=[]) == 2

    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith(said)
    assert shown.err.count("\n") == 1


def test_a_wrong_option_names_the_help_to_read(capsys):
    assert run_command(command(lambda: None), name="try", arguments=["--wrong"]) == 2

    assert capsys.readouterr().err == "try: No such option '--wrong'. See 'try --help'.\n"


def test_a_developer_can_have_the_traceback(monkeypatch):
    monkeypatch.setenv("SYSID_TRACEBACK", "1")

    with pytest.raises(ZeroDivisionError):
        run_command(command(raiser(ZeroDivisionError())), name="try", arguments=[])


def test_a_command_alone_prints_its_help_with_line_breaks(capsys):
    assert run_command(sysid, name="sysid", arguments=[]) == 0

    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 10
    assert max(map(len, lines)) <= 100


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
