"""A voltage budget: which term of the model takes how many volts, moment by moment."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.plot.picture import COLORS, INK, PAPER, REFERENCE, Picture, add_legend, make_panels
from sim.plot.table import Table, to_text

HATCHES = ("", "//", "..", "xx")  # a texture beside each color
TABLE_ROWS = 6  # moments that the table shows


def plot_budget(
    time: Array, terms: Mapping[str, Array], *, applied: Array, moment: float | None = None
) -> Picture:
    """Terms of the model as areas on top of each other, under the voltage that was applied.

    What is positive is stacked upward from zero, what is negative downward: while a robot brakes,
    the term of the acceleration gives volts back.

    Args:
        time: (n,) [s], rising.
        terms: name -> (n,) [V] what this term takes.
        applied: (n,) [V].
        moment: [s] to look at closely: a line marks it, and the words tell its numbers.

    Raises:
        BadRequest: there are no terms, or one has another length than ``time``.
    """
    if not terms or any(len(one) != len(time) for one in (*terms.values(), applied)):
        raise BadRequest(
            "every term needs one value for each time", advice="Give one or more, of equal length."
        )
    figure, ((axes,),) = make_panels(1, 1, height=3.6)
    _stack(axes, time, terms)
    axes.plot(time, applied, color=REFERENCE, linewidth=1.6, label="applied")
    axes.axhline(0.0, color=INK, linewidth=0.8)
    if moment is not None:
        axes.axvline(moment, color=INK, linestyle=":", linewidth=1.4, label=f"at {moment:g} s")
    axes.set_xlabel("time [s]", color=INK)
    axes.set_ylabel("voltage [V]", color=INK)
    add_legend(figure, (axes,), columns=len(terms) + 2)
    table = _table(time, terms, applied, moment)
    return Picture(figure, _words(time, terms, applied, moment), table)


def _stack(axes: Axes, time: Array, terms: Mapping[str, Array]) -> None:
    """Draw each term on top of the ones before it, positive and negative parts apart."""
    above, below = np.zeros(len(time)), np.zeros(len(time))
    for index, (name, volts) in enumerate(terms.items()):
        up, down = np.maximum(volts, 0.0), np.minimum(volts, 0.0)
        color, hatch = COLORS[index % len(COLORS)], HATCHES[index % len(HATCHES)]
        for low, high, label in ((above, above + up, name), (below, below + down, None)):
            axes.fill_between(
                time, low, high, label=label, facecolor=color, hatch=hatch, edgecolor=PAPER,
                linewidth=0.0, alpha=0.85,
            )  # fmt: skip
        above, below = above + up, below + down


def _at(time: Array, moment: float) -> int:
    return int(np.argmin(np.abs(time - moment)))


def _table(time: Array, terms: Mapping[str, Array], applied: Array, moment: float | None) -> Table:
    """The budget at one moment, or at a few."""
    places = np.linspace(0, len(time) - 1, TABLE_ROWS).round().astype(int).tolist()
    if moment is not None:
        places = [_at(time, moment)]
    rows: list[tuple[str | float, ...]] = []
    for place in places:
        volts = [float(one[place]) for one in (*terms.values(), applied)]
        rows.append((f"{time[place]:.2f}", *volts))
    header = ("time [s]", *(f"{name} [V]" for name in terms), "applied [V]")
    return Table(header, tuple(rows), caption="The budget in numbers")


def _words(time: Array, terms: Mapping[str, Array], applied: Array, moment: float | None) -> str:
    said = f"Areas on top of each other from {time[0]:.2f} to {time[-1]:.2f} s: "
    said += ", ".join(
        f"{name} between {to_text(float(volts.min()))} and {to_text(float(volts.max()))} V"
        for name, volts in terms.items()
    )
    said += f". A black line shows the applied voltage, at most {to_text(_most(applied))} V."
    if moment is not None:
        place = _at(time, moment)
        said += f" At {time[place]:.2f} s, of {to_text(float(applied[place]))} V: "
        parts = (f"{name} {to_text(float(volts[place]))} V" for name, volts in terms.items())
        said += ", ".join(parts) + "."
    return said


def _most(values: Array) -> float:
    return float(values[np.argmax(np.abs(values))])
