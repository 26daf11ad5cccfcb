"""JSON of the tools of 2019 to 2023 (robotpy-characterization, frc-characterization, SysId).

An object with a list of rows under each of ``slow-forward slow-backward fast-forward
fast-backward``, and with ``test`` (the kind of mechanism), ``units`` and ``unitsPerRotation``, the
factor of positions and velocities. Files of 2019 and 2020 have none of these three. A drivetrain
logs two sides, which are averaged unless one is chosen. The format is only read, not written.
"""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from sim.core.advice import Action
from sim.core.doubt import OF_POSITION, Doubt
from sim.core.errors import BadRequest, UnreadableFile
from sim.core.log import LARGEST, Log
from sim.core.units import UNITS, find_unit
from sim.io.format import ReadOptions, make_run, refuse_pick, warn_of_motor_choice
from sim.io.formats.sysid_json.rows import detect_columns, load_json, parse_tables
from sim.io.formats.sysid_json.sides import SIDES, Side, align_signs, choose_side

SUFFIXES = (".json",)
_KEY = re.compile(rb'"(slow-forward|slow-backward|fast-forward|fast-backward|track-width|sysid)"')
_TYPES = {
    "simple": "simple",
    "simple motor": "simple",
    "elevator": "elevator",
    "arm": "arm",
    "drivetrain": "simple",
    "drivetrain (angular)": "simple",
}


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
    empty, scale = _read_header(document, options, where=where)
    tables = parse_tables(document, where=where)
    columns, battery = detect_columns(tables, document, named=empty.type, where=where)
    sides = [{test: table[:, list(side)].T for test, table in tables.items()} for side in columns]

    def make_log(side: Side, *doubts: Doubt) -> Log:
        """The log with the runs of a side, in the order in which they were recorded."""
        runs, found = [], [*doubts]
        for test in sorted(tables, key=lambda test: float(tables[test][0, 0])):
            voltage, position, velocity = side[test]
            signals = {"time": tables[test][:, 0], "voltage": voltage}
            signals |= {"position": position * scale, "velocity": velocity * scale}
            if battery is not None:
                signals["bus_voltage"] = tables[test][:, battery]
            run, repeated = make_run(test, signals, si=find_unit(empty.units).si, where=where)
            runs.append(run)
            found.extend(repeated)
        return replace(empty, runs=tuple(runs)).add_doubts(*found)

    if len(sides) == 1:
        (side,), (doubts,) = align_signs(sides, where=where)
        return {"": make_log(side, *doubts, *warn_of_motor_choice(options.motor, where=where))}
    empty = replace(empty, type=empty.type or "simple")
    angular = "angular" in empty.mechanism.lower()
    sides, found = align_signs(sides, angular=angular, where=where)
    each = options.each_motor and not options.motor
    logs = {}
    for motor in SIDES if each else (options.motor or "combined",):
        side, odd = choose_side(sides, found, motor=motor, angular=angular, where=where)
        logs[motor if each else ""] = make_log(side, *odd)
    return logs


def _read_header(
    document: Mapping[str, object], options: ReadOptions, *, where: str
) -> tuple[Log, float]:
    """A log without runs, and the units per rotation of the rows.

    Raises:
        UnreadableFile: a value has the wrong type or range, or the units are unknown.
    """
    mechanism, scale = document.get("test", ""), document.get("unitsPerRotation", 1.0)
    if not isinstance(mechanism, str):
        raise UnreadableFile(
            'its "test" must be a text that names the kind of mechanism',
            where=where,
            advice='Write "Simple", "Elevator" or "Arm".',
        )
    if not isinstance(scale, float) or not 0.0 < scale < LARGEST:
        raise UnreadableFile(
            f"unitsPerRotation is {scale!r}",
            where=where,
            advice="Write how far the mechanism goes in one rotation, a positive number.",
        )
    type_ = _TYPES.get(mechanism.lower(), "")
    units, doubts = _read_units(document.get("units"), options, type_=type_, where=where)
    return Log((), units, mechanism, type=type_, source=where, doubts=doubts), scale


def _read_units(
    found: object, options: ReadOptions, *, type_: str, where: str
) -> tuple[str, tuple[Doubt, ...]]:
    """The unit of position, and a doubt if it was assumed or contradicts the user's.

    Raises:
        UnreadableFile: the file's units are unknown.
    """
    known = found.strip().lower() if isinstance(found, str) else ""
    if options.units:
        doubt = Doubt(
            "contradicting-units",
            f"{where}: the file says {found}, but you chose {options.units}.",
            action=Action("own-units"),
            gains=OF_POSITION,
        )
        return options.units, (doubt,) if found is not None and known != options.units else ()
    if found is None:
        default = "radians" if "arm" in (type_, options.type) else "meters"
        doubt = Doubt(
            "units-unknown",
            f"{where}: the file does not name its units, as no file of 2019 and 2020 does, so "
            f"{default} were assumed.",
            action=Action("units"),
        )
        return default, (doubt,)
    if known not in UNITS:
        raise UnreadableFile(
            f"its units are {found!r}, which are not known here",
            where=where,
            advice=Action("which-units", ", ".join(UNITS)),
        )
    return known, ()
