"""Constants worked out from their text: ``Volts.of(.5).per(Second)`` is 0.5 V/s.

Java's integers divide as Java does it (``1 / 4`` is 0), units multiply and divide, and what needs
the program to run has no value.
"""

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass, replace

from grader.robotcode.conversions import FACTORS, NUMBERS
from grader.robotcode.ir import Assign, Call, Cast, Member, Name, Node, Number, Operation
from grader.robotcode.name_resolution import (
    find_called_functions,
    find_single_return,
    get_last_name,
    get_simple_type_name,
)
from grader.robotcode.scope import Scope, find_only_value
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import PYTHON_UNITS, UNITS, spell_as_java

DEEPEST = 50  # expressions inside one another, names followed on the way
LARGEST_INT = 2**31 - 1  # Java's; beyond it an int wraps around, which nobody means

_DIMENSIONS = {(1, -1): "volts-per-second", (1, 0): "volts", (0, 1): "seconds", (0, 0): "number"}
_BOTH: dict[str, Callable[[float, float], float]] = {  # what an operator does in both languages
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
_JAVA = _BOTH | {"%": math.fmod}
_PYTHON = _BOTH | {"%": operator.mod, "//": operator.floordiv}
_DIVIDING = frozenset({"/", "//", "%"})
_REAL = frozenset({"double", "float", "Double", "Float"})
_WHOLE = frozenset({"int", "long", "short", "byte"})


@dataclass(frozen=True)
class FoldedConstant:
    """A number in SI with the powers of its units.

    Args:
        value: the number.
        volts, seconds: powers of volt and second.
        other: whether another unit is in it.
        integer: whether it is a Java integer.
        unit: whether it is a unit itself, ``Volts``, and not yet an amount of it.
    """

    value: float
    volts: int = 0
    seconds: int = 0
    other: bool = False
    integer: bool = False
    unit: bool = False

    @property
    def dimension(self) -> str:
        """As in ``facts.Quantity``."""
        known = _DIMENSIONS.get((self.volts, self.seconds), "other")
        return "other" if self.other else known

    def times(self, right: "FoldedConstant", power: int = 1) -> "FoldedConstant":
        """Multiply by a measure, or with power −1 divide by it."""
        return FoldedConstant(
            self.value * right.value**power,
            volts=self.volts + power * right.volts,
            seconds=self.seconds + power * right.seconds,
            other=self.other or right.other,
            unit=self.unit and right.unit,
        )


class ConstantFolder:
    """Computes constants from their source text, each once.

    Args:
        names: the names of the program.
    """

    def __init__(self, names: SymbolTable) -> None:
        self._names = names
        self._known: dict[Node, FoldedConstant | None] = {}

    def fold(self, node: Node, scope: Scope, *, depth: int = 0) -> FoldedConstant | None:
        """The value and dimension of an expression; None if it is no constant."""
        if node not in self._known:
            self._known[node] = None  # what depends on itself has no value
            if depth <= DEEPEST:
                found = self._worked_out(node, scope, depth + 1)
                if found is not None and math.isfinite(found.value):
                    self._known[node] = found
        return self._known[node]

    def _worked_out(self, node: Node, scope: Scope, depth: int) -> FoldedConstant | None:
        if isinstance(node, Number):
            return FoldedConstant(node.value, integer=node.integer)
        if isinstance(node, Name | Member):
            return self._named(node, scope, depth)
        if isinstance(node, Assign):  # Python's walrus
            return None if node.value is None else self.fold(node.value, scope, depth=depth)
        if isinstance(node, Cast):
            return _typed(self.fold(node.value, scope, depth=depth), node.type)
        if isinstance(node, Operation):
            return self._operation(node, scope, depth)
        return self._call(node, scope, depth) if isinstance(node, Call) else None

    def _operation(self, node: Operation, scope: Scope, depth: int) -> FoldedConstant | None:
        right = self.fold(node.right, scope, depth=depth)
        if node.left is None:
            return _signed(node.sign, right)
        left = self.fold(node.left, scope, depth=depth)
        if left is None or right is None or left.unit or right.unit:
            return None
        return _operated(node.sign, left, right, java=scope.module.language == "java")

    def _named(self, node: Name | Member, scope: Scope, depth: int) -> FoldedConstant | None:
        definitions = self._names.find_definitions(node, scope)
        only = find_only_value(definitions)
        if only is not None:
            found = self.fold(*only, depth=depth)
            declared = next((d.type for d in definitions if d.type), "")
            return _typed(found, declared)
        number = None if definitions else _library_number(node, scope)
        if number is not None:
            return FoldedConstant(number)
        unit = UNITS.get(node.name)
        if definitions or unit is None or scope.module.language != "java":
            return None
        if isinstance(node, Member) and get_last_name(node.owner) != "Units":
            return None
        return FoldedConstant(unit.si, unit.volts, unit.seconds, other=unit.other, unit=True)

    def _call(self, call: Call, scope: Scope, depth: int) -> FoldedConstant | None:
        functions = find_called_functions(call, scope, self._names)
        if functions:
            function, inside = functions[0]
            returned = find_single_return(function) if len(functions) == 1 else None
            found = None if returned is None else self.fold(returned, inside, depth=depth)
            return _typed(found, function.type)
        name, target = get_last_name(call.target), call.target
        args = [self.fold(arg, scope, depth=depth) for arg in call.args]
        first = args[0] if len(args) == 1 else None
        if first is not None and first.dimension == "number" and spell_as_java(name) in FACTORS:
            return FoldedConstant(first.value * FACTORS[spell_as_java(name)])
        if scope.module.language == "python":
            factor = PYTHON_UNITS.get(name)
            return None if first is None or factor is None else first.times(FoldedConstant(factor))
        if not isinstance(target, Member):
            return None
        if get_last_name(target.owner) in {"Double", "Integer", "Float"} and name == "valueOf":
            return first
        owner = self.fold(target.owner, scope, depth=depth)
        return None if owner is None else _method(name, owner, first, count=len(args))


def _library_number(node: Name | Member, scope: Scope) -> float | None:
    """π and its like, by their full name or brought in by an import."""
    if isinstance(node, Member):
        return NUMBERS.get((get_last_name(node.owner), node.name))
    for one in scope.module.imports:
        path = f"{one.path}.{node.name}" if one.name == "*" else one.path
        owner, _, name = path.rpartition(".")
        found = NUMBERS.get((owner.rpartition(".")[2], name))
        if one.name in {node.name, "*"} and found is not None:
            return found
    return None


def _method(
    name: str, owner: FoldedConstant, first: FoldedConstant | None, *, count: int
) -> FoldedConstant | None:
    """What a method of a unit or of a measure gives, with the one argument it got, if any."""
    if count == 0:
        return _without_argument(name, owner)
    if first is None:
        return None
    return _of_unit(name, owner, first) if owner.unit else _of_amount(name, owner, first)


def _of_unit(name: str, unit: FoldedConstant, first: FoldedConstant) -> FoldedConstant | None:
    if name == "per" and first.unit:
        return unit.times(first, -1)
    if name not in {"of", "ofBaseUnits", "mutable"} or first.dimension != "number":
        return None
    made = unit.times(replace(first, unit=False))
    return replace(made, value=first.value) if name == "ofBaseUnits" else made


def _of_amount(name: str, owner: FoldedConstant, first: FoldedConstant) -> FoldedConstant | None:
    same = owner.dimension == first.dimension
    if name in {"times", "mutTimes"}:
        return owner.times(first)
    if (name == "per" and first.unit) or (name in {"div", "divide", "mutDivide"} and first.value):
        return replace(owner.times(first, -1), unit=False)
    if name in {"plus", "minus"} and same and not first.unit:
        return replace(owner, value=owner.value + (1 if name == "plus" else -1) * first.value)
    return (
        FoldedConstant(owner.value / first.value) if name == "in" and same and first.unit else None
    )


def _without_argument(name: str, owner: FoldedConstant) -> FoldedConstant | None:
    if owner.unit:
        amount = {"one": 1.0, "zero": 0.0}.get(name)
        return None if amount is None else replace(owner, value=amount * owner.value, unit=False)
    if name in {"unaryMinus", "negate"}:
        return replace(owner, value=-owner.value)
    if name == "baseUnitMagnitude":
        return FoldedConstant(owner.value)
    return owner if name in {"copy", "mutableCopy"} else None


def _signed(sign: str, right: FoldedConstant | None) -> FoldedConstant | None:
    if right is None or right.unit or sign not in {"-", "+"}:
        return None
    return replace(right, value=-right.value) if sign == "-" else right


def _operated(
    sign: str, left: FoldedConstant, right: FoldedConstant, *, java: bool
) -> FoldedConstant | None:
    """Arithmetic on two numbers; measures have methods for theirs."""
    if {left.dimension, right.dimension} != {"number"}:
        return None
    whole = left.integer and right.integer and java
    operate = (_JAVA if java else _PYTHON).get(sign)
    if operate is None or (sign in _DIVIDING and right.value == 0.0):
        return None
    value = operate(left.value, right.value)
    if whole and sign == "/":
        value = float(math.trunc(value))
    return None if whole and abs(value) > LARGEST_INT else FoldedConstant(value, integer=whole)


def _typed(found: FoldedConstant | None, type_: str) -> FoldedConstant | None:
    """A number as a variable of some type keeps it."""
    if found is None or found.dimension != "number":
        return found
    if get_simple_type_name(type_) in _REAL:
        return replace(found, integer=False)
    if get_simple_type_name(type_) in _WHOLE:
        return replace(found, value=float(math.trunc(found.value)), integer=True)
    return found
