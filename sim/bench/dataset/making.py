"""Make one job: the bytes of its files and their ground truth, on any process or machine.

The result is plain data: machines need not share a disk, and only one process writes files.
"""

import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from sim.bench.dataset.plan import DAMAGE, MECHANISM, RECORD, Choice, LogJob
from sim.bench.ground_truth import describe_truth
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.core.errors import Refusal, refusals_at
from sim.core.log import Log, Run
from sim.inspect.contaminate import contaminate
from sim.inspect.fault import LogInterval
from sim.io import write
from sim.support.os_errors import refuse_os_errors

ATTEMPTS = 20  # to find a time at which a fault is possible
SIGNALS = ("time", "voltage", "position", "velocity", "current", "bus_voltage")
DIGITS = dict.fromkeys(SIGNALS, 6) | {"position": 9}  # [decimals in SI] finer than any encoder


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


def make_log(job: LogJob) -> MadeLog:
    """Make a log.

    Raises:
        BadRequest: it cannot be made; the message has the place in the spec.
    """
    settings = job.table.routine
    with refusals_at(f"{job.where} ({job.name})"):
        built = MECHANISMS[job.mechanism]
        if job.table.drawn:
            built = built.draw(job.make_random_stream(MECHANISM))
        effects = job.draw_effects()
        for name, size in effects:
            built = built.hide(name, size=size)
        log = simulate(
            built,
            settings.routine,
            rng=job.make_random_stream(RECORD),
            period=settings.period,
            duty_cycle=settings.duty_cycle,
            electrical=settings.electrical,
        )
        log = replace(log, runs=tuple(run for run in log.runs if run.test in settings.tests))
        log, faults = _damage_log(_round_log(log), job)
        truth = _describe_log(built, job, effects=dict(effects), faults=faults)
        return MadeLog(job, _write_files(log, job), truth)


def rehearse_logs(jobs: Iterable[LogJob]) -> None:
    """Make logs of each kind with all their effects and faults, to find impossible specs early.

    Raises:
        BadRequest: one of them cannot be made.
    """
    for job in {(job.where, job.mechanism): job for job in jobs}.values():
        table = job.table
        names = [one.name for one in table.effects] + [one.name for one in table.faults]
        for number in range(max(map(len, names), default=1)):
            effects = tuple(_pick_name(one, number) for one in table.effects)
            faults = tuple(_pick_name(one, number) for one in table.faults)
            make_log(replace(job, table=replace(table, effects=effects, faults=faults)))


def _pick_name(one: Choice, number: int) -> Choice:
    """The name for a log, taken from its names in turn."""
    return replace(one, name=(one.name[number % len(one.name)],), chance=1.0)


def _round_log(log: Log) -> Log:
    """The log, rounded to ``DIGITS``.

    On another processor, or with another version of NumPy, a sine or a logarithm may differ in the
    sixteenth digit. Without rounding, the same secret would give different bytes there.
    """

    def round_signals(run: Run) -> Run:
        signals = {name: getattr(run, name) for name in DIGITS}
        rounded: dict[str, Any] = {
            name: values.round(DIGITS[name]) + 0.0  # -0.0 becomes 0.0
            for name, values in signals.items()
            if values is not None
        }
        return replace(run, **rounded)

    return replace(log, runs=tuple(map(round_signals, log.runs)))


def _damage_log(log: Log, job: LogJob) -> tuple[Log, list[dict[str, object]]]:
    """The log with all its faults, and the ground truth about them."""
    faults = []
    for number, (choice, name, severity, test) in enumerate(job.draw_faults()):
        for attempt in range(ATTEMPTS):  # an impossible random time is drawn again
            rng = job.make_random_stream(DAMAGE, number, attempt)
            at = choice.at.draw(rng) if choice.at else None
            try:
                damaged = contaminate(log, name, severity=severity, test=test, at=at, rng=rng)
                break
            except Refusal:
                if attempt == ATTEMPTS - 1:
                    raise
        log = damaged.log
        faults.append((name, severity, damaged.where))
    log = _round_log(log)
    return log, [
        {"fault": name, "severity": size, "where": [_describe_interval(one, log) for one in where]}
        for name, size, where in faults
    ]


def _write_files(log: Log, job: LogJob) -> dict[str, bytes]:
    """Path in the dataset's folder -> bytes of the log's file."""
    advice = "Make room for temporary files, or say where with TMPDIR."
    place = Path(tempfile.gettempdir())
    contents = {}
    with (
        refuse_os_errors("a temporary file cannot be written", place, advice=advice),
        tempfile.TemporaryDirectory(prefix="sysid-") as folder,
    ):
        for file in job.files:
            path = Path(folder, Path(file).name)
            write(log, path)
            contents[file] = path.read_bytes()
    return contents


def _describe_log(
    built: Mechanism,
    job: LogJob,
    *,
    effects: Mapping[str, float],
    faults: list[dict[str, object]],
) -> dict[str, object]:
    """The ground truth of a log, for the key."""
    truth = describe_truth(built)
    for part in truth["hidden"]:  # an effect that every such mechanism has has no size
        part["size"] = effects.get(part["effect"])
    return {
        **truth,
        "student": job.student,
        "built": {name: getattr(built, name) for name in built.spread},
        "faults": faults,
        "routine": asdict(job.table.routine),
        "seed": f"{job.seed:064x}",
    }


def _describe_interval(found: LogInterval, log: Log) -> dict[str, object]:
    """A damaged interval of the final log; later faults may have renamed or removed its run."""
    middle = (found.start + found.end) / 2.0
    inside = (n for n, run in enumerate(log.runs) if run.time[0] <= middle <= run.time[-1])
    number = None if found.run is None else next(inside, None)
    return {
        "run": number,
        "test": found.test if number is None else log.runs[number].test,
        "start_s": found.start,
        "end_s": found.end,
    }
