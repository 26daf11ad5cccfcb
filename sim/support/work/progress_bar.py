"""A progress bar for many jobs."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn


@contextmanager
def progress_bar(
    what: str, total: int, *, done: int = 0
) -> Iterator[tuple[Callable[[], None], Callable[[], int]]]:
    """A progress bar on standard error, if that is a terminal.

    Args:
        what: what is counted.
        total: number of steps.
        done: steps that are already done.

    Yields:
        A function that advances it by one step, and one that returns the number of steps done.
    """
    console = Console(stderr=True)
    columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as progress:
        task = progress.add_task(what, total=total, completed=done)
        yield lambda: progress.advance(task), lambda: int(progress.tasks[0].completed)
