"""A fit as a picture."""

import os

from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.core.units import find_unit
from sim.fit import Fit
from sim.fit.replay import replay_fit
from sim.plot.fit_overview import plot_fit_overview


def write_picture(found: Fit, log: Log, path: str | os.PathLike[str]) -> None:
    """Write all runs as one picture.

    Args:
        found: the fit, in the unit to show.
        log: what it was fitted to.
        path: path of the picture.

    Raises:
        BadRequest: the file's name does not end in .png, .svg or .pdf, the file cannot be written,
            or there is nothing to draw.
    """
    try:
        runs = replay_fit(found, log)
    except BadRequest:  # the doubts about the gains say why
        runs = ()
    plot_fit_overview(runs, per=find_unit(found.units)).save(path)
