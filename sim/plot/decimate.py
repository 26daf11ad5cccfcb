"""Decimate samples for drawing only: fewer points that give the same picture.

A log of 20,000 samples has more samples than a panel has pixels. Drawing all of them would cost
megabytes and seconds, and look the same.
"""

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

FINEST = 512  # cells across a panel, about as many as pixels
COARSER = 0.8  # cells of a grid relative to the one before; a small step drops few samples too many


def decimate_curve(y: Array, *, most: int) -> NDArray[np.intp]:
    """Indices of the samples of a curve to draw so that no spike is lost.

    The lowest and the highest sample of each group of neighbors are kept, and both ends.

    Args:
        y: (n,) the curve.
        most: approximate number of samples to keep.

    Returns:
        (m,) indices in ``y``, rising.
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
    """Indices of the samples of a scatter plot to draw so that its shape and outliers remain.

    The first sample in each cell of a grid is kept; the grid is as fine as the limit allows.

    Args:
        x: (n,) horizontal coordinates.
        y: (n,) vertical coordinates.
        most: largest number of samples to keep.

    Returns:
        (m,) indices in ``x``, rising.
    """
    cells = FINEST
    kept: NDArray[np.intp] = np.arange(x.size)
    while kept.size > most and cells > 1:
        where = _find_cells(x, cells) * cells + _find_cells(y, cells)
        kept = np.sort(np.unique(where, return_index=True)[1])
        cells = int(COARSER * cells)
    return kept[:most]


def _find_cells(values: Array, cells: int) -> NDArray[np.intp]:
    """(n,) index of the cell of each value, of ``cells`` cells of equal width."""
    low, high = float(values.min()), float(values.max())
    share = (values - low) / ((high - low) or 1.0)
    return np.minimum((share * cells).astype(np.intp), cells - 1)
