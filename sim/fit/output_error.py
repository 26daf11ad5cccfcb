"""Output-error fit of kS, kV, kA (and kG), with static friction.

Any number of runs of any kind will do. If the velocity is averaged before it is logged, or the
whole mechanism reacts late, these delays are fitted as well and reported.
"""

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import NotIdentifiable
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.estimation.initial_guess import clamp_to_physical, orient_forward
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.measurements import LEAST_SPEED, measure_runs
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import compute_parameter_covariance, make_joint_jacobian
from sim.estimation.run_variation import compute_run_variation_covariance
from sim.fit.everyday_effects import (
    WORTH,
    add_absent_effects,
    fit_everyday_effects,
    list_everyday_effects,
    remove_everyday_effects,
)
from sim.fit.fit_doubts import (
    warn_of_lags,
    warn_of_misfit,
    warn_of_strong_effects,
)
from sim.fit.gravity_type_hint import hint_gravity_type
from sim.fit.identifiability import doubt_undetermined, moves_both_ways, refuse_unrelated
from sim.fit.open_loop_fallback import (
    HOLDS,
    LAGS,
    Solution,
    fit_velocity_only,
    replay_open_loop,
)
from sim.fit.result import Fit, multiply_gains, refuse_length_of_arm
from sim.fit.run_differences import fit_run_differences
from sim.fit.search import (
    TRACKING,
    drop_outliers,
    fit_open_loop,
    fit_tracking,
    make_fit_problem,
    predict_improvement,
    refine,
)
from sim.fit.sysid_doubts import OPPOSED_SIGNS

PENALTY = 4.0  # [of -2 log L] more for a window below a sample period, which noise can imitate
HINT = 2.0  # [of -2 log L] predicted improvement by short lags from which on longer ones are tried
FIRST_LAGS = {"velocity-filter.window": (0.5, 2.0, 6.0), "delay.lag": (0.3, 1.0, 2.0, 4.0)}
SHORT_WINDOWS = (0.1, 1.0, 0.5)
SHORT_LAGS = {"velocity-filter.window": SHORT_WINDOWS, "delay.lag": (0.05, 0.2)}
"""[sample periods] start values of lags: of the first search, and when the gains are nearly right.

A delay of a millisecond looks like inertia: 3 % of it if kA/kV is 35 ms.
"""
PAIRS = {"velocity-filter.window": (0.0, 1.0, 2.5, 5.0), "delay.lag": (0.3, 1.0, 2.0)}
"""[sample periods] start values of both lags together."""
FIRST_STEPS, BEST = 2, 3  # steps of a search from each pair, and how many pairs are then continued
FASTEST, SLOWEST = 1e-4, 0.5  # [s] sample periods; outside of them the times are not in seconds
HOLE = 10.0  # [s] longest gap in a run


def fit_output_error(log: Log, *, type: str) -> Fit:  # noqa: A002 - SysId's word
    """Fit a log by simulating it.

    Args:
        log: any runs of one mechanism.
        type: ``simple``, ``elevator`` or ``arm``.

    Raises:
        BadRequest: an arm whose position is not an angle.
        NotIdentifiable: the log does not determine these gains; the message says which test would.
    """
    refuse_length_of_arm(log, type=type)
    _check_times(log)
    log, still = _leave_out_still_runs(log, type=type)
    try:
        with np.errstate(all="ignore"):  # gains that are not finite are refused
            found = _fit_problem(log, type=type)
    except np.linalg.LinAlgError:
        found = None
    if found is None or not np.isfinite([*found.gains.values(), *found.errors.values()]).all():
        raise _refuse_motion(log)
    return replace(found, doubts=(*still, *found.doubts))


def _leave_out_still_runs(log: Log, *, type: str) -> tuple[Log, tuple[Doubt, ...]]:  # noqa: A002 - as above
    """The log without runs of an arm or elevator in which it never leaves its stop, and a doubt.

    How hard a stop pushes back is unknown, so such a run says nothing about the gains.
    """
    still = [run for run in log.runs if run.top_speed <= LEAST_SPEED * log.top_speed]
    if type == "simple" or not still or len(still) == len(log.runs):
        return log, ()
    tests = " and ".join(run.test for run in still)
    doubt = Doubt(
        "still-run",
        f"In {tests} the mechanism does not move, so that was left out. Repeat it with more volts.",
    )
    moving = tuple(run for run in log.runs if run.top_speed > LEAST_SPEED * log.top_speed)
    return replace(log, runs=moving), (doubt,)


def _check_times(log: Log) -> None:
    """Refuse times that are not in seconds, and a run with a long gap."""
    steps = [(run.test, np.diff(run.time)) for run in log.runs if len(run) > 1]
    if not steps:
        return
    period = _sample_period(log.runs)
    if not FASTEST <= period <= SLOWEST:
        raise NotIdentifiable(
            f"the samples are {period:.3g} s apart, where a robot logs every 0.001 to 0.1 s",
            where=log.source,
            advice="Give times in seconds.",
        )
    for test, some in steps:
        if some.max() > HOLE:
            raise NotIdentifiable(
                f"{test} has a gap of {some.max():.3g} s between two samples",
                where=log.source,
                advice="Cut the run there, or record it again.",
            )


def _refuse_motion(log: Log) -> NotIdentifiable:
    """The error for a log that no gains can simulate."""
    return NotIdentifiable(
        "its motion does not match its voltage",
        where=log.source,
        advice="Inspect the log: are units, signs, times and test names right?",
    )


def _fit_problem(log: Log, *, type: str) -> Fit:  # noqa: A002 - as above
    log, guess, sign = orient_forward(log, type=type)  # a negative sign becomes a warning
    begin = clamp_to_physical(guess, period=_sample_period(log.runs))
    measured = measure_runs(log, friction=None if type == "simple" else begin["kS"])
    problem = make_fit_problem(log, measured)
    begin = clamp_to_physical(begin, period=problem.period)  # of fresh readings
    plain = fit_tracking(problem, ModelStructure(type), begin)
    if not math.isfinite(plain.cost):
        raise _refuse_motion(log)
    likeliest = _add_run_differences(
        _choose_lags(problem, plain), every=problem, period=_sample_period(log.runs)
    )
    likeliest = _add_everyday_effects(likeliest)
    found = fit_velocity_only(likeliest)
    searched, point, replay = found.problem, found.point, found.replay
    gains, by_noise = compute_gains_with_errors(
        point, compute_parameter_covariance(searched, point), type=type
    )
    # a gain is refused if noise alone leaves it undetermined; errors of the model are warnings
    share = searched.noise.velocity / float(np.sqrt(point.innovation_cov[1, 1]))
    least = {name: min(share, 1.0) * error for name, error in by_noise.items()}
    both_ways = moves_both_ways([record.measurements for record in searched.records])
    if type == "elevator" and not both_ways:
        least |= {"kS": math.inf, "kG": math.inf}
    hint = hint_gravity_type(log, likeliest.problem, replay, type=type)
    unknown = doubt_undetermined(gains, least, log=log, type=type, both_ways=both_ways, hint=hint)
    refuse_unrelated(replay, log=log, hint=hint)
    whole = (searched, point) if searched.priors else add_absent_effects(searched, point)
    _, errors = compute_gains_with_errors(
        whole[1], compute_run_variation_covariance(*whole), type=type
    )
    gains_only = replay_open_loop(searched, remove_everyday_effects(point))
    said = (
        *unknown,
        *warn_of_misfit(replay, gains_only, hint=hint),
        *warn_of_strong_effects(list_everyday_effects(point), searched.priors),
    )
    return _make_result(log, found, sign=sign, gains=gains, errors=errors, said=said)


def _sample_period(runs: Sequence[Run]) -> float:
    """[s] median time between two samples."""
    return float(np.median(np.concatenate([np.diff(run.time) for run in runs])))


def _choose_lags(problem: PredictionErrorProblem, plain: Estimate) -> Solution:
    """The best estimate, with an averaged velocity, a delay, or both, if they improve it enough."""
    point = _add_lags(problem, plain, FIRST_LAGS, refit=fit_tracking)
    kept = drop_outliers(problem, point)

    def fit_without_outliers(first: Estimate) -> Solution:
        if kept is not problem:
            first = fit_tracking(kept, first.structure, first.values)
        return Solution(kept, fit_open_loop(kept, first))

    found = fit_without_outliers(point)
    if point is not plain:
        without = fit_without_outliers(plain)
        found = found if found.point.cost < without.point.cost - WORTH else without
    if found.needs_noise(HOLDS) or found.replay.has_misfit:
        other = fit_without_outliers(_fit_both_lags(kept, plain))
        more = len(other.point.structure.effects) - len(found.point.structure.effects)
        if other.point.cost < found.point.cost - WORTH * max(more, 0):
            found = other
    # with a misfit, short lags are not the cause
    return found if found.replay.has_misfit else _add_short_lags(found)


def _add_run_differences(
    found: Solution, *, every: PredictionErrorProblem, period: float
) -> Solution:
    """The solution with runs that differ, or unchanged if it is no better."""
    if found.is_incomplete:
        return found
    problem, point = fit_run_differences(found.problem, found.point, every=every, period=period)
    if point is found.point:
        return found
    other = _add_short_lags(Solution(problem, point))
    return found if other.is_incomplete else other


def _add_everyday_effects(found: Solution) -> Solution:
    """The solution with small effects, or unchanged if that is not enough."""
    problem, point = fit_everyday_effects(found.problem, found.point)
    other = Solution(problem, point)
    # if more is missing, or the runs differ, small effects would only imitate that
    return found if point is found.point or other.needs_noise(TRACKING) else other


def _fit_both_lags(problem: PredictionErrorProblem, plain: Estimate) -> Estimate:
    """The best of several fits that start with both a velocity window and a lag.

    If the log has both, the gains of a model without them are so wrong that the predicted
    improvement by one alone is unreliable.

    Args:
        problem: the measurements.
        plain: the best estimate without either.
    """
    points = []
    for window, lag in product(*PAIRS.values()):
        structure, values = plain.structure, dict(plain.values)
        for name, size in zip(PAIRS, (window, lag), strict=True):
            if size > 0.0:
                structure += name.partition(".")[0]
                values[name] = size * problem.period
        points.append(fit_tracking(problem, structure, values, steps=FIRST_STEPS))
    points.sort(key=lambda one: one.cost)
    best = (fit_tracking(problem, one.structure, one.values) for one in points[:BEST])
    return min(best, key=lambda one: one.cost)


def _add_short_lags(found: Solution) -> Solution:
    """A solution with nearly correct gains, with those short lags that improve it enough."""
    before = found.point

    def refit(
        problem: PredictionErrorProblem, structure: ModelStructure, values: Mapping[str, float]
    ) -> Estimate:
        first = problem.change(before, structure=structure, values=values)
        return fit_open_loop(problem, refine(problem, first))

    point = _add_lags(found.problem, before, SHORT_LAGS, refit=refit)
    return found if point is before else Solution(found.problem, point)


def _add_lags(
    problem: PredictionErrorProblem,
    point: Estimate,
    lags: Mapping[str, Sequence[float]],
    *,
    refit: Callable[[PredictionErrorProblem, ModelStructure, Mapping[str, float]], Estimate],
) -> Estimate:
    """An estimate with those lags that improve it enough, added one after another.

    Args:
        problem: the measurements.
        point: the best estimate without them.
        lags: parameter -> start values [sample periods].
        refit: fits a structure from some values.
    """
    left = {name: sizes for name, sizes in lags.items() if name not in point.values}
    while left:
        # the first two start values show whether there is a lag of any size
        firsts, others = (
            [(name, size * problem.period) for name, sizes in left.items() for size in sizes[part]]
            for part in (slice(2), slice(2, None))
        )
        kept = make_joint_jacobian(problem, point, fine=True)
        first = predict_improvement(problem, point, firsts, kept=kept)
        if not first.max() > HINT:
            break
        more = predict_improvement(problem, point, others, kept=kept)
        tried = firsts + others
        least = np.array([WORTH + PENALTY * (left[name] is SHORT_WINDOWS) for name, _ in tried])
        worth = np.concatenate([first, more]) - least
        if not worth.max() > 0.0:
            break
        best = int(np.argmax(worth))
        name, value = tried[best]
        structure = point.structure + name.partition(".")[0]
        other = refit(problem, structure, {**point.values, name: value})
        if not other.cost < point.cost - least[best]:
            break
        point = other
        del left[name]
    return point


def compute_gains_with_errors(
    point: Estimate,
    spread: Array,
    *,
    type: str,  # noqa: A002 - as above
) -> tuple[dict[str, float], dict[str, float]]:
    """The gains and their standard errors; an arm's gravity as kG and an angle."""
    values, errors = dict(point.values), np.sqrt(np.maximum(np.diag(spread), 0.0))
    names = list(point.structure.searched_names)
    sizes = dict(zip(names, errors.tolist(), strict=True))
    gains = {name: values[name] for name in ("kS", "kV", "kA")}
    if type == "elevator":
        gains["kG"] = values["kG"]
    if type == "arm":
        level, upright = values["level"], values["upright"]
        kg = math.hypot(level, upright)
        gains |= {"kG": kg, "offset_rad": math.atan2(-upright, level)}
        pair = [names.index("level"), names.index("upright")]
        part = spread[np.ix_(pair, pair)]
        along = np.array([level, upright]) / kg
        across = np.array([upright, -level]) / kg**2
        sizes["kG"] = math.sqrt(max(float(along @ part @ along), 0.0))
        sizes["offset_rad"] = math.sqrt(max(float(across @ part @ across), 0.0))
    return gains, {name: sizes[name] for name in gains}


def _make_result(
    log: Log, found: Solution, *, sign: float, gains: Mapping[str, float],
    errors: Mapping[str, float], said: tuple[Doubt, ...],
) -> Fit:  # fmt: skip
    """The result: gains, goodness of fit, and warnings."""
    point, replay = found.point, found.replay
    change = replay.acceleration_scores
    window, lag = (point.values.get(name, 0.0) for name in LAGS)
    return Fit(
        type=point.structure.type,
        method="output-error",
        units="radians" if find_unit(log.units).angular else "meters",
        log_units=find_unit(log.units).name,
        gains=multiply_gains(gains, sign),
        errors=errors,
        acceleration_r2=change[0],
        acceleration_rmse=change[1],
        simulated_velocity_r2=replay.r2,
        simulated_velocity_rmse=replay.rmse,
        samples_used=_count_samples(found.problem),
        position_delay=lag,
        velocity_delay=lag + 0.5 * window,
        velocity_threshold=0.0,
        step_duration=0.0,
        lag_differs=bool(point.nuisance.lag_offset.any()),
        parts=list_everyday_effects(point),
        doubts=(
            *log.doubts,
            *((OPPOSED_SIGNS,) if sign < 0.0 else ()),
            *warn_of_lags(window, lag),
            *said,
        ),
    )


def _count_samples(problem: PredictionErrorProblem) -> dict[str, int]:
    """Test -> number of samples in motion that were compared."""
    counts: Counter[str] = Counter()
    for record in problem.records:
        counts[record.test] += int(record.measurements.moving.sum())
    return dict(counts)
