"""``sysid simulate``."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import click
import numpy as np

from sim.bench.ground_truth import write_ground_truth
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import find_mechanism as find
from sim.bench.recorder import find_recorder
from sim.bench.routine import Routine
from sim.bench.simulate import simulate as record
from sim.cli.options import (
    EFFECT_NAMES,
    FAULT_NAMES,
    FILE,
    MECHANISM_NAMES,
    output_option,
    refuse_overwriting,
)
from sim.core.errors import BadRequest, Refusal
from sim.core.log import Log
from sim.core.vocabulary import KINDS
from sim.inspect.contaminate import contaminate_all, parse_fault_request
from sim.io import write
from sim.physics.battery import CONTROLLERS, Battery
from sim.support.command_line import quote_path

PERIOD = 0.02  # [s] loop period of a robot program by default


@click.command()
@click.argument("mechanism", shell_complete=MECHANISM_NAMES)
@output_option
@click.option("--ramp", default=0.5, show_default=True, help="Quasistatic ramp [V/s].")
@click.option("--step", default=3.5, show_default=True, help="Dynamic step [V].")
@click.option("--timeout", default=10.0, show_default=True, help="End of a test [s].")
@click.option(
    "--recorder",
    metavar="NAME",
    help="The hardware that measures and logs, with its published rates, filters and delays. One "
    "of roborio, roborio-2020, talonfx, talonfx-canfd, signal-logger, phoenix5, sparkmax, "
    "sparkmax-encoder, venom.",
)
@click.option(
    "--period", type=float, help="Loop of the robot program [s].  [default: the recorder's, 0.02]"
)
@click.option(
    "--tests",
    metavar="KIND,…",
    default=",".join(KINDS[:2]),
    show_default=True,
    help=f"Kinds of test: {', '.join(KINDS)}.",
)
@click.option(
    "--hide",
    multiple=True,
    shell_complete=EFFECT_NAMES,
    metavar="EFFECT[:SIZE]",
    help=(
        "Effect to add that the model does not contain; may be repeated. `sysid effects` lists "
        "them."
    ),
)
@click.option(
    "--fault",
    "faults",
    multiple=True,
    shell_complete=FAULT_NAMES,
    metavar="NAME[:SEVERITY][@TEST[+SECONDS]]",
    help="Fault to add to the log; may be repeated. `sysid faults` lists them.",
)
@click.option(
    "--battery",
    metavar="VOLTS[:OHMS]",
    help="Voltage at rest and resistance, wires included.  [default: the mechanism's, 12.6:0.02]",
)
@click.option(
    "--controller",
    type=click.Choice(tuple(CONTROLLERS)),
    default="roborio2",
    show_default=True,
    help="Robot controller, for its brownout voltage.",
)
@click.option("--vary", is_flag=True, help="Draw another mechanism of this kind at random.")
@click.option("--electrical", is_flag=True, help="Record current and battery voltage, too.")
@click.option(
    "--seed", type=int, help="The same seed gives the same log. Without a seed, each log is new."
)
@click.option(
    "--truth", type=FILE, help="Also write the true gains, effects and faults to this JSON file."
)
def simulate(  # noqa: PLR0917 - click passes options by name
    mechanism: str,
    output: Path,
    ramp: float,
    step: float,
    timeout: float,
    recorder: str | None,
    period: float | None,
    tests: str,
    hide: tuple[str, ...],
    faults: tuple[str, ...],
    battery: str | None,
    controller: str,
    vary: bool,  # noqa: FBT001 - click passes it by name
    electrical: bool,  # noqa: FBT001 - the same
    seed: int | None,
    truth: Path | None,
) -> None:
    """Run the four tests on a simulated MECHANISM, and write a log like that of a robot.

    For example: sysid simulate drivetrain --hide drag --fault encoder-slip --seed 1 -o drive.wpilog
    """
    if seed is not None and seed < 0:
        raise click.BadParameter("a seed is zero or more.", param_hint="'--seed'")
    refuse_overwriting(output, truth)
    kinds = tuple(kind.strip() for kind in tests.split(",") if kind.strip())
    routine = Routine(ramp=ramp, step=step, timeout=timeout, kinds=kinds)
    # separate random streams, so that adding a fault does not change the motion
    motion, damage, variation = np.random.default_rng(seed), *np.random.default_rng(seed).spawn(2)
    built = find(mechanism)
    built = _set_battery(built.draw(variation) if vary else built, battery, controller)
    built = _hide_effects(built, hide)
    if recorder is not None:
        built = find_recorder(recorder).record(built)
        period = period or find_recorder(recorder).period
    period = PERIOD if period is None else period
    log = record(built, routine, rng=motion, period=period, electrical=electrical)
    log, where = contaminate_all(log, [parse_fault_request(text) for text in faults], rng=damage)
    if truth:
        write_ground_truth(built, routine, path=truth, faults=where)
    try:
        write(log, output)
    except Refusal:
        if truth:  # a truth file without its log would mislead
            truth.unlink()
        raise
    _echo_written(log, output, after="inspect" if faults else "fit")


def _echo_written(log: Log, output: Path, *, after: str) -> None:
    """Print the doubts about a log, what was written, and the command for it."""
    samples = sum(len(part) for part in log.runs)
    for doubt in log.doubts:
        click.echo(f"warning: {doubt.text}")
    following = f"sysid {after} {quote_path(output)}"
    click.echo(f"{output}: {len(log.runs)} tests, {samples} samples. Next: {following}")


def _set_battery(mechanism: Mechanism, battery: str | None, controller: str) -> Mechanism:
    """The mechanism with the brownout voltage of a controller and the battery of an option.

    Args:
        mechanism: the mechanism to change.
        battery: ``VOLTS`` or ``VOLTS:OHMS``; None keeps the mechanism's own.
        controller: name of the robot controller.

    Raises:
        BadRequest: the text is not a battery.
    """
    stop = CONTROLLERS[controller].brownout
    if battery is None:
        return replace(mechanism, brownout=stop)
    rest, colon, ohms = battery.partition(":")
    try:
        chosen = Battery(float(rest), float(ohms) if colon else mechanism.battery.resistance)
    except ValueError:
        raise BadRequest(
            f"{battery!r} is not a battery", advice="Write VOLTS[:OHMS], as 12.2:0.035."
        ) from None
    return replace(mechanism, battery=chosen, brownout=stop)


def _hide_effects(mechanism: Mechanism, asked: Iterable[str]) -> Mechanism:
    """The mechanism with hidden effects, each written as ``NAME`` or ``NAME:SIZE``.

    Raises:
        BadRequest: a size is not a number, or there is no such effect.
    """
    for text in asked:
        name, colon, size = text.partition(":")
        try:
            mechanism = mechanism.hide(name.strip(), float(size) if colon else 1.0)
        except ValueError:
            raise BadRequest(
                f"{text!r}: {size!r} is not a size", advice="Write EFFECT[:SIZE], as drag:0.5."
            ) from None
    return mechanism
