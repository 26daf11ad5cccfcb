"""Tables of a few numbers as HTML, which screen readers can read, and as plain text."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import TypeAlias

Cell: TypeAlias = str | float

DIGITS = 3  # significant digits
NUMERIC = (*"+-−±<>≤≥~≈.–—",)  # first characters of numbers, and dashes in place of them
LONGEST = 1e5  # a larger number is written with an exponent


@dataclass(frozen=True)
class Table:
    """A table: a header, and rows that are named by their first cell.

    Args:
        header: title of each column, with its unit.
        rows: as many cells each as the header; numbers are shown with three significant digits.
        caption: title of the table; may be empty.
    """

    header: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    caption: str = ""

    @property
    def html(self) -> str:
        """The table as HTML, with the colors of the page that contains it."""
        caption = f"<caption>{escape(self.caption)}</caption>" if self.caption else ""
        left = self._left_aligned
        head = "".join(
            _write_cell("th", name, left=way) for name, way in zip(self.header, left, strict=True)
        )
        body = "".join(
            "<tr>"
            + _write_cell("th", to_text(row[0]), left=True, scope="row")
            + "".join(
                _write_cell("td", to_text(cell), left=way)
                for cell, way in zip(row[1:], left[1:], strict=True)
            )
            + "</tr>"
            for row in self.rows
        )
        return (
            '<table style="border-collapse:collapse;margin:0.5em 0;line-height:1.5">'
            f"{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
        )

    def __str__(self) -> str:
        """The table in plain text, columns aligned."""
        lines = [self.header, *([to_text(cell) for cell in row] for row in self.rows)]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        text = [
            "  ".join(
                cell.ljust(width) if way else cell.rjust(width)
                for cell, width, way in zip(line, widths, self._left_aligned, strict=True)
            ).rstrip()
            for line in lines
        ]
        return "\n".join([self.caption, *text] if self.caption else text)

    @property
    def _left_aligned(self) -> list[bool]:
        """Whether each column holds text, which is aligned to the left."""
        columns = zip(*self.rows, strict=True) if self.rows else ((),) * len(self.header)
        return [place == 0 or _is_text_column(column) for place, column in enumerate(columns)]

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html}


def _is_text_column(column: Sequence[Cell]) -> bool:
    """Whether no cell of a column begins like a number, and at least one is not empty."""
    return any(column) and all(
        isinstance(cell, str) and not cell[:1].isdigit() and cell[:1] not in NUMERIC
        for cell in column
    )


def _write_cell(tag: str, text: str, *, left: bool, scope: str = "col") -> str:
    """One cell as HTML, aligned to the left or to the right."""
    style = f"text-align:{'left' if left else 'right'};padding:0.1em 0.7em"
    if tag == "td":
        return f'<td style="{style}">{escape(text)}</td>'
    weight = "normal" if scope == "row" else "bold"
    return f'<th scope="{scope}" style="{style};font-weight:{weight}">{escape(text)}</th>'


def to_text(cell: Cell) -> str:
    """A cell as text; a number gets three significant digits and a minus sign (−)."""
    if isinstance(cell, str):
        return cell
    if isinstance(cell, int):
        return str(cell).replace("-", "−")
    if not math.isfinite(cell) or cell == 0.0:
        return f"{cell:g}".replace("-", "−")
    size = math.floor(math.log10(abs(cell)))
    text = f"{cell:.{DIGITS}g}" if abs(cell) >= LONGEST else f"{cell:.{max(DIGITS - 1 - size, 0)}f}"
    return text.replace("-", "−")
