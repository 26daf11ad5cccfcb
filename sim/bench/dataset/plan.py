"""Turn a spec into jobs: one log each, with all random choices and a seed for the rest.

A job contains everything it needs, so it gives the same bytes on any process of any machine, in any
order. The secret determines the order in which logs are numbered, so a number does not show which
faults or effects a log has.
"""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from sim.bench.dataset.logs import FaultChoice, HiddenEffectChoice, LogSettings, LogTable
from sim.bench.dataset.secret import Secret, derive_log_seed
from sim.bench.dataset.spec import Spec
from sim.bench.dataset.student import make_folder_name
from sim.bench.dataset.table import NumberRange

EFFECT, FAULT, MECHANISM, RECORD, DAMAGE = range(5)  # independent random streams of a job


@dataclass(frozen=True)
class HiddenEffect:
    """An effect that is hidden in a log's mechanism.

    Args:
        effect: name of the effect.
        size: [1] 1 is ordinary.
    """

    effect: str
    size: float


@dataclass(frozen=True)
class PlannedFault:
    """A fault of a log.

    Args:
        fault: name of the fault.
        severity: [1] 1 is ordinary.
        test: name of the damaged test; None lets the fault choose.
        at: [s] since the test's first sample, drawn when the log is made; None lets the fault
            choose.
    """

    fault: str
    severity: float
    test: str | None
    at: NumberRange | None


@dataclass(frozen=True)
class LogJob:
    """One log to make.

    Args:
        name: path of its files in the dataset's folder, without suffix.
        where: place in the spec, for messages.
        student: name of the student; empty if there is none.
        mechanism: name of the mechanism.
        drawn: whether it is a random variant of that mechanism.
        settings: settings of the tests.
        effects: effects, hidden in this order.
        strikes: faults, made in this order.
        formats: formats in which it is written.
        seed: seed of its random streams.
    """

    name: str
    where: str
    student: str
    mechanism: str
    drawn: bool
    settings: LogSettings
    effects: tuple[HiddenEffect, ...]
    strikes: tuple[PlannedFault, ...]
    formats: tuple[str, ...]
    seed: int

    @property
    def files(self) -> tuple[str, ...]:
        """The files of the log, as paths in the dataset's folder."""
        return tuple(f"{self.name}.{ending}" for ending in self.formats)

    @property
    def fingerprint(self) -> str:
        """A digest of everything that its files depend on."""
        content: dict[str, Any] = asdict(self)
        del content["where"]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()

    def make_random_stream(self, *which: int) -> np.random.Generator:
        """The random generator of a purpose, independent of those of other purposes."""
        return make_random_stream(self.seed, *which)


def make_random_stream(seed: int, *which: int) -> np.random.Generator:
    """One of the independent random generators of a seed, chosen by the numbers ``which``."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=which)))


def plan_jobs(spec: Spec, secret: Secret) -> tuple[LogJob, ...]:
    """The jobs of a spec, in the order of their names.

    Args:
        spec: the specification.
        secret: secret from which the seeds are derived.
    """
    return tuple(
        job
        for student in spec.students or ("",)
        for job in _number_jobs(list(_list_seeds(spec, secret, student)), spec, student)
    )


def _list_seeds(spec: Spec, secret: Secret, student: str) -> Iterator[tuple[int, LogTable, str]]:
    """Seed, place in the spec and mechanism of each log of a student."""
    for block, logs in enumerate(spec.logs, start=1):
        for mechanism in logs.mechanisms:
            for number in range(1, logs.count + 1):
                seed = derive_log_seed(
                    secret,
                    dataset=spec.name,
                    student=student,
                    block=block,
                    mechanism=mechanism,
                    number=number,
                )
                yield seed, logs, mechanism


def _number_jobs(
    found: list[tuple[int, LogTable, str]], spec: Spec, student: str
) -> Iterator[LogJob]:
    """Jobs, shuffled by their seeds and numbered."""
    folder = f"{make_folder_name(student)}/" if student else ""
    digits = max(2, len(str(len(found))))
    shuffled = sorted(found, key=lambda one: one[0])
    for number, (seed, logs, mechanism) in enumerate(shuffled, start=1):
        yield LogJob(
            name=f"{folder}log-{number:0{digits}}",
            where=logs.where,
            student=student,
            mechanism=mechanism,
            drawn=logs.drawn,
            settings=logs.settings,
            effects=tuple(_effects(logs.effects, seed)),
            strikes=tuple(_strikes(logs.faults, seed)),
            formats=spec.formats,
            seed=seed,
        )


def _effects(choices: tuple[HiddenEffectChoice, ...], seed: int) -> Iterator[HiddenEffect]:
    """Draw the hidden effects of a log."""
    for number, one in enumerate(choices):
        rng = make_random_stream(seed, EFFECT, number)
        if rng.random() < one.chance:
            yield HiddenEffect(_one_of(one.names, rng), one.size.draw(rng))


def _strikes(choices: tuple[FaultChoice, ...], seed: int) -> Iterator[PlannedFault]:
    """Draw the faults of a log."""
    for number, one in enumerate(choices):
        rng = make_random_stream(seed, FAULT, number)
        if rng.random() < one.chance:
            yield PlannedFault(
                fault=_one_of(one.names, rng),
                severity=one.severity.draw(rng),
                test=_one_of(one.tests, rng) if one.tests else None,
                at=one.at,
            )


def _one_of(names: tuple[str, ...], rng: np.random.Generator) -> str:
    return names[int(rng.integers(len(names)))]
