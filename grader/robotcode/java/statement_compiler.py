"""Java statements, compiled to Python functions that say how they ended.

A statement gives None where the next one follows, else a Jump: for return (the value lies in the
variables), break, continue or yield.
"""

from collections.abc import Callable, Sequence
from enum import Enum
from typing import Any

from tree_sitter import Node

from grader.robotcode.java import type_names, values
from grader.robotcode.java.classes import JavaClass
from grader.robotcode.java.expression_compiler import (
    LONGEST_TEXT,
    ExpressionCompiler,
    is_instance,
)
from grader.robotcode.java.program import iterate
from grader.robotcode.java.runtime import STATE
from grader.robotcode.java.scope import RESULT, Code, Env, Run, child, kind_of, named, text
from grader.robotcode.java.steps import CannotRunError
from grader.robotcode.java.values import (
    PRIMITIVES,
    NullPointerException,
    StackOverflowError,
    Throwable,
)
from grader.robotcode.library.base import Unknown

STATEMENTS = {  # expressions that can stand alone
    "assignment_expression", "update_expression", "method_invocation", "object_creation_expression",
}  # fmt: skip
MOST_UNKNOWN = 3  # turns of a loop whose condition nobody knows


class Jump(Enum):
    """The kind of jump that ended a statement."""

    RETURN = "return"
    BREAK = "break"
    CONTINUE = "continue"
    YIELD = "yield"


class StatementCompiler(ExpressionCompiler):
    """Compiles the statements of one method, with their expressions.

    Args:
        returns: the type of what the method gives back.
    """

    returns = ""
    in_lambda = 0
    gives = False  # whether the lambda around returns a value somewhere

    def statement(self, node: Node) -> Run:
        """Compile a statement; one that is not run here stops the program where it is reached."""
        if node.type == ";":
            return lambda _env: None
        if node.type == "switch_expression":
            return self._switch(node, None)
        run: Run | None = self.apply_method(node)
        if run is not None:
            return run

        def stop(_env: Env) -> Any:
            raise CannotRunError(" ".join(text(node).split())[:LONGEST_TEXT])

        return self._add_position(node, stop)

    def _add_position(self, node: Node, run: Run) -> Run:
        """A run that says first where it is."""
        at = self.at(node)

        def lead(env: Env) -> Any:
            STATE.at = at
            return run(env)

        return lead

    def block(self, node: Node) -> Run:
        """Compile the statements between braces."""
        self.frame.push()
        runs = [self.statement(one) for one in named(node)]
        self.frame.pop()
        return _sequence(runs)

    _block = _constructor_body = block

    def lambda_body(self, node: Node) -> tuple[Run, bool | None]:
        """Compile the body of a lambda, an expression or a block."""
        if node.type != "block":
            code = self.compile(node)
            gives = False if code.kind == "void" else None if node.type in STATEMENTS else True
            return self._add_position(node, code.run), gives
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

    def _local_variable_declaration(self, node: Node, type_: Node) -> Run:
        base = kind_of(type_)
        modifiers = child(node, "modifiers")
        final = modifiers is not None and "final" in text(modifiers).split()
        if base != "var":
            self.find_type(type_)
        runs = []
        for one in node.children_by_field_name("declarator"):
            name, value = text(one.child_by_field_name("name")), one.child_by_field_name("value")
            kind = base + "[]" * text(one.child_by_field_name("dimensions")).count("[")
            runs.append(self._declare(name, kind, value, final=final))
        run = runs[0] if len(runs) == 1 else (lambda env: [one(env) for one in runs] and None)
        return self._add_position(node, run)

    def _declare(self, name: str, kind: str, value: Node | None, *, final: bool) -> Run:
        if value is None:
            slot = self.frame.declare(name, self.erased(kind)).slot

            def clear(env: Env) -> None:
                env[slot] = None

            return clear
        if kind == "var":
            code = self.compile(value)
            kind = code.kind if code.kind != "lambda" else ""
            local = self.frame.declare(name, kind, final=final)
            run = self.coerce(code, kind, value)
        else:
            local = self.frame.declare(name, self.erased(kind), final=final)
            run = self.initial_value(value, kind)
        slot = local.slot

        def declare(env: Env) -> None:
            env[slot] = run(env)

        return declare

    def _class_declaration(self, node: Node, name: Node) -> Run:
        made = JavaClass(text(name), node, self.owner.unit, outer=self.owner, frame=self.frame)
        made.static = node.type != "class_declaration"
        self.frame.classes[-1][made.name] = made
        _ = made.cls
        return lambda _env: None

    _record_declaration = _enum_declaration = _interface_declaration = _class_declaration

    def _expression_statement(self, node: Node) -> Run:
        one = next(named(node))
        if one.type == "switch_expression":
            return self._switch(one, None)
        run = self.compile(one).run
        at = self.at(node)

        def execute(env: Env) -> None:
            STATE.at = at
            run(env)

        return execute

    def _if_statement(
        self, node: Node, condition: Node, consequence: Node, alternative: Node | None
    ) -> Run:
        self.frame.push()
        ask = self._add_position(node, self.condition(condition))
        yes = self.statement(consequence)
        patterns = dict(self.frame.scopes[-1])
        self.frame.pop()
        self.frame.scopes[-1].update(
            {k: v for k, v in patterns.items() if k not in self.frame.scopes[-1]}
        )
        if alternative is None:
            return lambda env: yes(env) if ask(env) else None
        no = self.statement(alternative)
        return lambda env: yes(env) if ask(env) else no(env)

    def _compile_loop(
        self, condition: Run | None, body: Run, update: Run, *, first: bool = True
    ) -> Run:
        """A loop: ``first`` asks its condition before the first turn."""
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
                if signal is Jump.BREAK:
                    return None
                if signal is not None and signal is not Jump.CONTINUE:
                    return signal
                update(env)

        return loop

    def _while_statement(self, node: Node, condition: Node, body: Node) -> Run:
        ask, first = (
            self._add_position(node, self.condition(condition)),
            node.type == "while_statement",
        )
        return self._compile_loop(ask, self.statement(body), lambda _env: None, first=first)

    _do_statement = _while_statement

    def _for_statement(self, node: Node, condition: Node | None, body: Node) -> Run:
        self.frame.push()
        before = [
            self.statement(one)
            if one.type == "local_variable_declaration"
            else self.compile(one).run
            for one in node.children_by_field_name("init")
        ]
        ask = self._add_position(node, self.condition(condition)) if condition is not None else None
        after = [self.compile(one).run for one in node.children_by_field_name("update")]
        turn = self.statement(body)
        self.frame.pop()
        loop = self._compile_loop(ask, turn, lambda env: [one(env) for one in after])

        def run(env: Env) -> Any:
            for one in before:
                one(env)
            return loop(env)

        return run

    def _enhanced_for_statement(
        self, node: Node, type_: Node, name: Node, value: Node, body: Node
    ) -> Run:
        self.frame.push()
        many, kind = self.compile(value), kind_of(type_)
        if kind == "var":
            kind = many.kind[:-2] if many.kind.endswith("[]") else ""
        local = self.frame.declare(text(name), self.erased(kind))
        turn = self.statement(body)
        slot, owner, at, run = local.slot, self.owner, self.at(node), many.run
        left = self.frame.declare(f"{node.start_byte} left", "").slot
        primitive = kind if kind in PRIMITIVES else ""

        def advance(env: Env) -> bool:
            for one in env[left]:
                env[slot] = owner.convert(primitive, one) if primitive else one
                return True
            return False

        self.frame.pop()
        loop = self._compile_loop(advance, turn, lambda _env: None)

        def run_loop(env: Env) -> Any:
            STATE.at = at
            env[left] = iter(iterate(run(env)))
            return loop(env)

        return run_loop

    def _return_statement(self, node: Node) -> Run:
        value = next(named(node), None)
        at = self.at(node)
        if value is None:
            return lambda _env: Jump.RETURN
        code = self.compile(value)
        self.gives = True
        run = self.coerce(code, self.returns, value) if not self.in_lambda else code.run

        def back(env: Env) -> Jump:
            STATE.at = at
            env[RESULT] = run(env)
            return Jump.RETURN

        return back

    def _break_statement(self, _node: Node) -> Run:
        return lambda _env: Jump.BREAK

    def _continue_statement(self, _node: Node) -> Run:
        return lambda _env: Jump.CONTINUE

    def _yield_statement(self, node: Node) -> Run:
        return _store_value(self.yields[-1], self.compile(next(named(node))))

    def _throw_statement(self, node: Node) -> Run:
        run, at = self.compile(next(named(node))).run, self.at(node)

        def throw(env: Env) -> Any:
            problem = run(env)
            STATE.at = at
            if isinstance(problem, Throwable):
                raise problem
            raise NullPointerException("the thrown exception is null")

        return throw

    def _assert_statement(self, _node: Node) -> Run:
        return lambda _env: None  # Java does not ask, unless it is started with -ea

    def _synchronized_statement(self, _node: Node, body: Node) -> Run:
        return self.block(body)

    # -- try --------------------------------------------------------------------------------

    def _try_statement(self, node: Node, body: Node) -> Run:
        tried = self.block(body)
        catches = [self._compile_catch(one) for one in node.children if one.type == "catch_clause"]
        last = child(node, "finally_clause")
        finally_ = self.block(next(named(last))) if last is not None else None

        def guarded(env: Env) -> Any:
            depth = STATE.depth
            try:
                return tried(env)
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

    def _compile_catch(self, node: Node) -> tuple[Callable[[Throwable], bool], int, Run]:
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

        def value(env: Env) -> Any:
            if run(env) is Jump.YIELD:
                return env[slot]
            raise NullPointerException("no case of the switch fits")

        return Code(value)

    _switch_statement = _switch_expression

    def _switch(self, node: Node, slot: int | None) -> Run:
        """Compile a switch; with a slot it is an expression, which leaves its value there."""
        subject = self.compile(node.child_by_field_name("condition")).run
        at = self.at(node)
        self.frame.push()
        self.yields.append((self.yields or [RESULT])[-1] if slot is None else slot)
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
                body = _store_value(slot, self.compile(next(named(rest[0]))))
            else:
                body = _sequence([self.statement(one) for one in rest])
            cases.append((labels, default, body, arrow))
        self.yields.pop()
        self.frame.pop()

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
                    return None if signal is Jump.BREAK else signal
                if arrow:
                    return None
            return None

        return switch

    def _label(self, node: Node) -> Any:
        """The value that a case compares with: the name of an enum's constant, or a value."""
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
    """A case for an unknown value: the first one, or else the default or the last."""
    default = next((n for n, (_, default, _, _) in enumerate(cases) if default), len(cases) - 1)
    return 0 if value else default


def _store_value(slot: int, code: Code) -> Run:
    def give(env: Env) -> Jump:
        env[slot] = code.run(env)
        return Jump.YIELD

    return give


def _sequence(runs: Sequence[Run]) -> Run:
    """A run of several statements, up to the first that jumps."""
    if len(runs) == 1:
        return runs[0]

    def run(env: Env) -> Any:
        for one in runs:
            signal = one(env)
            if signal is not None:
                return signal
        return None

    return run


def falls_through(node: Node) -> bool:
    """Whether a statement surely can end without a return; False if that is unclear."""
    kind, parts = node.type, list(named(node))
    if kind in {"block", "constructor_body"}:
        return all(map(falls_through, parts))
    if kind == "if_statement":
        return len(parts) < 3 or any(map(falls_through, parts[1:]))  # noqa: PLR2004 - with its else
    return kind in {"expression_statement", "local_variable_declaration", "enhanced_for_statement"}


__all__ = ["StatementCompiler", "falls_through"]
