"""A learner's preparation of a log, and the fit of the prepared log."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from grader.answers.asked_number import AskedNumber, Band
from grader.answers.number_answer import HALF, read_answer_number
from grader.checks.check import WrongAnswer
from sim.core.errors import Refusal
from sim.core.log import FOUR_TESTS, Log, Run
from sim.fit import Fit, fit

POINTS = 2.0  # for each gain
LATEST = 100.0  # [s] no test lasts so long
LONGEST = 15  # [samples] of a median window, as SysId's
EVERYTHING = ("all", "everything", "whole")
ANY = Band(0.0, 0.0)  # nobody asks how near: what comes of it is graded
NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
COMMAS = re.compile(r"\d,\d+,\d")  # 1,5,5 may be 1.5 to 5, and 1 to 5.5
BETWEEN = re.compile(r"\s*(?:(?:to|until|till|from|and|seconds?|secs?|s)\b\s*|[-–,;.:()]\s*)*")


@dataclass(frozen=True)
class Preparation:
    """The parts of a log that are fitted, and how they are filtered.

    Args:
        keep: test -> [s] from, to, since the test began; a test that is missing is kept whole.
        threshold: [m/s or rad/s] slower samples of quasistatic tests are dropped.
        median: [samples] window of the filter on the velocity.
    """

    keep: Mapping[str, tuple[float, float]]
    threshold: float
    median: int

    def kept(self, run: Run) -> Run:
        """The samples of a run that remain after it is trimmed."""
        first, last = self.keep.get(run.test, (0.0, float("inf")))
        since = run.time - run.time[0]
        return run.select((since >= first - 1e-9) & (since <= last + 1e-9))


def read_preparation(given: Mapping[str, object], *, symbol: str, si: float) -> Preparation:
    """Read the six lines of an answer.

    Args:
        given: the answers by name.
        symbol: the unit of the log's positions.
        si: how many meters or radians one of it is.

    Raises:
        WrongAnswer: one of them is missing or makes no sense; the message names it.
    """
    keep = {test: _parse_window(test, given.get(test.replace("-", "_"))) for test in FOUR_TESTS}
    asked = AskedNumber("threshold", 0.0, f"{symbol}/s", ANY)
    threshold = _read_number(given.get("threshold"), asked)
    if threshold < 0.0:
        raise WrongAnswer(
            f"threshold {threshold:g}", hint="A speed has no sign here. 0 drops nothing."
        )
    whole = f"Write a whole number of samples from 1 (no filter) to {LONGEST}."
    try:
        window = _read_number(given.get("median"), AskedNumber("median", 1.0, "", ANY))
    except WrongAnswer as wrong:
        wrong.hint = whole
        raise
    if window != round(window) or not 1 <= window <= LONGEST:
        raise WrongAnswer(f"median {window:g}", hint=whole)
    return Preparation(
        {test: span for test, span in keep.items() if span is not None},
        threshold * si,
        round(window),
    )


def _read_number(raw: object, asked: AskedNumber) -> float:
    try:
        return read_answer_number(raw, asked)
    except WrongAnswer as wrong:
        wrong.seen = f"{asked.name}: {wrong.seen}"
        raise


def _parse_window(test: str, raw: object) -> tuple[float, float] | None:
    """The part of one test to keep; None for all of it."""
    name = test.replace("-", "_")
    ask = (
        "Write the first and the last second to keep, counted from the start of the test: "
        '"0.4 to 5.2". Or write "all".'
    )
    if raw is None or raw == "":
        raise WrongAnswer(f"{name}: nothing yet", hint=ask)
    if isinstance(raw, list):
        raw = " ".join(str(part) for part in raw)
    if not isinstance(raw, str):
        raise WrongAnswer(f"{name}: {raw}, but two times are needed", hint=ask)
    if raw.strip().lower() in EVERYTHING:
        return None
    times = [float(part.replace(",", ".")) for part in NUMBER.findall(raw)]
    if COMMAS.search(raw):
        raise WrongAnswer(
            f'{name}: "{raw[:40]}"',
            hint=f"With these commas, it is not clear which two times you mean. {ask}",
        )
    if len(times) != 2 or not BETWEEN.fullmatch(NUMBER.sub(" ", raw.lower())):
        raise WrongAnswer(f'{name}: "{raw[:40]}", but two times are needed', hint=ask)
    ends = "That ends before it begins." if times[0] >= times[1] else ""
    if times[1] >= LATEST:
        ends = "No test is so long. Are your times in milliseconds? Write seconds."
    if ends:
        raise WrongAnswer(f'{name}: "{raw[:40]}"', hint=f"{ends} {ask}")
    return times[0], times[1]


def prepare_log(log: Log, preparation: Preparation) -> Log:
    """The log as the regression is to see it.

    A slow sample loses its voltage, by which SysId's recipe leaves it out: its time stays in the
    log, so that the period of the samples beside it is what it was.
    """
    runs = []
    for run in map(preparation.kept, log.runs):
        slow = np.abs(run.velocity) < preparation.threshold
        voltage = np.where(slow, 0.0, run.voltage)
        runs.append(replace(run, voltage=voltage) if run.kind == "quasistatic" else run)
    return replace(log, runs=tuple(runs))


def fit_prepared(log: Log, preparation: Preparation) -> Fit:
    """What SysId's recipe finds in the log, so prepared, in the unit of the log.

    Raises:
        NotIdentifiable: too little is left.
    """
    ready = prepare_log(log, preparation)
    return fit(ready, type="simple", method="sysid", median=preparation.median).in_log_units()


def judge_gain(value: float, asked: AskedNumber) -> float:
    """Points for one gain: all of them, half, or none."""
    if asked.is_right(value):
        return POINTS
    near = abs(value - asked.expected) <= asked.band.widths(asked.expected)[1]
    return HALF * POINTS if near else 0.0


def sum_points(
    log: Log, preparation: Preparation, asked: Mapping[str, AskedNumber], *, wider: float = 1.0
) -> float:
    """The points for the fit of a prepared log, with bands this many times as wide."""
    try:
        gains = fit_prepared(log, preparation).gains
    except Refusal:
        return 0.0
    return sum(
        judge_gain(one.expected + (gains[name] - one.expected) / wider, one)
        for name, one in asked.items()
    )
