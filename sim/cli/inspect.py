"""``sysid inspect``."""

import json
from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate
from pathlib import Path

import click

from sim.cli.log_reader import LogReader, refuse_duplicates
from sim.cli.options import FILE, as_json, reading_options
from sim.core.doubt import Doubt, sort_doubts
from sim.inspect.detect_faults import Inspection, inspect_together
from sim.inspect.fault import Damage
from sim.support.command_line import DONE, NOT_RIGHT

SURE, LIKELY = 0.9, 0.7  # [1] lowest confidence that is called sure, or likely
LINES = 40  # [lines] of a report at most: it should fit on one screen of a terminal
WIDTH = 78  # [characters] of a line
PLACES = 4  # places that a paragraph lists; further ones are counted
RUNS = 8  # runs that a heading lists
ALL_IN_JSON = "Add --json to list everything."


@click.command()
@click.argument("files", nargs=-1, required=True, type=FILE)
@reading_options
@as_json
def inspect(
    files: tuple[Path, ...],
    *,
    reader: LogReader,
    as_json: bool,
) -> int:
    """Look for faults in the logs of one mechanism.

    The command says which fault the log has, where it is, and what to do.

    For example: sysid inspect drive.wpilog

    Exit code 0 means that no fault was found; 1 that there is a fault, or that the log could not
    be checked.
    """
    refuse_duplicates(files)
    logs = [reader.read_recorded(file) for file in files]
    found = inspect_together(logs)
    if as_json:
        click.echo(json.dumps(found.to_json(), allow_nan=False))
    else:
        _print_report(
            found, runs={str(file): len(log.runs) for file, log in zip(files, logs, strict=True)}
        )
    return DONE if found.is_clean else NOT_RIGHT


def _print_report(found: Inspection, *, runs: Mapping[str, int]) -> None:
    """Print one paragraph for each kind of fault, the worst first; then the doubts, on one screen.

    Args:
        found: what to show.
        runs: name of each file -> the number of its runs.
    """
    kinds = found.group_by_kind()
    count = len(kinds)
    result = f"{count} fault{'s' * (count > 1)} found" if count else "no fault found"
    if any(doubt.code == "odd-clock" for doubt in found.doubts):
        result = f"not inspected{f', {result}' * bool(count)}"
    total = sum(runs.values())
    click.echo(f"{', '.join(runs)}: {total} run{'s' * (total != 1)}, {result}.")
    lines_left = LINES - 2  # the title, and the sentence about what is left out
    if count and len(runs) > 1:
        lines = click.wrap_text(_name_runs(runs), width=WIDTH).splitlines()
        click.echo("\n".join(lines))
        lines_left -= len(lines)
    for left, kind in zip(range(count - 1, -1, -1), kinds, strict=True):
        head, *body = _write_paragraph(kind)
        if 2 + len(body) + 2 * left > lines_left:
            body = []
        click.echo("")
        click.secho(head, bold=True)
        for line in body:
            click.echo(line)
        lines_left -= 2 + len(body)
    _show_doubts(found.doubts, lines_left=lines_left, cut=any(len(kind) > PLACES for kind in kinds))


def _name_runs(runs: Mapping[str, int]) -> str:
    """The runs of each file, as ``Runs 0 to 3: a.wpilog; runs 4 to 7: b.wpilog``."""
    ends = list(accumulate(runs.values()))
    parts = [
        f"runs {end - count} to {end - 1}: {name}" if count > 1 else f"run {end - 1}: {name}"
        for (name, count), end in zip(runs.items(), ends, strict=True)
    ]
    text = "; ".join(parts)
    return f"{text[:1].upper()}{text[1:]}."


def _show_doubts(doubts: Iterable[Doubt], *, lines_left: int, cut: bool) -> None:
    """Print the doubts that fit into the lines left, grave ones first.

    If doubts are left out, or places were (``cut``), a line says how to list everything.
    """
    shown, ordered = [], sort_doubts(doubts)
    for doubt in ordered:
        text = click.wrap_text(f"warning: {doubt.text}", width=WIDTH, subsequent_indent=" " * 9)
        lines = text.splitlines()
        if len(lines) + 1 <= lines_left:
            shown += lines
            lines_left -= len(lines)
        else:
            cut = True
    for line in ["", *shown] if shown else []:
        click.echo(line)
    if cut:
        click.echo(ALL_IN_JSON)


def _write_paragraph(kind: Sequence[Damage]) -> list[str]:
    """The lines on the faults of one kind: where, what happened, what to do."""
    worst, several = kind[0], len(kind) > 1
    where = _list_runs(kind) if several else _describe_place(worst)
    confidence = max(damage.confidence for damage in kind)
    lines = [f"{worst.fault}: {where} ({name_confidence(confidence)}, {confidence:.2f})"]
    texts = [worst.evidence, str(worst.advice)]
    if several:
        places = [_describe_place(damage) for damage in sorted(kind, key=_sort_key)[:PLACES]]
        if len(kind) > PLACES:
            places.append(f"{len(kind) - PLACES} more")
        listed = [f"Found at {'; '.join(places)}."] if worst.where.run is not None else []
        texts[:1] = [*listed, _describe_example(worst)]
    for text in texts:
        wrapped = click.wrap_text(text, width=WIDTH, initial_indent="  ", subsequent_indent="  ")
        lines += wrapped.splitlines()
    return lines


def _list_runs(kind: Sequence[Damage]) -> str:
    """The runs that have faults of a kind; for faults of no single run, the tests."""
    runs = sorted({damage.where.run for damage in kind if damage.where.run is not None})
    if not runs:
        return ", ".join(damage.where.test or "the whole log" for damage in kind)
    count = f"{len(kind)} times in " if len(kind) > len(runs) else ""
    shown = [str(run) for run in runs[:RUNS]] + ["others"] * (len(runs) > RUNS)
    return f"{count}run{'s' * (len(runs) > 1)} {', '.join(shown)}"


def _describe_example(worst: Damage) -> str:
    run = worst.where.run
    return worst.evidence if run is None else f"In run {run}: {worst.evidence}"


def _sort_key(damage: Damage) -> tuple[int, float]:
    run = damage.where.run
    return (-1 if run is None else run, damage.where.start)


def _describe_place(damage: Damage) -> str:
    """Where a fault is: a stretch of a run, a test, or the whole log."""
    where = damage.where
    if not where.test:
        return "the whole log"
    if where.run is None:
        return where.test
    return f"run {where.run}, {where.test}, {where.start:.2f} to {where.end:.2f} s"


def name_confidence(confidence: float) -> str:
    """The word for a confidence: ``sure``, ``likely`` or ``perhaps``."""
    return "sure" if confidence >= SURE else "likely" if confidence >= LIKELY else "perhaps"
