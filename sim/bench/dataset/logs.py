"""One ``[[logs]]`` table of a spec: mechanisms, routine, hidden effects and faults."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from sim.bench.dataset.table import NumberRange, TomlTable, suggest_word
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import FASTEST, SLOWEST
from sim.core.errors import Refusal
from sim.core.vocabulary import FOUR_TESTS, KINDS, TESTS
from sim.inspect.fault import MOST, Fault
from sim.inspect.faults import FAULTS
from sim.physics.effects import EFFECTS

MOST_LOGS = 100_000  # [logs of a dataset] its key and plan still fit in memory
ROUTINE = ("ramp", "step", "timeout", "tests", "period", "duty_cycle", "electrical")
LOGS = ("mechanisms", "count", "drawn", "routine", "effects", "faults")
EFFECT = ("name", "size", "chance")
FAULT = ("name", "severity", "test", "at", "chance")


@dataclass(frozen=True)
class LogSettings:
    """Settings with which the tests of a log are run.

    Args:
        routine: the commanded voltages.
        tests: the tests in the log.
        period: [s] loop period of the robot program.
        duty_cycle: whether the program commands a duty cycle instead of a voltage.
        electrical: whether the log has motor current and battery voltage, too.
    """

    routine: Routine = field(default_factory=Routine)
    tests: tuple[str, ...] = FOUR_TESTS
    period: float = 0.02
    duty_cycle: bool = False
    electrical: bool = False


@dataclass(frozen=True)
class HiddenEffectChoice:
    """An effect to hide, or one of several.

    Args:
        names: names of effects, of which one is drawn.
        size: [1] 1 is ordinary.
        chance: [1] share of the logs with the effect.
    """

    names: tuple[str, ...]
    size: NumberRange
    chance: float


@dataclass(frozen=True)
class FaultChoice:
    """A fault to damage a log with, or one of several.

    Args:
        names: names of faults, of which one is drawn.
        severity: [1] 1 is ordinary.
        tests: tests, of which one is drawn; empty lets the fault choose.
        at: [s] since the test's first sample; None lets the fault choose.
        chance: [1] share of the logs with the fault.
    """

    names: tuple[str, ...]
    severity: NumberRange
    tests: tuple[str, ...]
    at: NumberRange | None
    chance: float


@dataclass(frozen=True)
class LogTable:
    """Logs of one kind.

    Args:
        where: place in the spec, for messages.
        mechanisms: names of mechanisms, each with logs of its own.
        count: number of logs of each mechanism, for each student if there are any.
        drawn: whether each log has a random variant of the mechanism.
        settings: settings of the tests.
        effects: effects, hidden in this order.
        faults: faults, made in this order.
    """

    where: str
    mechanisms: tuple[str, ...]
    count: int
    drawn: bool
    settings: LogSettings
    effects: tuple[HiddenEffectChoice, ...]
    faults: tuple[FaultChoice, ...]


def read_settings(table: TomlTable, *, default: LogSettings) -> LogSettings:
    """The settings under ``routine``; one that is missing is taken from the default.

    Raises:
        BadRequest: a key is unknown, or its value is wrong.
    """
    if "routine" not in table:
        return default
    found = TomlTable(table.content["routine"], where=f"{table.where}, routine", known=ROUTINE)
    tests = found.read_choices("tests", TESTS) if "tests" in found else default.tests
    try:
        routine = Routine(
            ramp=found.read_number("ramp", default=default.routine.ramp),
            step=found.read_number("step", default=default.routine.step),
            timeout=found.read_number("timeout", default=default.routine.timeout),
            kinds=tuple(kind for kind in KINDS if any(test.startswith(kind) for test in tests)),
        )
    except Refusal as refusal:
        found.refuse(refusal.what, advice=refusal.advice)
    period = found.read_number("period", default=default.period)
    if not FASTEST <= period <= SLOWEST:
        found.refuse_value(
            "period",
            advice=f"Give a time from {FASTEST:g} to {SLOWEST:g} s. Robot programs use a time "
            "step of 0.02 s.",
        )
    return LogSettings(
        routine=routine,
        tests=tests,
        period=period,
        duty_cycle=found.read_flag("duty_cycle", default=default.duty_cycle),
        electrical=found.read_flag("electrical", default=default.electrical),
    )


def read_logs(table: TomlTable, *, default: LogSettings) -> LogTable:
    """Read and check one ``[[logs]]`` table.

    Raises:
        BadRequest: a key is unknown, its value is wrong, or an effect or fault is impossible.
    """
    settings = read_settings(table, default=default)
    mechanisms = table.read_choices("mechanisms", MECHANISMS)
    effects = table.read_tables("effects", name="logs.effects", known=EFFECT)
    faults = table.read_tables("faults", name="logs.faults", known=FAULT)
    found = LogTable(
        where=table.where,
        mechanisms=mechanisms,
        count=table.read_integer("count", default=1, least=1, most=MOST_LOGS),
        drawn=table.read_flag("drawn", default=True),
        settings=settings,
        effects=tuple(_read_effect(one, mechanisms=mechanisms) for one in effects),
        faults=tuple(_read_fault(one, settings=settings, mechanisms=mechanisms) for one in faults),
    )
    named = [name for one in found.effects for name in one.names]
    for name in named:
        if named.count(name) > 1:
            table.refuse(
                f"one log might get the effect {name!r} twice",
                advice="Name each effect in one [[logs.effects]] only.",
            )
    return found


def _read_effect(table: TomlTable, *, mechanisms: tuple[str, ...]) -> HiddenEffectChoice:
    """Read one ``[[logs.effects]]`` table, and try it on each mechanism at both sizes."""
    found = HiddenEffectChoice(
        names=table.read_choices("name", EFFECTS),
        size=table.read_range("size", default=1.0),
        chance=table.read_number("chance", default=1.0, above=0.0, most=1.0),
    )
    if found.size.most == 0.0:
        table.refuse_value("size", advice="Leave the effect out, or give a number above 0.")
    for mechanism in mechanisms:
        for name in found.names:
            for size in (found.size.least, found.size.most):
                try:
                    MECHANISMS[mechanism].hide(name, size=size)
                except Refusal as refusal:
                    table.refuse(refusal.what, advice=refusal.advice)
    return found


def _read_fault(
    table: TomlTable, *, settings: LogSettings, mechanisms: tuple[str, ...]
) -> FaultChoice:
    """Read one ``[[logs.faults]]`` table."""
    found = FaultChoice(
        names=table.read_choices("name", FAULTS),
        severity=table.read_range("severity", default=1.0, least=0.0, most=MOST),
        tests=table.read_texts("test", example=settings.tests[0]) if "test" in table else (),
        at=table.read_range("at", default=0.0, least=0.0, most=settings.routine.timeout)
        if "at" in table
        else None,
        chance=table.read_number("chance", default=1.0, above=0.0, most=1.0),
    )
    if found.severity.most == 0.0:
        table.refuse_value("severity", advice="Leave the fault out, or give a number above 0.")
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
    fault: Fault, choice: FaultChoice, *, tests: tuple[str, ...]
) -> Iterator[tuple[str, str]]:
    """Problem and advice for each impossible test or time of a fault."""
    possible = tuple(test for test in tests if test.rpartition("-")[0] in fault.kinds)
    for test in choice.tests:
        if test not in tests:
            yield f"the routine does not run a test {test!r}", suggest_word(test, tests)
        elif test not in possible:
            yield (
                f"{fault.name} cannot strike in {test}",
                f"Choose one of: {', '.join(possible)}." if possible else "Leave it out.",
            )
    if not possible:
        yield f"{fault.name} strikes in none of the tests", f"Run one of: {', '.join(fault.kinds)}."
    if fault.whole and choice.at is not None:
        yield f"{fault.name} damages a whole test, so the key at has no use here", "Leave out at."
