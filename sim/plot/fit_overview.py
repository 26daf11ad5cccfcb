"""A fit in one picture: its runs, measured and simulated, and the loops' step responses."""

from collections.abc import Sequence

from sim.core.errors import BadRequest
from sim.core.units import Unit
from sim.fit.feedback_trial import FeedbackTrial
from sim.fit.replay import RunReplay
from sim.plot.measured_vs_simulated import MOST_RUNS, describe_run, draw_all_runs, make_error_table
from sim.plot.picture import Picture
from sim.plot.step_response import describe_trials, draw_loop, group_by_loop


def plot_fit_overview(
    runs: Sequence[RunReplay], tried: Sequence[FeedbackTrial], *, per: Unit
) -> Picture:
    """Runs and step responses of a fit in one picture.

    Args:
        runs: measured and simulated runs; at most the first ``MOST_RUNS`` are drawn.
        tried: simulated trials of feedback gains; may be empty.
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
    sentences = [describe_run(one, per=per) for one in runs[:MOST_RUNS]]
    if len(runs) > MOST_RUNS:
        sentences.append(f"The other {len(runs) - MOST_RUNS} runs are not drawn.")
    return Picture(
        figure,
        " ".join((*sentences, describe_trials(tried, per=per))),
        make_error_table(runs, per=per),
    )
