"""``sysid simulate``."""

from pathlib import Path

import click

from sim.cli.options import FILE
from sim.errors import Refusal


@click.command()
@click.argument("mechanism")
@click.option("-o", "--output", type=FILE, required=True, help="Log to write: .wpilog or .csv.")
@click.option("--ramp", default=0.5, show_default=True, help="Quasistatic ramp [V/s].")
@click.option("--step", default=3.5, show_default=True, help="Dynamic step [V].")
@click.option("--timeout", default=10.0, show_default=True, help="End of a test [s].")
@click.option("--period", default=0.02, show_default=True, help="Loop of the robot program [s].")
@click.option("--seed", type=int, help="Same seed, same log; a new log every time without.")
@click.option("--truth", type=FILE, help="Also write the true gains to this JSON file.")
def simulate(  # noqa: PLR0917 - click passes options by name
    mechanism: str,
    output: Path,
    ramp: float,
    step: float,
    timeout: float,
    period: float,
    seed: int | None,
    truth: Path | None,
) -> None:
    """Run the four tests on a simulated MECHANISM and write the log a robot would.

    For example: sysid simulate drivetrain --seed 1 -o drive.wpilog
    """
    import numpy as np  # noqa: PLC0415 - as all below: --help must not wait for it

    from sim.formats import write  # noqa: PLC0415
    from sim.mechanisms import mechanism as find  # noqa: PLC0415
    from sim.routine import Routine  # noqa: PLC0415
    from sim.simulate import simulate as record  # noqa: PLC0415
    from sim.truth import write_truth  # noqa: PLC0415

    if seed is not None and seed < 0:
        raise click.BadParameter("a seed is zero or more.", param_hint="'--seed'")
    built = find(mechanism)
    routine = Routine(ramp=ramp, step=step, timeout=timeout)
    log = record(built, routine, rng=np.random.default_rng(seed), period=period)
    if truth:
        write_truth(built, routine, path=truth)
    try:
        write(log, output)
    except Refusal:
        if truth:  # the truth of a log that is not there would only mislead
            truth.unlink()
        raise
    samples = sum(len(part) for part in log.runs)
    click.echo(f"{output}: {len(log.runs)} tests, {samples} samples. Next: sysid fit {output}")
