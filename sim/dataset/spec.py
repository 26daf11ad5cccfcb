"""The spec of a dataset: what an instructor writes in TOML, read and checked as a whole.

``example.toml`` beside this file is one with every key explained.
"""

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from sim.dataset.roster import students_of
from sim.dataset.table import Span, Table, nearest
from sim.errors import BadRequest, Refusal
from sim.fault import MOST, Fault
from sim.faults import FAULTS
from sim.mechanisms import MECHANISMS
from sim.routine import Routine
from sim.simulate import FASTEST, SLOWEST

FORMATS = ("wpilog", "csv")
ENDING = ".secret"  # of the name of a file with a secret
MOST_LOGS = 100_000  # [logs of a dataset] its key and plan still fit in memory
LARGEST_SEED = 2**63 - 1  # TOML's largest whole number
PERIOD = 0.02  # [s] of a robot program's loop
TOP = ("name", "seed", "secret", "students", "formats", "routine", "logs")
ROUTINE = ("ramp", "step", "timeout", "tests", "period")
LOGS = ("mechanisms", "count", "drawn", "routine", "effects", "faults")
EFFECT = ("name", "size", "chance")
FAULT = ("name", "severity", "test", "at", "chance")


@dataclass(frozen=True)
class Hiding:
    """An effect to hide, or one of several.

    Args:
        names: of which one is drawn.
        size: 1 is what an ordinary robot has.
        chance: share of the logs that get it.
    """

    names: tuple[str, ...]
    size: Span
    chance: float


@dataclass(frozen=True)
class Spoiling:
    """A fault to spoil a log with, or one of several.

    Args:
        names: of which one is drawn.
        severity: 1 is an ordinary bad day.
        tests: of which one is drawn; empty leaves it to the fault.
        at: [s] since the test's first sample; None leaves it to the fault.
        chance: share of the logs that get it.
    """

    names: tuple[str, ...]
    severity: Span
    tests: tuple[str, ...]
    at: Span | None
    chance: float


@dataclass(frozen=True)
class Logs:
    """Logs of one kind.

    Args:
        where: its place in the spec, for refusals.
        mechanisms: each gets its own logs.
        count: logs of each mechanism, for each student if there are any.
        drawn: each log's mechanism is another one like the catalogue's.
        routine: the tests' settings.
        tests: those that the log holds.
        period: [s] of the robot program's loop.
        effects: hidden in this order.
        faults: made in this order.
    """

    where: str
    mechanisms: tuple[str, ...]
    count: int
    drawn: bool
    routine: Routine
    tests: tuple[str, ...]
    period: float
    effects: tuple[Hiding, ...]
    faults: tuple[Spoiling, ...]


@dataclass(frozen=True)
class Spec:
    """A dataset, as asked for.

    Args:
        where: the file, as given.
        name: of the dataset; another name gives other data.
        seed: what all is drawn from where nothing is secret.
        secret: the file with the secret that all is drawn from.
        students: each gets logs of their own; empty if the logs are nobody's.
        formats: each log is written in each of these.
        logs: what to make.
    """

    where: str
    name: str
    seed: int | None
    secret: Path | None
    students: tuple[str, ...]
    formats: tuple[str, ...]
    logs: tuple[Logs, ...]


def read_spec(path: Path) -> Spec:
    """Read a spec and check everything that can be known before a log is made.

    Raises:
        BadRequest: it cannot be read, or asks for what is not there; the message names the key.
    """
    top = Table(_parsed(path), where=str(path), known=TOP)
    name = top.text("name", example="week3")
    if len(name) > 64 or not name.isprintable():  # noqa: PLR2004 - as long as a student's name
        top.wrong("name", advice="Give a name of 1 to 64 characters.")
    logs = tuple(
        _logs(one, default=_settings(top, default=None))
        for one in top.tables("logs", name="logs", known=LOGS)
    )
    if not logs:
        top.refuse("there is no [[logs]] in it", advice="Add one, with mechanisms and count.")
    spec = Spec(
        where=str(path),
        name=name,
        seed=top.whole("seed", least=0, most=LARGEST_SEED) if "seed" in top else None,
        secret=_secret(top, folder=path.parent),
        students=students_of(top, folder=path.parent),
        formats=top.choices("formats", FORMATS) if "formats" in top else FORMATS[:1],
        logs=logs,
    )
    total = max(len(spec.students), 1) * sum(one.count * len(one.mechanisms) for one in logs)
    if total > MOST_LOGS:
        top.refuse(
            f"{total} logs are asked for", advice=f"Split it: one dataset has at most {MOST_LOGS}."
        )
    return spec


def _parsed(path: Path) -> object:
    """What TOML says."""
    try:
        return tomllib.loads(path.read_bytes().decode("utf-8-sig"))
    except FileNotFoundError:
        raise BadRequest(
            "there is no such file",
            where=str(path),
            advice=f"Write an example there with: sysid dataset --example {path}",
        ) from None
    except OSError as error:
        raise BadRequest(
            f"cannot be read ({error.strerror})", where=str(path), advice="Give a TOML file."
        ) from None
    except UnicodeDecodeError:
        raise BadRequest("is not UTF-8", where=str(path), advice="Save it as UTF-8.") from None
    except tomllib.TOMLDecodeError as error:
        raise BadRequest(
            f"is not TOML: {error}", where=str(path), advice="Mend that line."
        ) from None


def _secret(top: Table, *, folder: Path) -> Path | None:
    """The file with the secret. What is named is never repeated: it might be the secret itself."""
    if "secret" not in top:
        return None
    if "seed" in top:
        top.refuse("both seed and secret are there", advice="Leave one of them out.")
    name = top.text("secret", example=f"class{ENDING}")
    if not name.endswith(ENDING) or len(name) == len(ENDING):
        top.refuse(
            f"secret is not the name of a file that ends in {ENDING}",
            advice=f'Write secret = "class{ENDING}", a file made for you: a spec gets shared.',
        )
    return folder / name


@dataclass(frozen=True)
class _Settings:
    """A routine, the tests of it that are kept, and the loop's period [s]."""

    routine: Routine
    tests: tuple[str, ...]
    period: float


def _settings(table: Table, *, default: _Settings | None) -> _Settings:
    """The settings under ``routine``, each as in the default unless it is there."""
    default = default or _Settings(Routine(), Routine().tests, PERIOD)
    if "routine" not in table:
        return default
    found = Table(table.content["routine"], where=f"{table.where}, routine", known=ROUTINE)
    numbers = {
        name: found.number(name, default=getattr(default.routine, name))
        for name in ("ramp", "step", "timeout")
    }
    try:
        routine = Routine(**numbers)
    except Refusal as refusal:
        found.refuse(refusal.what, advice=refusal.advice)
    tests = found.choices("tests", routine.tests) if "tests" in found else default.tests
    period = found.number("period", default=default.period)
    if not FASTEST <= period <= SLOWEST:
        found.wrong("period", advice=f"Give {FASTEST:g} to {SLOWEST:g} s; a robot's is 0.02.")
    return _Settings(routine, tests, period)


def _logs(table: Table, *, default: _Settings) -> Logs:
    """One ``[[logs]]``, checked."""
    settings = _settings(table, default=default)
    mechanisms = table.choices("mechanisms", MECHANISMS)
    found = Logs(
        where=table.where,
        mechanisms=mechanisms,
        count=table.whole("count", default=1, least=1, most=MOST_LOGS),
        drawn=table.flag("drawn", default=True),
        routine=settings.routine,
        tests=settings.tests,
        period=settings.period,
        effects=tuple(
            _hiding(one, mechanisms=mechanisms)
            for one in table.tables("effects", name="logs.effects", known=EFFECT)
        ),
        faults=tuple(
            _spoiling(one, settings=settings, mechanisms=mechanisms)
            for one in table.tables("faults", name="logs.faults", known=FAULT)
        ),
    )
    _check_together(found)
    return found


def _hiding(table: Table, *, mechanisms: tuple[str, ...]) -> Hiding:
    """One ``[[logs.effects]]``, tried on every mechanism at both ends of its size."""
    found = Hiding(
        names=table.texts("name", example="stribeck"),
        size=table.span("size", default=1.0),
        chance=table.number("chance", default=1.0, above=0.0, most=1.0),
    )
    for mechanism in mechanisms:
        for name in found.names:
            for size in (found.size.least, found.size.most):
                try:
                    MECHANISMS[mechanism].hiding(name, size=size)
                except Refusal as refusal:
                    table.refuse(refusal.what, advice=refusal.advice)
    return found


def _check_together(logs: Logs) -> None:
    """Refuse effects that can be hidden one by one, but not one after the other."""
    for name in logs.mechanisms:
        mechanism = MECHANISMS[name]
        for effect in logs.effects:
            try:
                mechanism = mechanism.hiding(effect.names[0], size=effect.size.most)
            except Refusal as refusal:
                raise BadRequest(
                    refusal.what, where=f"{logs.where}, effects", advice=refusal.advice
                ) from None


def _spoiling(table: Table, *, settings: _Settings, mechanisms: tuple[str, ...]) -> Spoiling:
    """One ``[[logs.faults]]``."""
    found = Spoiling(
        names=table.choices("name", FAULTS),
        severity=table.span("severity", default=1.0, least=0.0, most=MOST),
        tests=table.texts("test", example=settings.tests[0]) if "test" in table else (),
        at=table.span("at", default=0.0, least=0.0, most=settings.routine.timeout)
        if "at" in table
        else None,
        chance=table.number("chance", default=1.0, above=0.0, most=1.0),
    )
    if found.severity.most == 0.0:
        table.wrong("severity", advice="Leave the fault out, or give a number above 0.")
    for name in found.names:
        for what, advice in _mistakes(FAULTS[name], found, tests=settings.tests):
            table.refuse(what, advice=advice)
        for mechanism in mechanisms:
            if MECHANISMS[mechanism].type not in FAULTS[name].types:
                table.refuse(
                    f"{name} cannot strike {mechanism}",
                    advice=f"It takes a mechanism of type {' or '.join(FAULTS[name].types)}.",
                )
    return found


def _mistakes(
    fault: Fault, asked: Spoiling, *, tests: tuple[str, ...]
) -> Iterator[tuple[str, str]]:
    """What is impossible about where a fault shall strike, and what to do about it."""
    possible = tuple(test for test in tests if test.rpartition("-")[0] in fault.kinds)
    for test in asked.tests:
        if test not in tests:
            yield f"test {test!r} is not run", nearest(test, tests)
        elif test not in possible:
            yield (
                f"{fault.name} cannot strike in {test}",
                f"Choose one of: {', '.join(possible)}." if possible else "Leave it out.",
            )
    if not possible:
        yield f"{fault.name} strikes in none of the tests", f"Run one of: {', '.join(fault.kinds)}."
    if fault.whole and asked.at is not None:
        yield f"{fault.name} spoils a whole test, so at means nothing", "Leave out at."
