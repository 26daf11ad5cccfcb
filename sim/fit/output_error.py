"""Output-error fit of kS, kV, kA (and kG), with static friction.

Any number of runs of any kind will do. If the velocity is averaged before it is logged, or the
whole mechanism reacts late, these delays are fitted as well and reported.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import product

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, NotIdentifiable
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.estimation.initial_guess import clamp_to_physical, orient_forward
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.measurements import RunMeasurements, measure_runs
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import compute_parameter_covariance, make_joint_jacobian
from sim.fit.everyday_effects import (
    fit_everyday_effects,
    list_everyday_effects,
    remove_everyday_effects,
)
from sim.fit.fit_doubts import (
    warn_of_lags,
    warn_of_misfit,
    warn_of_opposed_signs,
    warn_of_strong_effects,
)
from sim.fit.gain_covariance import compute_gain_covariances
from sim.fit.gravity_type_hint import hint_gravity_type
from sim.fit.identifiability import moves_both_ways, refuse_unidentifiable, refuse_unrelated
from sim.fit.open_loop_fallback import (
    HOLDS,
    LAGS,
    OpenLoopReplay,
    fit_velocity_only,
    replay_open_loop,
)
from sim.fit.result import Fit
from sim.fit.run_lags import fit_run_lags
from sim.fit.search import (
    TRACKING,
    drop_outliers,
    fit_open_loop,
    fit_tracking,
    make_fit_problem,
    predict_improvement,
    refine,
)
from sim.fit.sysid_doubts import warn_of_uncertain_gains

WORTH = 8.0  # [of -2 log L] what a lag must explain to be believed: odds of some fifty to one
CHANCE = 4.0  # [of -2 log L] more for a window below a sample, of which noise looks like one
HINT = 2.0  # [of -2 log L] what a short one must promise before longer ones are tried
FIRST_LAGS = {"velocity-filter.window": (0.5, 2.0, 6.0), "delay.lag": (0.3, 1.0, 2.0, 4.0)}
SHORT_WINDOWS = (0.1, 1.0, 0.5)
SHORT_LAGS = {"velocity-filter.window": SHORT_WINDOWS, "delay.lag": (0.05, 0.2)}
"""[sample periods] from which a search begins, and from which again when gains are nearly right.

An answer a millisecond late passes for inertia: 3 % of it where kA/kV is 35 ms.
"""
PAIRS = {"velocity-filter.window": (0.0, 1.0, 2.5, 5.0), "delay.lag": (0.3, 1.0, 2.0)}
"""[sample periods] from which a search of both begins."""
GLANCE, HOPEFUL = 2, 3  # steps from each of these, and how many of them go on
FASTEST, SLOWEST = 1e-4, 0.5  # [s] between samples; other clocks do not tell seconds
HOLE = 10.0  # [s] in which anything might have happened


def fit_output_error(log: Log, *, type: str) -> Fit:  # noqa: A002 - SysId's word
    """Fit a log by simulating it.

    Args:
        log: any runs of one mechanism.
        type: ``simple``, ``elevator`` or ``arm``.

    Raises:
        BadRequest: an arm whose position is no angle.
        NotIdentifiable: the log cannot tell these gains; the message says what would.
    """
    per = find_unit(log.units)
    if type == "arm" and not per.angular:
        raise BadRequest(
            f"an arm's position must be an angle, and this log is in {per.name}",
            where=log.source,
            advice="Add --units radians, rotations or degrees, or --type elevator.",
        )
    _check_times(log)
    try:
        with np.errstate(all="ignore"):  # what overflows is refused
            found = _fit_problem(log, type=type)
    except np.linalg.LinAlgError:
        found = None
    if found is None or not all(
        map(math.isfinite, (*found.gains.values(), *found.errors.values()))
    ):
        raise _refuse_motion(log)
    return found


def _check_times(log: Log) -> None:
    """Refuse times that are no seconds, and a run with a hole in it."""
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
    return NotIdentifiable(
        "its motion does not match its voltage",
        where=log.source,
        advice="Inspect the log: are units, signs, times and test names right?",
    )


def _fit_problem(log: Log, *, type: str) -> Fit:  # noqa: A002 - as above
    log, guess, way = orient_forward(
        log, type=type
    )  # fitted as if the leads were swapped, and told
    begin = clamp_to_physical(guess, period=_sample_period(log.runs))
    seen = measure_runs(log, friction=None if type == "simple" else begin["kS"])
    problem = make_fit_problem(log, seen)
    plain = fit_tracking(problem, ModelStructure(type), begin)
    if not math.isfinite(plain.cost):
        raise _refuse_motion(log)
    every = problem
    problem, likeliest, followed = _choose_lags(problem, plain)
    problem, likeliest, followed = _add_run_lags(
        problem, likeliest, followed, every=every, period=_sample_period(log.runs)
    )
    problem, likeliest, followed = _add_everyday_effects(problem, likeliest, followed)
    searched, point, followed = fit_velocity_only(problem, likeliest, followed)
    gains, errors = _gains_with_errors(
        point, compute_parameter_covariance(searched, point), type=type
    )
    # what a model that does not hold adds to the errors is doubted; what noise alone would leave
    # unknown is refused
    share = searched.noise.velocity / float(np.sqrt(point.innovation_cov[1, 1]))
    least = {name: min(share, 1.0) * error for name, error in errors.items()}
    if type == "elevator" and not moves_both_ways(
        [record.measurements for record in searched.records]
    ):
        least |= {"kS": math.inf, "kG": math.inf}
    hint = hint_gravity_type(log, problem, followed, type=type)
    refuse_unidentifiable(gains, least, log=log, type=type, hint=hint)
    refuse_unrelated(followed, log=log, hint=hint)
    for wide, spread in compute_gain_covariances(searched, point, followed):
        others = _gains_with_errors(wide, spread, type=type)[1]
        errors = {name: max(error, others[name]) for name, error in errors.items()}
    alone = followed
    if list_everyday_effects(point):
        alone = replay_open_loop(searched, remove_everyday_effects(point))
    said = (
        *warn_of_misfit(followed, alone, per=find_unit(log.units), hint=hint),
        *warn_of_strong_effects(list_everyday_effects(point), searched.priors),
    )
    return _make_result(
        log, problem, point, way=way, gains=gains, errors=errors, followed=followed, said=said
    )


def _sample_period(seen: Sequence[RunMeasurements | Run]) -> float:
    """[s] between two samples."""
    return float(np.median(np.concatenate([np.diff(run.time) for run in seen])))


def _choose_lags(
    problem: PredictionErrorProblem, plain: Estimate
) -> tuple[PredictionErrorProblem, Estimate, OpenLoopReplay]:
    """The best point, with a velocity that is averaged, a late answer, or both, if worth it."""
    point = _add_lags(problem, plain, FIRST_LAGS, settle=fit_tracking)
    everything, problem = problem, drop_outliers(problem, point)

    def open_loop(first: Estimate) -> Estimate:
        if problem is not everything:
            first = fit_tracking(problem, first.structure, first.values)
        return fit_open_loop(problem, first)

    found = open_loop(point)
    if point is not plain:
        without = open_loop(plain)
        found = found if found.cost < without.cost - WORTH else without
    followed = replay_open_loop(problem, found)
    if followed.has_misfit or found.process_noise > HOLDS * problem.noise.velocity**2:
        other = open_loop(_fit_both_lags(problem, plain))
        more = len(other.structure.effects) - len(found.structure.effects)
        if other.cost < found.cost - WORTH * max(more, 0):
            found, followed = other, replay_open_loop(problem, other)
    if followed.has_misfit:  # a millisecond is not what is wrong
        return problem, found, followed
    best = _add_short_lags(problem, found)
    return problem, best, followed if best is found else replay_open_loop(problem, best)


def _add_run_lags(
    problem: PredictionErrorProblem,
    point: Estimate,
    followed: OpenLoopReplay,
    *,
    every: PredictionErrorProblem,
    period: float,
) -> tuple[PredictionErrorProblem, Estimate, OpenLoopReplay]:
    """The same with a lag of each run's own, where the runs' likelihood asks for it."""
    if _lacks_more(problem, point, followed):
        return problem, point, followed
    extended, found = fit_run_lags(problem, point, every=every, period=period)
    if found is point:
        return problem, point, followed
    found = _add_short_lags(extended, found)
    after = replay_open_loop(extended, found)
    if _lacks_more(extended, found, after):
        return problem, point, followed
    return extended, found, after


def _lacks_more(problem: PredictionErrorProblem, point: Estimate, followed: OpenLoopReplay) -> bool:
    """Whether so much is missing from a model that its small parameters stand in for it."""
    return followed.has_misfit and point.process_noise > TRACKING * problem.noise.velocity**2


def _add_everyday_effects(
    problem: PredictionErrorProblem, point: Estimate, followed: OpenLoopReplay
) -> tuple[PredictionErrorProblem, Estimate, OpenLoopReplay]:
    """The same with the small effects of every mechanism, where they make the model hold."""
    extended, found = fit_everyday_effects(problem, point)
    # as long as more is missing, or the runs differ, small effects only stand in for that
    if found is point or found.process_noise > TRACKING * problem.noise.velocity**2:
        return problem, point, followed
    return extended, found, replay_open_loop(extended, found)


def _fit_both_lags(problem: PredictionErrorProblem, plain: Estimate) -> Estimate:
    """The best point of those that begin with a window and a lag at once.

    Where both act, the gains of a model that has neither are so far off that what one of them alone
    promises is worth little.

    Args:
        problem: what is searched.
        plain: the best estimate without either.
    """
    points = []
    for window, lag in product(*PAIRS.values()):
        structure, values = plain.structure, dict(plain.values)
        for name, size in zip(PAIRS, (window, lag), strict=True):
            if size > 0.0:
                structure += name.partition(".")[0]
                values[name] = size * problem.period
        points.append(fit_tracking(problem, structure, values, steps=GLANCE))
    points.sort(key=lambda one: one.cost)
    best = (fit_tracking(problem, one.structure, one.values) for one in points[:HOPEFUL])
    return min(best, key=lambda one: one.cost)


def _add_short_lags(problem: PredictionErrorProblem, found: Estimate) -> Estimate:
    """An estimate whose gains are nearly right, with the short lags that are worth it."""

    def settle(
        problem: PredictionErrorProblem, structure: ModelStructure, values: Mapping[str, float]
    ) -> Estimate:
        first = problem.evaluate(structure, values, found.nuisance, found.process_noise)
        return fit_open_loop(problem, refine(problem, first))

    return _add_lags(problem, found, SHORT_LAGS, settle=settle)


def _add_lags(
    problem: PredictionErrorProblem,
    point: Estimate,
    lags: Mapping[str, Sequence[float]],
    *,
    settle: Callable[[PredictionErrorProblem, ModelStructure, Mapping[str, float]], Estimate],
) -> Estimate:
    """A point with those lags that are worth it, one after another.

    Args:
        problem: what is searched.
        point: a best estimate.
        lags: name -> [sample periods] from which to try.
        settle: the best estimate near some values.
    """
    left = {name: sizes for name, sizes in lags.items() if name not in point.values}
    while left:
        # a lag of any size shows in what one of the first two promises
        firsts, others = (
            [(name, size * problem.period) for name, sizes in left.items() for size in sizes[part]]
            for part in (slice(2), slice(2, None))
        )
        kept = make_joint_jacobian(problem, point, fine=True)
        promised = predict_improvement(problem, point, firsts, kept=kept)
        if not promised.max() > HINT:
            break
        more = predict_improvement(problem, point, others, kept=kept)
        tried = firsts + others
        least = np.array([WORTH + CHANCE * (left[name] is SHORT_WINDOWS) for name, _ in tried])
        worth = np.concatenate([promised, more]) - least
        if not worth.max() > 0.0:
            break
        best = int(np.argmax(worth))
        name, value = tried[best]
        structure = point.structure + name.partition(".")[0]
        other = settle(problem, structure, {**point.values, name: value})
        if not other.cost < point.cost - least[best]:
            break
        point = other
        del left[name]
    return point


def _gains_with_errors(
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
    log: Log, problem: PredictionErrorProblem, point: Estimate, *, way: float,
    gains: Mapping[str, float], errors: Mapping[str, float], followed: OpenLoopReplay,
    said: tuple[Doubt, ...],
) -> Fit:  # fmt: skip
    """The result: gains, how well they follow, and what to doubt."""
    change = followed.acceleration_scores
    window, lag = (point.values.get(name, 0.0) for name in LAGS)
    signed = {name: value if name == "offset_rad" else way * value for name, value in gains.items()}
    return Fit(
        type=point.structure.type,
        method="output-error",
        units="radians" if find_unit(log.units).angular else "meters",
        log_units=find_unit(log.units).name,
        gains=signed,
        errors=errors,
        acceleration_r2=change[0],
        acceleration_rmse=change[1],
        simulated_velocity_r2=followed.r2,
        simulated_velocity_rmse=followed.rmse,
        samples_used=_count_samples(log, problem),
        position_delay=lag,
        velocity_delay=lag + 0.5 * window,
        velocity_threshold=0.0,
        step_duration=0.0,
        parts=list_everyday_effects(point),
        doubts=(
            *log.doubts,
            *warn_of_opposed_signs(way),
            *warn_of_lags(window, lag),
            *said,
            *warn_of_uncertain_gains(signed, errors, per=find_unit(log.units)),
        ),
    )


def _count_samples(log: Log, problem: PredictionErrorProblem) -> dict[str, int]:
    """Test -> samples in motion that were compared."""
    counts: dict[str, int] = {}
    long = [run for run in log.runs if len(run) > 3]  # noqa: PLR2004 - as ``see`` has it
    for run, record in zip(long, problem.records, strict=True):
        counts[run.test] = counts.get(run.test, 0) + int(record.measurements.moving.sum())
    return counts
