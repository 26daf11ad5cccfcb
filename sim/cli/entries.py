"""``sysid entries``."""

import json
from pathlib import Path

import click

from sim.cli.options import FILE, as_json
from sim.io import list_entries
from sim.io.entries.discovery import identify_signal
from sim.io.entries.entry import NUMBERS, STRING, Entry
from sim.io.entries.state import names_tests
from sim.io.entries.units import find_unit_text


@click.command()
@click.argument("file", type=FILE)
@as_json
def entries(file: Path, *, as_json: bool) -> None:
    """List the entries of a robot's log.

    The command also says which motor signal an entry seems to be.

    For example: sysid entries robot.wpilog

    Pass the right entries to `sysid fit` with --voltage, --position and --velocity.
    """
    rows = [describe_entry(entry) for entry in list_entries(file)]
    rows.sort(key=lambda row: (not row["signal"], row["name"]))
    if as_json:
        click.echo(json.dumps(rows, allow_nan=False))
        return
    width = max((len(str(row["name"])) for row in rows), default=0)
    click.echo(f"{len(rows)} entries:")
    for row in rows:
        line = f"{row['signal'] or '-':12} {row['name']!s:{width}}  {row['type']}, {row['values']}"
        click.echo(f"{line} {row['unit']}".rstrip())


def describe_entry(entry: Entry) -> dict[str, object]:
    """An entry as plain data; ``signal`` is empty if it is not a motor's signal."""
    found = identify_signal(entry.name, entry.metadata) if entry.type in NUMBERS else None
    device, signal = found or ("", "")
    if entry.type == STRING and names_tests(entry):
        signal = "state"
    return {
        "name": entry.name, "type": entry.type, "values": len(entry), "signal": signal,
        "motor": device, "unit": find_unit_text(entry, signal),
    }  # fmt: skip
