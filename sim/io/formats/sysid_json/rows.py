"""The rows of the tools before 2024: one table of numbers for each test."""

import json
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from sim.core.errors import BadSample, UnreadableFile
from sim.core.log import LARGEST, Array

RUNS = {
    "slow-forward": "quasistatic-forward",
    "slow-backward": "quasistatic-reverse",
    "fast-forward": "dynamic-forward",
    "fast-backward": "dynamic-reverse",
}
EMPTIEST = 4.0  # [V] lowest battery voltage of a running robot

Columns = tuple[tuple[tuple[int, int, int], ...], int | None]
"""For each side, its columns of voltage, position and velocity; the column of the battery."""

_COLUMNS: dict[int, Columns] = {  # by the width of a row, whose first number is always the time
    4: (((1, 2, 3),), None),  # SysId 2021 to 2023, one mechanism
    6: (((3, 4, 5),), 1),  # 2019 and 2020, one mechanism; [2] is the commanded speed
    9: (((1, 3, 5), (2, 4, 6)), None),  # SysId 2021 to 2023, drivetrain; [7], [8] are the gyro's
    10: (((3, 5, 7), (4, 6, 8)), 1),  # 2020, drivetrain; [9] is the gyro's angle
}
_NINE_OF_2019 = _COLUMNS[10]  # without the gyro


def load_json(path: Path) -> dict[str, object]:
    """Decode a file; every number becomes a float.

    Raises:
        UnreadableFile: it is not a JSON object; the message says where the damage is.
    """
    again = "Copy it again from the computer that recorded it."
    try:
        # Integers as floats, too: then no number is too long, and a row has one type.
        document = json.loads(path.read_bytes(), parse_int=float)
    except json.JSONDecodeError as error:
        ends = error.pos >= len(error.doc.rstrip())
        raise UnreadableFile(
            "the file ends in the middle" if ends else f"damaged JSON ({error.msg})",
            where=f"{path}, line {error.lineno}, column {error.colno}",
            advice=again,
        ) from None
    except UnicodeDecodeError as error:
        what = f"byte {error.start} is not text"
        raise UnreadableFile(what, where=str(path), advice=again) from None
    except RecursionError:
        document = None
    if not isinstance(document, dict):
        raise UnreadableFile(
            "not an object with a list of rows for every test",
            where=str(path),
            advice="Give the JSON that SysId saved, unchanged.",
        )
    return document


def parse_tables(document: Mapping[str, object], *, where: str) -> dict[str, Array]:
    """Test -> its (n, columns) table.

    Raises:
        UnreadableFile: there is no run, or rows are not lists of equally many numbers.
    """
    present = {key: document[key] for key in RUNS if key in document}
    tables = {
        RUNS[key]: _read_table(rows, where=f"{where}, {key}")
        for key, rows in present.items()
        if rows != []
    }
    if not tables:
        raise UnreadableFile(
            "all its runs are empty" if present else "there is no run in it",
            where=where,
            advice=f"Give a file with rows under {', '.join(RUNS)}.",
        )
    return tables


def detect_columns(
    tables: Mapping[str, Array], document: Mapping[str, object], *, named: str, where: str
) -> Columns:
    """The columns of each side and of the battery, by the width of the rows and their values.

    Args:
        tables: test -> its table.
        document: the file.
        named: the type of mechanism that the file names; may be empty.
        where: the file, for messages.

    Raises:
        UnreadableFile: the width is unknown, does not match the mechanism, or differs between runs.
        BadSample: a number that is used is missing, not finite or absurdly large.
    """
    widths = {test: table.shape[1] for test, table in tables.items()}
    if len(set(widths.values())) > 1:
        raise UnreadableFile(
            "its runs have rows of different widths: "
            + ", ".join(f"{width} numbers in {test}" for test, width in widths.items()),
            where=where,
            advice="Give a file as the tool saved it, not two joined.",
        )
    width = next(iter(widths.values()))
    if width not in _COLUMNS:
        known = ", ".join(map(str, _COLUMNS))
        raise UnreadableFile(
            f"no tool wrote rows of {width} numbers",
            where=where,
            advice=f"Give a tool's own file: its rows have {known} numbers.",
        )
    sides, battery = _COLUMNS[width]
    if len(sides) > 1 and "sysid" not in document and _has_battery_column(tables):
        sides, battery = _NINE_OF_2019
    if len(sides) > 1 and named and not str(document["test"]).lower().startswith("drivetrain"):
        if battery is None:
            raise UnreadableFile(
                f"its rows are those of a drivetrain, but its test is {document['test']!r}",
                where=where,
                advice='Write "Drivetrain" there if it is one.',
            )
        sides = sides[:1]  # the tools of 2020 wrote a drivetrain's row for every mechanism
    used = [0, *(column for side in sides for column in side), *([battery] if battery else ())]
    for test, table in tables.items():
        for row, place in np.argwhere(~(np.abs(table[:, used]) < LARGEST)).tolist():
            column = used[place]
            raise BadSample(
                f"number {column + 1} of row {row} is {table[row, column]:.6g}",
                where=f"{where}, {test}",
                advice="Remove that row, or record the run again.",
            )
    return sides, battery


def _has_battery_column(tables: Mapping[str, Array]) -> bool:
    """Whether the second column can be a battery voltage and the third a speed from -1 to 1."""
    return all(
        bool(np.all(table[:, 1] > EMPTIEST) and np.all(np.abs(table[:, 2]) <= 1.0))
        for table in tables.values()
    )


def _read_table(rows: object, *, where: str) -> Array:
    """The rows of a run as numbers (n, columns), nan for null.

    Raises:
        UnreadableFile: the rows are not lists of equally many numbers.
    """
    if not isinstance(rows, list) or not all(type(row) is list for row in rows):
        raise UnreadableFile(
            "not a list of rows", where=where, advice="Give the JSON that SysId saved, unchanged."
        )
    width = Counter(map(len, rows)).most_common(1)[0][0]
    for number, row in enumerate(rows):
        # SysId wrote null for a missing sensor
        if len(row) != width or not set(map(type, row)) <= {float, type(None)}:
            raise UnreadableFile(
                f"{json.dumps(row)[:60]} is not a row of {width} numbers like the others",
                where=f"{where}, row {number}",
                advice="Remove the row, or copy the file again.",
            )
    return np.array(rows, dtype=np.float64)
