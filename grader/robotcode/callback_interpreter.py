"""Follows a callback through the code, into methods and lambdas, without running anything.

Every expression becomes a Value. What a call means to the matter at hand (a command to a motor, an
entry in a log) is for a subclass to say.
"""

from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import MappingProxyType

from grader.robotcode.abstract_value import Value, join_values
from grader.robotcode.facts import ParseProblem
from grader.robotcode.ir import Call, Function, Member, Node, Reference, Self
from grader.robotcode.motors import make_motor_label
from grader.robotcode.name_resolution import (
    Method,
    find_called_functions,
    find_class,
    find_implementing_methods,
    get_last_name,
    get_method_name,
    infer_type,
    resolve,
)
from grader.robotcode.scope import Scope
from grader.robotcode.statement_interpreter import Frame, StatementInterpreter
from grader.robotcode.vocabulary import LOOPS, RUNS, is_motor, spell_as_java

MOST_CALLS = 4  # methods followed, one inside the other
MOST_SPREAD = 8  # arguments that a list may be spread into


class CallbackInterpreter(StatementInterpreter):
    """Interprets one callback.

    Args:
        names: the names of the program.
        measures: its constants.
    """

    @abstractmethod
    def note_call(
        self, call: Call, receiver: Value | None, args: list[Value], at: Value
    ) -> Value | None:
        """Record a call of library code if this trace looks for it; its value, None if unknown.

        Returns:
            What the call gives; None if it is nothing to this trace.
        """

    @abstractmethod
    def entry_count(self) -> int:
        """How many calls have been noted so far."""

    def run(self, callback: Node, scope: Scope, parameter: Value) -> bool:
        """Interpret a callback.

        Args:
            callback: a lambda, a method reference, or a variable that holds one.
            scope: where it stands.
            parameter: what it is called with.

        Returns:
            Whether it could be found.
        """
        node, where = resolve(callback, scope, self.names)
        if not isinstance(node, Function | Member):
            self.note_unreadable(callback)
            return False
        frame = Frame(where)
        callee = frame.make_unknown_value(node)
        if isinstance(callback, Call):  # a function that makes one, with what it was given
            made = self.evaluate(callback, Frame(scope))
            callee = made if isinstance(made.origin, Function | Member) else callee
        self._invoked(callee, [parameter], frame)
        return True

    def interpret_method(self, method: Method) -> None:
        """Interpret another method of the class, once the callback is interpreted."""
        self.follow_call(method, [], {}, Frame(method[1].home), me="")

    def note_unreadable(self, node: Node) -> None:
        """Note that a call leads out of these files."""
        said = f"`{node.place.text}` calls code that is not in this file or in the files next to it"
        self.unread.setdefault(said, ParseProblem(said, self.find_line_of(node)))

    def evaluate_call(self, node: Call, frame: Frame) -> Value:
        """The value of a call, its arguments first."""
        receiver = None if node.owner is None else self.evaluate(node.owner, frame)
        args = [self.evaluate(arg, frame) for arg in node.args]
        if node.spread:  # any of the arguments that are left may be in it
            args += [
                replace(frame.make_unknown_value(node), carries=None, factor=None)
            ] * MOST_SPREAD
        named = {word: self.evaluate(value, frame) for word, value in node.named}
        return self._applied(node, receiver, args, named, frame)

    def _applied(
        self,
        call: Call,
        receiver: Value | None,
        args: list[Value],
        named: dict[str, Value],
        frame: Frame,
    ) -> Value:
        """A call, when what it is called on and with is known."""
        ran = self._runs_lambda(call, receiver, args, frame)
        if ran is not None:
            return ran
        owner = None if receiver is None else (receiver.origin, receiver.scope)
        methods = find_called_functions(call, frame.scope, self.names, owner=owner)
        fresh = next((method for method in methods if method[0] not in frame.around), None)
        said: Value | None = None
        if fresh is not None:
            before = self.entry_count()
            value = self.follow_call(fresh, args, named, frame, me=self._object(receiver, frame))
            if fresh[0].body or self.entry_count() > before:
                return value
            said = self._implemented(fresh, call, (receiver, args, named), frame)
        every = [*args, *named.values()]
        if said is None and (fresh is not None or not methods):
            said = self.note_call(call, receiver, every, frame.make_unknown_value(call))
        if said is not None:
            return said
        self._keep(call, receiver, every, frame)
        return self.flow.apply_library_call(call, receiver, every, frame.make_unknown_value(call))

    def _runs_lambda(
        self, call: Call, receiver: Value | None, args: list[Value], frame: Frame
    ) -> Value | None:
        """A call that runs a lambda: by its name, by its interface, or once for each element."""
        if receiver is None:
            held = frame.locals.get(get_last_name(call.target))
            python = frame.scope.module.language == "python"
            return self._invoked(held, args, frame) if held is not None and python else None
        if get_method_name(call) in RUNS and self._holds_lambda(receiver):
            return self._invoked(receiver, args, frame)
        if get_method_name(call) in LOOPS and args:
            several = self.list_loop_elements(receiver, frame)
            return [self._invoked(args[0], [element], frame) for element in several][-1]
        return None

    def _implemented(
        self,
        method: Method,
        call: Call,
        given: tuple[Value | None, list[Value], dict[str, Value]],
        frame: Frame,
    ) -> Value | None:
        """A call of a method without a body: what the class does that implements it.

        Returns:
            None where no class of these files does, or where several do something else.
        """
        receiver, args, named = given
        me = self._object(receiver, frame)
        found = [
            one
            for one in find_implementing_methods(method, self.names)
            if one[0] not in frame.around
        ]
        if len(found) == 1:
            return self.follow_call(found[0], args, named, frame, me=me)
        ways = [partial(self.follow_call, one, args, named, frame, me=me) for one in found]
        return (
            self.note_ambiguous_call(call, receiver, ways, frame.make_unknown_value(call))
            if ways
            else None
        )

    def note_ambiguous_call(
        self,
        call: Call,  # noqa: ARG002 - for a subclass that can compare
        receiver: Value | None,  # noqa: ARG002 - the same
        ways: Sequence[Callable[[], Value]],  # noqa: ARG002 - the same
        at: Value,  # noqa: ARG002 - the same
    ) -> Value | None:
        """Record a call that several classes may run, if all do the same; its value, else None."""
        return None

    def _invoked(self, callee: Value, args: list[Value], frame: Frame) -> Value:
        """A call of a lambda or of a method reference."""
        node, scope = resolve(callee.origin, callee.scope, self.names)
        if isinstance(node, Function):
            method = (node, scope.within(node))
            captured = callee.captured
            return self.follow_call(method, args, {}, frame, me=callee.me, captured=captured)
        if not isinstance(node, Member):
            return join_values(args, at=callee).times(None)
        inner = Frame(scope, callee.me, dict(callee.captured), around=frame.around)
        written_out = Call(node.place, node, tuple(arg.origin for arg in args))
        return self._applied(written_out, self.evaluate(node.owner, inner), args, {}, inner)

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
        """Interpret a call of a function of these files; its value."""
        function, scope = method
        if len(frame.around) > MOST_CALLS:
            return self.stop_too_deep(function, frame)
        inner = Frame(scope, me, around=(*frame.around, function))
        inner.locals |= captured
        outer = Frame(replace(scope, functions=scope.functions[:-1]), me, around=inner.around)
        inner.locals |= {
            one.name: self.evaluate(one.default, outer)
            if one.default
            else inner.make_unknown_value(one)
            for one in function.parameters
        }
        inner.locals |= {one.name: arg for one, arg in zip(function.parameters, args, strict=False)}
        inner.locals |= named
        condition = self.condition
        for statement in function.body:
            self.evaluate(statement, inner)
        self.condition = condition
        if len(inner.returned) == 1:
            return inner.returned[0]
        return join_values(inner.returned, at=inner.make_unknown_value(function))

    def _object(self, receiver: Value | None, frame: Frame) -> str:
        """The object whose code a method is, to be put before the names of its fields."""
        if receiver is None:
            return frame.me
        if isinstance(receiver.origin, Self) or get_last_name(receiver.origin) == "super":
            return receiver.me
        if self.names.find_home(receiver.origin, receiver.scope) is not None:
            return ""
        return f"{receiver.me}{make_motor_label(receiver.origin)}."

    def _holds_lambda(self, value: Value) -> bool:
        node, _ = resolve(value.origin, value.scope, self.names)
        return isinstance(node, Function | Reference)

    def _keep(self, call: Call, receiver: Value | None, args: list[Value], frame: Frame) -> None:
        """Remember what an object was given: ``m_applied.mut_replace(volts, Volts)``."""
        if receiver is None or not isinstance(call.target, Member):
            return
        type_ = infer_type(receiver.origin, receiver.scope, self.names)
        foreign = bool(type_) and not is_motor(type_)
        if foreign and find_class(receiver.origin, receiver.scope, self.names) is not None:
            foreign = False
        if foreign or spell_as_java(call.target.name).startswith(("mut", "with")):
            self.store_value(
                call.target.owner, join_values(args, at=frame.make_unknown_value(call)), frame
            )
