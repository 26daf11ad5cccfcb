"""A table of gains."""

from collections.abc import Mapping, Sequence

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
