"""JSON of the tools of 2019 to 2023 (robotpy-characterization, frc-characterization, SysId).

An object with a list of rows under each of ``slow-forward slow-backward fast-forward
fast-backward``, and beside them ``test`` (the kind of mechanism), ``units`` and
``unitsPerRotation``, by which positions and velocities are multiplied. Files of 2019 and 2020 have
none of the three. A drivetrain logs two sides; unless one is asked for, they are made one. The
format is only read: its tools are gone.
"""

import re
from pathlib import Path

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import Array, Log
from sim.core.units import find_unit
from sim.io.format import ReadOptions, doubt_motor_choice, make_run
from sim.io.formats.sysid_json.drivetrain import read_drivetrain
from sim.io.formats.sysid_json.rows import (
    RowForm,
    check_columns,
    detect_form,
    load_json,
    parse_tables,
)
from sim.io.formats.sysid_json.said import FileHeader, read_header
from sim.io.formats.sysid_json.side import Side, read_one_side

SUFFIXES = (".json",)
_KEY = re.compile(rb'"(slow-forward|slow-backward|fast-forward|fast-backward|track-width|sysid)"')


def recognizes(head: bytes) -> bool:
    """Whether it starts as a JSON object and soon names one of the tools' keys."""
    return head.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"{") and bool(_KEY.search(head))


def read(path: Path, asked: ReadOptions) -> Log:
    """Read a log of the tools before 2024.

    Args:
        path: the file.
        asked: what its reader knows: units, type, and which side of a drivetrain (``motor``).

    Raises:
        UnreadableFile: damaged JSON, rows of a width no tool wrote, or no run at all.
        MissingSignal: one side of a drivetrain does not move while the other does.
        BadSample: a number that cannot be a measurement.
        BadRequest: a side that is none, or names of entries, which rows do not have.
    """
    where = str(path)
    if asked.entries:
        raise BadRequest(
            "the columns of this format have no names",
            where=where,
            advice="Leave out --state, --voltage, --position and --velocity.",
        )
    document = load_json(path)
    said = read_header(document, asked, where=where)
    tables, doubts = parse_tables(document, where=where)
    form = detect_form(tables, said, where=where)
    check_columns(tables, form, where=where)
    sides, odd = _sides(tables, form, said, asked, where=where)
    runs = []
    doubts = [*said.doubts, *doubts, *odd]
    for test in sorted(tables, key=lambda test: float(tables[test][0, 0])):
        signals = sides[test].signals(time=tables[test][:, 0], scale=said.per_rotation)
        if form.battery is not None:
            signals["bus_voltage"] = tables[test][:, form.battery]
        run, repeated = make_run(test, signals, si=find_unit(said.units).si, where=where)
        runs.append(run)
        doubts.extend(repeated)
    return Log(
        tuple(runs),
        units=said.units,
        mechanism=said.mechanism,
        type=said.type or ("simple" if len(form.sides) > 1 else ""),  # two sides: a drivetrain
        source=where,
        doubts=tuple(doubts),
    )


def _sides(
    tables: dict[str, Array], form: RowForm, said: FileHeader, asked: ReadOptions, *, where: str
) -> tuple[dict[str, Side], list[Doubt]]:
    """One side for every test: the only one, the one asked for, or both made one."""
    found = [
        {test: Side(*(table[:, column] for column in columns)) for test, table in tables.items()}
        for columns in form.sides
    ]
    if len(found) == 1:
        sides, doubts = read_one_side(found[0], where=where)
        return sides, [*doubts, *doubt_motor_choice(asked, where=where)]
    motor = asked.motor or "combined"
    return read_drivetrain(found, motor=motor, angular=said.angular, where=where)
