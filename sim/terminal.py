"""Results as text for a terminal."""

import math

from rich.console import Console
from rich.table import Table

from sim.feedback import Preset
from sim.fit.result import Fit, gain_unit
from sim.units import unit

FINEST = 1e-4  # [share of a gain] carpet, battery and heat change it by more


def show_fit(found: Fit, *, preset: Preset, title: str, console: Console | None = None) -> None:
    """Print gains with errors and units, how well they fit, feedback gains, and every doubt.

    Args:
        found: the fit, in the units to show.
        preset: the motor controller the feedback gains are for.
        title: the files it came from.
        console: where to print; standard output if None.
    """
    console = console or Console(soft_wrap=True, highlight=False)
    per = unit(found.units)
    console.print(f"{title}: {found.type} mechanism in {per.name}, method {found.method}")
    rows = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    rows.add_column("gain")
    rows.add_column("value", justify="right")
    rows.add_column("± one standard error", justify="right")
    rows.add_column("unit")
    for name, value in found.gains.items():
        error = found.errors.get(name, math.nan)
        rows.add_row(
            "angle" if name == "offset_rad" else name,
            _digits(value, error),
            _error(value, error),
            gain_unit(name, per),
        )
    console.print(rows)
    console.print(
        f"simulated velocity R² {found.simulated_velocity_r2:.3f}, "
        f"RMSE {found.simulated_velocity_rmse:.3g} {per.symbol}/s; "
        f"acceleration R² {found.acceleration_r2:.3f}, "
        f"RMSE {found.acceleration_rmse:.3g} {per.symbol}/s²"
    )
    loops = found.feedback(preset)
    if loops:
        console.print(
            f"feedback to start from ({preset.name}): "
            + "; ".join(f"{loop} kP {g.kp:.4g}, kD {g.kd:.4g}" for loop, g in loops.items())
        )
    for doubt in found.all_doubts(preset):
        console.print(f"{'wrong' if doubt.grave else 'look'}: {doubt.message}", style="bold")


def _error(value: float, error: float) -> str:
    """The error, or that it is below what matters on a robot."""
    return f"< {FINEST:.2%} of it" if error < FINEST * abs(value) else f"{error:.2g}"


def _digits(value: float, error: float) -> str:
    """The value to the second digit of its error, three to six of its own."""
    if not (math.isfinite(error) and error > 0.0 and value):
        return f"{value:.4g}"
    error = max(error, FINEST * abs(value))
    size = max(abs(value), error)
    digits = 1 + math.floor(math.log10(size)) - math.floor(math.log10(error))
    return f"{value:.{min(max(digits + 1, 3), 6)}g}"
