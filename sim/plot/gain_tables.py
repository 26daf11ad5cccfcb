"""Tables of gains: the true ones, and the fitted ones relative to them."""

from collections.abc import Mapping, Sequence

from sim.core.log import Log
from sim.fit import fit
from sim.plot.table import Cell, Table

POWERS = {"kV": "V·s/", "kA": "V·s²/"}


def tabulate_gains(
    sets: Mapping[str, Mapping[str, Cell]],
    *,
    first: str = "",
    unit: str = "m",
    more: Mapping[str, Sequence[Cell]] | None = None,
    caption: str = "",
) -> Table:
    """A row for each set of gains, and a column for each gain that one of them has.

    Args:
        sets: name -> gains, in volts and the unit.
        first: header of the names.
        unit: of the position.
        more: header -> cells of a further column.
        caption: title of the table.
    """
    more = more or {}
    names = list(dict.fromkeys(gain for one in sets.values() for gain in one))
    rows = [(row, *(gains.get(name, "–") for name in names)) for row, gains in sets.items()]
    header = (f"{name} [{POWERS[name] + unit if name in POWERS else 'V'}]" for name in names)
    return Table(
        (first, *header, *more),
        tuple((*row, *cells) for row, *cells in zip(rows, *more.values(), strict=True)),
        caption,
    )


def tabulate_fits(logs: Mapping[str, Log], truth: Mapping[str, float]) -> Table:
    """What SysId's recipe finds in each log: the gains over the true ones, and its two R².

    Args:
        logs: name -> log.
        truth: the true gains.
    """
    rows: list[tuple[Cell, ...]] = []
    for name, log in logs.items():
        found = fit(log, method="sysid")
        ratios = (found.gains[gain] / truth[gain] for gain in truth)
        rows.append((name, *ratios, found.acceleration_r2, found.simulated_velocity_r2))
    header = ("log", *(f"{gain} ÷ true" for gain in truth))
    return Table((*header, "acceleration R²", "simulated velocity R²"), tuple(rows))
