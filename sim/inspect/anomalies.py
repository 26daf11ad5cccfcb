"""Anomalies: intervals in which the velocity of a run does not follow its voltage.

The baseline model of the whole log predicts a run's velocity from its voltage. An anomaly is an
interval of limited length in which the residual is larger than noise and the usual errors of a
linear model. Each fault that could be the cause predicts a shape of the residual, and the share of
the anomaly's sum of squares that the shape explains is the confidence in that fault.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array, Run
from sim.inspect.baseline_model import BaselineModel

WITHIN = 0.1  # [V] usual error of a linear model,
SHARE = 0.1  # [share of the back-EMF] additional with speed,
ONSET, SETTLED = 0.35, 0.6  # [V, s] additional for a time after the start, because of friction
LATE = 0.03  # [s] age that a reading may have
SIGMAS = 3.0  # [standard deviations of the averaged noise]
AVERAGE = 0.04  # [s] over which noise is averaged, at least two samples
SLACK = 0.06  # [s] uncertainty of an anomaly's begin and end
SHORTEST = 0.03  # [s] a shorter anomaly is noise, at least two samples
LONGEST = 0.6  # [share of the motion] a longer deviation is not an anomaly
AROUND = 0.15  # [s] before and after an anomaly that a hypothesis has to explain as well
ALIKE = 0.5  # [share of the shorter] overlap from which on two anomalies are the same
JOIN = 0.06  # [s] two closer anomalies are one


@dataclass(frozen=True, eq=False)
class Anomaly:
    """An interval of a run in which its velocity does not follow its voltage.

    Args:
        run: index of the run in the log.
        first: index of its first sample.
        last: index of its last sample.
        begin: index of the first sample of the interval with its surroundings.
        end: index after the last sample of that interval.
        residual: (end - begin,) [m/s or rad/s] measured minus predicted velocity, minus the run's
            usual residual.
        expected: (end - begin,) [m/s or rad/s] predicted velocity.
    """

    run: int
    first: int
    last: int
    begin: int
    end: int
    residual: Array
    expected: Array

    def list_candidate_spans(self, *, margin: int) -> list[tuple[int, int]]:
        """Candidate (begin, end) samples of the disturbance within the anomaly.

        Args:
            margin: [samples] largest distance from its first and last sample, 3 or more.
        """
        return self._list_spans(self.first, self.last + 1, reach=margin, stride=margin // 3)

    def refine_spans(self, span: tuple[int, int], *, margin: int) -> list[tuple[int, int]]:
        """Candidate spans at sample resolution around the best of ``list_candidate_spans``."""
        first, last = span
        return self._list_spans(
            self.begin + first, self.begin + last, reach=margin // 3 - 1, stride=1
        )

    def _list_spans(
        self, first: int, last: int, *, reach: int, stride: int
    ) -> list[tuple[int, int]]:
        return [
            (begin - self.begin, end - self.begin)
            for begin in range(first - reach, first + reach + 1, stride)
            for end in range(last - reach, last + reach + 1, stride)
            if self.begin <= begin < end <= self.end
        ]

    def compute_explained_share(self, shape: Array) -> float:
        """[1] share of the squared residual explained by a shape (end - begin,); may be below 0."""
        total = float(self.residual @ self.residual)
        rest = self.residual - shape
        return 1.0 - float(rest @ rest) / total if total > 0.0 else 0.0


def predict_velocity(run: Run, baseline: BaselineModel, *, still: float) -> Array:
    """(n,) [m/s or rad/s] velocity that the baseline model predicts from a run's voltage.

    Before its first motion the mechanism is at rest, because a log does not show whether a stop or
    friction holds it.

    Args:
        run: the run.
        baseline: the baseline model.
        still: [m/s or rad/s] a slower mechanism is at rest.
    """
    begin = find_first_motion(run, still=still)
    rest = np.zeros(begin)
    velocity = float(run.velocity[begin]) if abs(run.velocity[begin]) > still else 0.0
    moving = baseline.replay(
        run, voltage=run.voltage, first=begin, last=len(run), velocity=velocity
    )
    return np.concatenate((rest, moving))


def find_first_motion(run: Run, *, still: float) -> int:
    """Index of the sample before the first three moving ones; the last index if nothing moves."""
    fast = np.abs(run.velocity) > still
    lasting = fast[:-2] & fast[1:-1] & fast[2:]
    return max(int(np.argmax(lasting)) - 1, 0) if lasting.any() else max(len(run) - 1, 0)


def find_anomalies(
    runs: Sequence[Run],
    expected: Sequence[Array],
    baseline: BaselineModel,
    *,
    still: float,
    noise: float,
    period: float,
) -> tuple[Anomaly, ...]:
    """Find the intervals in which runs do not follow the prediction.

    One that another run has at the same position, or as long after its start, is left out: there
    the mechanism is the cause, not a fault.

    Args:
        runs: the runs of a log.
        expected: per run, (n,) [m/s or rad/s] predicted velocity.
        baseline: the baseline model of the log.
        still: [m/s or rad/s] a slower mechanism is at rest.
        noise: [m/s or rad/s] standard deviation of the velocity in motion.
        period: [s] usual time between samples.
    """
    found = []
    wide = max(2, round(AVERAGE / period))
    sigma = SIGMAS * noise / np.sqrt(wide)
    for index, run in enumerate(runs):
        if len(run) < 3 * wide:
            continue
        begin = find_first_motion(run, still=still)
        since = run.time - run.time[begin]
        early = ONSET * (since < SETTLED)
        late = LATE * np.abs(np.gradient(expected[index], run.time))
        within = (WITHIN + early) / baseline.kv + SHARE * np.abs(expected[index]) + late + sigma
        residual = run.velocity - expected[index]
        usual = np.abs(residual) <= 2.0 * within
        residual -= np.median(residual[usual]) if usual.any() else 0.0
        anomalous = np.abs(_compute_running_mean(residual, wide)) > within
        anomalous[:begin] = False
        longest = LONGEST * (len(run) - begin)
        for first, last in find_intervals(anomalous, join=round(JOIN / period)):
            if last - first + 1 < max(2, round(SHORTEST / period)) or last - first > longest:
                continue
            around = max(3, round(AROUND / period))
            part = slice(max(first - around, begin), min(last + around + 1, len(run)))
            found.append(
                Anomaly(
                    index,
                    first,
                    last,
                    part.start,
                    part.stop,
                    residual[part],
                    expected[index][part],
                )
            )
    return tuple(
        one
        for one in found
        if not any(_are_same_event(one, other, runs, still=still) for other in found)
    )


def _are_same_event(one: Anomaly, other: Anomaly, runs: Sequence[Run], *, still: float) -> bool:
    """Whether two anomalies of two runs are at the same time after the start, or the same place."""
    if one.run == other.run:
        return False
    mine, others = runs[one.run], runs[other.run]

    def have_common_span(a: Array, b: Array) -> bool:
        together = min(a.max(), b.max()) - max(a.min(), b.min())
        return bool(together >= ALIKE * min(np.ptp(a), np.ptp(b)))

    since = [
        run.time[[s.first, s.last]] - run.time[find_first_motion(run, still=still)]
        for run, s in ((mine, one), (others, other))
    ]
    place = [run.position[s.first : s.last + 1] for run, s in ((mine, one), (others, other))]
    return (mine.kind == others.kind and have_common_span(*since)) or have_common_span(*place)


def _compute_running_mean(values: Array, wide: int) -> Array:
    """(n,) centered running mean; beyond the ends the values are repeated."""
    padded = np.pad(values, (wide // 2, wide - 1 - wide // 2), mode="edge")
    return np.asarray(np.convolve(padded, np.full(wide, 1.0 / wide), mode="valid"))


def find_intervals(
    flags: "np.ndarray[tuple[int], np.dtype[np.bool_]]", *, join: int
) -> list[tuple[int, int]]:
    """First and last index of each interval of flags; gaps up to ``join`` samples are closed."""
    at = np.flatnonzero(flags)
    if not at.size:
        return []
    parts = np.split(at, np.flatnonzero(np.diff(at) > max(join, 1)) + 1)
    return [(int(part[0]), int(part[-1])) for part in parts]
