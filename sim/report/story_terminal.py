"""Print a reconcile story on a terminal."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from sim.reconcile.story import Finding, Story
from sim.reconcile.story_text import (
    FAULT,
    describe_gains,
    describe_size,
    format_gap,
    format_parameter,
    list_gain_doubts,
    list_gains,
    list_inspections,
    list_next_tests,
    list_remarks,
    write_headline,
)
from sim.report.terminal import WARNING, WrappedPrinter

COLUMNS, BAR = 80, 40  # [characters] of a line, and of the longest bar
PLACES = 5  # places listed where the base model disagrees most

ShowStep = Callable[[str, float], None]


@contextmanager
def show_progress() -> Iterator[ShowStep]:
    """A progress bar on the terminal; yields a function of a step's text and the share done.

    If standard error is not a terminal, nothing is drawn.
    """
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda _, __: None
        return
    columns = (TextColumn("{task.description:32}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda words, share: bar.update(task, description=words, completed=share)


def show_story(story: Story, *, title: str, console: Console | None = None) -> None:
    """Print the verdict, then the findings and gaps behind it.

    Args:
        story: result of ``reconcile``.
        title: names of the files.
        console: where to print; standard output if None.
    """
    say = WrappedPrinter(console, widest=COLUMNS)
    say(title)
    say(write_headline(story), style="bold")
    for one in story.findings:
        _print_finding(say, one, story)
    say("")
    _print_gains(say, story)
    say("")
    _print_gaps(say, story)
    if story.where:
        say("")
        say("Where the base model disagrees most:")
    for place in story.where[:PLACES]:
        say(place.sentence, indent=2)
    say("")
    say(f"{story.how} The sensor noise is measured in the velocity signal, without a model.")
    for test in list_next_tests(story):
        say(f"Test to run next: {test}", style="bold")
    for message in list_remarks(story):
        say(f"warning: {message}", hang=9, style=WARNING)


def _print_finding(say: WrappedPrinter, one: Finding, story: Story) -> None:
    say("")
    name = " or ".join([one.effect, *one.ambiguous_with])
    say(f"{name} ({describe_size(one)})", style="bold")
    say(one.sentence, indent=2)
    for name, estimate in one.parameters.items():
        say(format_parameter(name, estimate), indent=2)
    if one.kind != FAULT:
        before, after = (format_gap(gap, story) for gap in (one.gap_before, one.gap_after))
        say(f"The simulation error goes from {before} to {after} times the noise.", indent=2)
    for head, text in list_inspections(one):
        say(f"{head}: {text}", indent=2)


def _print_gains(say: WrappedPrinter, story: Story) -> None:
    say(f"{describe_gains(story)} (± is one standard error):")
    for name, with_, without in list_gains(story):
        beside = "" if with_ == without else f"; without: {without}"
        say(f"{name} {with_}{beside}", indent=2)
    for doubt in list_gain_doubts(story):
        say(doubt.text)


def _print_gaps(say: WrappedPrinter, story: Story) -> None:
    """Print the gap of each model as a bar of ASCII characters."""
    say("The gap is the simulation error divided by the sensor noise (1 means only noise):")
    names = ["base model", *(f"+ {one.added}" for one in story.chapters[1:])]
    wide = max(map(len, names))
    most = max(story.gap_before, *(one.gap for one in story.chapters), story.noise_floor)
    for name, chapter in zip(names, story.chapters, strict=True):
        share = chapter.gap / most if most > 0.0 and most < float("inf") else 0.0
        bar = "#" * round(BAR * share)
        say(f"{name}{'.' * (wide - len(name))} {bar} {format_gap(chapter.gap, story)}", indent=2)
