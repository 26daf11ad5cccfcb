"""The frame of both commands: what a person sees when something goes wrong, and the exit code."""

import click
import pytest

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
