"""Accessible figures: a drawing, its description in words, and a table of its numbers."""

import base64
import io
import os
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias
from warnings import catch_warnings, filterwarnings

from sim.core.errors import BadRequest
from sim.plot.table import Table
from sim.support.atomic_file import atomic_path
from sim.support.os_errors import refuse_os_errors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Dash: TypeAlias = str | tuple[float, tuple[float, ...]]  # a line style, as matplotlib takes it

SUFFIXES = (".svg", ".png", ".pdf")
PAPER = "white"  # opaque, so that colors chosen for white stay legible on a dark page
INK = "#222222"
# In JupyterLab's dark theme, the drawing's lightness is inverted, and its hues are kept.
DARK = 'body[data-jp-theme-light="false"] figure.picture img{filter:invert(0.9) hue-rotate(180deg)}'

# Okabe and Ito's colors for color-blind people, without yellow, too pale on white. Each has
# its own marker and line style, so that color is never the only difference.
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000")
# The same for a dark page, where blue and black would be too dark.
COLORS_ON_DARK = ("#3A8FD0", *COLORS[1:-1], "#FFFFFF")
MARKERS = ("o", "s", "^", "D", "v", "x")
LINES: tuple[Dash, ...] = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1)))
REFERENCE = "#000000"  # color of the truth and of targets


@dataclass(frozen=True, eq=False)
class Picture:
    """A figure with a description and a table, readable without seeing it, and without JavaScript.

    Args:
        figure: the drawing.
        alt: a description in a few sentences; with numbers, if there is no table.
        table: its numbers.
    """

    figure: "Figure"
    alt: str
    table: Table | None = None

    @property
    def svg(self) -> str:
        """The drawing as SVG; the same figure always gives the same text.

        If matplotlib's font lacks a character, for example of a Chinese name, text is not converted
        to paths, and the viewer uses a font of the computer.
        """
        try:
            return self._draw_svg("path", missing="error")
        except UserWarning:
            return self._draw_svg("none", missing="ignore")

    def _draw_svg(self, text: str, *, missing: Literal["error", "ignore"]) -> str:
        from matplotlib import rc_context  # noqa: PLC0415 - slow, so with the first picture

        buffer = io.StringIO()
        with rc_context({"svg.hashsalt": "picture", "svg.fonttype": text}), catch_warnings():
            filterwarnings(missing, message=r"Glyph .* missing from", category=UserWarning)
            self.figure.savefig(buffer, format="svg", metadata={"Date": None, "Title": self.alt})
        return buffer.getvalue()

    @property
    def html(self) -> str:
        """Picture, description and table as self-contained HTML."""
        source = base64.b64encode(self.svg.encode("utf-8")).decode("ascii")
        width = round(self.figure.get_figwidth() * 96)
        return (
            f"<style>{DARK}</style>"
            f'<figure class="picture" style="margin:0.5em 0;max-width:{width}px">'
            f'<img alt="{escape(self.alt)}" src="data:image/svg+xml;base64,{source}" '
            f'style="width:100%;height:auto;background:{PAPER};border-radius:4px">'
            f"<details><summary>This figure in words</summary><p>{escape(self.alt)}</p></details>"
            f"</figure>{self.table.html if self.table else ''}"
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the drawing into a file; its title is the description.

        If that fails, an existing file stays as it was.

        Raises:
            BadRequest: the name does not end in .svg, .png or .pdf, or the file cannot be written.
        """
        from matplotlib import rc_context  # noqa: PLC0415 - as above

        target = Path(path)
        kind = target.suffix.lower()
        if kind not in SUFFIXES:
            raise BadRequest(
                f"a picture cannot end in {target.suffix or 'nothing'!r}",
                where=str(target),
                advice=f"End its name in one of: {', '.join(SUFFIXES)}.",
            )
        extra: dict[str, object] = {} if kind == ".png" else {_DATE[kind]: None}
        advice = "Choose a folder that exists and that you may write to."
        with (
            refuse_os_errors("cannot be written", target, advice=advice),
            atomic_path(target) as part,
            rc_context({"svg.hashsalt": "picture"}),
            part.open("wb") as stream,
        ):
            self.figure.savefig(
                stream, format=kind[1:], dpi=200, metadata={"Title": self.alt, **extra}
            )

    def __str__(self) -> str:
        """The description and the table, for a terminal."""
        return f"{self.alt}\n\n{self.table}" if self.table else self.alt

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html}


# Omitted, so that the same picture gives the same file
_DATE = {".svg": "Date", ".pdf": "CreationDate"}


def make_panels(
    rows: int, columns: int, *, width: float = 7.6, height: float = 3.2, shared: bool = False
) -> "tuple[Figure, list[list[Axes]]]":
    """A figure with a grid of empty axes.

    Args:
        rows: rows of the grid.
        columns: columns of the grid.
        width: width of the figure [in].
        height: height of the figure [in].
        shared: whether a column shares its x axis, and a row its y axis.
    """
    from matplotlib.figure import Figure  # noqa: PLC0415 - slow, so with the first picture

    figure = Figure(figsize=(width, height), layout="constrained", facecolor=PAPER)
    grid = figure.subplots(
        rows,
        columns,
        squeeze=False,
        sharex="col" if shared else "none",
        sharey="row" if shared else "none",
    )
    for axes in grid.flat:
        axes.set_facecolor(PAPER)
        axes.grid(visible=True, color="#DDDDDD", linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(colors=INK, labelsize=9)
    return figure, [list(row) for row in grid]


def write_number(axes: "Axes", text: str, at: tuple[float, float], *, right: bool = False) -> None:
    """Write a number above a point, or to the right of it, legible over lines."""
    place: dict[str, Any] = (
        {"xytext": (4, 0), "va": "center"} if right else {"xytext": (0, 7), "ha": "center"}
    )
    box = {"facecolor": PAPER, "edgecolor": "none", "pad": 0.8}
    axes.annotate(
        text, at, textcoords="offset points", fontsize=8, color=INK, zorder=6, bbox=box, **place
    )


def add_legend(figure: "Figure", axes: Sequence["Axes"], *, columns: int = 3) -> None:
    """Add one legend below all panels, with each name once.

    Args:
        figure: the figure of the panels.
        axes: the panels whose labels it lists.
        columns: largest number of names in a row.
    """
    entries: dict[str, Any] = {}
    for panel in axes:
        handles, names = panel.get_legend_handles_labels()
        entries |= dict(zip(names, handles, strict=True))
    figure.legend(
        handles=[*entries.values()],
        fontsize=9,
        labelcolor=INK,
        loc="outside lower center",
        ncols=columns,
        frameon=False,
    )
