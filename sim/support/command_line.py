"""Shared by both commands: exit codes, one-line errors, and consoles of any encoding."""

import codecs
import io
import os
import re
import sys
from collections.abc import Sequence

import click

from sim.core.errors import Refusal
from sim.support.printable import make_printable

DONE, NOT_RIGHT, COULD_NOT = 0, 1, 2
INTERRUPTED = 130  # what a shell reports for Ctrl+C
TRACEBACK = "SYSID_TRACEBACK"  # set in the environment, it shows a traceback for our own mistakes

PLAIN = str.maketrans(
    {
        "✓": "+", "✗": "x", "→": ">", "–": "-", "—": "-", "…": "...", "×": "x", "·": "*",
        "²": "^2", "³": "^3", "±": "+-", "≈": "~", "≥": ">=", "≤": "<=", "π": "pi", "τ": "tau",
        "−": "-", "“": '"', "”": '"', "’": "'", "°": "deg", "α": "alpha", "θ": "theta",
    }
)  # fmt: skip


def run_command(
    command: click.Command, *, name: str, arguments: Sequence[str] | None = None
) -> int:
    """Run a command and return its exit code; nothing gets out as a traceback.

    A refusal, a wrong option or a mistake of ours becomes one line on standard error and code 2.

    Args:
        command: whose callback returns an exit code, or None for 0.
        name: as typed, for messages.
        arguments: None takes the process's own.
    """
    _any_encoding()
    try:
        code = command.main(arguments, prog_name=name, standalone_mode=False)
        sys.stdout.flush()
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message())  # the help, with its own line breaks
        return DONE
    except (KeyboardInterrupt, click.Abort):
        return INTERRUPTED
    except BrokenPipeError:  # the reader of our output has gone, as `head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return COULD_NOT
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        print_error(_sentence(error, name=name), name=name)
        return COULD_NOT
    return code if isinstance(code, int) else DONE


def print_error(said: str, *, name: str) -> None:
    """Print one line to standard error.

    Args:
        said: the line; line breaks in it become spaces.
        name: the command that says it.
    """
    plain = make_printable(click.unstyle(said))  # what other programs say may be colored
    click.echo(f"{name}: {' '.join(plain.split())}", err=True)


def quote_path(path: str | os.PathLike[str]) -> str:
    """A path as one word of a command line: in double quotes, where a shell would split it.

    Double quotes work in PowerShell, cmd and POSIX shells.

    Args:
        path: of a file that a suggested command names.
    """
    text = os.fspath(path)
    if re.fullmatch(r"[A-Za-z0-9_./:~+-]+", text.replace(os.sep, "/")):
        return text
    if os.sep == "/":
        text = re.sub(r'([\\$`"])', r"\\\1", text)
    return f'"{text}"'


def _sentence(error: Exception, *, name: str) -> str:
    """What a person reads instead of a traceback."""
    match error:
        case Refusal():
            return str(error)
        case click.UsageError():
            asked = error.ctx
            while asked and asked.command.hidden:
                asked = asked.parent
            see = asked.command_path if asked else name
            return f"{error.format_message().rstrip('.')}. See '{see} --help'."
        case click.ClickException():
            return error.format_message()
        case MemoryError():
            return "this needs more memory than there is. Try a smaller file."
        case _:
            return (
                f"our mistake, not yours ({type(error).__name__}: {error}). Set {TRACEBACK}=1, run "
                "it again and report what it prints."
            )


def _any_encoding() -> None:
    """Let both streams print anything: a sign their encoding lacks becomes plain letters."""
    codecs.register_error("plain", _plainly)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="plain")


def _plainly(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end].translate(PLAIN)
    return lacking.encode("ascii", "replace").decode("ascii"), error.end
