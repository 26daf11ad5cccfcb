"""What every command of the project shares: exit codes, one-line errors, consoles of all kinds."""

import os
import sys
from collections.abc import Sequence
from typing import NoReturn

import click

from sim.errors import Refusal

DONE, NOT_RIGHT, COULD_NOT = 0, 1, 2
INTERRUPTED = 130  # what a shell reports for Ctrl+C
TRACEBACK = "SYSID_TRACEBACK"  # set in the environment, it shows a traceback for our own mistakes


def run(command: click.Command, *, name: str, arguments: Sequence[str] | None = None) -> NoReturn:
    """Run a command and leave the process with its exit code.

    A refusal, a wrong option or a mistake of ours becomes one line on standard error and code 2.

    Args:
        command: whose callback returns an exit code, or None for 0.
        name: as typed, for messages.
        arguments: None takes the process's own.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a Windows console may not speak UTF-8 by itself
            stream.reconfigure(encoding="utf-8", errors="replace")
    sys.exit(_outcome(command, name=name, arguments=arguments))


def _outcome(command: click.Command, *, name: str, arguments: Sequence[str] | None) -> int:
    try:
        code = command.main(arguments, prog_name=name, standalone_mode=False)
        sys.stdout.flush()
    except (KeyboardInterrupt, click.Abort):
        return INTERRUPTED
    except BrokenPipeError:  # the reader of our output has gone, as `head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        click.echo(" ".join(f"{name}: {_sentence(error, name=name)}".split()), err=True)
        return COULD_NOT
    return DONE if code is None else int(code)


def _sentence(error: Exception, *, name: str) -> str:
    """What a person reads instead of a traceback."""
    match error:
        case Refusal():
            return str(error)
        case click.UsageError():
            asked = error.ctx.command_path if error.ctx else name
            return f"{error.format_message()} See '{asked} --help'."
        case click.ClickException():
            return error.format_message()
        case MemoryError():
            return "this needs more memory than there is. Try a smaller file."
        case _:
            return (
                f"our mistake, not yours ({type(error).__name__}: {error}). Set {TRACEBACK}=1, run "
                "it again and report what it prints."
            )
