"""Standard errors of gains, as bars."""

from collections.abc import Mapping

from sim.plot.picture import COLORS, INK, Picture, make_rows
from sim.plot.table import to_text

UNKNOWN = 1.0  # [share of the gain] standard error from which a gain is called unknown


def plot_gain_errors(errors: Mapping[str, float]) -> Picture:
    """The standard error of each gain as a bar; a gain with a full bar is unknown.

    Args:
        errors: gain -> standard error as a share of the gain, may be infinite.
    """
    figure, axes = make_rows(list(errors), label="standard error [% of the gain]")
    shares = {gain: min(error, UNKNOWN) for gain, error in errors.items()}
    words = [
        "unknown" if one == UNKNOWN else f"± {to_text(100 * one)} %" for one in shares.values()
    ]
    bars = axes.barh(
        range(len(shares)),
        [100 * one for one in shares.values()],
        color=COLORS[: len(shares)],
        alpha=0.6,
    )
    axes.bar_label(bars, words, padding=4, fontsize=9, color=INK)
    axes.set_xlim(0.0, 118.0)
    alt = "Bars show the standard error of each gain. " + " ".join(
        f"{gain}: {word}." for gain, word in zip(shares, words, strict=True)
    )
    return Picture(figure, alt)
