"""Make one job: the bytes of its files and their ground truth, on any process or machine.

The result is plain data: machines need not share a disk, and only one process writes files.
"""

import tempfile
import threading
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from sim.bench.dataset.plan import DAMAGE, MECHANISM, RECORD, LogJob, PlannedFault
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.core.log import Log, Run
from sim.core.units import convert_gains, find_unit
from sim.inspect.contaminate import contaminate
from sim.inspect.fault import DamagedLog, LogInterval
from sim.io import write

LOCK = threading.Lock()  # a worker of a cluster has many threads, but one processor
ATTEMPTS = 20  # to find a time at which a fault is possible
DIGITS = {  # decimals of each signal in SI; finer than any encoder or converter
    "time": 6,
    "voltage": 6,
    "position": 9,
    "velocity": 6,
    "current": 6,
    "bus_voltage": 6,
}


@dataclass(frozen=True)
class MadeLog:
    """A log that was made: its files and its ground truth.

    Args:
        job: its job.
        contents: path of a file in the dataset's folder -> its bytes.
        truth: ground truth for the key.
    """

    job: LogJob
    contents: Mapping[str, bytes]
    truth: Mapping[str, object]


@dataclass(frozen=True)
class FailedLog:
    """A log that cannot be made, with the error as plain data.

    Args:
        job: its job.
        what: the problem.
        advice: what to do.
    """

    job: LogJob
    what: str
    advice: str


def make_log(job: LogJob) -> MadeLog | FailedLog:
    """Make a log; the threads of a process take turns, as they share its one processor."""
    with LOCK:
        return _make_log(job)


def _make_log(job: LogJob) -> MadeLog | FailedLog:
    """Make a log, or describe why it cannot be made."""
    try:
        built = _build_mechanism(job)
        settings = job.settings
        log = simulate(
            built,
            settings.routine,
            rng=job.make_random_stream(RECORD),
            period=settings.period,
            duty_cycle=settings.duty_cycle,
            electrical=settings.electrical,
        )
        kept = tuple(run for run in log.runs if run.test in settings.tests)
        log, where = _spoil(_round_log(replace(log, runs=kept)), job)
        log = _round_log(log)
        return MadeLog(job, _contents(log, job), _truth(built, job, log=log, where=where))
    except Refusal as refusal:
        what = f"{refusal.where}: {refusal.what}" if refusal.where else refusal.what
        return FailedLog(job, what, refusal.advice)
    except OSError as error:
        return FailedLog(
            job,
            f"a temporary file cannot be written ({error.strerror or error})",
            "Make room for temporary files, or say where with TMPDIR.",
        )


def _build_mechanism(job: LogJob) -> Mechanism:
    """The mechanism of a job, with its hidden effects."""
    built = MECHANISMS[job.mechanism]
    if job.drawn:
        built = built.draw(job.make_random_stream(MECHANISM))
    for one in job.effects:
        built = built.hide(one.effect, size=one.size)
    return built


def _round_log(log: Log) -> Log:
    """The log, rounded to ``DIGITS``.

    On another processor, or with another version of NumPy, a sine or a logarithm may differ in the
    sixteenth digit. Without rounding, the same secret would give different bytes there.
    """
    return replace(log, runs=tuple(replace(run, **_round_signals(run)) for run in log.runs))


def _round_signals(run: Run) -> dict[str, Any]:
    """Signal -> its rounded values."""
    signals = {name: getattr(run, name) for name in DIGITS}
    return {
        name: values.round(DIGITS[name]) + 0.0  # -0.0 becomes 0.0
        for name, values in signals.items()
        if values is not None
    }


def _spoil(log: Log, job: LogJob) -> tuple[Log, list[tuple[LogInterval, ...]]]:
    """The log with all its faults, and the intervals of each."""
    where = []
    for number, strike in enumerate(job.strikes):
        spoilt = _add_fault(log, strike, job, number)
        log = spoilt.log
        where.append(spoilt.where)
    return log, where


def _add_fault(log: Log, strike: PlannedFault, job: LogJob, number: int) -> DamagedLog:
    """The log with one more fault; an impossible random time is drawn again."""
    attempt = 0
    while True:
        rng = job.make_random_stream(DAMAGE, number, attempt)
        try:
            return contaminate(
                log,
                strike.fault,
                severity=strike.severity,
                test=strike.test,
                at=strike.at.draw(rng) if strike.at else None,
                rng=rng,
            )
        except Refusal:
            attempt += 1
            if attempt == ATTEMPTS:
                raise


def _contents(log: Log, job: LogJob) -> dict[str, bytes]:
    """Path in the dataset's folder -> bytes of the log's file."""
    with tempfile.TemporaryDirectory(prefix="sysid-") as folder:
        contents = {}
        for file in job.files:
            path = Path(folder) / Path(file).name
            write(log, path)
            contents[file] = path.read_bytes()
    return contents


def _truth(
    built: Mechanism, job: LogJob, *, log: Log, where: list[tuple[LogInterval, ...]]
) -> dict[str, object]:
    """The ground truth of a log, for the key."""
    per = find_unit(built.units)
    sizes = {
        one.effect: one.size for one in job.effects
    }  # an effect of every such mechanism has no size
    return {
        "student": job.student,
        "mechanism": built.name,
        "type": built.type,
        "units": per.name,
        "gains": convert_gains(built.gains, factor=per.si),
        "built": {name: getattr(built, name) for name in built.spread},
        "hidden": [
            {
                "effect": part.effect,
                "size": sizes.get(part.effect),
                "parameters": part.to_json(per),
            }
            for part in built.hidden
        ],
        "faults": [
            {
                "fault": strike.fault,
                "severity": strike.severity,
                "where": [_describe_interval(one, log) for one in found],
            }
            for strike, found in zip(job.strikes, where, strict=True)
        ],
        "routine": _flat(asdict(job.settings)),
        "seed": f"{job.seed:064x}",
    }


def _flat(settings: dict[str, Any]) -> dict[str, Any]:
    """The settings as in a spec, those of the routine on the same level as the others."""
    routine = settings.pop("routine")
    del routine["kinds"]  # follows from the tests
    return {**routine, **settings, "tests": list(settings["tests"])}


def _describe_interval(found: LogInterval, log: Log) -> dict[str, object]:
    """A damaged interval in the final log, in which a later fault may remove or rename its run."""
    number = None if found.run is None else _find_run((found.start + found.end) / 2.0, log)
    return {
        "run": number,
        "test": found.test if number is None else log.runs[number].test,
        "start_s": found.start,
        "end_s": found.end,
    }


def _find_run(time: float, log: Log) -> int | None:
    """Index of the run that contains a time [s]; None if there is none."""
    for number, run in enumerate(log.runs):
        if run.time[0] <= time <= run.time[-1]:
            return number
    return None
