"""Types of Java expressions around units and measures, and arguments that do not fit them."""

import re
from collections.abc import Iterator

from grader.robotcode.compiling.season import HOME, PACKAGES_OF, find_call_on_class
from grader.robotcode.facts import ParseProblem
from grader.robotcode.ir import (
    Call,
    Cast,
    Choice,
    Function,
    FunctionParameter,
    Member,
    Name,
    Node,
    Number,
    Operation,
    Reference,
    Self,
)
from grader.robotcode.name_resolution import (
    find_called_functions,
    find_constructed_class,
    find_methods,
    get_last_name,
    get_simple_type_name,
)
from grader.robotcode.readings import find_device, find_quantity
from grader.robotcode.scope import Scope, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import (
    COMMANDS_V3,
    CONFIG_FACTORIES,
    MECHANISMS,
    ROTATIONS,
    UNITS,
    is_motor,
)

DEEPEST = 12
NUMBER, SIGNAL = "double", "StatusSignal"
WANTED = {  # of the methods of WPILib's MotorLog
    "voltage": "Voltage",
    "current": "Current",
    "linearPosition": "Distance",
    "linearVelocity": "LinearVelocity",
    "linearAcceleration": "LinearAcceleration",
    "angularPosition": "Angle",
    "angularVelocity": "AngularVelocity",
    "angularAcceleration": "AngularAcceleration",
}
MEASURES = frozenset(WANTED.values()) | {"Time"}
VALUES = {  # what the signal of a quantity holds
    "position": "Angle",
    "velocity": "AngularVelocity",
    "voltage": "Voltage",
    "bus": "Voltage",
    "current": "Current",
    "duty": NUMBER,
}
PARAMETERS = ({"Voltage", "Measure", ""}, {"SysIdRoutineLog", ""})  # of the two callbacks
COUNTS = {  # how many arguments the parts of a SysIdRoutine take
    "SysIdRoutine": (2,),
    "Config": (0, 3, 4),
    "Mechanism": (3, 4),
    "SysIdMechanism": (3, 4),
    "useDataLog": (3,),
    "defaults": (0,),
}
COUNT_OF_V3_CONFIG = (4,)  # its shorter forms are useDataLog and defaults
ONLY_IN_V3 = {"SysIdMechanism": "Mechanism", "useDataLog": "Config", "defaults": "Config"}
ONLY_IN_V2 = {"Mechanism": "SysIdMechanism"}
CONFIG_TYPES = (  # of the first arguments of Config: what each is, and its type
    ("the ramp rate", "voltage per time, as in Volts.of(0.5).per(Second)"),
    ("the step", "Voltage"),
    ("the timeout", "Time"),
)
NUMBERS = frozenset({"double", "float", "int", "long", "Double", "Float", "Integer"})
MAKES = frozenset({"of", "ofBaseUnits", "mutable", "one", "zero"})
ARITHMETIC = frozenset({"+", "-", "*", "/", "%"})
PLAIN_NUMBERS = frozenset(
    {"in", "getValueAsDouble", "baseUnitMagnitude", "magnitude", "getAsDouble"}
)
SHARES = frozenset({"get", "getThrottle"})  # numbers, also of a TalonFX
KEEPS = re.compile(r"mut_?\w+|plus|minus|copy|mutableCopy|unaryMinus|negate")


def find_type_errors(names: SymbolTable) -> Iterator[ParseProblem]:
    """Arguments of the SysId log, of units and of callbacks whose type is not the declared one."""
    for node, scope in walk_with_scopes(names.main.body, Scope(names.main)):
        if isinstance(node, Operation) and node.sign in ARITHMETIC:
            yield from _operands(node, scope, names)
        if not isinstance(node, Call):
            continue
        name = get_last_name(node.target)
        if isinstance(node.target, Member):
            yield from _one_argument(node, node.target, scope, names)
            owner, line = get_last_name(node.target.owner), node.place.line
            yield from find_call_on_class(name, owner, held="m_routine", line=line)
        if isinstance(node.target, Member) and node.args:
            yield from _argument(node, node.target, name, scope, names)
        yield from _routine_part(node, scope, names)
        if find_constructed_class(node, scope, names) in MECHANISMS:
            yield from _callbacks(node, scope, names)


def _operands(node: Operation, scope: Scope, names: SymbolTable) -> Iterator[ParseProblem]:
    """Arithmetic with what is no number: Java has no operators for measures and signals."""
    for part in (node.left, node.right):
        given = "" if part is None else infer_expression_type(part, scope, names)
        if given == SIGNAL or given in MEASURES:
            what = "a signal: add getValueAsDouble()" if given == SIGNAL else f"a {given}"
            yield ParseProblem(
                f"{node.sign} works with numbers only, and this is {what}", node.place.line
            )


def _argument(
    call: Call, target: Member, name: str, scope: Scope, names: SymbolTable
) -> Iterator[ParseProblem]:
    given = infer_expression_type(call.args[0], scope, names)
    wanted = WANTED.get(name, "")
    line = target.place.line
    if (
        wanted
        and given
        and given != wanted
        and (name not in {"voltage", "current"} or _logs(target))
    ):
        kinds = {NUMBER: "a plain number", SIGNAL: "a signal"}
        said = kinds.get(given, f"a {given}")
        yield ParseProblem(f"{name}() takes a {wanted}, and this is {said}", line)
    unit = find_measure_of_unit(get_last_name(target.owner)) if name == "of" else ""
    if unit and (given in MEASURES or given == SIGNAL):
        what = "a signal: add getValueAsDouble()" if given == SIGNAL else f"a {given}"
        yield ParseProblem(
            f"{get_last_name(target.owner)}.of() takes a number, and this is {what}", line
        )
    owner = infer_expression_type(target.owner, scope, names) if name == "in" else ""
    asked = find_measure_of_unit(get_last_name(call.args[0])) if name == "in" else ""
    if owner in MEASURES and asked and asked != owner:
        yield ParseProblem(f"a {owner} cannot be given in {get_last_name(call.args[0])}", line)
    if name == "setVoltage" and given in {SIGNAL, *MEASURES} - {"Voltage"}:
        yield ParseProblem(f"setVoltage() takes volts, and this is a {given}", line)


def _one_argument(
    call: Call, target: Member, scope: Scope, names: SymbolTable
) -> Iterator[ParseProblem]:
    """Methods that take one argument, and are given none or several; methods of a number."""
    name = target.name
    if isinstance(target.owner, Number):
        said = f"a plain number has no {name}(): a unit makes a measure of it, as in Volts.of(0.5)"
        yield ParseProblem(said, target.place.line)
    if len(call.args) == 1:
        return
    takes = name in WANTED and _logs(target)
    takes |= name == "of" and bool(find_measure_of_unit(get_last_name(target.owner)))
    if name == "in":
        takes |= infer_expression_type(target.owner, scope, names) in MEASURES
    elif name == "setVoltage":
        _, type_ = find_device(target.owner, scope, names)
        takes |= type_ in HOME and is_motor(type_) and names.find_by_name(type_, scope) is None
    if takes:
        said = f"{name}() takes one argument, and gets {len(call.args)}"
        yield ParseProblem(said, target.place.line)


def _routine_part(call: Call, scope: Scope, names: SymbolTable) -> Iterator[ParseProblem]:
    """Arguments of WPILib's SysIdRoutine, its Config and its Mechanism: how many, and which."""
    part = _part_of_routine(call, scope)
    if part not in COUNTS:
        return
    counts, line = COUNTS[part], call.place.line
    other = _part_of_other_version(part, line, scope)
    if other:
        yield other
        return
    if part == "Config" and _is_v3(scope):
        counts = COUNT_OF_V3_CONFIG
    if len(call.args) not in counts:
        wanted = " or ".join(map(str, counts))
        yield ParseProblem(f"{part} takes {wanted} arguments, and gets {len(call.args)}", line)
        return
    if part in MECHANISMS:
        for given, what in zip(call.args, ("drive", "log"), strict=False):
            if isinstance(given, Self):
                said = f"the {what} callback has to be a method or a lambda, and this is the object"
                yield ParseProblem(said, given.place.line)
    elif part in {"Config", "useDataLog"}:
        yield from _config_types(call, scope, names)


def _config_types(call: Call, scope: Scope, names: SymbolTable) -> Iterator[ParseProblem]:
    """Arguments of a Config that are of another type."""
    for given, (what, wanted) in zip(call.args, CONFIG_TYPES, strict=False):
        type_ = infer_expression_type(given, scope, names)
        if type_ and type_ != wanted:
            is_ = {NUMBER: "a plain number", SIGNAL: "a signal"}.get(type_, f"a {type_}")
            yield ParseProblem(f"{what} has to be a {wanted}, and this is {is_}", given.place.line)


def _part_of_other_version(part: str, line: int, scope: Scope) -> ParseProblem | None:
    """A part that only the SysIdRoutine of the other version of Commands has."""
    version, others = (3, ONLY_IN_V2) if _is_v3(scope) else (2, ONLY_IN_V3)
    if part not in others:
        return None
    said = f"SysIdRoutine of Commands v{version} has no {part}. Did you mean {others[part]}?"
    return ParseProblem(said, line, others[part])


def _is_v3(scope: Scope) -> bool:
    return any(one.path.startswith(COMMANDS_V3) for one in scope.module.imports)


def _part_of_routine(call: Call, scope: Scope) -> str:
    """What a call makes of WPILib's SysIdRoutine: ``Config``, ``useDataLog``; empty if nothing."""
    target = call.target
    outer = target
    while isinstance(outer, Member):
        outer = outer.owner
    path = next((one.path for one in scope.module.imports if one.name == get_last_name(outer)), "")
    ours = path.startswith(tuple(PACKAGES_OF)) and ".sysid.SysIdRoutine" in path
    name = get_last_name(target)
    owner = get_last_name(target.owner) if isinstance(target, Member) else ""
    if not ours or not isinstance(outer, Name):
        return ""
    if name in CONFIG_FACTORIES:
        return name if owner == "Config" or path.endswith(f".Config.{name}") else ""
    return name if owner in {"", "SysIdRoutine"} and name[:1].isupper() else ""


def _logs(target: Member) -> bool:
    """Whether a method belongs to a chain that begins with ``log.motor(...)``."""
    node: Node = target.owner
    while isinstance(node, Call | Member):
        if isinstance(node, Call) and get_last_name(node.target) == "motor":
            return True
        node = node.target if isinstance(node, Call) else node.owner
    return False


def _callbacks(call: Call, scope: Scope, names: SymbolTable) -> Iterator[ParseProblem]:
    for given, allowed in zip(call.args, PARAMETERS, strict=False):
        if not isinstance(given, Reference) or not isinstance(given.owner, Self):
            continue
        found = find_methods(given.name, scope.home, names) if scope.classes else []
        if scope.classes and not found and len(names.list_base_classes(scope.home)) == 1:
            yield ParseProblem(f"the method {given.name}() is not declared", given.place.line)
        fits = [
            one
            for one, _ in found
            if len(one.parameters) == 1 and get_simple_type_name(one.parameters[0].type) in allowed
        ]
        if found and not fits:
            wanted = max(allowed, key=len)
            wanted = "Voltage" if "Voltage" in allowed else wanted
            said = f"{given.name}() must take exactly one {wanted} to be this callback"
            yield ParseProblem(said, given.place.line)


def find_measure_of_unit(unit: str) -> str:
    """The measure that a unit's name stands for: ``LinearVelocity`` of ``MetersPerSecond``."""
    found = UNITS.get(unit)
    if found is None:
        return ""
    rate = unit.count("PerSecond") + (unit == "RPM")
    kinds = {
        "linear": ("Distance", "LinearVelocity", "LinearAcceleration"),
        "angular": ("Angle", "AngularVelocity", "AngularAcceleration"),
    }
    if found.family:
        return kinds[found.family][rate]
    if found.volts == 1 and not found.seconds:
        return "Voltage"
    if found.seconds == 1:
        return "Time"
    return "Current" if "amp" in unit.lower() else ""


def infer_expression_type(node: Node, scope: Scope, names: SymbolTable, *, depth: int = 0) -> str:
    """The type of an expression: ``double``, a measure or ``StatusSignal``; empty if unknown."""
    depth += 1
    found = ""
    if depth > DEEPEST:
        return found
    if isinstance(node, Number):
        found = NUMBER
    elif isinstance(node, Operation):
        found = NUMBER if node.sign in ARITHMETIC else ""
    elif isinstance(node, Cast):
        found = _named(node.type)
    elif isinstance(node, Choice):
        found = infer_expression_type(node.one, scope, names, depth=depth)
    elif isinstance(node, Call):
        found = _of_call(node, scope, names, depth)
    elif isinstance(node, Name | Member) and not isinstance(node, Reference):
        found = _of_variable(node, scope, names, depth)
    return found


def _named(type_: str) -> str:
    name = get_simple_type_name(type_).removeprefix("Mut")
    if name in NUMBERS:
        return NUMBER
    return name if name in MEASURES | {SIGNAL} else ""


def _of_variable(node: Node, scope: Scope, names: SymbolTable, depth: int) -> str:
    for one in names.find_definitions(node, scope):
        if isinstance(one.value, FunctionParameter):
            return _named(one.value.type)
        if one.type and one.type != "var":
            return _named(one.type)
        if one.value is not None and not isinstance(one.value, Function):
            return infer_expression_type(one.value, one.scope, names, depth=depth)
    return ""


def _of_call(call: Call, scope: Scope, names: SymbolTable, depth: int) -> str:
    functions = find_called_functions(call, scope, names)
    if functions:
        return _named(functions[0][0].type)
    target = call.target
    if not isinstance(target, Member):
        return ""
    name = target.name
    unit = (
        find_measure_of_unit(get_last_name(target.owner))
        if isinstance(target.owner, Name | Member)
        else ""
    )
    if name in MAKES and unit:
        return unit
    if name in PLAIN_NUMBERS or get_last_name(target.owner) == "Math":
        return NUMBER
    return _of_device(target, scope, names) or _of_measure(target, scope, names, depth)


def _of_device(target: Member, scope: Scope, names: SymbolTable) -> str:
    """What a method of a motor controller or an encoder gives; empty if it is none."""
    device, type_ = find_device(target.owner, scope, names)
    if not device or not find_quantity(target.name, motor=is_motor(type_)):
        return ""
    gives_signal = ROTATIONS.fullmatch(type_) and target.name not in SHARES
    return SIGNAL if gives_signal else NUMBER


def _of_measure(target: Member, scope: Scope, names: SymbolTable, depth: int) -> str:
    """What a method of a measure or of a signal gives; empty if unknown."""
    name, inner = target.name, target.owner
    owner = infer_expression_type(inner, scope, names, depth=depth)
    if owner == SIGNAL and name == "getValue":
        asked = get_last_name(inner.target) if isinstance(inner, Call) else ""
        return VALUES.get(find_quantity(asked, motor=True), "")
    if owner == SIGNAL:
        return SIGNAL if name == "refresh" else ""
    return owner if owner in MEASURES and KEEPS.fullmatch(name) else ""
