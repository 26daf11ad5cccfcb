"""A fit in one picture: every run measured and simulated, and its loops' step responses below."""

from collections.abc import Sequence

from sim.compared import Compared
from sim.errors import BadRequest
from sim.plot.followed import EVERY, blocks, numbers, words
from sim.plot.picture import Picture
from sim.plot.step import by_loop, draw_loop, said
from sim.trial import Trial
from sim.units import Unit


def whole_fit(runs: Sequence[Compared], tried: Sequence[Trial], *, per: Unit) -> Picture:
    """All of a fit that can be drawn.

    Args:
        runs: measured and simulated; of more than can be read the first are drawn.
        tried: feedback gains on trial; may be none.
        per: the unit of position to show.

    Raises:
        BadRequest: there is nothing to draw.
    """
    loops = by_loop(tried)
    if not runs and not loops:
        raise BadRequest("there is nothing to draw", advice="Settle first what the doubts say.")
    figure, empty = blocks(runs, per=per, more=len(loops))
    for part, mine in zip(empty, loops, strict=False):
        draw_loop(part, mine, per=per)
    told = [words(one, per=per) for one in runs[:EVERY]]
    if len(runs) > EVERY:
        told.append(f"The other {len(runs) - EVERY} runs are not drawn.")
    return Picture(figure, " ".join((*told, said(tried, per=per))), numbers(runs, per=per))
