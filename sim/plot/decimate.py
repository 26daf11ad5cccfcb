"""Fewer points for the same picture: what is drawn is thinned, what is counted never is.

A log of 20,000 samples has more of them than a panel has pixels; all of them would cost megabytes
and seconds, and show nothing more.
"""

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

FINEST = 512  # cells across a panel: about its pixels
COARSER = 0.8  # from one grid to the next, so that little more goes than has to


def decimate_curve(y: Array, *, most: int) -> NDArray[np.intp]:
    """Which samples of a curve to draw so that none of its spikes is lost.

    Of every stretch of neighbors the lowest and the highest are kept, and both ends.

    Args:
        y: (n,) the curve.
        most: how many to keep, roughly.

    Returns:
        (m,) places in ``y``, rising.
    """
    n = y.size
    if n <= most:
        return np.arange(n)
    starts = np.linspace(0, n, max(most // 2, 1), endpoint=False).astype(np.intp)
    kept = [0, n - 1]
    for start, end in zip(starts.tolist(), [*starts[1:].tolist(), n], strict=True):
        kept += [start + int(np.argmin(y[start:end])), start + int(np.argmax(y[start:end]))]
    return np.unique(np.array(kept, dtype=np.intp))


def decimate_cloud(x: Array, y: Array, *, most: int) -> NDArray[np.intp]:
    """Which samples of a cloud to draw so that its shape and its outliers stay.

    Of samples that would cover each other, in one cell of a grid, the first is kept; the grid is as
    fine as the limit allows.

    Args:
        x: (n,) across.
        y: (n,) up.
        most: how many to keep at most.

    Returns:
        (m,) places in ``x``, rising.
    """
    cells = FINEST
    kept: NDArray[np.intp] = np.arange(x.size)
    while kept.size > most and cells > 1:
        where = _cell(x, cells) * cells + _cell(y, cells)
        kept = np.sort(np.unique(where, return_index=True)[1])
        cells = int(COARSER * cells)
    return kept[:most]


def _cell(values: Array, cells: int) -> NDArray[np.intp]:
    """(n,) which of so many equal cells each value falls into."""
    low, high = float(values.min()), float(values.max())
    share = (values - low) / ((high - low) or 1.0)
    return np.minimum((share * cells).astype(np.intp), cells - 1)
