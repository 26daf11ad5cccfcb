"""Completion of names in a shell, without importing the modules they name."""

import re
from collections.abc import Callable
from pathlib import Path

import click
from click.shell_completion import CompletionItem

NAME = re.compile(r'^    name="([\w-]+)"', re.MULTILINE)
Completion = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]


def complete_members(folder: Path) -> Completion:
    """A completion of the members of a catalogue, by the name in each file.

    Args:
        folder: folder of the catalogue.
    """

    def complete(
        _context: click.Context, _parameter: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        names = sorted(map(_read_name, folder.glob("[!_]*.py")))
        return [CompletionItem(name) for name in names if name.startswith(incomplete)]

    return complete


def _read_name(path: Path) -> str:
    """The name of a member, read from its source text, because an import would be too slow."""
    found = NAME.search(path.read_text(encoding="utf-8"))
    return found[1] if found else path.stem.replace("_", "-")


def explain_completion(command: str) -> str:
    """How to turn on completion, for the end of a command's help.

    Args:
        command: name of the command.
    """
    variable = f"_{command.upper()}_COMPLETE"
    return (
        "To complete names with Tab, run this once in each terminal. In bash: eval "
        f'"$({variable}=bash_source {command})"; in zsh: eval "$({variable}=zsh_source '
        f'{command})"; in fish: {variable}=fish_source {command} | source'
    )
