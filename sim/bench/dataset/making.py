"""Make one job: the bytes of its files and their ground truth, on any process or machine.

What comes back is plain data: machines need not share a disk, and one process alone writes.
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

ALONE = threading.Lock()  # a worker of a cluster has many threads, and the engine is loaded once
ATTEMPTS = 20  # at finding a moment where a fault can strike
DIGITS = {  # after the point, of what is in SI; finer than any encoder or converter
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
        job: the job that it was made for.
        contents: path of a file in the dataset's folder -> its bytes.
        truth: about them, as it stands in the key.
    """

    job: LogJob
    contents: Mapping[str, bytes]
    truth: Mapping[str, object]


@dataclass(frozen=True)
class FailedLog:
    """A log that cannot be made: its error as plain data, which any process can pass on."""

    job: LogJob
    what: str
    advice: str


def make_log(job: LogJob) -> MadeLog | FailedLog:
    """Make a log; the threads of a process take turns, as they share its one processor."""
    with ALONE:
        return _made(job)


def _made(job: LogJob) -> MadeLog | FailedLog:
    try:
        built = _built(job)
        asked = job.settings
        log = simulate(
            built,
            asked.routine,
            rng=job.make_random_stream(RECORD),
            period=asked.period,
            duty_cycle=asked.duty_cycle,
            electrical=asked.electrical,
        )
        kept = tuple(run for run in log.runs if run.test in asked.tests)
        log, where = _spoil(_recorded(replace(log, runs=kept)), job)
        log = _recorded(log)
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


def _built(job: LogJob) -> Mechanism:
    """The mechanism, drawn and with its effects hidden."""
    built = MECHANISMS[job.mechanism]
    if job.drawn:
        built = built.draw(job.make_random_stream(MECHANISM))
    for one in job.effects:
        built = built.hide(one.effect, size=one.size)
    return built


def _recorded(log: Log) -> Log:
    """The log to as many digits as a recorder keeps.

    Another processor, or another version of NumPy, computes a sine or a logarithm that differs in
    the sixteenth digit. Without this, the same secret would give other bytes there.
    """
    return replace(log, runs=tuple(replace(run, **_rounded(run)) for run in log.runs))


def _rounded(run: Run) -> dict[str, Any]:
    signals = {name: getattr(run, name) for name in DIGITS}
    return {
        name: values.round(DIGITS[name]) + 0.0  # so that there is one zero, not -0.0 besides
        for name, values in signals.items()
        if values is not None
    }


def _spoil(log: Log, job: LogJob) -> tuple[Log, list[tuple[LogInterval, ...]]]:
    """The log with all its faults, and where each of them is."""
    where = []
    for number, strike in enumerate(job.strikes):
        spoilt = _struck(log, strike, job, number)
        log = spoilt.log
        where.append(spoilt.where)
    return log, where


def _struck(log: Log, strike: PlannedFault, job: LogJob, number: int) -> DamagedLog:
    """The log with one more fault; where chance chose a moment that cannot be, it chooses again."""
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
    """The log as files."""
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
    """What is true of a log, as it stands in the key."""
    per = find_unit(built.units)
    sizes = {one.effect: one.size for one in job.effects}  # none for what every such one has
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
                "where": [_stretch(one, log) for one in found],
            }
            for strike, found in zip(job.strikes, where, strict=True)
        ],
        "routine": _flat(asdict(job.settings)),
        "seed": f"{job.seed:064x}",
    }


def _flat(settings: dict[str, Any]) -> dict[str, Any]:
    """The settings as they stand in a spec, the routine's own numbers beside the others."""
    routine = settings.pop("routine")
    del routine["kinds"]  # the tests say it
    return {**routine, **settings, "tests": list(settings["tests"])}


def _stretch(found: LogInterval, log: Log) -> dict[str, object]:
    """A damaged part, in the log as it ended up: a later fault may remove a run, or rename it."""
    number = None if found.run is None else _run_at((found.start + found.end) / 2.0, log)
    return {
        "run": number,
        "test": found.test if number is None else log.runs[number].test,
        "start_s": found.start,
        "end_s": found.end,
    }


def _run_at(time: float, log: Log) -> int | None:
    """The run that holds a time [s]; None if it is in none."""
    for number, run in enumerate(log.runs):
        if run.time[0] <= time <= run.time[-1]:
            return number
    return None
