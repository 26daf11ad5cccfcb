"""A fit in one picture: every run measured and simulated, and its loops' step responses below."""

from collections.abc import Sequence

from sim.core.errors import BadRequest
from sim.core.units import Unit
from sim.fit.feedback_trial import FeedbackTrial
from sim.fit.replay import RunReplay
from sim.plot.measured_vs_simulated import EVERY, describe_run, draw_all_runs, make_error_table
from sim.plot.picture import Picture
from sim.plot.step_response import describe_trials, draw_loop, group_by_loop


def plot_fit_overview(
    runs: Sequence[RunReplay], tried: Sequence[FeedbackTrial], *, per: Unit
) -> Picture:
    """All of a fit that can be drawn.

    Args:
        runs: measured and simulated; of more than can be read the first are drawn.
        tried: feedback gains on trial; may be none.
        per: the unit of position to show.

    Raises:
        BadRequest: there is nothing to draw.
    """
    loops = group_by_loop(tried)
    if not runs and not loops:
        raise BadRequest("there is nothing to draw", advice="First do what the warnings say.")
    figure, empty = draw_all_runs(runs, per=per, more=len(loops))
    for part, mine in zip(empty, loops, strict=False):
        draw_loop(part, mine, per=per)
    told = [describe_run(one, per=per) for one in runs[:EVERY]]
    if len(runs) > EVERY:
        told.append(f"The other {len(runs) - EVERY} runs are not drawn.")
    return Picture(
        figure, " ".join((*told, describe_trials(tried, per=per))), make_error_table(runs, per=per)
    )
