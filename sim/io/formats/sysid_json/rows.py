"""The rows of the tools before 2024: one table of numbers for each test."""

import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import BadSample, UnreadableFile
from sim.core.log import LARGEST, Array
from sim.io.formats.sysid_json.file_header import FileHeader

RUNS = {
    "slow-forward": "quasistatic-forward",
    "slow-backward": "quasistatic-reverse",
    "fast-forward": "dynamic-forward",
    "fast-backward": "dynamic-reverse",
}
TRACK_WIDTH = "track-width"  # a turn that measured the track width; not one of the tests
EMPTIEST = 4.0  # [V] lowest battery voltage of a running robot


@dataclass(frozen=True)
class RowForm:
    """The meaning of each column of a row; the first is always the time.

    Args:
        sides: for each side, its columns of voltage, position and velocity.
        battery: the column of the battery voltage; None if there is none.
    """

    sides: tuple[tuple[int, int, int], ...]
    battery: int | None = None


_FORMS = {
    4: RowForm(((1, 2, 3),)),  # SysId 2021 to 2023, one mechanism
    6: RowForm(((3, 4, 5),), battery=1),  # 2019 and 2020, one mechanism; [2] is the commanded speed
    9: RowForm(((1, 3, 5), (2, 4, 6))),  # SysId 2021 to 2023, drivetrain; [7], [8] are the gyro's
    10: RowForm(((3, 5, 7), (4, 6, 8)), battery=1),  # 2020, drivetrain; [9] is the gyro's angle
}
_NINE_OF_2019 = RowForm(((3, 5, 7), (4, 6, 8)), battery=1)  # as with ten columns, without the gyro


def load_json(path: Path) -> dict[str, object]:
    """Decode a file; every number becomes a float.

    Raises:
        UnreadableFile: it is not a JSON object; the message says where the damage is.
    """
    try:
        # Integers as floats, too: then no number is too long, and a row has one type.
        document = json.loads(path.read_bytes(), parse_int=float, object_pairs_hook=_make_object)
    except json.JSONDecodeError as error:
        ends = error.pos >= len(error.doc.rstrip())
        raise UnreadableFile(
            "the file ends in the middle" if ends else f"damaged JSON ({error.msg})",
            where=f"{path}, line {error.lineno}, column {error.colno}",
            advice="Copy it again from the computer that recorded it.",
        ) from None
    except UnicodeDecodeError as error:
        raise UnreadableFile(
            f"byte {error.start} is not text",
            where=str(path),
            advice="Copy it again from the computer that recorded it.",
        ) from None
    except RecursionError:
        document = None
    if not isinstance(document, dict):
        raise UnreadableFile(
            "not an object with a list of rows for every test",
            where=str(path),
            advice="Give the JSON that SysId saved, unchanged.",
        )
    return document


def parse_tables(
    document: Mapping[str, object], *, where: str
) -> tuple[dict[str, Array], list[Doubt]]:
    """Test -> its (n, columns) table, and doubts about what was left out.

    Raises:
        UnreadableFile: there is no run, or rows are not lists of equally many numbers.
    """
    present = [key for key in RUNS if key in document]
    tables = {
        RUNS[key]: _read_table(document[key], where=f"{where}, {key}")
        for key in present
        if document[key] != []
    }
    if not tables:
        raise UnreadableFile(
            "all its runs are empty" if present else "there is no run in it",
            where=where,
            advice=f"Give a file with rows under {', '.join(RUNS)}.",
        )
    doubts = [
        Doubt("empty-run", f"{where}: {key} is there but has no rows; record that test again.")
        for key in present
        if document[key] == []
    ]
    strange = [
        key
        for key, value in document.items()
        if isinstance(value, list) and key not in (*RUNS, TRACK_WIDTH)
    ]
    if strange:
        doubts.append(
            Doubt(
                "unknown-run",
                f"{where}: {', '.join(map(repr, strange))}: no tool wrote such a run; left out.",
            )
        )
    return tables, doubts


def detect_form(tables: Mapping[str, Array], header: FileHeader, *, where: str) -> RowForm:
    """The form of the rows, by their width, their values and the header.

    Raises:
        UnreadableFile: the width is unknown, does not match the mechanism, or differs between runs.
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
    if width not in _FORMS:
        raise UnreadableFile(
            f"no tool wrote rows of {width} numbers",
            where=where,
            advice=f"Give a tool's own file: its rows have {', '.join(map(str, _FORMS))} numbers.",
        )
    form = _FORMS[width]
    if (
        form.battery is None
        and len(form.sides) > 1
        and not header.sysid
        and _has_battery_column(tables)
    ):
        form = _NINE_OF_2019
    if len(form.sides) == 1 or header.drivetrain:
        return form
    if header.type and form.battery is None:
        raise UnreadableFile(
            f"its rows are those of a drivetrain, but its test is {header.mechanism!r}",
            where=where,
            advice='Write "Drivetrain" there if it is one.',
        )
    # The tools of 2020 wrote a drivetrain's row for every mechanism, the right side all zero.
    unused = not any(np.any(table[:, list(form.sides[1])]) for table in tables.values())
    return replace(form, sides=form.sides[:1]) if header.type or unused else form


def _has_battery_column(tables: Mapping[str, Array]) -> bool:
    """Whether the second column can be a battery voltage and the third a speed from -1 to 1."""
    return all(
        bool(np.all(table[:, 1] > EMPTIEST) and np.all(np.abs(table[:, 2]) <= 1.0))
        for table in tables.values()
    )


def check_numbers(tables: Mapping[str, Array], form: RowForm, *, where: str) -> None:
    """Refuse numbers that cannot be measurements; those of a gyro are not read.

    Raises:
        BadSample: a number is missing, not finite or absurdly large.
    """
    used = [0, *chain(*form.sides), *(() if form.battery is None else (form.battery,))]
    for test, table in tables.items():
        for row, place in np.argwhere(~(np.abs(table[:, used]) < LARGEST)).tolist():
            column = used[place]
            raise BadSample(
                f"number {column + 1} of row {row} is {table[row, column]:.6g}",
                where=f"{where}, {test}",
                advice="Remove that row, or record the run again.",
            )


def _make_object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    """A JSON object from its pairs.

    Raises:
        UnreadableFile: a name appears twice.
    """
    (name, times) = Counter(name for name, _ in pairs).most_common(1)[0] if pairs else ("", 0)
    if times > 1:
        raise UnreadableFile(
            f"{name[:40]!r} appears in it {times} times", advice="Keep one, and remove the others."
        )
    return dict(pairs)


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
    kinds = {float, type(None)}  # SysId wrote null for a missing sensor
    if set(map(len, rows)) != {width} or not set(map(type, chain.from_iterable(rows))) <= kinds:
        for number, row in enumerate(rows):
            if len(row) != width or not all(type(value) in kinds for value in row):
                raise UnreadableFile(
                    f"{json.dumps(row)[:60]} is not a row of {width} numbers like the others",
                    where=f"{where}, row {number}",
                    advice="Remove the row, or copy the file again.",
                )
    return np.array(rows, dtype=np.float64)
