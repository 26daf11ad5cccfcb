"""Damage a log on purpose with a fault of the catalogue.

contaminate(log, "encoder-slip", severity=0.5, test="dynamic-forward", at=0.4, rng=rng)
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import Log, Run
from sim.core.vocabulary import TESTS
from sim.inspect.fault import MOST, DamagedLog, Fault, FaultStrike, LogInterval
from sim.inspect.faults import find_fault
from sim.inspect.log_features import MIN_SAMPLES

SPEC = re.compile(
    r"(?P<name>[^:@]+)(?::(?P<severity>[^@]*))?(?:@(?P<test>[^+]*)(?:\+(?P<at>.*))?)?"
)


@dataclass(frozen=True)
class FaultRequest:
    """A requested fault: its name, severity, test and time.

    Args:
        name: name of the fault.
        severity: 0 to ``MOST``; 1 is ordinary.
        test: name of the test to damage; None chooses at random.
        at: [s] since that test's first sample; None chooses at random.
    """

    name: str
    severity: float = 1.0
    test: str | None = None
    at: float | None = None


def parse_fault_request(text: str) -> FaultRequest:
    """Read ``NAME[:SEVERITY][@TEST[+SECONDS]]``: ``encoder-slip:0.5@dynamic-forward+0.4``.

    Args:
        text: the request.

    Raises:
        BadRequest: a part is missing or is not a number; ``contaminate`` checks whether fault and
            test exist.
    """
    parts = SPEC.fullmatch(text.strip())
    if parts is None:
        raise _refuse_syntax(text, "the name of the fault is missing")
    name, test = parts["name"].strip(), parts["test"]
    if test is not None and not test.strip():
        raise _refuse_syntax(text, "no test is named after @")
    return FaultRequest(
        name,
        severity=1.0 if parts["severity"] is None else _parse_number(text, parts["severity"]),
        test=None if test is None else test.strip(),
        at=None if parts["at"] is None else _parse_number(text, parts["at"]),
    )


def contaminate(
    log: Log,
    name: str,
    *,
    severity: float = 1.0,
    test: str | None = None,
    at: float | None = None,
    rng: np.random.Generator,
) -> DamagedLog:
    """Damage a log with a fault.

    Args:
        log: the log, which is not changed.
        name: name of the fault, one of ``sim.inspect.faults.FAULTS``.
        severity: 0 changes nothing, 1 is ordinary, at most ``MOST``.
        test: name of the test, whose first run is damaged; None chooses at random.
        at: [s] since that run's first sample; None chooses at random.
        rng: random generator; the same state gives the same log.

    Returns:
        The damaged log, and where the damage is.

    Raises:
        BadRequest: no such fault, test or time; a severity out of range; a test or a mechanism in
            which this fault cannot happen; a run that is too short, or does not show the fault.

    Examples:
        >>> from sim.bench.mechanisms import MECHANISMS
        >>> from sim.bench.routine import Routine
        >>> from sim.bench.simulate import simulate
        >>> rng = np.random.default_rng(0)
        >>> log = simulate(MECHANISMS["drivetrain"], Routine(), rng=rng)
        >>> contaminate(log, "encoder-slip", test="dynamic-forward", rng=rng).where[0].test
        'dynamic-forward'
    """
    fault = find_fault(name)
    if not 0.0 <= severity <= MOST:
        raise BadRequest(
            f"{name} of severity {severity:g}",
            advice=f"Choose 0 (no fault) to {MOST:g}. Severity 1 means that {fault.ordinary}.",
        )
    if log.type and log.type not in fault.types:
        raise BadRequest(
            f"{name} cannot happen to a mechanism of type {log.type}",
            where=log.source,
            advice=f"This fault needs a mechanism of type {' or '.join(fault.types)}.",
        )
    run = _choose_run(log, fault, test=test, rng=rng)
    start = _choose_start(log.runs[run], fault, at=at, rng=rng)
    if severity == 0.0:
        return DamagedLog(log, ())
    spoilt = fault.spoil(log, FaultStrike(run, start, severity), rng)
    if not spoilt.where:
        raise BadRequest(
            f"{name} of severity {severity:g} would not show at {start:.2f} s",
            where=_describe_place(log, log.runs[run].test),
            advice="Choose a moment when it moves, a longer test, or a higher severity.",
        )
    return spoilt


def contaminate_all(
    log: Log, requests: Iterable[FaultRequest], *, rng: np.random.Generator
) -> tuple[Log, list[tuple[str, float, LogInterval]]]:
    """Damage a log with several faults, one after another.

    Args:
        log: the log, which is not changed.
        requests: the faults.
        rng: random generator; the same state gives the same log.

    Returns:
        The damaged log, and name, severity and interval of each fault.

    Raises:
        BadRequest: as ``contaminate``.
    """
    where = []
    for one in requests:
        spoilt = contaminate(
            log, one.name, severity=one.severity, test=one.test, at=one.at, rng=rng
        )
        log = spoilt.log
        where += [(one.name, one.severity, interval) for interval in spoilt.where]
    return log, where


def _choose_run(log: Log, fault: Fault, *, test: str | None, rng: np.random.Generator) -> int:
    """Index of the run to damage."""
    kinds = " or ".join(fault.kinds)
    if test is not None:
        if test not in TESTS:
            raise BadRequest(
                f"{test!r} is not the name of a test", advice=f"Choose one of: {', '.join(TESTS)}."
            )
        there = [index for index, run in enumerate(log.runs) if run.test == test]
        if not there:
            names = dict.fromkeys(run.test for run in log.runs)
            raise BadRequest(
                f"there is no {test} test in this log",
                where=log.source,
                advice=f"It contains {', '.join(names) or 'none at all'}: choose one of these.",
            )
        if log.runs[there[0]].kind not in fault.kinds:
            raise BadRequest(
                f"{fault.name} cannot happen in a {test} test", advice=f"Choose a {kinds} test."
            )
        there = there[:1]
    else:
        there = [index for index, run in enumerate(log.runs) if run.kind in fault.kinds]
        there = [index for index in there if len(log.runs[index]) >= MIN_SAMPLES] or there
    if not there:
        raise BadRequest(
            f"no test in this log that {fault.name} could happen in",
            where=log.source,
            advice=f"It takes a {kinds} test.",
        )
    index = there[int(rng.integers(len(there)))]
    if len(log.runs[index]) < MIN_SAMPLES:
        raise BadRequest(
            f"the run has {len(log.runs[index])} samples, too few to damage",
            where=_describe_place(log, log.runs[index].test),
            advice=f"Choose a run of at least {MIN_SAMPLES}.",
        )
    return index


def _choose_start(run: Run, fault: Fault, *, at: float | None, rng: np.random.Generator) -> float:
    """[s] start of the fault since the run's first sample; a random time in motion if not given."""
    span = float(run.time[-1] - run.time[0])
    if at is not None:
        if not 0.0 <= at < span:
            raise BadRequest(
                f"{at:g} s is not within {run.test}, which lasts {span:.2f} s",
                advice=f"Choose a time from 0 to {span:.2f} s.",
            )
        if abs(run.voltage[np.searchsorted(run.time, run.time[0] + at)]) < fault.least_voltage:
            raise _refuse_low_voltage(run, fault)
        return at
    possible = np.abs(run.voltage) >= fault.least_voltage
    if not possible.any():
        raise _refuse_low_voltage(run, fault)
    moving = np.flatnonzero(run.moving & possible)
    first, last = (moving[0], moving[-1]) if moving.size else (0, -1)
    begin, end = (float(run.time[i] - run.time[0]) for i in (first, last))
    return begin + float(rng.uniform(*fault.when)) * (end - begin)


def _refuse_low_voltage(run: Run, fault: Fault) -> BadRequest:
    """The error that a fault needs more voltage than a test has."""
    return BadRequest(
        f"{fault.name} needs at least {fault.least_voltage:g} V, and {run.test} has less then",
        advice="Choose a later time of a ramp, or a test with a higher voltage.",
    )


def _describe_place(log: Log, test: str) -> str:
    """The source of a log and a test, for messages."""
    return f"{log.source}, {test}" if log.source else test


def _parse_number(text: str, part: str) -> float:
    try:
        return float(part)
    except ValueError:
        raise _refuse_syntax(text, f"{part!r} is not a number") from None


def _refuse_syntax(text: str, why: str) -> BadRequest:
    return BadRequest(
        f"{text!r} is not a fault: {why}",
        advice="Write NAME[:SEVERITY][@TEST[+SECONDS]], as encoder-slip:0.5@dynamic-forward+0.4.",
    )
