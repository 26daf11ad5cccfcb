"""Gains in robot code: constants, their comments, and the feedforward they are handed to."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from grader.robotcode.closure import BoundNode, find_definitions, resolve_bound
from grader.robotcode.comments import Comment, find_comments_near, list_comments
from grader.robotcode.compiling import find_compile_errors
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.controller_gains import RATIO, GainSetting, find_gain_settings
from grader.robotcode.facts import ParseProblem
from grader.robotcode.files import Files
from grader.robotcode.ir import Assign, Call, Cast, Member, Module, Name, Node, Self, iter_nodes
from grader.robotcode.name_resolution import (
    MOST_STEPS,
    Placed,
    find_constructed_class,
    get_last_name,
)
from grader.robotcode.scope import Scope, find_only_value, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import spell_as_java

HOLDER = re.compile(r"characteri[sz]ation", re.IGNORECASE)
# kS, K_S, ks, kSVolts, kvVoltSecondsPerMeter; not kStatic, kAngle.
GAIN = re.compile(r"[kK]_?([svagpSVAGP])(?=$|_|[A-Z0-9])(.*)")
FEEDFORWARD = re.compile(r"(SimpleMotor|Elevator|Arm)Feedforward\w*")
ARGUMENTS = {
    "SimpleMotorFeedforward": ("kS", "kV", "kA"),
    "ElevatorFeedforward": ("kS", "kG", "kV", "kA"),
    "ArmFeedforward": ("kS", "kG", "kV", "kA"),
}


@dataclass(frozen=True)
class GainConstant:
    """A gain in the code.

    Args:
        gain: ``kS``, ``kV``, ``kA``, ``kG`` or ``kP``.
        name: as written.
        holder: the class it is in; empty at the top of a file.
        value: the number; None if unknown.
        text: what it is given, as written.
        comment: the comments beside it and directly above it.
        line: its line, from 1.
    """

    gain: str
    name: str
    holder: str
    value: float | None
    text: str
    comment: str
    line: int


@dataclass(frozen=True)
class Argument:
    """What a feedforward, or a feedback loop, is given in one place.

    Args:
        gain: whose constant it is made of; empty if of none, or of several.
        value: the number; None if unknown.
        text: as written.
    """

    gain: str
    value: float | None
    text: str


@dataclass(frozen=True)
class Feedforward:
    """A feedforward that is made, or configured in a motor controller.

    Args:
        kind: its class, without what Python adds: ``SimpleMotorFeedforward``; ``Slot0Configs`` or
            ``FeedForwardConfig`` inside a motor controller.
        arguments: parameter -> what it is given, where it is given anything.
        text: the call.
        line: its line, from 1.
        spread: whether it gets more from a list that cannot be read.
        choices: setting -> constant without its season's dress: ``GravityType`` -> ``armcosine``.
    """

    kind: str
    arguments: dict[str, Argument] = field(hash=False)
    text: str = ""
    line: int = 0
    spread: bool = False
    choices: dict[str, str] = field(default_factory=dict, hash=False)


@dataclass(frozen=True)
class DeployFacts:
    """All that the text of a robot program says about its gains.

    Args:
        language: ``java`` or ``python``.
        holder: the class that is there for the gains; empty if there is none.
        constants: the gains, each once: that in the holder before others.
        general: the comments in and above the holder.
        feedforwards: those that are made, in order.
        feedback: the argument made of kP that something other than a feedforward is given.
        problems: syntax errors; when there are any, the rest is empty.
        compile_errors: what keeps the file from being compiled, as far as text can tell.
    """

    language: str
    holder: str = ""
    constants: tuple[GainConstant, ...] = ()
    general: str = ""
    feedforwards: tuple[Feedforward, ...] = ()
    feedback: Argument | None = None
    problems: tuple[ParseProblem, ...] = ()
    compile_errors: tuple[ParseProblem, ...] = ()

    def find_constant(self, gain: str) -> GainConstant | None:
        """A gain's constant, if it is there."""
        return next((one for one in self.constants if one.gain == gain), None)


def find_gain_of_name(name: str) -> str:
    """The gain that a name stands for; empty if for none."""
    found = GAIN.fullmatch(name.lstrip("_").removeprefix("m_"))
    return f"k{found[1].upper()}" if found else ""


def read_gains(path: Path) -> DeployFacts:
    """Read what a robot program says about its gains, without running any of it.

    Raises:
        UnreadableFile: it is missing, empty, too large, not text, or neither Java nor Python.
    """
    names = SymbolTable(Files(path))
    if names.main.problems:
        return DeployFacts(names.main.language, problems=names.main.problems)
    return _Reader(names).facts()


class _Reader:
    """Goes through one file, and through those its feedforward takes gains from."""

    def __init__(self, names: SymbolTable) -> None:
        self._names = names
        self._measures = ConstantFolder(names)
        self._gains: dict[Node, str] = {}  # by node: the gain whose constant it is made of

    def facts(self) -> DeployFacts:
        """All facts of the file."""
        main = self._names.main
        every = list(walk_with_scopes(main.body, Scope(main)))
        calls = [(node, scope) for node, scope in every if isinstance(node, Call)]
        settings = list(find_gain_settings(every, self._names))
        made = [*self._feedforwards(calls), *self._in_controllers(settings)]
        modules = dict.fromkeys((main, *self._others(calls)))
        found = [one for module in modules for one in self._constants(module)]
        found.sort(key=lambda one: (not HOLDER.search(one.holder), len(one.name)))
        first = {one.gain: one for one in reversed(found)}
        holders = [
            (module, node)
            for module in modules
            for node, _ in walk_with_scopes(module.body, Scope(module))
            if HOLDER.search(getattr(node, "name", "")) and hasattr(node, "bases")
        ]
        module, holder = holders[0] if holders else (main, None)
        return DeployFacts(
            main.language,
            holder=getattr(holder, "name", ""),
            constants=tuple(sorted(first.values(), key=lambda one: one.line)),
            general=_around(holder, list_comments(module)),
            feedforwards=tuple(made),
            feedback=self._feedback(calls) or self._feedback_field(settings),
            compile_errors=find_compile_errors(self._names),
        )

    def _constants(self, module: Module) -> Iterator[GainConstant]:
        said = list_comments(module)
        for node, scope in walk_with_scopes(module.body, Scope(module)):
            if not isinstance(node, Assign) or node.value is None:
                continue
            target = node.target
            mine = isinstance(target, Member) and isinstance(target.owner, Self)
            if not (mine or (isinstance(target, Name) and not scope.functions)):
                continue
            gain = find_gain_of_name(get_last_name(target))
            if gain:
                yield GainConstant(
                    gain,
                    get_last_name(target),
                    scope.classes[-1].name if scope.classes else "",
                    self._value(node.value, scope),
                    node.value.place.text,
                    find_comments_near(said, node.place.line, node.place.last_line),
                    node.place.line,
                )

    def _value(self, node: Node, scope: Scope) -> float | None:
        found = self._measures.fold(node, scope)
        return None if found is None or found.unit else found.value

    def _feedforwards(self, calls: list[tuple[Call, Scope]]) -> Iterator[Feedforward]:
        for call, scope in calls:
            made = find_constructed_class(call, scope, self._names)
            if not FEEDFORWARD.fullmatch(made):
                continue
            kind = made.partition("Feedforward")[0] + "Feedforward"
            words = ARGUMENTS[kind]
            given = dict(zip(words, call.args, strict=False))
            given |= {find_gain_of_name(spell_as_java(word)): node for word, node in call.named}
            arguments = {
                word: self._argument(node, scope) for word, node in given.items() if word in words
            }
            yield Feedforward(kind, arguments, call.place.text, call.place.line, spread=call.spread)

    def _in_controllers(self, settings: list[GainSetting]) -> Iterator[Feedforward]:
        """What each motor controller's configuration is given, as one feedforward."""
        for kind in dict.fromkeys(one.kind for one in settings):
            mine = sorted(
                (one for one in settings if one.kind == kind),
                key=lambda one: one.value.place.start,  # a chain is met from its end
            )
            given = {
                one.name: self._argument(one.value, one.scope)
                for one in mine
                if not one.choice and one.name != "kP"
            }
            if given.keys() - {RATIO}:
                yield Feedforward(
                    kind,
                    given,
                    kind,
                    mine[0].line,
                    choices={one.name: one.choice for one in mine if one.choice},
                )

    def _feedback_field(self, settings: list[GainSetting]) -> Argument | None:
        """What ``slot0.kP = …`` is given."""
        return next(
            (self._argument(one.value, one.scope) for one in settings if one.name == "kP"), None
        )

    def _argument(self, node: Node, scope: Scope) -> Argument:
        value = self._value(node, scope)
        if value is None:
            value = self._of_object(node, scope)
        return Argument(self._gain(node, scope), value, node.place.text)

    def _of_object(self, node: Node, scope: Scope) -> float | None:
        """The value of an object's field; None where the object may have been made with others."""
        one = self._only_value(node, scope) if isinstance(node, Member) else None
        if one is None or not isinstance(node, Member):
            return None
        owner = resolve_bound(BoundNode(node.owner, scope), self._names).node
        if isinstance(owner, Call) and (owner.args or owner.named or owner.spread):
            return None
        return self._value(*one)

    def _gain(self, node: Node, scope: Scope) -> str:
        """The gain whose constant a value is made of, names followed."""
        if node not in self._gains:
            self._gains[node] = ""  # what is made of itself is made of no gain
            with self._names.limit_depth() as allowed:
                if allowed:
                    self._gains[node] = self._followed(node, scope)
        return self._gains[node]

    def _followed(self, node: Node, scope: Scope) -> str:
        for _ in range(MOST_STEPS):
            if isinstance(node, Cast):
                node = node.value
                continue
            if not isinstance(node, Name | Member):
                break
            gain = find_gain_of_name(node.name)
            if gain:
                return gain
            one = self._only_value(node, scope)
            if one is None:
                return ""
            node, scope = one
        found = {
            self._gain(part, scope)
            for part in iter_nodes(node, but=(Member,))
            if isinstance(part, Name | Member)
        } - {""}
        return found.pop() if len(found) == 1 else ""

    def _only_value(self, node: Node, scope: Scope) -> Placed | None:
        return find_only_value(find_definitions(BoundNode(node, scope), self._names))

    def _others(self, calls: list[tuple[Call, Scope]]) -> Iterator[Module]:
        """Other files that hold gains which are handed to something here."""
        for call, scope in calls:
            for node in call.all_args:
                for part in iter_nodes(node, but=(Member,)):
                    if isinstance(part, Name | Member) and find_gain_of_name(part.name):
                        one = self._only_value(part, scope)
                        if one is not None:
                            yield one[1].module

    def _feedback(self, calls: list[tuple[Call, Scope]]) -> Argument | None:
        for call, scope in calls:
            if FEEDFORWARD.fullmatch(find_constructed_class(call, scope, self._names)):
                continue
            for node in call.all_args:
                if self._gain(node, scope) == "kP":
                    return self._argument(node, scope)
        return None


def _around(holder: Node | None, said: tuple[Comment, ...]) -> str:
    """The comments in a class and directly above it."""
    if holder is None:
        return ""
    return find_comments_near(said, holder.place.line, holder.place.last_line)
