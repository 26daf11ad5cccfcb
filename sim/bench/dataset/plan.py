"""Turn a spec into jobs: one log each, with a seed for all its random choices.

A job contains everything it needs, so it gives the same bytes on any process of any machine, in any
order. The secret determines the order in which logs are numbered, so a number does not show which
faults or effects a log has.
"""

import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, TypeVar

import numpy as np

from sim.bench.dataset.spec import EffectChoice, FaultChoice, LogTable, Spec
from sim.support.secret import Secret
from sim.support.student_names import make_folder_name, normalize_name

EFFECT, FAULT, MECHANISM, RECORD, DAMAGE = range(5)  # independent random streams of a job

Choice = TypeVar("Choice", EffectChoice, FaultChoice)


@dataclass(frozen=True)
class LogJob:
    """One log to make.

    Args:
        name: path of its files in the dataset's folder, without suffix.
        student: name of the student; empty if there is none.
        mechanism: name of the mechanism.
        where: place in the spec, for messages.
        table: table of the spec that it belongs to.
        formats: formats in which it is written.
        seed: seed of its random streams.
    """

    name: str
    student: str
    mechanism: str
    where: str
    table: LogTable
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
        del content["where"], content["table"]["mechanisms"], content["table"]["count"]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()

    def make_random_stream(self, *which: int) -> np.random.Generator:
        """The random generator of a purpose, independent of those of other purposes."""
        return np.random.Generator(
            np.random.PCG64(np.random.SeedSequence(self.seed, spawn_key=which))
        )

    def draw_effects(self) -> list[tuple[str, float]]:
        """Name and size of each hidden effect."""
        drawn = self._draw_choices(self.table.effects, EFFECT)
        return [(draw_one(one.name, rng), one.size.draw(rng)) for one, rng in drawn]

    def draw_faults(self) -> list[tuple[FaultChoice, str, float, str | None]]:
        """Choice, name, severity and test of each fault; None lets the fault choose the test."""
        return [
            (
                one,
                draw_one(one.name, rng),
                one.severity.draw(rng),
                draw_one(one.test, rng) if one.test else None,
            )
            for one, rng in self._draw_choices(self.table.faults, FAULT)
        ]

    def _draw_choices(
        self, choices: Sequence[Choice], stream: int
    ) -> Iterator[tuple[Choice, np.random.Generator]]:
        """Those of the choices that this log gets, each with a random generator of its own."""
        for number, one in enumerate(choices):
            rng = self.make_random_stream(stream, number)
            if rng.random() < one.chance:
                yield one, rng


def draw_one(names: Sequence[str], rng: np.random.Generator) -> str:
    """A random name of those given."""
    return names[int(rng.integers(len(names)))]


def plan_jobs(spec: Spec, secret: Secret) -> tuple[LogJob, ...]:
    """The jobs of a spec, in the order of their names.

    Args:
        spec: the specification.
        secret: secret from which the seeds are derived.
    """
    jobs: list[LogJob] = []
    for student in spec.students or ("",):
        owner = normalize_name(student) if student else ""
        folder = f"{make_folder_name(student)}/" if student else ""
        logs = [
            LogJob(
                name="",
                where=f"{spec.where}, [[logs]] number {block}",
                student=student,
                mechanism=mechanism,
                table=table,
                formats=spec.formats,
                # It does not change when students or further logs are added.
                seed=secret.derive_seed(spec.name, owner, block, mechanism, number),
            )
            for block, table in enumerate(spec.logs, start=1)
            for mechanism in table.mechanisms
            for number in range(1, table.count + 1)
        ]
        digits = max(2, len(str(len(logs))))
        shuffled = enumerate(sorted(logs, key=lambda job: job.seed), start=1)
        jobs += [replace(job, name=f"{folder}log-{n:0{digits}}") for n, job in shuffled]
    return tuple(jobs)
