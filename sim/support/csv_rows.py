"""Rows of a CSV text from any program: commas, semicolons or tabs between the cells."""

import csv
import io
from collections.abc import Iterator, Sequence

from sim.core.errors import UnreadableFile


def detect_delimiter(text: str) -> str:
    """The separator of the cells: the most frequent candidate in the first line."""
    return max(",;\t", key=text.lstrip().partition("\n")[0].count)


def split_rows(text: str, *, where: str) -> Iterator[tuple[int, list[str]]]:
    """The number of the line and the cells of each row that is not blank.

    Args:
        text: the text; any line breaks are read.
        where: the file, for messages.

    Raises:
        UnreadableFile: an unmatched quotation mark.
    """
    lines = io.StringIO(text.replace("\r\n", "\n").replace("\r", "\n"))
    reader = csv.reader(lines, delimiter=detect_delimiter(text), strict=True)
    try:
        for row in reader:
            if any(row) and not (len(row) == 1 and row[0].isspace()):
                yield reader.line_num, row
    except csv.Error as error:
        raise UnreadableFile(
            f"damaged CSV ({error})",
            where=f"{where}, line {reader.line_num}",
            advice="Look for a quotation mark without its partner.",
        ) from None


def check_width(row: Sequence[str], header: Sequence[str], *, where: str) -> None:
    """Refuse a row with more or fewer cells than the header.

    Raises:
        UnreadableFile: the numbers differ.
    """
    if len(row) != len(header):
        raise UnreadableFile(
            f"the row and the header differ in length: {len(row)} and {len(header)}",
            where=where,
            advice="Complete the line, or remove it. In a log, each line is one sample.",
        )
