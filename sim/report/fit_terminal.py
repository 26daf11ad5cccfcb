"""Print a fit on a terminal."""

import math
from collections.abc import Sequence

from rich.console import Console
from rich.table import Table

from sim.core.doubt import sort_doubts
from sim.core.log import Log
from sim.core.units import Unit, find_unit
from sim.feedback import Preset
from sim.fit.feedback_trial import OWN, FeedbackTrial, format_gain_pair
from sim.fit.result import Fit, format_gain_unit
from sim.report.gain_verdicts import judge_gains, write_gain_verdict
from sim.report.terminal import VERDICT_STYLES, WARNING, WRONG, WrappedPrinter
from sim.support.printable import format_error, format_value


def show_fit(
    found: Fit,
    *,
    preset: Preset,
    title: str,
    log: Log | None = None,
    tried: Sequence[FeedbackTrial] = (),
    notes: Sequence[str] = (),
    console: Console | None = None,
) -> None:
    """Print grave doubts, the verdict, gains with errors, feedback gains, notes and other doubts.

    Args:
        found: the fit, in the units to show.
        preset: the motor controller the feedback gains are for.
        title: the files it came from.
        log: what it was fitted to, for the advice in the verdict.
        tried: simulated trials of feedback gains, whose doubts are among those of the fit.
        notes: sentences about checks that passed.
        console: where to print; standard output if None.
    """
    say = WrappedPrinter(console)
    per = find_unit(found.units)
    doubts = sort_doubts(found.doubts if tried else found.list_doubts(preset))
    for doubt in doubts:
        if doubt.grave:
            say(f"wrong: {doubt.text}", hang=7, style=WRONG)
        elif doubt.is_shown_first:
            say(f"warning: {doubt.text}", hang=9, style=WARNING)
    style = VERDICT_STYLES.get(judge_gains(found), "bold yellow")
    say(f"Verdict: {write_gain_verdict(found, log)}", hang=9, style=style)
    say(f"{title}: {found.type} mechanism in {per.name}, method {found.method}", hang=2)
    rows = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    rows.add_column("gain")
    rows.add_column("value", justify="right")
    rows.add_column("± one standard error", justify="right")
    rows.add_column("unit")
    for row in format_gains(found):
        rows.add_row(*row)
    say.console.print(rows)
    say(
        f"simulated velocity R² {found.simulated_velocity_r2:.3f}, "
        f"RMSE {found.simulated_velocity_rmse:.3g} {per.symbol}/s; "
        f"acceleration R² {found.acceleration_r2:z.3f}, "
        f"RMSE {found.acceleration_rmse:.3g} {per.symbol}/s²",
        hang=2,
    )
    if tried:
        say(
            f"feedback gains to start with, as SysId suggests them ({preset.name}), in a "
            "simulation:",
            hang=2,
        )
    _show_trials(tried, per, say)
    for note in notes:
        say(note, hang=2)
    for doubt in doubts:
        if not doubt.is_shown_first:
            say(f"warning: {doubt.text}", hang=9, style=WARNING)


def format_gains(found: Fit) -> list[tuple[str, str, str, str]]:
    """Name, value, standard error and unit of each gain, as text."""
    per = find_unit(found.units)
    return [
        (
            "angle" if name == "offset_rad" else name,
            format_value(value, found.errors.get(name, math.nan)),
            format_error(value, found.errors.get(name, math.nan)),
            format_gain_unit(name, per),
        )
        for name, value in found.gains.items()
    ]


def _show_trials(tried: Sequence[FeedbackTrial], per: Unit, say: WrappedPrinter) -> None:
    """Print the step response of each pair of feedback gains, a line each."""
    for trial in tried:
        step = f"{trial.response.target:.4g} {per.symbol}{'/s' * (trial.loop == 'velocity')}"
        if trial.owner != OWN and not trial.is_good:
            say(f"{trial.loop}: no good start; see the warning below", indent=2)
            continue
        own = "your own " if trial.owner == OWN else ""
        bad = "" if trial.is_good else " (no good start)"
        say(
            f"{own}{trial.loop} {format_gain_pair(trial, per.symbol)}{bad}: after a step of {step} "
            f"the mechanism {trial.verdict.description}",
            indent=2,
            hang=2,
        )
