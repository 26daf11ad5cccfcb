"""Numbers that a device reports: which device, which quantity, and in which unit.

A unit follows the source of a number. ``Meters.of(x)`` converts nothing: if ``x`` is a TalonFX's
position, the number is still in rotations.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.ir import Assign, Call, Member, Name, Node, Self, Text
from grader.robotcode.motors import make_motor_label
from grader.robotcode.name_resolution import (
    get_last_name,
    get_simple_type_name,
    infer_type,
    infer_type_from,
    resolve,
)
from grader.robotcode.scope import Scope, collect_bindings, find_only_value, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import (
    APPLIED_DUTY,
    APPLIED_VOLTAGE,
    BUS_VOLTAGE,
    PULSES,
    ROTATIONS,
    SPARKS,
    is_motor,
    spell_as_java,
)

PARTS = {  # methods of a motor controller that hand out its encoder
    "getEncoder": "RelativeEncoder",
    "getAlternateEncoder": "RelativeEncoder",
    "getAbsoluteEncoder": "AbsoluteEncoder",
}
QUANTITIES = (
    ("velocity", re.compile(r"get\w*(Velocity|Rate|Speed)\w*")),
    ("acceleration", re.compile(r"get\w*Acceleration\w*")),
    ("current", re.compile(r"get\w*Current\w*")),
    ("position", re.compile(r"get\w*(Position|Distance|Angle|Raw)\w*|get")),
)
ENCODER = re.compile(r"\w*(Encoder|CANcoder|CANCoder|Cancoder)")
MOST_IDS = 62  # on a CAN bus
PULSE_COUNT = "pulse count"  # the type of a reading by one of ...
COUNTS = frozenset({"get", "getRaw"})  # methods of WPILib's Encoder that know of no distance
ANY = "*"  # a setting of a device that cannot be told apart


@dataclass(frozen=True)
class DeviceReading:
    """One number asked of a device.

    Args:
        device: the variable that is asked, ``m_left``; an encoder of a motor controller counts as
            the motor controller.
        type: its class: ``TalonFX``, ``RelativeEncoder``.
        quantity: ``position``, ``velocity``, ``acceleration``, ``current``, ``voltage``, ``duty``
            or ``bus``.
    """

    device: str
    type: str
    quantity: str


@dataclass
class DeviceSettings:
    """The settings that the program gives its devices.

    Args:
        per_pulse: encoder -> what it counts per pulse; None if unknown.
        position, velocity: the conversion factors of Spark encoders; None if unknown.
        ratios: the source text of every sensor-to-mechanism ratio.
        inverted: the motors that are set to turn the other way round.
        configured: the devices that get a configuration.
        elsewhere: whether settings come from code that is not in these files.
    """

    per_pulse: dict[str, float | None] = field(default_factory=dict)
    position: list[float | None] = field(default_factory=list)
    velocity: list[float | None] = field(default_factory=list)
    ratios: list[str] = field(default_factory=list)
    inverted: set[str] = field(default_factory=set)
    configured: set[str] = field(default_factory=set)
    elsewhere: bool = False


def find_quantity(method: str, *, motor: bool) -> str:
    """The quantity that a device's method returns, as ``voltage``; empty if none."""
    if method in APPLIED_VOLTAGE or (motor and method == "getVoltage"):
        return "voltage"
    if method in BUS_VOLTAGE:
        return "bus"
    if method in APPLIED_DUTY and (motor or method != "get"):
        return "duty"
    return next((name for name, form in QUANTITIES if form.fullmatch(method)), "")


def find_device(node: Node, scope: Scope, names: SymbolTable) -> tuple[str, str]:
    """The name and the class of a motor controller or encoder; two empty texts for other nodes."""
    type_ = get_simple_type_name(infer_type(node, scope, names))
    value, _ = resolve(node, scope, names)
    if isinstance(value, Call) and isinstance(value.target, Member):
        made = PARTS.get(spell_as_java(value.target.name), "")
        if made and not value.target.name[:1].isupper():
            return make_motor_label(value.target.owner), made
    known = is_motor(type_) or bool(ENCODER.fullmatch(type_))
    return (make_motor_label(node), type_) if known else ("", "")


def find_native_unit(reading: DeviceReading, settings: DeviceSettings) -> tuple[str, float | None]:
    """The unit in which a device reports a position or a velocity, and a factor it is set to.

    Returns:
        ``rotation``, ``rotation per second``, ``rpm``, ``pulse`` or ``set`` (whatever the program
        set the device to), or empty if unknown; and the factor that the program set,
        None if unknown.
    """
    moves = reading.quantity == "velocity"
    found: tuple[str, float | None] = ("", None)
    if reading.quantity not in {"position", "velocity"}:
        return found
    if ROTATIONS.fullmatch(reading.type):
        if not any("meter" in ratio.lower() for ratio in settings.ratios):
            found = ("rotation per second" if moves else "rotation"), 1.0
    elif SPARKS.fullmatch(reading.type):
        factors = set(settings.velocity if moves else settings.position)
        if factors or not settings.elsewhere:
            factor = 1.0 if not factors else factors.pop() if len(factors) == 1 else None
            found = ("rpm" if moves else "rotation"), factor
    elif reading.type == PULSE_COUNT:
        found = "pulse", 1.0
    elif PULSES.fullmatch(reading.type):
        if ANY in settings.per_pulse:
            found = "set", None
        elif reading.device in settings.per_pulse:
            found = "set", settings.per_pulse[reading.device]
        else:
            found = "pulse", 1.0
    return found


def read_device_settings(
    home: Scope, names: SymbolTable, measures: ConstantFolder
) -> DeviceSettings:
    """The settings that a class and its file give to devices."""
    return _SettingsReader(names, measures).read(home)


class _SettingsReader:
    """Goes through the code for what sets a device."""

    def __init__(self, names: SymbolTable, measures: ConstantFolder) -> None:
        self._names = names
        self._measures = measures
        self._found = DeviceSettings()

    def read(self, home: Scope) -> DeviceSettings:
        """All settings in the files of a class and of those above it."""
        above = self._names.list_base_classes(home) if home.classes else []
        for module in dict.fromkeys((self._names.main, *(place.module for place in above))):
            for node, scope in walk_with_scopes(module.body, Scope(module)):
                if isinstance(node, Assign) and node.value is not None:
                    self._assigned(get_last_name(node.target), node.value)
                elif isinstance(node, Call) and isinstance(node.target, Member):
                    for first in node.all_args[:1]:
                        self._called(node.target, first, scope)
        return self._found

    def _assigned(self, name: str, value: Node) -> None:
        if _is_ratio(name):
            self._found.ratios.append(value.place.text)
        elif spell_as_java(name).lower() == "inverted":
            self._found.inverted.add(ANY)

    def _called(self, target: Member, first: Node, scope: Scope) -> None:
        name = spell_as_java(target.name).removeprefix("set").removeprefix("with")
        name = name[:1].lower() + name[1:]
        device = (
            ANY if _is_open(target.owner, scope, self._names) else make_motor_label(target.owner)
        )
        measure = self._measures.fold(first, scope)
        amount = None if measure is None else measure.value
        if name == "distancePerPulse":
            self._found.per_pulse[device] = amount
        elif name == "positionConversionFactor":
            self._found.position.append(amount)
        elif name == "velocityConversionFactor":
            self._found.velocity.append(amount)
        elif _is_ratio(target.name):
            self._found.ratios.append(first.place.text)
        elif name == "inverted" and first.place.text.lower() != "false":
            self._found.inverted.add(device)
        elif name in {"configure", "apply"}:
            self._found.configured.add(_configured(target.owner))
            value, where = resolve(first, scope, self._names)
            if isinstance(value, Name | Member) and not self._names.find_definitions(value, where):
                self._found.elsewhere = True


def _configured(node: Node) -> str:
    """The device of ``m_top.configure(…)`` and of ``m_top.getConfigurator().apply(…)``."""
    inner = node.target if isinstance(node, Call) else node
    if isinstance(inner, Member) and isinstance(node, Call):
        inner = inner.owner
    return make_motor_label(inner)


def _is_ratio(name: str) -> bool:
    return spell_as_java(name).lower().endswith(("sensortomechanismratio", "rotortosensorratio"))


def _is_open(node: Node, scope: Scope, names: SymbolTable) -> bool:
    """Whether a device is a parameter, an element of a list, or another object's."""
    if isinstance(node, Member) and isinstance(node.owner, Self):
        return False
    if not isinstance(node, Name):
        return True
    if names.find_field_name(node, scope):
        return False
    return bool(names.find_local(node.name, scope))


def find_impossible_ids(
    home: Scope, names: SymbolTable, measures: ConstantFolder
) -> list[tuple[str, float]]:
    """The devices of a class whose port or CAN ID is impossible."""
    found = []
    for name, value in _made(home, names):
        several = (measures.fold(arg, home) for arg in value.args)
        amounts = [one.value for one in several if one is not None]
        wrong = [one for one in amounts if one != int(one) or not 0 <= one <= MOST_IDS]
        twice = len(amounts) > 1 and amounts[0] == amounts[1]
        if wrong or (twice and get_last_name(value.target) == "Encoder"):
            found.append((name, (wrong or amounts)[0]))
    return found


def _made(home: Scope, names: SymbolTable) -> Iterator[tuple[str, Call]]:
    """The motor controllers and encoders of a class that are made with a number."""
    for name, definitions in (names.find_fields(home) if home.classes else {}).items():
        value = next((one.value for one in definitions if isinstance(one.value, Call)), None)
        if isinstance(value, Call) and value.args:
            type_ = get_simple_type_name(infer_type(value, home, names))
            if is_motor(type_) or type_ == "Encoder":
                yield name, value


def find_shared_ids(
    home: Scope, names: SymbolTable, measures: ConstantFolder
) -> list[tuple[str, str]]:
    """Pairs of devices of a class that share a port or a CAN ID."""
    made: dict[tuple[object, ...], str] = {}
    found: list[tuple[str, str]] = []
    for name, value in _made(home, names):
        kind = get_simple_type_name(infer_type(value, home, names))
        amounts = [measures.fold(arg, home) for arg in value.args]
        known = [one.value for one in amounts if one is not None]
        texts = [arg.value for arg in value.args if isinstance(arg, Text)]
        keys: list[tuple[object, ...]] = [(kind, *known, *texts)] if known else []
        if kind == "Encoder":  # each of its two channels is a port of its own
            keys = [(kind, channel) for channel in dict.fromkeys(known[:2])]
        found += [(made[key], name) for key in keys if made.setdefault(key, name) != name]
    return list(dict.fromkeys(found))


def find_devices(home: Scope, names: SymbolTable) -> Iterator[tuple[str, str]]:
    """The motor controllers and encoders that a class owns: name and class."""
    for place in names.list_base_classes(home) if home.classes else ():
        for name, definitions in names.find_fields(place).items():
            type_ = get_simple_type_name(infer_type_from(definitions, names))
            if is_motor(type_) or ENCODER.fullmatch(type_):
                yield name, type_


def find_number_fields(
    home: Scope, names: SymbolTable, measures: ConstantFolder
) -> Iterator[tuple[str, float]]:
    """The numbers among a class's fields, and in Python among those of its file: name and value."""
    at_top = collect_bindings(home.module.body, Scope(home.module))
    for several in (names.find_fields(home) if home.classes else {}, at_top):
        for name, definitions in several.items():
            only = find_only_value(definitions)
            amount = None if only is None else measures.fold(*only)
            if amount is not None and amount.dimension == "number":
                yield name, amount.value
