"""How a value goes through an expression: what arithmetic and library calls do to the voltage."""

import math
from dataclasses import replace

from grader.robotcode.abstract_value import CHANGED, Mark, Value, join_values
from grader.robotcode.constant_folding import ConstantFolder, FoldedConstant
from grader.robotcode.conversions import FACTORS
from grader.robotcode.ir import Call, Member, Node, Operation
from grader.robotcode.name_resolution import (
    get_last_name,
    get_method_name,
    get_simple_type_name,
    infer_type,
)
from grader.robotcode.readings import COUNTS, PULSE_COUNT, DeviceReading, find_device, find_quantity
from grader.robotcode.scope import Scope
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import (
    AMOUNTS,
    APPLIED_DUTY,
    APPLIED_VOLTAGE,
    ARGUMENT,
    BUS_VOLTAGE,
    CALCULATES,
    CONTROLLERS,
    LIMITS,
    MEASURED,
    NEVER_REACHED,
    OPPOSITE,
    OVER,
    PULSES,
    REPLACES,
    SAME,
    TIMES,
    UNITS,
    UNSIGNED,
    is_motor,
)

_MARKED_BY = (
    (APPLIED_VOLTAGE, Mark.APPLIED),
    (BUS_VOLTAGE, Mark.BUS),
    (UNSIGNED, Mark.UNSIGNED),
)


class TransferFunctions:
    """Applies operators and library calls to abstract values.

    Args:
        names: the names of the program.
        measures: its constants.
    """

    def __init__(self, names: SymbolTable, measures: ConstantFolder) -> None:
        self._names = names
        self._measures = measures

    def apply_operator(self, node: Operation, left: Value | None, right: Value, at: Value) -> Value:
        """The value of ``left sign right``."""
        if left is None:
            return join_values([right.times(-1.0 if node.sign == "-" else 1.0)], at=at)
        both = replace(
            join_values([left, right], at=at), scale=self._scale_of(node, left, right, at.scope)
        )
        if both.carries is False:
            return both
        if left.carries is not False and right.carries is not False:
            return replace(both, factor=CHANGED)
        carrying, other = (left, node.right) if left.carries is not False else (right, node.left)
        constant = None if other is None else self._measures.fold(other, at.scope)
        factor = _factor(node.sign, constant, left_carries=carrying is left)
        if constant is None and (left.marks | right.marks) & {Mark.BUS}:
            factor = CHANGED
        return replace(both, factor=carrying.times(factor).factor)

    def _scale_of(self, node: Operation, left: Value, right: Value, scope: Scope) -> float | None:
        """What the reading in ``left sign right`` is multiplied with."""
        if left.readings and right.readings:
            if node.sign == "*" and left.scale is not None and right.scale is not None:
                return left.scale * right.scale
            return None
        if not left.readings and not right.readings:
            return 1.0
        reading, other = (left, node.right) if left.readings else (right, node.left)
        if node.sign in {"+", "-"}:  # an offset changes no unit
            flipped = node.sign == "-" and reading is right
            return reading.times(-1.0).scale if flipped else reading.scale
        constant = None if other is None else self._measures.fold(other, scope)
        factor = _factor(node.sign, constant, left_carries=reading is left)
        return None if factor is None or math.isnan(factor) else reading.times(factor).scale

    def apply_library_call(
        self, call: Call, receiver: Value | None, args: list[Value], at: Value
    ) -> Value:
        """The value of a call whose function is not in these files."""
        name = get_method_name(call)
        several = [*args] if receiver is None else [receiver, *args]
        made = join_values(several, at=at)
        made = replace(made, marks=made.marks | self._marks(name, receiver))
        reading = self._reading(name, receiver)
        if reading is not None:
            made = replace(made, readings=made.readings | {reading}, scale=1.0)
        elif made.readings:
            made = replace(made, scale=self._scale_of_call(call, name, made, at.scope))
        if name in CALCULATES:
            controller = receiver is not None and self._is_controller(receiver)
            return replace(made, closed=made.closed or controller, factor=CHANGED)
        kept = "" if name == "in" else made.unit
        made = replace(made, unit=self._unit(call, name, at.scope) or kept)
        if receiver is not None and (name in TIMES or name in OVER) and call.args:
            sign = "*" if name in TIMES else "/"
            constant = self._measures.fold(call.args[0], at.scope)
            factor = _factor(sign, constant, left_carries=receiver.carries is not False)
            if constant is None and Mark.BUS in made.marks:
                factor = CHANGED
            return replace(made, factor=receiver.times(factor).factor)
        if made.carries is False:
            return made
        return replace(made, factor=self._factor_of_call(call, name, made, at.scope))

    def _reading(self, name: str, receiver: Value | None) -> DeviceReading | None:
        """The number that a method of a device reports; None if it is no such method."""
        if receiver is None or receiver.readings:
            return None
        device, type_ = find_device(receiver.origin, receiver.scope, self._names)
        quantity = find_quantity(name, motor=is_motor(type_)) if device else ""
        if PULSES.fullmatch(type_) and name in COUNTS:
            type_ = PULSE_COUNT
        return DeviceReading(f"{receiver.me}{device}", type_, quantity) if quantity else None

    def _scale_of_call(self, call: Call, name: str, made: Value, scope: Scope) -> float | None:
        """The scale after a call that a reading goes into or is asked."""
        first = call.args[0] if call.args else None
        if name in OPPOSITE:
            return made.times(-1.0).scale
        if name in TIMES | OVER:
            constant = None if first is None else self._measures.fold(first, scope)
            factor = _factor("*" if name in TIMES else "/", constant, left_carries=True)
            return None if factor is None or math.isnan(factor) else made.times(factor).scale
        if name in FACTORS:
            return made.times(FACTORS[name]).scale
        if name == "in" and first is not None:
            return made.times(_turns(made.unit) / _turns(get_last_name(first))).scale
        kept = name in SAME | ARGUMENT | LIMITS | AMOUNTS | REPLACES or name.startswith("with")
        return made.scale if kept or name[:1].isupper() else None

    def _factor_of_call(self, call: Call, name: str, made: Value, scope: Scope) -> float | None:
        """The factor after a call that the parameter goes into or is asked."""
        if name in OPPOSITE:
            return made.times(-1.0).factor
        if name == "in":
            return made.times(self._size(call.args, scope, inverse=True)).factor
        if name in AMOUNTS and isinstance(call.target, Member):
            return made.times(self._size((call.target.owner,), scope)).factor
        if name in REPLACES:
            return made.times(self._size(call.args[1:2], scope)).factor
        if name in LIMITS:
            return made.times(self._limit(call.args, scope)).factor
        kept = name in SAME or name in ARGUMENT or name.startswith("with")
        return made.factor if kept or name[:1].isupper() else None  # upper: a constructor

    def _limit(self, args: tuple[Node, ...], scope: Scope) -> float:
        """What bounds do to the voltage: 1 where no test comes near any that is known."""
        bounds = (self._measures.fold(one, scope) for one in args)
        near = any(bound is not None and abs(bound.value) < NEVER_REACHED for bound in bounds)
        return CHANGED if near else 1.0

    def _size(
        self, units: tuple[Node, ...], scope: Scope, *, inverse: bool = False
    ) -> float | None:
        """How many volts a unit is; 1 where none is named."""
        if not units:
            return 1.0
        unit = self._measures.fold(units[0], scope)
        if unit is None or not unit.unit:
            return None
        if unit.volts != 1 or unit.seconds or unit.other:
            return CHANGED  # no unit of a voltage
        return 1.0 / unit.value if inverse else unit.value

    def _unit(self, call: Call, name: str, scope: Scope) -> str:
        """The unit a call wraps a number in, as written."""
        node: Node | None = None
        if name in AMOUNTS and isinstance(call.target, Member):
            node = call.target.owner
        elif name in REPLACES and len(call.args) > 1:
            node = call.args[1]
        if node is None:
            return ""
        measure = self._measures.fold(node, scope)
        if measure is None or not measure.unit:
            return ""
        return get_last_name(node) if get_last_name(node) in UNITS else node.place.text

    def _marks(self, name: str, receiver: Value | None) -> set[Mark]:
        found = {mark for methods, mark in _MARKED_BY if name in methods}
        motor = receiver is not None and is_motor(
            infer_type(receiver.origin, receiver.scope, self._names)
        )
        if motor and name == "getVoltage":
            found.add(Mark.APPLIED)
        if name in APPLIED_DUTY and (motor or name != "get"):
            found.add(Mark.DUTY)
        elif MEASURED.fullmatch(name):
            found.add(Mark.MEASURED)
        return found

    def _is_controller(self, receiver: Value) -> bool:
        type_ = get_simple_type_name(infer_type(receiver.origin, receiver.scope, self._names))
        return bool(CONTROLLERS.fullmatch(type_ or receiver.origin.place.text))


def _turns(unit: str) -> float:
    """How many rotations a unit of an angle is; 1 for any other unit."""
    name = unit.lower()
    if name == "rpm":
        return 1.0 / 60.0
    sizes = {"radian": 0.5 / math.pi, "degree": 1.0 / 360.0}
    return next((size for word, size in sizes.items() if word in name), 1.0)


def _factor(sign: str, constant: FoldedConstant | None, *, left_carries: bool) -> float | None:
    """What ``x sign constant`` multiplies x with."""
    if sign in {"+", "-"}:
        flip = -1.0 if sign == "-" and not left_carries else 1.0
        return flip if constant is not None and constant.value == 0.0 else CHANGED
    if sign == "*":
        return None if constant is None else constant.value
    if sign == "/" and left_carries:
        return None if constant is None or not constant.value else 1.0 / constant.value
    return CHANGED
