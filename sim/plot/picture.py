"""A figure that can also be read: its picture, the same in words, and its numbers in a table."""

import base64
import io
import os
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Literal, TypeAlias
from warnings import catch_warnings, filterwarnings

from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sim.core.errors import BadRequest
from sim.plot.table import Table
from sim.support.atomic_file import atomic_path

Dash: TypeAlias = str | tuple[float, tuple[float, ...]]  # a line style, as matplotlib takes it

SUFFIXES = (".svg", ".png", ".pdf")
PAPER = "white"  # an opaque ground: colors chosen for contrast on white stay legible on a dark page
INK = "#222222"
# JupyterLab's dark theme shows the same drawing with light and dark exchanged, hues kept.
DARK = 'body[data-jp-theme-light="false"] figure.picture img{filter:invert(0.9) hue-rotate(180deg)}'

# Okabe and Ito's colors, which people who see few colors can tell apart, without the yellow that
# is too pale on white. Each has a marker and a line style of its own: color never speaks alone.
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000")
# The same on a dark page: only its blue and its black are too dark there.
COLORS_ON_DARK = ("#3A8FD0", *COLORS[1:-1], "#FFFFFF")
MARKERS = ("o", "s", "^", "D", "v", "x")
LINES: tuple[Dash, ...] = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1)))
REFERENCE = "#000000"  # what is true, asked for, or really happened


@dataclass(frozen=True, eq=False)
class Picture:
    """A figure with everything a reader without eyes, colors or JavaScript needs.

    Args:
        figure: the drawing.
        alt: what it shows, in a few sentences with numbers.
        table: its numbers; None where ``alt`` says them all.
    """

    figure: Figure
    alt: str
    table: Table | None = None

    @property
    def svg(self) -> str:
        """The drawing as SVG; the same figure always gives the same text.

        Where matplotlib's font lacks a sign, for instance of a Chinese name, the text stays text,
        and whoever shows the drawing takes a font of the computer's.
        """
        try:
            return self._draw_svg("path", missing="error")
        except UserWarning:
            return self._draw_svg("none", missing="ignore")

    def _draw_svg(self, text: str, *, missing: Literal["error", "ignore"]) -> str:
        buffer = io.StringIO()
        with rc_context({"svg.hashsalt": "picture", "svg.fonttype": text}), catch_warnings():
            filterwarnings(missing, message=r"Glyph .* missing from", category=UserWarning)
            self.figure.savefig(buffer, format="svg", metadata={"Date": None, "Title": self.alt})
        return buffer.getvalue()

    @property
    def html(self) -> str:
        """Picture, words and table as a piece of HTML that needs nothing from elsewhere."""
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
        """Write the drawing into a file, whole or not at all; its title is the alternative text.

        Raises:
            BadRequest: the name ends in no kind of picture, or the file cannot be written.
        """
        target = Path(path)
        kind = target.suffix.lower()
        if kind not in SUFFIXES:
            raise BadRequest(
                f"a picture cannot end in {target.suffix or 'nothing'!r}",
                where=str(target),
                advice=f"End its name in one of: {', '.join(SUFFIXES)}.",
            )
        extra: dict[str, object] = {} if kind == ".png" else {_DATE[kind]: None}
        try:
            with (
                atomic_path(target) as part,
                rc_context({"svg.hashsalt": "picture"}),
                part.open("wb") as stream,
            ):
                self.figure.savefig(
                    stream, format=kind[1:], dpi=200, metadata={"Title": self.alt, **extra}
                )
        except OSError as error:
            raise BadRequest(
                f"cannot be written ({error.strerror or error})",
                where=str(target),
                advice="Choose a folder that exists and that you may write to.",
            ) from None

    def __str__(self) -> str:
        """The words and the numbers, for a terminal."""
        return f"{self.alt}\n\n{self.table}" if self.table else self.alt

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html}


_DATE = {".svg": "Date", ".pdf": "CreationDate"}  # left out, so that a picture never changes


def make_panels(
    rows: int, columns: int, *, width: float = 7.6, height: float = 3.2, shared: bool = False
) -> tuple[Figure, list[list[Axes]]]:
    """A figure with a grid of empty axes.

    Args:
        rows: of the grid.
        columns: of the grid.
        width: [in] of the figure.
        height: [in] of the figure.
        shared: whether a column shares its x axis, and a row its y axis.
    """
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


def add_legend(
    figure: Figure, axes: Sequence[Axes], *, columns: int = 3, extra: Sequence[Artist] = ()
) -> None:
    """One legend below all panels, each name once.

    Args:
        figure: where it goes.
        axes: the panels whose labels it lists.
        columns: at most so many names side by side.
        extra: further labeled entries.
    """
    entries: dict[str, Artist] = {}
    for panel in axes:
        handles, names = panel.get_legend_handles_labels()
        entries |= dict(zip(names, handles, strict=True))
    figure.legend(
        handles=[*entries.values(), *extra],
        fontsize=9,
        labelcolor=INK,
        loc="outside lower center",
        ncols=columns,
        frameon=False,
        handleheight=1.2 if extra else None,
    )
