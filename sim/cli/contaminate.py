"""``sysid contaminate``."""

from pathlib import Path

import click
import numpy as np

from sim.cli.log_reader import LogReader
from sim.cli.options import FAULT_NAMES, FILE, output_option, reading_options, refuse_overwriting
from sim.inspect.contaminate import contaminate_all, parse_fault_request
from sim.io import write
from sim.support.command_line import quote_path


@click.command()
@click.argument("file", type=FILE)
@reading_options
@click.option(
    "--fault",
    "faults",
    multiple=True,
    shell_complete=FAULT_NAMES,
    required=True,
    metavar="NAME[:SEVERITY][@TEST[+SECONDS]]",
    help="Fault to add; may be repeated. `sysid faults` lists them.",
)
@output_option
@click.option("--seed", type=click.IntRange(min=0), help="The same seed gives the same damage.")
def contaminate(
    file: Path,
    *,
    faults: tuple[str, ...],
    output: Path,
    seed: int | None,
    reader: LogReader,
) -> None:
    """Write a copy of the log FILE with a fault added to it.

    For example: sysid contaminate drive.csv --fault encoder-slip:0.5@dynamic-forward+0.4 -o bad.csv
    """
    refuse_overwriting(output, inputs=[file])
    asked = [parse_fault_request(text) for text in faults]
    log, where = contaminate_all(reader.read_recorded(file), asked, rng=np.random.default_rng(seed))
    write(log, output)
    for name, _, stretch in where:
        place = stretch.test or "the whole log"
        if stretch.run is not None and stretch.test:
            place += f" {stretch.start:.2f} to {stretch.end:.2f} s"
        click.echo(f"{name}: {place}")
    click.echo(f"{output}: written. Next: sysid inspect {quote_path(output)}")
