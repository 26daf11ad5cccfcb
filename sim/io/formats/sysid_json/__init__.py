"""JSON of the tools of 2019 to 2023 (robotpy-characterization, frc-characterization, SysId).

An object with a list of rows under each of ``slow-forward slow-backward fast-forward
fast-backward``, and with ``test`` (the kind of mechanism), ``units`` and ``unitsPerRotation``, the
factor of positions and velocities. Files of 2019 and 2020 have none of these three. A drivetrain
logs two sides, which are averaged unless one is chosen. The format is only read, not written.
"""

import re
from pathlib import Path

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import Array, Log
from sim.core.units import find_unit
from sim.io.format import ReadOptions, make_run, refuse_pick, warn_of_motor_choice
from sim.io.formats.sysid_json.drivetrain import SIDES, read_drivetrain
from sim.io.formats.sysid_json.file_header import FileHeader, read_header
from sim.io.formats.sysid_json.rows import (
    RowForm,
    check_numbers,
    detect_form,
    load_json,
    parse_tables,
)
from sim.io.formats.sysid_json.side import Side, read_one_side

SUFFIXES = (".json",)
_KEY = re.compile(rb'"(slow-forward|slow-backward|fast-forward|fast-backward|track-width|sysid)"')


def recognizes(head: bytes) -> bool:
    """Whether a file starts as a JSON object with one of the tools' keys near its beginning."""
    return head.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"{") and bool(_KEY.search(head))


def read(path: Path, options: ReadOptions) -> dict[str, Log]:
    """Read a log of the tools before 2024, or a log for each side of a drivetrain.

    Args:
        path: the file.
        options: the user's choices: units, type, and which side of a drivetrain (``motor``).

    Raises:
        UnreadableFile: damaged JSON, rows of an unknown width, or no run.
        BadSample: a number that cannot be a measurement.
        BadRequest: an unknown side, or names of entries, which this format does not have.
    """
    where = str(path)
    if options.entries:
        raise BadRequest(
            "the columns of this format have no names",
            where=where,
            advice="Leave out --state, --voltage, --position and --velocity.",
        )
    refuse_pick(options.pick, where=where)
    document = load_json(path)
    header = read_header(document, options, where=where)
    tables, doubts = parse_tables(document, where=where)
    form = detect_form(tables, header, where=where)
    check_numbers(tables, form, where=where)
    single = len(form.sides) == 1 or options.motor or not options.each_motor
    motors = {"": options.motor} if single else {side: side for side in SIDES}
    return {
        name: _make_log(tables, form, header, motor, where=where).add_doubts(*doubts)
        for name, motor in motors.items()
    }


def _make_log(
    tables: dict[str, Array], form: RowForm, header: FileHeader, motor: str | None, *, where: str
) -> Log:
    """The log of one side, or of the mean of both."""
    sides, odd = _read_sides(tables, form, header, motor, where=where)
    runs = []
    doubts = [*header.doubts, *odd]
    for test in sorted(tables, key=lambda test: float(tables[test][0, 0])):
        signals = sides[test].signals(time=tables[test][:, 0], scale=header.per_rotation)
        if form.battery is not None:
            signals["bus_voltage"] = tables[test][:, form.battery]
        run, repeated = make_run(test, signals, si=find_unit(header.units).si, where=where)
        runs.append(run)
        doubts.extend(repeated)
    return Log(
        tuple(runs),
        units=header.units,
        mechanism=header.mechanism,
        # two sides: a drivetrain
        type=header.type or ("simple" if len(form.sides) > 1 else ""),
        source=where,
        doubts=tuple(doubts),
    )


def _read_sides(
    tables: dict[str, Array], form: RowForm, header: FileHeader, motor: str | None, *, where: str
) -> tuple[dict[str, Side], list[Doubt]]:
    """One side for every test: the only one, the chosen one, or the mean of both."""
    found = [
        {test: Side(*(table[:, column] for column in columns)) for test, table in tables.items()}
        for columns in form.sides
    ]
    if len(found) == 1:
        sides, doubts = read_one_side(found[0], where=where)
        return sides, [*doubts, *warn_of_motor_choice(motor, where=where)]
    return read_drivetrain(found, motor=motor or "combined", angular=header.angular, where=where)
