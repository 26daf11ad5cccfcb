"""The drive callback: which motors it commands, how, and whether the voltage gets there."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from grader.robotcode.abstract_value import Value, join_values
from grader.robotcode.callback_interpreter import CallbackInterpreter
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.facts import DriveCall, Output
from grader.robotcode.ir import Call, Element, Member, Name, Node, Self
from grader.robotcode.motors import list_motor_names
from grader.robotcode.name_resolution import (
    find_class,
    get_last_name,
    get_method_name,
    get_simple_type_name,
    infer_type,
)
from grader.robotcode.scope import Scope
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import (
    BY_MODE,
    BY_REQUEST,
    COMMANDS,
    DRIVES,
    GROUPS,
    MODES,
    SILENT,
    STOPS,
    WITHOUT_MODE,
    find_request_output,
    is_motor,
    normalize_enum_constant,
)


class DriveTrace(CallbackInterpreter):
    """Interprets the drive callback and records every command to a motor.

    Args:
        names: the names of the program.
        measures: its constants.
        only_sure: whether commands are left out that may not be reached.
    """

    def __init__(
        self, names: SymbolTable, measures: ConstantFolder, *, only_sure: bool = False
    ) -> None:
        super().__init__(names, measures)
        self._only_sure = only_sure
        self.calls: list[DriveCall] = []

    def entry_count(self) -> int:
        """How many commands have been recorded."""
        return len(self.calls)

    def note_ambiguous_call(
        self, call: Call, receiver: Value | None, ways: Sequence[Callable[[], Value]], at: Value
    ) -> Value | None:
        """Record one command if all classes that a call may run in command their motors alike."""
        before = [*self.calls], dict(self.stored), dict(self.unread)
        outcomes = []
        for way in ways:
            way()
            outcomes.append({_kind(one): one for one in self.calls[len(before[0]) :]})
            self.calls, self.stored, self.unread = [*before[0]], dict(before[1]), dict(before[2])
        first = outcomes[0]
        if len(first) != 1 or any(one.keys() != first.keys() for one in outcomes):
            return None
        command = replace(
            next(iter(first.values())),
            method=get_last_name(call.target),
            text=call.place.text,
            line=self.find_line_of(call),
        )
        self.calls += [replace(command, motor=motor) for motor in self._motors(receiver, at)]
        return at

    def note_call(
        self, call: Call, receiver: Value | None, args: list[Value], at: Value
    ) -> Value | None:
        """Record a command to a motor, or a call that may be one."""
        method = get_method_name(call)
        of_motor = receiver is not None and self._is_motor(receiver)
        if not of_motor and any(map(self._is_motor, args)):
            self.note_unreadable(call)  # a motor is handed out: what it gets is not told here
            return None
        if method[:1].isupper():  # makes an object, a request perhaps
            return None
        if self._may_be_motor(method, receiver, at):
            return self._command(call, receiver, args, at, of_motor=of_motor)
        if receiver is not None and self._may_lead_to_one(method, receiver, args):
            self.note_unreadable(call)
        return None

    def _command(
        self, call: Call, receiver: Value | None, args: list[Value], at: Value, *, of_motor: bool
    ) -> Value | None:
        """Note a command to what is, or may be, a motor; None if it is no command."""
        method = get_method_name(call)
        values = [arg for arg in args if _mode(arg) is None]
        sent = join_values(values[:1] if method in BY_MODE else values, at=at)
        if method in STOPS and of_motor:
            if self.sure:  # under a condition it is a limit that ends the test early
                self._note(call, receiver, Output.VOLTAGE, sent)
            return at
        named = method in COMMANDS or method in BY_MODE or method in BY_REQUEST
        if not named and (sent.carries is False or SILENT.fullmatch(method)):
            return None
        output = self._output(method, args)
        if output is not None and (self.sure or not self._only_sure):
            self._note(call, receiver, output, sent)
        return at

    def _output(self, method: str, args: list[Value]) -> Output | None:
        """What kind of command a method is; None if it moves nothing."""
        if method in BY_MODE:
            mode = next(filter(None, map(_mode, args)), None)
            return WITHOUT_MODE[method] if mode is None else mode
        if method in BY_REQUEST and args:
            type_ = get_simple_type_name(infer_type(args[0].origin, args[0].scope, self.names))
            return find_request_output(type_)
        return COMMANDS.get(method, Output.UNKNOWN)

    def _note(self, call: Call, receiver: Value | None, output: Output, sent: Value) -> None:
        if sent.closed:
            output = Output.CLOSED_LOOP
        for motor in self._motors(receiver, sent):
            self.calls.append(
                DriveCall(
                    motor=motor,
                    method=get_last_name(call.target),
                    output=output,
                    uses_parameter=sent.carries,
                    scaled=sent.is_scaled,
                    text=call.place.text,
                    line=self.find_line_of(call),
                    negative=sent.factor is not None and sent.factor < 0,
                    condition=self.condition,
                )
            )

    def _motors(self, receiver: Value | None, sent: Value) -> tuple[str, ...]:
        if receiver is None or isinstance(receiver.origin, Self):
            me = sent.me if receiver is None else receiver.me
            java = sent.scope.module.language == "java"
            return (me.removesuffix(".") or ("this" if java else "self"),)
        found = list_motor_names(receiver.origin, receiver.scope, self.names)
        return tuple(f"{receiver.me}{name}" for name in found)

    def _may_be_motor(self, method: str, receiver: Value | None, at: Value) -> bool:
        """Whether what a method is called on can be a motor, or stand for some."""
        named = method in COMMANDS or method in BY_REQUEST
        if receiver is None:  # a method of a class above, which these files do not hold
            above = bool(at.scope.classes and at.scope.classes[-1].bases)
            method_here = at.scope.module.language == "java" and not method[:1].isupper()
            return method_here and (named or above)
        origin = receiver.origin
        if isinstance(origin, Self):
            return True
        if receiver.carries is not False or not self._is_variable(origin, receiver.scope):
            return False
        type_ = infer_type(origin, receiver.scope, self.names)
        known = is_motor(type_) or get_simple_type_name(type_) in GROUPS | DRIVES
        if known or not type_ or find_class(origin, receiver.scope, self.names) is not None:
            return True
        return named or method in BY_MODE - {"set"}  # much can be set that is no motor

    def _may_lead_to_one(self, method: str, receiver: Value, args: list[Value]) -> bool:
        """Whether an object of a class that is not here may send the voltage on to a motor."""
        given = any(arg.carries for arg in args) and receiver.carries is False
        variable = self._is_variable(receiver.origin, receiver.scope)
        return given and variable and not SILENT.fullmatch(method)

    def _is_motor(self, value: Value) -> bool:
        return is_motor(infer_type(value.origin, value.scope, self.names))

    def _is_variable(self, node: Node, scope: Scope) -> bool:
        """Whether a node can hold an object: no class, no module, no number."""
        while isinstance(node, Element):
            node = node.owner
        brought = {one.name for one in scope.module.imports}
        if isinstance(node, Member) and self.names.find_home(node.owner, scope) is None:
            root = node.owner
            while isinstance(root, Member):
                root = root.owner
            if isinstance(root, Name) and root.name in brought:  # phoenix6.controls
                return bool(self.names.find_local(root.name, scope))
        if isinstance(node, Name) and node.name in brought:
            return bool(self.names.find_local(node.name, scope))
        named = get_last_name(node).lstrip("_")  # in any script: most have no capitals
        return isinstance(node, Call) or (bool(named) and not named[:1].isupper())


def _kind(call: DriveCall) -> tuple[Output, bool | None, bool | None, bool, str]:
    """What a command does, whatever its motor is called."""
    return call.output, call.uses_parameter, call.scaled, call.negative, call.condition


def _mode(value: Value) -> Output | None:
    """The control mode that an argument names, if it is one."""
    return (
        MODES.get(normalize_enum_constant(get_last_name(value.origin)))
        if isinstance(value.origin, Member)
        else None
    )
