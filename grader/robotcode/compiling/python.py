"""What would stop a RobotPy file with an error as soon as that line runs."""

import ast
import builtins
from collections.abc import Iterator

from grader.robotcode.compiling.season import (
    CLASSES,
    INHERITED,
    METHODS,
    MODULE_OF,
    PLAIN,
    ROBOTPY,
    find_call_on_class,
    make_spelling_problem,
    suggest_name,
)
from grader.robotcode.facts import ParseProblem
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import spell_as_java

ALWAYS = frozenset(dir(builtins)) | {"__file__", "__name__", "__doc__", "__annotations__"}
OPEN = frozenset({"setattr", "vars", "__getattr__"})  # set attributes by a name nobody can read


NAMED_BY: dict[type[ast.AST], str] = {  # the field with the name that a node brings into being
    **dict.fromkeys((ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef), "name"),
    **dict.fromkeys((ast.ExceptHandler, ast.MatchAs, ast.MatchStar), "name"),
    ast.MatchMapping: "rest",
    ast.arg: "arg",
}


def find_python_errors(names: SymbolTable) -> Iterator[ParseProblem]:
    """Names that nothing defines, imports that do not exist, attributes that nobody sets."""
    try:
        tree = ast.parse(names.main.source.decode("utf-8", errors="replace"))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return
    every = list(ast.walk(tree))
    yield from _imports(every)
    wide = any(isinstance(one, ast.ImportFrom) and one.names[0].name == "*" for one in every)
    bound = _bound(every)
    if not wide:
        for one in every:
            if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Load) and one.id not in bound:
                yield ParseProblem(f"{one.id} is not defined or imported", one.lineno)
    yield from _self_in_class_body(every)
    for one in every:
        if isinstance(one, ast.Call) and isinstance(one.func, ast.Attribute) and len(one.args) <= 1:
            owner = one.func.value
            name = owner.attr if isinstance(owner, ast.Attribute) else getattr(owner, "id", "")
            method, line = one.func.attr, one.lineno
            yield from find_call_on_class(method, name, held="self.routine", line=line)
    yield from _attributes(every)
    yield from _methods(every)


def _self_in_class_body(every: list[ast.AST]) -> Iterator[ParseProblem]:
    """Where ``self`` is used in a class but in none of its methods: there it does not exist."""
    later = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)
    for one in every:
        waiting: list[ast.AST] = list(one.body) if isinstance(one, ast.ClassDef) else []
        while waiting:
            node = waiting.pop()
            if isinstance(node, ast.Name) and node.id == "self":
                said = "the body of a class has no self: move this line into __init__"
                yield ParseProblem(said, node.lineno)
            if not isinstance(node, later):
                waiting.extend(ast.iter_child_nodes(node))


def _imports(every: list[ast.AST]) -> Iterator[ParseProblem]:
    modules: dict[str, str] = {}
    for node in every:
        if isinstance(node, ast.Import):
            modules |= {one.asname or one.name: one.name for one in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level and _is_robotpy(node.module or ""):
            for one in node.names:
                yield from _imported(one.name, node.module or "", node.lineno)
    for node in every:
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            module = modules.get(node.value.id, "")
            if _is_robotpy(module) and node.attr[:1].isupper():
                yield from _imported(node.attr, module, node.lineno)


def _is_robotpy(module: str) -> bool:
    return module.partition(".")[0] in ROBOTPY


def _imported(name: str, module: str, line: int) -> Iterator[ParseProblem]:
    meant = suggest_name(name, CLASSES) if name[:1].isupper() else ""
    home = MODULE_OF.get(name, "")
    if meant and name not in CLASSES:
        yield make_spelling_problem("class", name, meant=meant, line=line)
    elif home and module in {*MODULE_OF.values()} and home != module:
        yield ParseProblem(f"{name} is not in {module}: it is in {home}", line)


def _bound(every: list[ast.AST]) -> set[str]:
    """Every name that gets a value anywhere in the file."""
    bound = set(ALWAYS)
    for one in every:
        if isinstance(one, ast.Name) and not isinstance(one.ctx, ast.Load):
            bound.add(one.id)
        elif isinstance(one, ast.Import | ast.ImportFrom):
            bound |= {(alias.asname or alias.name).partition(".")[0] for alias in one.names}
        elif isinstance(one, ast.Global | ast.Nonlocal):
            bound |= {*one.names}
        elif type(one) in NAMED_BY:
            bound.add(getattr(one, NAMED_BY[type(one)]))
        bound |= {word.name for word in getattr(one, "type_params", ())}
    return bound


def _attributes(every: list[ast.AST]) -> Iterator[ParseProblem]:
    """Attributes of ``self`` that nothing sets."""
    classes = {one.name: one for one in every if isinstance(one, ast.ClassDef)}
    for one in classes.values():
        known = _members(one, classes)
        if known is None:
            continue
        for node in ast.walk(one):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                used = isinstance(node.ctx, ast.Load) and node.value.id == "self"
                if used and node.attr not in known and not node.attr.startswith("__"):
                    yield ParseProblem(f"self.{node.attr} is never set", node.lineno)


def _methods(every: list[ast.AST]) -> Iterator[ParseProblem]:
    """Methods of a library whose name is misspelled."""
    own = {one.name for one in every if isinstance(one, ast.FunctionDef)}
    own |= {one.attr for one in every if isinstance(one, ast.Attribute) and _is_set(one)}
    for node in every:
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            name, line = node.func.attr, node.func.end_lineno or node.lineno
            meant = suggest_name(name, METHODS)
            if meant and name not in own and spell_as_java(name) not in METHODS:
                yield make_spelling_problem("method", name, meant=meant, line=line)


def _is_set(node: ast.Attribute) -> bool:
    return not isinstance(node.ctx, ast.Load)


def _members(one: ast.ClassDef, classes: dict[str, ast.ClassDef]) -> set[str] | None:
    """All attributes of a class; None where it inherits from a class out of sight."""
    known = {*INHERITED}
    known |= {"".join(f"_{a.lower()}" if a.isupper() else a for a in name) for name in INHERITED}
    waiting, seen = [one], set()
    while waiting:
        place = waiting.pop()
        seen.add(place.name)
        if any("dataclass" not in ast.unparse(word) for word in place.decorator_list):
            return None
        bases = {ast.unparse(base).rpartition(".")[2] for base in place.bases} - seen
        if not bases <= PLAIN | classes.keys():
            return None
        waiting += [classes[name] for name in bases & classes.keys()]
        known |= {name for node in ast.walk(place) for name in _sets(node)}
        variables = [node for node in place.body if isinstance(node, ast.Assign | ast.AnnAssign)]
        known |= {
            target.id
            for node in variables
            for target in ast.walk(node)
            if isinstance(target, ast.Name) and not isinstance(target.ctx, ast.Load)
        }
    return None if known & OPEN else known


def _sets(node: ast.AST) -> Iterator[str]:
    """The attributes that a piece of a class's code may set or define."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Attribute) and _is_set(node):
        yield node.attr
    elif isinstance(node, ast.Name) and node.id in OPEN:
        yield node.id
