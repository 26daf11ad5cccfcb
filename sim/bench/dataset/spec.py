"""The spec of a dataset: an instructor's TOML file, read and checked as a whole.

``example.toml`` in this folder explains every key.
"""

import math
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from sim.bench.dataset.table import (
    NumberRange,
    choices,
    flag,
    integer,
    key,
    number,
    number_range,
    read_table,
    table,
    tables,
    text,
    texts,
)
from sim.bench.mechanism import LARGEST
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import FASTEST, SLOWEST
from sim.core.errors import BadRequest, refusals_at
from sim.core.vocabulary import FOUR_TESTS, KINDS, TESTS
from sim.inspect.fault import MOST
from sim.inspect.faults import FAULTS
from sim.physics.effects import EFFECTS
from sim.support.secret import Secret, find_secret
from sim.support.student_table import make_distinct_names, read_student_table

FORMATS = ("wpilog", "csv")
ENDING = ".secret"  # suffix of a file with a secret
MOST_LOGS = 100_000  # [logs of a dataset] its key and plan still fit in memory
ROSTER, COLUMN = "roster.csv", "student"  # an example, and the column unless the spec names another
ORDINARY = NumberRange(1.0, 1.0)  # size of an effect, severity of a fault


def read_secret_name(key: str, value: object) -> str:
    """Read the name of the file with the secret; messages do not repeat it, as it might be it."""
    name: str = text(f"class{ENDING}")(key, value)
    if not name.endswith(ENDING) or len(name) == len(ENDING):
        raise BadRequest(
            f"{key} is not the name of a file that ends in {ENDING}",
            advice=f'Write secret = "class{ENDING}" into the spec, and run this command again: it '
            "makes the file. Others may read the spec, so the secret itself must not be in it.",
        )
    return name


@dataclass(frozen=True, kw_only=True)
class RosterFile:
    """The file of a roster, as a spec names it.

    Args:
        file: its path, seen from the spec's folder.
        column: header of the column with the names.
    """

    file: str = key(text(ROSTER))
    column: str = key(text(COLUMN), COLUMN)


def read_students(name: str, value: object) -> tuple[str, ...] | RosterFile:
    """Read the spec's students: a list of names, the path of a roster, or a table with its path."""
    if isinstance(value, list):
        return make_distinct_names((name, one) for one in texts("ann")(name, value))
    if isinstance(value, dict):
        found: RosterFile = table(RosterFile)(name, value)
        return found
    return RosterFile(file=text(ROSTER)(name, value))


@dataclass(frozen=True, kw_only=True)
class LogSettings:
    """Settings with which the tests of a log are run: ``routine`` in a spec.

    Args:
        ramp: [V/s] ramp rate of the quasistatic tests.
        step: [V] voltage of the dynamic tests.
        timeout: [s] longest duration of a test.
        tests: the tests in the log.
        period: [s] loop period of the robot program.
        duty_cycle: whether the program commands a duty cycle instead of a voltage.
        electrical: whether the log has motor current and battery voltage, too.

    Raises:
        BadRequest: a number is out of range.
    """

    ramp: float = key(number(0.0, math.inf), Routine.ramp)
    step: float = key(number(0.0, math.inf), Routine.step)
    timeout: float = key(number(0.0, math.inf), Routine.timeout)
    tests: tuple[str, ...] = key(choices(TESTS), FOUR_TESTS)
    period: float = key(number(FASTEST, SLOWEST), 0.02)
    duty_cycle: bool = key(flag, default=False)
    electrical: bool = key(flag, default=False)

    def __post_init__(self) -> None:
        _ = self.routine

    @property
    def routine(self) -> Routine:
        """The commanded voltages."""
        kinds = tuple(kind for kind in KINDS if any(test.startswith(kind) for test in self.tests))
        return Routine(self.ramp, self.step, self.timeout, kinds)


@dataclass(frozen=True, kw_only=True)
class EffectChoice:
    """An effect to hide, or one of several.

    Args:
        name: names of effects, of which one is drawn.
        size: [1] 1 is ordinary.
        chance: [1] share of the logs with the effect.
    """

    name: tuple[str, ...] = key(choices(EFFECTS))
    size: NumberRange = key(number_range(0.0, LARGEST), ORDINARY)
    chance: float = key(number(0.0, 1.0), 1.0)


@dataclass(frozen=True, kw_only=True)
class FaultChoice:
    """A fault to damage a log with, or one of several.

    Args:
        name: names of faults, of which one is drawn.
        severity: [1] 1 is ordinary.
        test: tests, of which one is drawn; empty lets the fault choose.
        at: [s] since the test's first sample; None lets the fault choose.
        chance: [1] share of the logs with the fault.
    """

    name: tuple[str, ...] = key(choices(FAULTS))
    severity: NumberRange = key(number_range(0.0, MOST), ORDINARY)
    test: tuple[str, ...] = key(choices(TESTS), ())
    at: NumberRange | None = key(number_range(0.0, math.inf), None)
    chance: float = key(number(0.0, 1.0), 1.0)


@dataclass(frozen=True, kw_only=True)
class LogTable:
    """Logs of one kind: a ``[[logs]]`` table.

    Args:
        mechanisms: names of mechanisms, each with logs of its own.
        count: number of logs of each mechanism, for each student if there are any.
        drawn: whether each log has a random variant of the mechanism.
        routine: settings of the tests.
        effects: effects, hidden in this order.
        faults: faults, made in this order.
    """

    mechanisms: tuple[str, ...] = key(choices(MECHANISMS))
    count: int = key(integer(1, MOST_LOGS), 1)
    drawn: bool = key(flag, default=True)
    routine: LogSettings = key(table(LogSettings), LogSettings())
    effects: tuple[EffectChoice, ...] = key(tables(EffectChoice, "logs.effects"), ())
    faults: tuple[FaultChoice, ...] = key(tables(FaultChoice, "logs.faults"), ())


@dataclass(frozen=True, kw_only=True)
class Spec:
    """The specification of a dataset.

    Args:
        where: path of the file, as given.
        name: name of the dataset; another name gives other data.
        seed: seed of all random choices, if nothing is secret.
        secret: file with the secret from which all seeds are derived.
        students: names of the students, each with logs of their own; may be empty.
        formats: formats in which each log is written.
        routine: settings of the tests of all logs, unless a table of logs has its own.
        logs: tables of logs.
    """

    where: str = ""
    name: str = key(text("week3"))
    seed: int | None = key(integer(0, 2**63 - 1), None)
    secret: Any = key(read_secret_name, None)
    students: Any = key(read_students, ())
    formats: tuple[str, ...] = key(choices(FORMATS), FORMATS[:1])
    routine: LogSettings = key(table(LogSettings), LogSettings())
    logs: tuple[LogTable, ...] = key(tables(LogTable, "logs"), ())

    def find_secret(self, *, make: bool) -> Secret:
        """The secret of the dataset, or its seed.

        Args:
            make: whether to make a new secret if its file does not exist.

        Raises:
            BadRequest: there is none, it is too short, or file and environment differ.
        """
        if self.seed is not None:
            return Secret(f"sysid dataset of seed {self.seed}".encode(), hidden=False)
        found = find_secret(self.secret, make=make)
        if found is None:
            raise BadRequest(
                "it says neither secret nor seed",
                where=self.where,
                advice=f'Add secret = "class{ENDING}" to the spec, and run this command again: it '
                "makes the file. Or add seed = 1, if everybody may make the same data again.",
            )
        return found


def read_spec(path: Path) -> Spec:
    """Read a spec and check it, as far as possible without making a log.

    Raises:
        BadRequest: it cannot be read, or a value is wrong; the message names the key.
    """
    with refusals_at(str(path)):
        found = read_table(Spec, _hand_down_routine(_parse_toml(path)))
        if not found.logs:
            advice = "Add one, with mechanisms and count."
            raise BadRequest("there is no [[logs]] in it", advice=advice)
        if found.secret and found.seed is not None:
            advice = "Leave one of them out."
            raise BadRequest("the spec has both a seed and a secret", advice=advice)
    students = found.students
    if isinstance(students, RosterFile):
        advice = "Give the path of a CSV file in UTF-8, seen from the spec's folder."
        roster = read_student_table(path.parent / students.file, what="the roster", advice=advice)
        advice = f'Name one of its columns: students = {{ file = "{students.file}", column = "…" }}'
        students = tuple(roster.index_rows(roster.find_column(students.column, advice=advice)))
    total = max(len(students), 1) * sum(one.count * len(one.mechanisms) for one in found.logs)
    if total > MOST_LOGS:
        advice = f"Make several datasets: each dataset can have at most {MOST_LOGS} logs."
        raise BadRequest(f"{total} logs are requested", where=str(path), advice=advice)
    secret = path.parent / found.secret if found.secret else None
    return replace(found, where=str(path), secret=secret, students=students)


def _parse_toml(path: Path) -> dict[str, Any]:
    """The content of a TOML file."""
    if not path.exists():
        advice = f"Write an example there with: sysid dataset --example {path}"
        raise BadRequest("there is no such file", advice=advice)
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except tomllib.TOMLDecodeError as error:
        raise BadRequest(f"is not TOML: {error}", advice="Mend that line.") from None
    except UnicodeDecodeError:
        raise BadRequest("is not UTF-8", advice="Save it as UTF-8.") from None
    except OSError as error:
        what = f"cannot be read ({error.strerror})"
        raise BadRequest(what, advice="Give a TOML file.") from None


def _hand_down_routine(content: dict[str, Any]) -> dict[str, Any]:
    """The content of a spec whose tables of logs have the settings of its ``routine``, too."""
    routine, logs = content.get("routine", {}), content.get("logs")
    for one in logs if isinstance(logs, list) else ():
        own = one.get("routine", {}) if isinstance(one, dict) else None
        if isinstance(own, dict) and isinstance(routine, dict):
            one["routine"] = routine | own
    return content
