"""Intervals in which a run does not follow its voltage, and how much of that a hypothesis explains.

The baseline model of the whole log predicts a run's velocity from its voltage. Where the measured
velocity differs from that by more than noise and an ordinary mechanism's deviations, and only for a
while, there is an anomaly. Each fault that could be its cause gives the shape that it would leave,
and the share of the anomaly that the shape explains is the confidence in that fault.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sim.core.log import Array, Run
from sim.inspect.baseline_model import BaselineModel

WITHIN = 0.1  # [V] a linear model of a real mechanism strays this far anyway,
SHARE = 0.1  # [share of the back-EMF] and this much more with speed,
ONSET, SETTLED = 0.35, 0.6  # [V, s] and this much just after it begins to move: friction is no line
LATE = 0.03  # [s] a reading may be this old, and the mechanism no worse for it
STARTING = 1.5, 0.06  # [timescales, s] after its first motion a run says little about accidents
SIGMAS = 3.0  # [standard deviations of the averaged noise]
AVERAGE = 0.04  # [s] over which noise is averaged, at least two samples
SHORTEST = 0.03  # [s] a shorter anomaly is noise, at least two samples
LONGEST = 0.6  # [share of the motion] a longer one is no anomaly but how this run is
AROUND = 0.15  # [s] before and after that an explanation has to explain as well
ALIKE = 0.5  # [share of the shorter] two stretches of time or way that share more are one habit
JOIN = 0.06  # [s] two closer ones are one


@dataclass(frozen=True, eq=False)
class Anomaly:
    """An interval of a run in which its velocity does not follow its voltage.

    Args:
        run: which run of the log.
        first: its first sample.
        last: its last sample.
        begin: the first sample of the stretch with what is around it.
        end: behind the last sample of that.
        residual: (end - begin,) [m/s or rad/s] measured minus expected, less the run's usual
            residual.
        expected: (end - begin,) [m/s or rad/s] the velocity as replayed, brought to what was seen
            before and after.
        at_start: it begins with the motion, where delays and limits of current look like accidents.
        recurs: another run has one at the same place, or as long after its start: that is how the
            mechanism is, and no accident.
    """

    run: int
    first: int
    last: int
    begin: int
    end: int
    residual: Array
    expected: Array
    at_start: bool
    recurs: bool = False

    def list_candidate_spans(self, *, margin: int) -> list[tuple[int, int]]:
        """Candidate (begin, end) samples of the disturbance within the anomaly.

        Args:
            margin: [samples] how far from its own first and last sample to look.
        """
        stride = max(1, margin // 3)
        return self._span_grid(self.first, self.last + 1, reach=margin, stride=stride)

    def refine_spans(self, span: tuple[int, int], *, margin: int) -> list[tuple[int, int]]:
        """Candidate spans at sample resolution around the best of ``list_candidate_spans``."""
        first, last = span
        return self._span_grid(
            self.begin + first, self.begin + last, reach=max(1, margin // 3) - 1, stride=1
        )

    def _span_grid(
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
    """The velocity (n,) [m/s or rad/s] that the baseline model predicts from a run's voltage.

    Before its first motion it is taken to stand: whether a stop or friction holds it there, a log
    cannot tell.
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

    Args:
        runs: of the log.
        expected: per run, (n,) [m/s or rad/s].
        baseline: of the log.
        still: [m/s or rad/s] what counts as standing.
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
        stray = run.velocity - expected[index]
        stray -= _ordinary_residual(stray, within)
        far = np.abs(_running_mean(stray, wide)) > within
        far[:begin] = False
        longest = LONGEST * (len(run) - begin)
        for first, last in _find_intervals(far, join=round(JOIN / period)):
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
                    stray[part],
                    expected[index][part],
                    at_start=bool(since[first] < STARTING[0] * baseline.timescale + STARTING[1]),
                )
            )
    return tuple(
        replace(one, recurs=any(_recur(one, other, runs, still=still) for other in found))
        for one in found
    )


def _recur(one: Anomaly, other: Anomaly, runs: Sequence[Run], *, still: float) -> bool:
    """Whether two are one habit: in two runs, as long after the start, or at the same place."""
    if one.run == other.run:
        return False
    mine, others = runs[one.run], runs[other.run]

    def shared(a: Array, b: Array) -> bool:
        together = min(a.max(), b.max()) - max(a.min(), b.min())
        return bool(together >= ALIKE * min(np.ptp(a), np.ptp(b)))

    since = [
        run.time[[s.first, s.last]] - run.time[find_first_motion(run, still=still)]
        for run, s in ((mine, one), (others, other))
    ]
    place = [run.position[s.first : s.last + 1] for run, s in ((mine, one), (others, other))]
    return (mine.kind == others.kind and shared(*since)) or shared(*place)


def _ordinary_residual(stray: Array, within: Array) -> Array:
    """(n,) the usual residual of a run: the median of samples without an anomaly."""
    usual = np.abs(stray) <= 2.0 * within
    return np.full(stray.size, np.median(stray[usual]) if usual.any() else 0.0)


def _running_mean(values: Array, wide: int) -> Array:
    """A centered running mean that keeps the length; the ends repeat themselves."""
    fed = np.pad(values, (wide // 2, wide - 1 - wide // 2), mode="edge")
    return np.asarray(np.convolve(fed, np.full(wide, 1.0 / wide), mode="valid"))


def _find_intervals(
    flags: "np.ndarray[tuple[int], np.dtype[np.bool_]]", *, join: int
) -> list[tuple[int, int]]:
    """First and last sample of each stretch of flags, those less than ``join`` apart as one."""
    at = np.flatnonzero(flags)
    if not at.size:
        return []
    parts = np.split(at, np.flatnonzero(np.diff(at) > max(join, 1)) + 1)
    return [(int(part[0]), int(part[-1])) for part in parts]
