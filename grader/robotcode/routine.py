"""From a file to the facts about its SysIdRoutine."""

from dataclasses import dataclass, replace
from pathlib import Path

from grader.robotcode.abstract_value import MotorLog, Value
from grader.robotcode.compiling import find_compile_errors
from grader.robotcode.compiling.season import find_season
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.drive_callback import DriveTrace
from grader.robotcode.facts import (
    Certainty,
    ConfigQuantity,
    DriveCall,
    ParseProblem,
    RoutineFacts,
)
from grader.robotcode.files import Files
from grader.robotcode.ir import Assign, Call, Function, Member, Node, Null, Number, Self, Text
from grader.robotcode.kept_field import find_line_that_clears
from grader.robotcode.log_callback import LogTrace
from grader.robotcode.motors import list_owned_motors
from grader.robotcode.name_resolution import (
    Placed,
    find_constructed_class,
    find_imported_name,
    find_methods,
    get_last_name,
    get_simple_type_name,
    infer_type,
    resolve,
)
from grader.robotcode.readings import (
    find_devices,
    find_impossible_ids,
    find_number_fields,
    find_shared_ids,
    read_device_settings,
)
from grader.robotcode.scope import Scope, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import (
    COMMANDS_V3,
    CONFIG,
    CONFIG_FACTORIES,
    DEFAULTS,
    MECHANISM,
    MECHANISMS,
    NAMED_DEFAULTS,
    ROUTINE,
    STOPS,
    SUBSYSTEMS,
    find_config_defaults,
    spell_as_java,
)


@dataclass(frozen=True)
class _Routine:
    """A SysIdRoutine constructor call, its two arguments found.

    Args:
        call: the call.
        scope: where it stands.
        config, mechanism: their positions among the arguments; -1 if absent.
    """

    call: Call
    scope: Scope
    config: int
    mechanism: int

    def argument(self, position: int) -> Placed | None:
        """The argument at a position; None if there is none."""
        found = _arguments(self.call, ROUTINE).get(position)
        return None if found is None else (found, self.scope)


def read_routine_facts(path: Path) -> RoutineFacts:
    """Read the facts from a file; see ``grader.robotcode.read``."""
    names = SymbolTable(Files(path))
    module = names.main
    facts = RoutineFacts(module.language, problems=module.problems)
    routine = _find(names)
    if routine is None:
        return facts
    facts = replace(facts, compile_errors=find_compile_errors(names))
    measures = ConstantFolder(names)
    home = routine.scope.home
    if home.classes:
        above = {
            find_imported_name(base, place) or base
            for place in names.list_base_classes(home)
            for base in place.classes[-1].bases
        }
        facts = replace(
            facts,
            class_name=home.classes[-1].name,
            is_subsystem=not above.isdisjoint(SUBSYSTEMS),
            motors=list_owned_motors(home, names),
            impossible_numbers=tuple(find_impossible_ids(home, names, measures)),
            same_numbers=tuple(find_shared_ids(home, names, measures)),
            devices=tuple(find_devices(home, names)),
            constants=tuple(find_number_fields(home, names, measures)),
        )
    facts = replace(
        facts,
        routine_line=routine.call.place.line,
        config_argument=routine.config,
        mechanism_argument=routine.mechanism,
        routine_lost=find_line_that_clears(routine.call, home, names),
    )
    facts = _with_config(facts, routine.argument(routine.config), names, measures)
    return _with_mechanism(facts, routine.argument(routine.mechanism), names, measures)


def _find(names: SymbolTable) -> _Routine | None:
    """The first routine that is complete, else the one that has most."""
    found = [
        _routine(node, scope, names)
        for node, scope in walk_with_scopes(names.main.body, Scope(names.main))
        if isinstance(node, Call) and find_constructed_class(node, scope, names) == "SysIdRoutine"
    ]
    return max(found, key=lambda one: (one.config >= 0) + (one.mechanism >= 0), default=None)


def _routine(call: Call, scope: Scope, names: SymbolTable) -> _Routine:
    kinds = {at: _kind(node, scope, names) for at, node in _arguments(call, ROUTINE).items()}
    config, mechanism = (
        next((at for at, kind in kinds.items() if kind == word), -1)
        for word in ("Config", "Mechanism")
    )
    unclear = [at for at, kind in kinds.items() if not kind]
    if config < 0 and unclear:
        config = unclear.pop(0)
    if mechanism < 0 and unclear:
        mechanism = unclear.pop(0)
    return _Routine(call, scope, config, mechanism)


def _kind(node: Node, scope: Scope, names: SymbolTable) -> str:
    """The class of an argument; empty if unknown."""
    value, where = resolve(node, scope, names)
    if isinstance(value, Call):
        return _part_made(value, where, names)
    if isinstance(value, Null | Text | Number | Function | Self):
        return "other"
    return _part_name(get_simple_type_name(infer_type(node, scope, names)))


def _part_made(call: Call, scope: Scope, names: SymbolTable) -> str:
    """The part of a routine that a call makes: ``Config``, ``Mechanism``; else its class."""
    target = call.target
    if get_last_name(target) in CONFIG_FACTORIES:
        owner = target.owner if isinstance(target, Member) else None
        imported = next(
            (i.path for i in scope.module.imports if i.name == get_last_name(target)), ""
        )
        made_by = get_last_name(owner) if owner else imported.rpartition(".")[0].rpartition(".")[2]
        return "Config" if made_by == "Config" else ""
    return _part_name(find_constructed_class(call, scope, names))


def _part_name(made: str) -> str:
    return "Mechanism" if made in MECHANISMS else made


def _arguments(call: Call, words: tuple[str, ...]) -> dict[int, Node]:
    """Arguments by position, those given by keyword at the position of their word."""
    named = ((spell_as_java(word), node) for word, node in call.named)
    by_word = {words.index(word): node for word, node in named if word in words}
    return dict(enumerate(call.args)) | by_word


def _may_hide(call: Call, words: tuple[str, ...]) -> bool:
    """Whether an argument may be there unseen: spread from a variable, or its word misspelled."""
    return call.spread or any(spell_as_java(word) not in words for word, _ in call.named)


def _with_config(
    facts: RoutineFacts, config: Placed | None, names: SymbolTable, measures: ConstantFolder
) -> RoutineFacts:
    if config is None:
        return facts
    call, scope = resolve(*config, names)
    if not isinstance(call, Call) or _part_made(call, scope, names) != "Config":
        untold = ConfigQuantity(
            Certainty.UNKNOWN, text=config[0].place.text, line=_line(config[0], names)
        )
        return replace(facts, ramp=untold, step=untold, timeout=untold)
    given, season = _arguments(call, CONFIG), find_season(names.main.imports)
    found = dict.fromkeys(DEFAULTS, ConfigQuantity(Certainty.UNKNOWN))
    for at, (name, default) in enumerate(find_config_defaults(season).items()):
        if at in given:
            found[name] = _quantity(given[at], scope, default, names, measures)
        elif not _may_hide(call, CONFIG):
            found[name] = default
    for name, change in _changes(config[0], names).items():
        line = _line(change, names)
        found[name] = ConfigQuantity(Certainty.UNKNOWN, text=change.place.text, line=line)
    return replace(facts, ramp=found["ramp"], step=found["step"], timeout=found["timeout"])


def _changes(config: Node, names: SymbolTable) -> dict[str, Assign]:
    """Where a Config that a variable holds gets other numbers later, as Python lets it."""
    words = dict(zip(CONFIG, DEFAULTS, strict=False))
    return {
        words[spell_as_java(node.target.name)]: node
        for node, _ in walk_with_scopes(names.main.body, Scope(names.main))
        if isinstance(node, Assign)
        and isinstance(node.target, Member)
        and spell_as_java(node.target.name) in words
        and get_last_name(node.target.owner) == get_last_name(config) != ""
    }


def _line(node: Node, names: SymbolTable) -> int:
    return node.place.line if node.place.source is names.main.source else 0


def _quantity(
    node: Node, scope: Scope, default: ConfigQuantity, names: SymbolTable, measures: ConstantFolder
) -> ConfigQuantity:
    """One number of a Config that was given something."""
    place, line = node.place, _line(node, names)
    resolved, where = resolve(node, scope, names)
    if isinstance(resolved, Null):  # only Java takes null for "your own"; Python stumbles over it
        taken = where.module.language == "java" and not _commands_v3(names)
        known = Certainty.DEFAULT if taken else Certainty.UNKNOWN
        stated = default if known is Certainty.DEFAULT else ConfigQuantity(known)
        return replace(stated, text=place.text, line=line)
    constant = NAMED_DEFAULTS.get(get_last_name(resolved))
    if constant:
        named = find_config_defaults(find_season(names.main.imports))[constant]
        return replace(named, text=place.text, line=line)
    measure = measures.fold(node, scope)
    if measure is None or measure.unit:
        return ConfigQuantity(Certainty.UNKNOWN, text=place.text, line=line)
    return ConfigQuantity(Certainty.STATED, measure.value, measure.dimension, place.text, line)


def _commands_v3(names: SymbolTable) -> bool:
    """Whether a program uses Commands v3, whose Config refuses null."""
    return any(one.path.startswith(COMMANDS_V3) for one in names.main.imports)


def _with_mechanism(
    facts: RoutineFacts, mechanism: Placed | None, names: SymbolTable, measures: ConstantFolder
) -> RoutineFacts:
    if mechanism is None:
        return facts
    call, scope = resolve(*mechanism, names)
    if not isinstance(call, Call) or _part_made(call, scope, names) != "Mechanism":
        said = f"`{mechanism[0].place.text}` is made in code that is not in these files"
        return replace(facts, unread=(ParseProblem(said, _line(mechanism[0], names)),))
    given = _arguments(call, MECHANISM)
    facts = replace(facts, subsystem_passed=_passed(given.get(2), call, scope, names))
    drive = DriveTrace(names, measures)
    callback = _callback(given.get(0), scope, names)
    if callback is not None:
        parameter = Value(callback, scope, carries=True)
        facts = replace(facts, drive_found=drive.run(callback, scope, parameter))
        _in_periodic(drive, scope, names)
        facts = replace(facts, in_periodic=_besides(drive, scope, names, measures))
    commanded = {key for key, value in drive.stored.items() if value.carries is not False}
    settings = read_device_settings(scope.home, names, measures)
    log = LogTrace(names, measures, commanded=commanded, settings=settings)
    callback = _callback(given.get(1), scope, names)
    if callback is not None:
        found = log.run(callback, scope, Value(callback, scope, log=MotorLog()))
        facts = replace(facts, log_found=found)
    return replace(
        facts,
        drive=tuple(drive.calls),
        logged=tuple(log.signals),
        log_is_null=given.get(1) is not None and callback is None,
        unread=(*drive.unread.values(), *log.unread.values()),
        inverted=frozenset(settings.inverted),
        geared=frozenset(settings.configured if settings.ratios else ()),
    )


def _callback(node: Node | None, scope: Scope, names: SymbolTable) -> Node | None:
    """A callback argument; None if it is left out or null."""
    empty = node is None or isinstance(resolve(node, scope, names)[0], Null)
    return None if empty else node


def _passed(node: Node | None, call: Call, scope: Scope, names: SymbolTable) -> bool | None:
    """Whether the subsystem argument is the object itself."""
    if node is None:
        return None if _may_hide(call, MECHANISM) else False
    value, _ = resolve(node, scope, names)
    return True if isinstance(value, Self) else False if isinstance(value, Null) else None


def _besides(
    drive: DriveTrace, scope: Scope, names: SymbolTable, measures: ConstantFolder
) -> tuple[DriveCall, ...]:
    """What periodic() commands in every loop, where the callback itself moves the motors."""
    loop = DriveTrace(names, measures, only_sure=True)
    driven = {call.motor for call in drive.calls if call.method not in STOPS}
    for method in find_methods("periodic", scope.home, names)[:1] if scope.classes else ():
        loop.interpret_method(method)
    followed = any(call.text == other.text for call in drive.calls for other in loop.calls)
    return () if followed else tuple(call for call in loop.calls if call.motor in driven)


def _in_periodic(drive: DriveTrace, scope: Scope, names: SymbolTable) -> None:
    """A callback that only keeps the voltage leaves the motors to periodic()."""
    if drive.calls or not scope.classes:
        return
    if any(value.carries for value in drive.stored.values()):
        for method in find_methods("periodic", scope.home, names)[:1]:
            drive.interpret_method(method)
