"""The log callback: which values it records, for which motor, in which unit, and from where."""

from collections.abc import Collection
from dataclasses import replace

from grader.robotcode.abstract_value import Mark, MotorLog, Value, join_values
from grader.robotcode.callback_interpreter import CallbackInterpreter
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.facts import LoggedSignal, Source
from grader.robotcode.ir import Call, Function, FunctionParameter, Member, Name
from grader.robotcode.name_resolution import fold_text, get_method_name
from grader.robotcode.readings import DeviceReading, DeviceSettings, find_native_unit
from grader.robotcode.scope import Scope, walk_with_scopes
from grader.robotcode.statement_interpreter import Frame
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import SIGNALS, UNITS

LINEAR = "linear"


class LogTrace(CallbackInterpreter):
    """Interprets the log callback and records every value that it logs.

    Args:
        names: the names of the program.
        measures: its constants.
        commanded: the fields that the drive callback put its voltage into.
        settings: what the program sets its devices to.
    """

    def __init__(
        self,
        names: SymbolTable,
        measures: ConstantFolder,
        *,
        commanded: Collection[str],
        settings: DeviceSettings,
    ) -> None:
        super().__init__(names, measures)
        self._settings = settings
        self.signals: list[LoggedSignal] = []
        self._commanded = commanded
        self._open: set[str] = set()  # fields being looked into
        self._changes: dict[Scope, dict[str, list[tuple[Call, Scope]]]] = {}

    def entry_count(self) -> int:
        """How many values have been recorded."""
        return len(self.signals)

    def note_call(
        self,
        call: Call,
        receiver: Value | None,
        args: list[Value],
        at: Value,  # noqa: ARG002 - the log is what the call is made on, or nothing
    ) -> Value | None:
        """Record a value that is logged."""
        name = get_method_name(call)
        if receiver is None or receiver.log is None:
            if any(arg.log is not None for arg in args):
                self.note_unreadable(call)
            return None
        if name == "motor":
            said = fold_text(args[0].origin, args[0].scope, self.names) if args else ""
            return replace(receiver, log=MotorLog(said))
        if receiver.log.name is not None and name in SIGNALS and args:
            self._note(call, name, receiver.log.name, args)
        return receiver

    def evaluate_unassigned_variable(self, node: Name | Member, frame: Frame) -> Value:
        """The value of a field: whatever it is given anywhere in the class."""
        key = self.make_storage_key(node, frame)
        at = frame.make_unknown_value(node)
        if key in self._commanded:
            return replace(at, marks=frozenset({Mark.COMMANDED}))
        if key in self._open:
            return at
        self._open.add(key)
        several = [
            self.evaluate(d.value, Frame(d.scope, frame.me, around=frame.around))
            for d in self.names.find_definitions(node, frame.scope)
            if d.value is not None and not isinstance(d.value, Function | FunctionParameter)
        ]
        for call, scope in self._changes_of(key.removeprefix(frame.me), frame.scope.home):
            inner = Frame(scope, frame.me, around=frame.around)
            several += [self.evaluate(arg, inner) for arg in call.args]
        self._open.discard(key)
        return replace(join_values(several, at=at), log=None)

    def _changes_of(self, name: str, home: Scope) -> list[tuple[Call, Scope]]:
        """The calls that give a mutable measure a new value: ``m_applied.mut_replace(…)``."""
        if not home.classes:
            return []
        if home not in self._changes:
            found: dict[str, list[tuple[Call, Scope]]] = {}
            for node, scope in walk_with_scopes(home.classes[-1].body, home):
                if isinstance(node, Call) and isinstance(node.target, Member):
                    field = self.names.find_field_name(node.target.owner, scope)
                    if field and node.target.name.startswith("mut"):
                        found.setdefault(field, []).append((node, scope))
            self._changes[home] = found
        return self._changes[home].get(name, [])

    def _note(self, call: Call, name: str, motor: str, args: list[Value]) -> None:
        signal, family = SIGNALS[name]
        value = args[-1] if signal != "other" else join_values(args, at=args[0])
        if not family and signal in {"position", "velocity", "acceleration"}:
            python = value.scope.module.language == "python"
            unit = UNITS.get(value.unit)
            family = LINEAR if python else unit.family if unit else ""
        told = [one for one in value.readings if one.quantity != "bus"] or [*value.readings]
        reading = told[0] if len(told) == 1 else DeviceReading("", "", "")
        native, factor = find_native_unit(reading, self._settings)
        scale = None if factor is None else value.times(factor).scale
        self.signals.append(
            LoggedSignal(
                motor=motor,
                signal=signal,
                family=family,
                unit=value.unit,
                source=_source(signal, value.marks),
                text=call.target.place.text,
                line=self.find_line_of(call.target),
                device=reading.device,
                type=reading.type,
                quantity=reading.quantity,
                native=native,
                scale=scale if native else value.scale if told else None,
                unsigned=Mark.UNSIGNED in value.marks,
                condition=self.condition,
            )
        )


def _source(signal: str, marks: frozenset[Mark]) -> Source:
    applied = Mark.APPLIED in marks or {Mark.DUTY, Mark.BUS} <= marks
    measured = Mark.MEASURED in marks if signal != "voltage" else applied
    if Mark.COMMANDED in marks:
        return Source.UNKNOWN if measured else Source.COMMANDED
    return Source.APPLIED if measured else Source.UNKNOWN
