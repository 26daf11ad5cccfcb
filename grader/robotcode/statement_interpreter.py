"""Interpret statements and expressions on abstract values; subclasses interpret calls."""

import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import ClassVar

from grader.robotcode.abstract_value import CHANGED, Value, join_values
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.facts import ParseProblem
from grader.robotcode.ir import (
    Assign,
    Branch,
    Call,
    Cast,
    Choice,
    Element,
    Function,
    Items,
    Loop,
    Member,
    Name,
    Node,
    Operation,
    Reference,
    Return,
    Self,
)
from grader.robotcode.motors import list_group_members, make_motor_label
from grader.robotcode.name_resolution import Method, find_given_setting, get_last_name
from grader.robotcode.scope import Scope
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.transfer_functions import TransferFunctions

MOST_STEPS = 20_000  # expressions looked at in all; a whole subsystem has some hundred
DEEPEST = 60  # expressions and statements inside one another
DECIDES = re.compile(r"(if|elif|while)\b")  # how a statement begins whose first part is a condition
CONSTANT = re.compile(r"\(?\s*(true|false|0|1)\s*\)?", re.IGNORECASE)
ARROW = re.compile(r"switch\b[^{]*\{\s*(case\b[^:>]*|default\s*)->")
LEAVES = re.compile(r"\b(return|break|continue|throw|raise)\b")


@dataclass
class Frame:
    """The frame of a function that is being interpreted.

    Args:
        scope: the scope inside it.
        me: the object whose code it is; see Value.
        locals: its variables.
        around: the functions being followed, outermost first.
        branches: how many branches deep the statement at hand is.
        returned: the values it hands back.
    """

    scope: Scope
    me: str = ""
    locals: dict[str, Value] = field(default_factory=dict)
    around: tuple[Function, ...] = ()
    branches: int = 0
    returned: list[Value] = field(default_factory=list)

    def make_unknown_value(self, node: Node) -> Value:
        """An unknown value, with its place in the code."""
        return Value(node, self.scope, me=self.me)


class StatementInterpreter(ABC):
    """Evaluates code piece by piece, keeping what fields and variables were given.

    Args:
        names: the names of the program.
        measures: its constants.
    """

    def __init__(self, names: SymbolTable, measures: ConstantFolder) -> None:
        self.names = names
        self.stored: dict[str, Value] = {}  # fields, by what they were given on the way
        self.unread: dict[str, ParseProblem] = {}
        self.condition = ""  # what decides, by the parameter or by nothing, if the code is reached
        self.sure = True  # whether the code at hand is reached each time
        self.flow = TransferFunctions(names, measures)
        self._steps = 0
        self._depth = 0

    @abstractmethod
    def evaluate_call(self, node: Call, frame: Frame) -> Value:
        """The value of a call."""

    @abstractmethod
    def follow_call(
        self,
        method: Method,
        args: list[Value],
        named: dict[str, Value],
        frame: Frame,
        *,
        me: str,
        captured: Mapping[str, Value] = MappingProxyType({}),
    ) -> Value:
        """The value of a call of a function in these files."""

    def evaluate_unassigned_variable(self, node: Name | Member, frame: Frame) -> Value:
        """The value of a variable that no statement has assigned so far."""
        return frame.make_unknown_value(node)

    def find_line_of(self, node: Node) -> int:
        """The line of a node in the file in hand; 0 if it stands in another."""
        return node.place.line if node.place.source is self.names.main.source else 0

    def evaluate(self, node: Node, frame: Frame) -> Value:
        """Evaluate one expression or statement."""
        self._steps += 1
        if self._depth >= DEEPEST or self._steps > MOST_STEPS:
            return self.stop_too_deep(node, frame)
        self._depth += 1
        try:
            if isinstance(node, Call):
                return self.evaluate_call(node, frame)
            return self._KINDS.get(type(node), StatementInterpreter._parts)(self, node, frame)
        finally:
            self._depth -= 1

    def make_storage_key(self, node: Node, frame: Frame) -> str:
        """The key of a field's stored value; for a part of an object, the object's key."""
        while not isinstance(node, Name) and not _of_self(node):
            if not isinstance(node, Element | Member):
                break
            node = node.owner
        return frame.me + make_motor_label(node)

    def stop_too_deep(self, node: Node, frame: Frame) -> Value:
        """Give up on code that nests too deeply, and note it."""
        said = "the code is nested too deeply here for the grader"
        self.unread.setdefault(said, ParseProblem(said, self.find_line_of(node)))
        return replace(frame.make_unknown_value(node), carries=None)

    def _name(self, node: Name | Member, frame: Frame) -> Value:
        if isinstance(node, Name) and node.name in frame.locals:
            return frame.locals[node.name]
        if isinstance(node, Member) and self._is_part(node, frame):
            return join_values(
                [self.evaluate(node.owner, frame)], at=frame.make_unknown_value(node)
            )
        stored = self.stored.get(self.make_storage_key(node, frame))
        if stored is not None:
            return join_values([stored], at=frame.make_unknown_value(node))
        definitions = self.names.find_definitions(node, frame.scope)
        value = definitions[0].value if len(definitions) == 1 else None
        if isinstance(value, Function) and value.property:
            method = (value, definitions[0].scope.within(value))
            return self.follow_call(method, [], {}, frame, me=frame.me)
        local = isinstance(node, Name) and self.names.find_local(node.name, frame.scope)
        if local and isinstance(value, Name | Member | Function):
            outer = Frame(definitions[0].scope, frame.me, around=frame.around)
            return self.evaluate(value, outer)
        return self.evaluate_unassigned_variable(node, frame)

    def _is_part(self, node: Member, frame: Frame) -> bool:
        """Whether a member belongs to some object: not to this one, nor to a class or a file."""
        if isinstance(node, Reference) or _of_self(node):
            return False
        return self.names.find_home(node.owner, frame.scope) is None

    def _self(self, node: Self, frame: Frame) -> Value:
        return frame.make_unknown_value(node)

    def _operation(self, node: Operation, frame: Frame) -> Value:
        left = None if node.left is None else self.evaluate(node.left, frame)
        right = self.evaluate(node.right, frame)
        return self.flow.apply_operator(node, left, right, frame.make_unknown_value(node))

    def _choice(self, node: Choice, frame: Frame) -> Value:
        self.evaluate(node.condition, frame)
        several = [self.evaluate(node.one, frame), self.evaluate(node.other, frame)]
        made = join_values(several, at=frame.make_unknown_value(node))
        alike = {one.carries for one in several} != {True, False}
        return made if alike else replace(made, factor=CHANGED)

    def _cast(self, node: Cast, frame: Frame) -> Value:
        value = self.evaluate(node.value, frame)
        return value if node.type not in {"int", "long"} else value.times(None)

    def _element(self, node: Element, frame: Frame) -> Value:
        self.evaluate(node.index, frame)
        return join_values([self.evaluate(node.owner, frame)], at=frame.make_unknown_value(node))

    def _function(self, node: Function, frame: Frame) -> Value:
        value = replace(frame.make_unknown_value(node), captured=dict(frame.locals))
        if node.name:
            frame.locals[node.name] = value
        return value

    def _assign(self, node: Assign, frame: Frame) -> Value:
        value = (
            frame.make_unknown_value(node)
            if node.value is None
            else self.evaluate(node.value, frame)
        )
        target = node.target
        if isinstance(target, Name) and not self.names.find_field_name(target, frame.scope):
            before = frame.locals.get(target.name)
            branched = frame.branches > 0 and before is not None
            frame.locals[target.name] = (
                join_values([before, value], at=value) if branched and before else value
            )
        elif node.value is not None:
            self.store_value(target, value, frame)
        return value

    def _return(self, node: Return, frame: Frame) -> Value:
        frame.returned.append(self.evaluate(node.value, frame))
        return frame.returned[-1]

    def _branch(self, node: Branch, frame: Frame) -> Value:
        before, sure = self.condition, self.sure
        frame.branches += 1
        self.sure = False
        results = []
        for number, (part, is_result) in enumerate(self._branch_parts(node, frame)):
            value = self.evaluate(part, frame)
            results += [value] if is_result else []
            text = part.place.text
            decides = number == 0 and DECIDES.match(node.place.text)
            if decides and (value.carries is not False or CONSTANT.fullmatch(text)):
                self.condition = self.condition or f"{decides[0]} {text}"
        frame.branches -= 1
        self.sure = sure
        if not LEAVES.search(node.place.text):
            self.condition = before
        only = results[0] if len(results) == 1 else frame.make_unknown_value(node)
        return join_values(results, at=only)

    def _branch_parts(self, node: Branch, frame: Frame) -> list[tuple[Node, bool]]:
        """The parts of a branch, and whether a part is what a ``case … ->`` of a switch comes to.

        Of a switch over a setting that the program gives once, only the case of its value counts.
        """
        if not ARROW.match(node.place.text):
            return [(part, False) for part in node.parts]
        decides, *blocks = node.parts
        cases = [case.parts for block in blocks for case in block.parts if case.parts]
        given = find_given_setting(decides, frame.scope, self.names)
        meant = [case for case in cases if given in map(get_last_name, case[:-1])]
        several = meant if given and len(meant) == 1 else cases
        return [(decides, False), *((part, part is case[-1]) for case in several for part in case)]

    def _loop(self, node: Loop, frame: Frame) -> Value:
        result = []
        collection = self.evaluate(node.collection, frame)
        for element in self.list_loop_elements(collection, frame):
            parts = [element] * len(node.variables)
            if len(parts) > 1 and isinstance(element.origin, Items):
                inner = frame if element.scope == frame.scope else Frame(element.scope, element.me)
                parts = [self.evaluate(item, inner) for item in element.origin.items]
            frame.locals |= dict(zip(node.variables, parts, strict=False))
            result += [self.evaluate(statement, frame) for statement in node.body]
        return join_values(result, at=frame.make_unknown_value(node))

    def _parts(self, node: Node, frame: Frame) -> Value:
        several = [self.evaluate(part, frame) for part in node.parts]
        return join_values(several, at=frame.make_unknown_value(node)).times(None)

    def list_loop_elements(self, collection: Value, frame: Frame) -> list[Value]:
        """The elements that a loop runs over; the whole collection if they have no names."""
        found = list_group_members(collection.origin, collection.scope, self.names)
        inner = Frame(collection.scope, collection.me, around=frame.around)
        values = [
            self.evaluate(n, frame if s == frame.scope else replace(inner, scope=s))
            for n, s in found
        ]
        return values or [collection]

    def store_value(self, target: Node, value: Value, frame: Frame) -> None:
        """Store the value that a field, or an object in a variable, was given."""
        if isinstance(target, Name) and target.name in frame.locals:
            before = frame.locals[target.name]
            frame.locals[target.name] = join_values([before, value], at=before)
            return
        key = self.make_storage_key(target, frame)
        if value.is_informative or key in self.stored:
            several = [self.stored[key], value] if key in self.stored else [value]
            self.stored[key] = join_values(several, at=value)

    _KINDS: ClassVar[dict[type[Node], Callable[..., Value]]] = {
        Name: _name,
        Member: _name,
        Reference: _name,
        Self: _self,
        Operation: _operation,
        Choice: _choice,
        Cast: _cast,
        Element: _element,
        Function: _function,
        Assign: _assign,
        Return: _return,
        Branch: _branch,
        Loop: _loop,
    }


def _of_self(node: Node) -> bool:
    return isinstance(node, Member) and isinstance(node.owner, Self)
