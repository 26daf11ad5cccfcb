"""Java statements, compiled to Python functions that say how they ended.

A statement gives None where the next one follows, else a signal: RETURN (the value lies in the
variables), or a Jump for break, continue and yield.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from tree_sitter import Node

from grader.robotcode.java import type_names, values
from grader.robotcode.java.checks import join_codes
from grader.robotcode.java.classes import DECLARATIONS, PRIMITIVES, JavaClass
from grader.robotcode.java.expression_compiler import ExpressionCompiler, is_instance
from grader.robotcode.java.program import iterate
from grader.robotcode.java.runtime import STATE, find_caller
from grader.robotcode.java.scope import MISSING, RESULT, Code, Env, Run, child, kind_of, named, text
from grader.robotcode.java.values import (
    NullPointerException,
    StackOverflowError,
    Throwable,
)
from grader.robotcode.library.base import Unknown

LOOPS = {"while_statement", "do_statement", "for_statement", "enhanced_for_statement"}
STATEMENTS = {  # expressions that can stand alone
    "assignment_expression", "update_expression", "method_invocation", "object_creation_expression",
}  # fmt: skip
MOST_UNKNOWN = 3  # turns of a loop whose condition nobody knows


@dataclass(frozen=True)
class Jump:
    """How a statement ended: ``break``, ``continue``, ``return`` or ``yield``; and its label."""

    kind: str
    label: str = ""


RETURN, BREAK, CONTINUE, YIELD = (Jump(one) for one in ("return", "break", "continue", "yield"))


class StatementCompiler(ExpressionCompiler):
    """Compiles the statements of one method, with their expressions.

    Args:
        returns: the type of what the method gives back.
    """

    returns = ""
    in_lambda = 0
    arms: Sequence[Code] = ()  # of the switch that was compiled last
    gives = False  # whether the lambda around returns a value somewhere

    def statement(self, node: Node, label: str = "") -> Run:
        """Compile a statement."""
        if node.type in LOOPS:
            return getattr(self, f"_{node.type}")(node, label)
        if node.type == ";":
            return lambda _env: None
        method = getattr(self, f"_{node.type}", None)
        if method is None:
            return self.refuse("this is no statement", node).run
        if node.type == "switch_expression":
            return self._switch(node, None)
        return method(node)

    def _lead(self, node: Node, run: Run) -> Run:
        """A run that says first where it is."""
        at = self.at(node)

        def lead(env: Env) -> Any:
            STATE.at = at
            return run(env)

        return lead

    def block(self, node: Node) -> Run:
        """Compile the statements between braces."""
        self.frame.push()
        parts = list(named(node))
        runs = []
        for number, one in enumerate(parts):
            runs.append(self.statement(one))
            if (
                number + 1 < len(parts)
                and not completes(one)
                and parts[number + 1].type not in DECLARATIONS
            ):
                self.refuse(
                    "unreachable statement: nothing gets past the line above", parts[number + 1]
                )
                break
        self.frame.pop()
        if not runs:
            return lambda _env: None
        if len(runs) == 1:
            return runs[0]

        def run(env: Env) -> Any:
            for one in runs:
                signal = one(env)
                if signal is not None:
                    return signal
            return None

        return run

    _block = _constructor_body = block

    def lambda_body(self, node: Node) -> tuple[Run, bool | None]:
        """Compile the body of a lambda, an expression or a block."""
        if node.type != "block":
            code = self.compile(node)
            gives = False if code.kind == "void" else None if node.type in STATEMENTS else True
            return self._lead(node, code.run), gives
        (returns, self.returns), (gave, self.gives) = (self.returns, ""), (self.gives, False)
        self.in_lambda += 1
        run = self.block(node)
        self.in_lambda -= 1
        gives, self.returns, self.gives = self.gives, returns, gave

        def body(env: Env) -> Any:
            env[RESULT] = None
            run(env)
            return env[RESULT]

        return body, gives

    def _local_variable_declaration(self, node: Node) -> Run:
        kind_node = node.child_by_field_name("type")
        base = kind_of(kind_node)
        modifiers = child(node, "modifiers")
        final = modifiers is not None and "final" in text(modifiers).split()
        if base != "var":
            self.find_type(kind_node)
        runs = []
        for one in node.children_by_field_name("declarator"):
            name, value = text(one.child_by_field_name("name")), one.child_by_field_name("value")
            kind = base + "[]" * text(one.child_by_field_name("dimensions")).count("[")
            if self.frame.find(name) is not None:
                self.refuse(f"variable {name} is already defined in this method", one)
            runs.append(self._declare(name, kind, value, final=final))
        run = runs[0] if len(runs) == 1 else (lambda env: [one(env) for one in runs] and None)
        return self._lead(node, run)

    def _declare(self, name: str, kind: str, value: Node | None, *, final: bool) -> Run:
        if value is None:
            slot = self.frame.declare(name, self.erased(kind), final=final).slot

            def clear(env: Env) -> None:
                env[slot] = None

            return clear
        if value.type == "array_initializer":
            local = self.frame.declare(name, kind, final=final)
            run = self.array_of(value, kind).run
        else:
            if kind == "var":
                code = self.compile(value)
                local = self.frame.declare(
                    name, code.kind if code.kind != "lambda" else "", final=final
                )
            else:
                local = self.frame.declare(name, self.erased(kind), final=final)
                code = self.compile(value)
            run = self.coerce(code, local.kind, value)
            if final and code.constant is not MISSING and local.kind in {*PRIMITIVES, "String"}:
                local.constant = values.cast(local.kind, code.constant)
        local.assigned += 1
        local.valued = True
        slot = local.slot

        def declare(env: Env) -> None:
            env[slot] = run(env)

        return declare

    def _class_declaration(self, node: Node) -> Run:
        name = text(node.child_by_field_name("name"))
        made = JavaClass(name, node, self.owner.unit, outer=self.owner, frame=self.frame)
        made.static = node.type != "class_declaration" or (self.frame.static and False)
        self.frame.classes[-1][name] = made
        _ = made.cls
        return lambda _env: None

    _record_declaration = _enum_declaration = _interface_declaration = _class_declaration

    def _expression_statement(self, node: Node) -> Run:
        one = next(named(node))
        if one.type == "switch_expression":
            return self._switch(one, None)
        run = self.compile(one).run
        if one.type not in STATEMENTS:
            return self.refuse("not a statement: its value goes nowhere", one).run
        at = self.at(node)

        def execute(env: Env) -> None:
            STATE.at = at
            run(env)

        return execute

    def _if_statement(self, node: Node) -> Run:
        self.frame.push()
        condition = self._lead(node, self.condition(node.child_by_field_name("condition")))
        yes = self.statement(node.child_by_field_name("consequence"))
        other = node.child_by_field_name("alternative")
        patterns = dict(self.frame.scopes[-1])
        self.frame.pop()
        self.frame.scopes[-1].update(
            {k: v for k, v in patterns.items() if k not in self.frame.scopes[-1]}
        )
        if other is None:
            return lambda env: yes(env) if condition(env) else None
        no = self.statement(other)
        return lambda env: yes(env) if condition(env) else no(env)

    def _labeled_statement(self, node: Node) -> Run:
        label, body = list(named(node))
        name = text(label)
        run = self.statement(body, name)

        def labeled(env: Env) -> Any:
            signal = run(env)
            return None if signal == Jump("break", name) else signal

        return labeled

    def _loop(
        self, condition: Run | None, body: Run, update: Run, label: str, *, first: bool = True
    ) -> Run:
        """A loop: ``first`` asks its condition before the first turn."""
        mine = {BREAK: "break", CONTINUE: "continue", Jump("continue", label): "continue"}
        state = STATE

        def loop(env: Env) -> Any:
            asked, unknown = first, 0
            while True:
                if asked and condition is not None:
                    value = condition(env)
                    if isinstance(value, Unknown):
                        unknown += 1
                        if unknown > MOST_UNKNOWN or not value:
                            return None
                    elif not value:
                        return None
                asked = True
                state.tick()
                signal = body(env)
                if signal is not None:
                    kind = mine.get(signal)
                    if kind == "break":
                        return None
                    if kind is None:
                        return signal
                update(env)

        return loop

    def _while_statement(self, node: Node, label: str) -> Run:
        condition = self._lead(node, self.condition(node.child_by_field_name("condition")))
        body = self.statement(node.child_by_field_name("body"))
        self._refuse_never(node.child_by_field_name("condition"), node)
        return self._loop(condition, body, lambda _env: None, label)

    def _refuse_never(self, condition: Node | None, body: Node) -> None:
        if text(condition).strip("() ") == "false":
            self.refuse("unreachable statement: the condition of this loop is never true", body)

    def _do_statement(self, node: Node, label: str) -> Run:
        body = self.statement(node.child_by_field_name("body"))
        condition = self._lead(node, self.condition(node.child_by_field_name("condition")))
        return self._loop(condition, body, lambda _env: None, label, first=False)

    def _for_statement(self, node: Node, label: str) -> Run:
        self.frame.push()
        before = [
            self.statement(one)
            if one.type == "local_variable_declaration"
            else self.compile(one).run
            for one in node.children_by_field_name("init")
        ]
        asked = node.child_by_field_name("condition")
        condition = self._lead(node, self.condition(asked)) if asked is not None else None
        self._refuse_never(asked, node)
        after = [self.compile(one).run for one in node.children_by_field_name("update")]
        body = self.statement(node.child_by_field_name("body"))
        self.frame.pop()
        loop = self._loop(condition, body, lambda env: [one(env) for one in after], label)

        def run(env: Env) -> Any:
            for one in before:
                one(env)
            return loop(env)

        return run

    def _enhanced_for_statement(self, node: Node, label: str) -> Run:
        self.frame.push()
        many = self.compile(node.child_by_field_name("value"))
        kind = kind_of(node.child_by_field_name("type"))
        if kind == "var":
            kind = many.kind[:-2] if many.kind.endswith("[]") else ""
        elif many.kind in PRIMITIVES or many.kind == "String":
            self.refuse(
                f"a for-each loop goes over an array or a collection, not over {many.kind}", node
            )
        local = self.frame.declare(text(node.child_by_field_name("name")), self.erased(kind))
        body = self.statement(node.child_by_field_name("body"))
        self.frame.pop()
        slot, owner, at, run = local.slot, self.owner, self.at(node), many.run
        primitive = kind if kind in PRIMITIVES else ""
        mine = {BREAK: "break", CONTINUE: "continue", Jump("continue", label): "continue"}

        def loop(env: Env) -> Any:
            STATE.at = at
            for one in iterate(run(env)):
                STATE.tick()
                env[slot] = owner.convert(primitive, one) if primitive else one
                signal = body(env)
                if signal is not None:
                    ended = mine.get(signal)
                    if ended == "break":
                        return None
                    if ended is None:
                        return signal
            return None

        return loop

    def _return_statement(self, node: Node) -> Run:
        value = next(named(node), None)
        at = self.at(node)
        if value is None:
            if self.returns not in {"", "void"} and not self.in_lambda:
                self.refuse(f"return needs a value of type {self.returns} here", node)
            return lambda _env: RETURN
        code = self.compile(value)
        self.gives = True
        if self.returns == "void" and not self.in_lambda:
            return self.refuse(
                "a void method gives nothing back, so its return has no value", node
            ).run
        run = self.coerce(code, self.returns, value) if not self.in_lambda else code.run

        def back(env: Env) -> Jump:
            STATE.at = at
            env[RESULT] = run(env)
            return RETURN

        return back

    def _break_statement(self, node: Node) -> Run:
        label = child(node, "identifier")
        jump = BREAK if label is None else Jump("break", text(label))
        return lambda _env: jump

    def _continue_statement(self, node: Node) -> Run:
        label = child(node, "identifier")
        jump = CONTINUE if label is None else Jump("continue", text(label))
        return lambda _env: jump

    def _yield_statement(self, node: Node) -> Run:
        code = self.compile(next(named(node)))
        slot, arms = self.yields[-1] if self.yields else (RESULT, [])
        arms.append(code)
        return _give(slot, code)

    def _throw_statement(self, node: Node) -> Run:
        run, at = self.compile(next(named(node))).run, self.at(node)

        def throw(env: Env) -> Any:
            problem = run(env)
            STATE.at = at
            if isinstance(problem, Throwable):
                raise problem
            raise NullPointerException("what is thrown is null")

        return throw

    def _assert_statement(self, _node: Node) -> Run:
        return lambda _env: None  # Java does not ask, unless it is started with -ea

    def _synchronized_statement(self, node: Node) -> Run:
        return self.block(node.child_by_field_name("body"))

    # -- try --------------------------------------------------------------------------------

    def _try_statement(self, node: Node) -> Run:
        body = self.block(node.child_by_field_name("body"))
        return self._guarded(node, body)

    def _try_with_resources_statement(self, node: Node) -> Run:
        self.frame.push()
        opened = []
        for one in named(node.child_by_field_name("resources")):
            value = one.child_by_field_name("value")
            if value is None:
                code = self.compile(next(named(one)))
                slot = self.frame.declare(f"{one.start_byte} resource", code.kind).slot
                opened.append((slot, code.run))
            else:
                code = self.compile(value)
                kind = kind_of(one.child_by_field_name("type"))
                name = text(one.child_by_field_name("name"))
                opened.append(
                    (self.frame.declare(name, code.kind if kind == "var" else kind).slot, code.run)
                )
        body = self.block(node.child_by_field_name("body"))
        self.frame.pop()
        return self._guarded(node, _with_resources(opened, body))

    def _guarded(self, node: Node, body: Run) -> Run:
        catches = [self._catch(one) for one in node.children if one.type == "catch_clause"]
        last = child(node, "finally_clause")
        finally_ = self.block(next(named(last))) if last is not None else None

        def guarded(env: Env) -> Any:
            depth = STATE.depth
            try:
                return body(env)
            except (Throwable, RecursionError) as raised:
                STATE.depth = depth
                problem = raised if isinstance(raised, Throwable) else StackOverflowError()
                for fits, slot, handler in catches:
                    if fits(problem):
                        env[slot] = problem
                        return handler(env)
                raise

        if finally_ is None:
            return guarded

        def run(env: Env) -> Any:
            try:
                signal = guarded(env)
            except Throwable:
                result = finally_(env)
                if result is not None:
                    return result
                raise
            kept = env[RESULT]
            result = finally_(env)
            if result is None:
                env[RESULT] = kept
            return signal if result is None else result

        return run

    def _catch(self, node: Node) -> tuple[Callable[[Throwable], bool], int, Run]:
        parameter = child(node, "catch_formal_parameter")
        types = [
            (kind_of(one), self.find_type(one)) for one in named(child(parameter, "catch_type"))
        ]
        self.frame.push()
        slot = self.frame.declare(
            text(parameter.child_by_field_name("name")), types[0][0] if len(types) == 1 else ""
        ).slot
        body = self.block(node.child_by_field_name("body"))
        self.frame.pop()

        def fits(problem: Throwable) -> bool:
            return any(is_instance(problem, kind, cls) is True for kind, cls in types)

        return fits, slot, body

    # -- switch -----------------------------------------------------------------------------

    def _switch_expression(self, node: Node) -> Code:
        slot = self.frame.declare(f"{node.start_byte} switch", "").slot
        run = self._switch(node, slot)
        kind = join_codes(self.arms) if self.arms else ""

        def value(env: Env) -> Any:
            env[slot] = MISSING
            signal = run(env)
            if signal is not None and signal is not YIELD:
                return None
            if env[slot] is MISSING:
                raise NullPointerException("no case of the switch fits")
            return env[slot]

        return Code(value, kind)

    _switch_statement = _switch_expression

    def _switch(self, node: Node, slot: int | None) -> Run:
        """Compile a switch; with a slot it is an expression, which leaves its value there."""
        subject = self.compile(node.child_by_field_name("condition")).run
        at = self.at(node)
        self.frame.push()
        arms: list[Code] = []
        around = self.yields[-1] if self.yields else (RESULT, arms)
        self.yields.append(around if slot is None else (slot, arms))
        cases: list[tuple[list[Any], bool, Run, bool]] = []
        for part in named(node.child_by_field_name("body")):
            labels, default = [], False
            for label in (one for one in part.children if one.type == "switch_label"):
                listed = list(named(label))
                default = default or text(label).startswith("default")
                labels += [self._label(one) for one in listed]
            arrow = part.type == "switch_rule"
            rest = [one for one in named(part) if one.type != "switch_label"]
            if arrow and slot is not None and rest and rest[0].type == "expression_statement":
                code = self.compile(next(named(rest[0])))
                body = _give(slot, code)
                arms.append(code)
            elif arrow and rest and rest[0].type == "expression_statement":
                body = self._expression_statement(rest[0])
            else:
                runs = [self.statement(one) for one in rest]
                body = _sequence(runs)
            cases.append((labels, default, body, arrow))
        self.yields.pop()
        self.frame.pop()
        self.arms = arms

        def switch(env: Env) -> Any:
            STATE.at = at
            value = subject(env)
            if value is None:
                raise NullPointerException("the value of the switch is null")
            known = not isinstance(value, Unknown)
            start = _find_case(cases, value, env) if known else _choose_case(cases, value)
            for _, _, body, arrow in cases[start:]:
                signal = body(env)
                if signal is not None:
                    return None if signal is BREAK else signal
                if arrow:
                    return None
            return None

        return switch

    def _label(self, node: Node) -> Any:
        """What a case compares with: the name of an enum's constant, or a value."""
        if node.type == "identifier" and self.find_variable(text(node)) is None:
            return text(node)
        return self.compile(node).run


def _find_case(cases: Sequence[tuple[list[Any], bool, Run, bool]], value: Any, env: Env) -> int:
    """The number of the case that fits; one too many if none does."""
    name = type_names.enum_name(value)
    for number, (labels, _, _, _) in enumerate(cases):
        for label in labels:
            if label == name if isinstance(label, str) else values.equals(label(env), value):
                return number
    return next((n for n, (_, default, _, _) in enumerate(cases) if default), len(cases))


def _choose_case(cases: Sequence[tuple[list[Any], bool, Run, bool]], value: Unknown) -> int:
    """A case for a value that nobody knows: the first one, or else the default or the last."""
    default = next((n for n, (_, default, _, _) in enumerate(cases) if default), len(cases) - 1)
    return 0 if value else default


def _give(slot: int, code: Code) -> Run:
    def give(env: Env) -> Jump:
        env[slot] = code.run(env)
        return YIELD

    return give


def _sequence(runs: Sequence[Run]) -> Run:
    def run(env: Env) -> Any:
        for one in runs:
            signal = one(env)
            if signal is not None:
                return signal
        return None

    return run


def _with_resources(opened: Sequence[tuple[int, Run]], body: Run) -> Run:
    """A body with what has to be closed after it, the last one first."""
    if not opened:
        return body
    (slot, make), *rest = opened
    inner = _with_resources(rest, body)

    def run(env: Env) -> Any:
        one = env[slot] = make(env)
        try:
            signal = inner(env)
        except Throwable as problem:
            if one is not None:
                try:
                    find_caller(type(one), "close", ())(one, ())
                except Throwable as second:
                    problem.addSuppressed(second)
            raise
        if one is not None:
            find_caller(type(one), "close", ())(one, ())
        return signal

    return run


def completes(node: Node) -> bool:
    """Whether a statement can end normally, so that the next one is reached (JLS 14.22)."""
    kind = node.type
    if kind in {
        "return_statement",
        "throw_statement",
        "break_statement",
        "continue_statement",
        "yield_statement",
    }:
        return False
    if kind in {"block", "constructor_body"}:
        return all(completes(one) for one in named(node))
    if kind == "if_statement":
        other = node.child_by_field_name("alternative")
        return (
            other is None or completes(node.child_by_field_name("consequence")) or completes(other)
        )
    if kind in {"while_statement", "for_statement", "do_statement"}:
        condition = node.child_by_field_name("condition")
        endless = (condition is None and kind == "for_statement") or text(condition).strip(
            "() "
        ) == "true"
        return not endless or _breaks(node.child_by_field_name("body"))
    if kind == "labeled_statement":
        return completes(list(named(node))[1]) or f"break {text(next(named(node)))}" in text(node)
    if kind in {"try_statement", "try_with_resources_statement"}:
        last = child(node, "finally_clause")
        if last is not None and not completes(next(named(last))):
            return False
        bodies = [
            one.child_by_field_name("body")
            for one in (node, *node.children)
            if one.type in {kind, "catch_clause"}
        ]
        return any(completes(one) for one in bodies)
    if kind == "synchronized_statement":
        return completes(node.child_by_field_name("body"))
    if kind == "expression_statement" and next(named(node)).type == "switch_expression":
        return completes(next(named(node)))
    if kind == "switch_expression":
        return _switch_completes(node)
    return True


def _switch_completes(node: Node) -> bool:
    parts = list(named(node.child_by_field_name("body")))
    labels = [text(one) for part in parts for one in part.children if one.type == "switch_label"]
    if not any(one.startswith("default") for one in labels) or _breaks(
        node.child_by_field_name("body")
    ):
        return True
    if parts and parts[0].type == "switch_rule":
        bodies = [list(named(part))[-1] for part in parts]
        return any(completes(one) for one in bodies)
    last = [one for one in named(parts[-1]) if one.type != "switch_label"] if parts else []
    return not last or all(completes(one) for one in last)


def _breaks(node: Node) -> bool:
    """Whether a body has a break of its own, or one with a label."""
    if node.type == "break_statement":
        return True
    if node.type in {"lambda_expression", "class_body"}:
        return False
    inner = [
        one
        for one in node.named_children
        if one.type not in LOOPS | {"switch_expression"} or any(map(_has_label, _all(one)))
    ]
    return any(_breaks(one) for one in inner)


def _has_label(node: Node) -> bool:
    return node.type == "break_statement" and bool(node.named_children)


def _all(node: Node) -> Any:
    yield node
    for one in node.named_children:
        yield from _all(one)


__all__ = ["StatementCompiler", "completes"]
