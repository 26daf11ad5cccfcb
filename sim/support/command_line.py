"""Code of both commands: exit codes, one-line errors, and consoles of any encoding."""

import codecs
import io
import os
import re
import sys
from collections.abc import Sequence
from difflib import get_close_matches

import click

from sim.core.errors import Refusal
from sim.support.printable import make_printable

DONE, NOT_RIGHT, COULD_NOT = 0, 1, 2
INTERRUPTED = 130  # exit code of a shell for Ctrl+C
TRACEBACK = "SYSID_TRACEBACK"  # environment variable: show tracebacks of unexpected errors

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
    """Run a command and return its exit code, without a traceback.

    A refusal, a wrong option or an unexpected error becomes one line on standard error and code 2.
    With the environment variable SYSID_TRACEBACK, errors are raised instead.

    Args:
        command: the command; its callback returns an exit code, or None for 0.
        name: name of the command in messages.
        arguments: its arguments; None takes those of the process.
    """
    _allow_any_encoding()
    try:
        code = command.main(arguments, prog_name=name, standalone_mode=False)
        sys.stdout.flush()
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message())  # the help, with its own line breaks
        return DONE
    except (KeyboardInterrupt, click.Abort):
        return INTERRUPTED
    except BrokenPipeError:  # the reader of the output has closed it, as `head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return COULD_NOT
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        print_error(_describe_error(error, name=name), name=name)
        return COULD_NOT
    return code if isinstance(code, int) else DONE


def print_error(text: str, *, name: str) -> None:
    """Print one line to standard error.

    Args:
        text: the line; line breaks in it become spaces.
        name: name of the command, printed first.
    """
    plain = make_printable(click.unstyle(text))  # texts of other programs may be colored
    click.echo(f"{name}: {' '.join(plain.split())}", err=True)


def quote_path(path: str | os.PathLike[str]) -> str:
    """A path as one word of a command line, in double quotes if a shell would split it.

    Double quotes work in PowerShell, cmd and POSIX shells.

    Args:
        path: path of a file in a suggested command.
    """
    text = os.fspath(path)
    if re.fullmatch(r"[A-Za-z0-9_./:~+-]+", text.replace(os.sep, "/")):
        return text
    if os.sep == "/":
        text = re.sub(r'([\\$`"])', r"\\\1", text)
    return f'"{text}"'


def _describe_error(error: Exception, *, name: str) -> str:
    """The message for an error, in one sentence."""
    match error:
        case Refusal():
            return str(error)
        case click.UsageError():
            asked = error.ctx
            while asked and asked.command.hidden:
                asked = asked.parent
            see = asked.command_path if asked else name
            said = error.format_message().rstrip(".")
            if near := _find_similar_command(said, asked):
                said = f"{said}. Did you mean '{see} {near}'?"
            return f"{said}{'' if said.endswith('?') else '.'} See '{see} --help'."
        case click.ClickException():
            return error.format_message()
        case MemoryError():
            return "this needs more memory than there is. Try a smaller file."
        case _:
            return (
                f"our mistake, not yours ({type(error).__name__}: {error}). Set {TRACEBACK}=1, run "
                "it again and report what it prints."
            )


def _find_similar_command(said: str, asked: click.Context | None) -> str:
    """The known command most like the unknown one in a message; empty if none is like it."""
    wrong = re.fullmatch(r"No such command '(.+)'", said)
    if wrong is None or asked is None or not isinstance(asked.command, click.Group):
        return ""
    return "".join(get_close_matches(wrong[1], asked.command.list_commands(asked), n=1))


def _allow_any_encoding() -> None:
    """Let both output streams print any text: characters outside their encoding become ASCII."""
    codecs.register_error("plain", _replace_unprintable)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="plain")


def _replace_unprintable(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end].translate(PLAIN)
    return lacking.encode("ascii", "replace").decode("ascii"), error.end
