"""Python code that changes Python or WPILib itself, so that running it does not show what it does.

A robot program that replaces a method of WPILib, runs text as code, looks into other functions'
variables or ends the process can forge what a run shows: it shares its process with the bench. No
robot needs that, so such a file is refused; a person has to look at it. What a program imports
from its own folders is looked at in the same way.
"""

import ast
import io
import re
import sys
import tokenize
import tomllib
import warnings
from collections.abc import Iterator
from pathlib import Path

from grader.robotcode.python.sandbox_files import list_program_files
from sim.core.errors import UnreadableFile

WORDS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
PARTLY = {module: frozenset(names.split()) for module, names in WORDS.pop("partly").items()}
PACKAGES, INSIDES, MORE, CALLS, ATTRIBUTES, DUNDERS = (
    frozenset(WORDS[one].split())
    for one in ("packages", "insides", "not_imported", "calls", "attributes", "dunders")
)
NOT_IMPORTED = INSIDES | MORE
MOST_CODE = 2_000_000  # [bytes] of all files together; a robot program has a fiftieth of it
UTF_8 = frozenset({"utf-8", "utf-8-sig"})
NOTES = frozenset({".csv", ".json", ".log", ".txt"})  # what a robot may write; no code, no devices
LIBRARY_METHOD = re.compile(r"(get|set|is)([A-Z_]\w*)?$")


def refuse_tampering(path: Path) -> None:
    """Refuse a Python program that could forge its grade, as by replacing a method of WPILib.

    Args:
        path: the learner's file; what it imports from its own folders is looked at, too.

    Raises:
        UnreadableFile: it does; where, and what to do.
    """
    local = _list_local_modules(path)
    for file, tree in _parse_files(path):
        line, what = next(_find_tampering(file, tree, local), (0, ""))
        if line:
            raise _make_refusal(what, path if file == path else Path(file.name), line)


def _make_refusal(what: str, file: Path, line: int) -> UnreadableFile:
    return UnreadableFile(
        f"{what}, so the grader cannot see what this code does",
        where=f"{file}, line {line}",
        advice="Remove it: a robot program does not need it. Then grade again.",
    )


def _parse_files(path: Path) -> Iterator[tuple[Path, ast.Module]]:
    """The syntax trees of the file and of the modules that it imports from its own folders.

    Raises:
        UnreadableFile: it is too much, or in an encoding that hides what is in it.
    """
    there = [path, *(one for one in list_program_files(path) if one.suffix == ".py")]
    todo, seen, size = [path], {path.resolve()}, 0
    while todo:
        file = todo.pop()
        try:
            text = file.read_bytes()
            encoding, _ = tokenize.detect_encoding(io.BytesIO(text).readline)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of a learner's text, which says them itself
                tree = ast.parse(text)
        except (OSError, ValueError, SyntaxError, RecursionError, MemoryError):
            continue  # whoever imports it stops there
        size += len(text)
        if encoding not in UTF_8 or size > MOST_CODE:
            what = "it is too much code" if size > MOST_CODE else f"it is written in {encoding}"
            raise _make_refusal(what, path if file == path else Path(file.name), 1)
        yield file, tree
        asked = {part for node in ast.walk(tree) for part in _list_imported_modules(node)}
        for one in there:
            name = one.parent.name if one.stem == "__init__" else one.stem
            wanted = name in asked or name in sys.stdlib_module_names or name in PACKAGES
            if wanted and one.resolve() not in seen:
                seen.add(one.resolve())
                todo.append(one)


def _list_local_modules(path: Path) -> frozenset[str]:
    """The names of modules that are the program's own."""
    files = [one for one in list_program_files(path) if one.suffix == ".py"]
    return frozenset({one.stem for one in files} | {one.parent.name for one in files})


def _list_imported_modules(node: ast.AST) -> Iterator[str]:
    """The parts of the names an import asks for."""
    if isinstance(node, ast.Import | ast.ImportFrom):
        for alias in node.names:
            yield from alias.name.split(".")
        yield from (getattr(node, "module", None) or "").split(".")


def _find_tampering(
    file: Path, tree: ast.Module, local: frozenset[str]
) -> Iterator[tuple[int, str]]:
    """Each line that changes Python or WPILib, with a description."""
    if file.stem in PACKAGES:
        yield 1, f"this file replaces WPILib's own {file.stem}"
    foreign = _list_foreign_names(tree, local)
    bases = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    calls = {id(node.func): node for node in ast.walk(tree) if isinstance(node, ast.Call)}
    for node in ast.walk(tree):
        said = ""
        if isinstance(node, ast.Import | ast.ImportFrom):
            said = _import(node, local)
        elif isinstance(node, ast.Name):
            said = _name(node, id(node) in bases, calls.get(id(node)))
        elif isinstance(node, ast.Attribute):
            said = _check_attribute(node, id(node) in bases, calls.get(id(node)), foreign)
        if said:
            yield node.lineno, said  # type: ignore[attr-defined]  # all four kinds have one


def _import(node: ast.Import | ast.ImportFrom, local: frozenset[str]) -> str:
    module = (getattr(node, "module", None) or "").partition(".")[0]
    for alias in node.names:
        top, _, _ = alias.name.partition(".")
        part = alias.name if module in PARTLY else ""
        if module in PARTLY and part not in PARTLY[module]:
            return f"it imports {part} of {module}"
        if module and alias.name.strip("_") in INSIDES | PARTLY.keys():
            return f"it imports {alias.name} of {module}"
        if not module and top in PARTLY and alias.asname:
            return f"it gives {top} another name"
        whole = module or top
        if whole in NOT_IMPORTED and whole not in local:
            return f"it imports {whole}"
    return ""


def _name(node: ast.Name, is_base: bool, call: ast.Call | None) -> str:  # noqa: FBT001 - what is around the node
    if not isinstance(node.ctx, ast.Load):
        return ""
    if node.id in CALLS or _find_hidden_part(node.id):
        return f"it uses {node.id}"
    if node.id in PARTLY and not is_base:
        return f"it gives {node.id} another name"
    if node.id == "getattr" and not _is_plain_getattr(call):
        return "it uses getattr with a name that cannot be read"
    if node.id == "open" and not (_only_reads(call, mode_at=1) or _opens_named_text_file(call)):
        return "it writes a file that may be code"
    return ""


def _check_attribute(
    node: ast.Attribute,
    is_base: bool,  # noqa: FBT001 - what is around the node
    call: ast.Call | None,
    foreign: frozenset[str],
) -> str:
    name, plain = node.attr, node.attr.strip("_")
    base = _get_last_name(node.value).strip("_")
    if base in PARTLY and name not in PARTLY[base]:
        return f"it uses {base}.{name}"
    if plain in INSIDES or name in ATTRIBUTES or _find_hidden_part(name):
        return f"it uses {name}"
    if plain in PARTLY and not is_base:
        return f"it gives {name} another name"
    if name == "open" and call is not None and not _only_reads(call, mode_at=0):
        return "it writes a file that may be code"
    if not isinstance(node.ctx, ast.Load) and _of_a_library(node, foreign):
        return f"it replaces {name} of {_get_root_name(node.value) or 'a library'}"
    return ""


def _find_hidden_part(name: str) -> bool:
    """Whether it is one of Python's own names, ``__dict__``, that lead into its insides."""
    return name.startswith("__") and name.endswith("__") and name not in DUNDERS


def _get_last_name(node: ast.AST) -> str:
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _is_plain_getattr(call: ast.Call | None) -> bool:
    """Whether the name that getattr is asked for can be read, and is an ordinary one."""
    if call is None or len(call.args) < 2 or not isinstance(call.args[1], ast.Constant):  # noqa: PLR2004 - of what, and which
        return False
    name = str(call.args[1].value)
    return not name.startswith("__") and name not in INSIDES | PARTLY.keys() | ATTRIBUTES


def _only_reads(call: ast.Call | None, *, mode_at: int) -> bool:
    if call is None or any(word.arg in {None, "opener"} for word in call.keywords):
        return False
    modes = [*call.args[mode_at : mode_at + 1]]
    modes += [word.value for word in call.keywords if word.arg == "mode"]
    return all(
        isinstance(one, ast.Constant) and str(one.value).strip("bt") == "r" for one in modes
    ) and not any(isinstance(one, ast.Starred) for one in call.args)


def _opens_named_text_file(call: ast.Call | None) -> bool:
    """Whether a call opens a text file whose name stands in the code."""
    name = call.args[0] if call is not None and call.args else None
    if not isinstance(name, ast.Constant) or not isinstance(name.value, str):
        return False
    return Path(name.value).suffix in NOTES and not name.value.startswith(("/dev", "/proc"))


def _list_foreign_names(tree: ast.Module, local: frozenset[str]) -> frozenset[str]:
    """The names that stand for something of a library: imported, or another name of that."""
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            module = getattr(node, "module", None) or ""
            within = bool(getattr(node, "level", 0)) or module.partition(".")[0] in local
            for alias in node.names:
                top = alias.name.partition(".")[0]
                if not within and (module or top not in local):
                    found.add(alias.asname or top)
    other_names: dict[str, set[str]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and not _is_called(node.value):
            names = {one.id for one in node.targets if isinstance(one, ast.Name)}
            other_names.setdefault(_get_root_name(node.value), set()).update(names)
    todo = [*found]
    while todo:
        more = other_names.get(todo.pop(), set()) - found
        found |= more
        todo += more
    return frozenset(found)


def _of_a_library(node: ast.Attribute, foreign: frozenset[str]) -> bool:
    """Whether setting this attribute changes a library, or an object of one."""
    kinds = [one for one in ast.walk(node.value) if _get_last_name(one) in {"type", "__class__"}]
    if kinds or (_get_root_name(node.value) in foreign and not _is_called(node.value)):
        return True
    own = isinstance(node.value, ast.Name) and node.value.id in {"self", "cls"}
    return not own and LIBRARY_METHOD.match(node.attr) is not None


def _get_root_name(node: ast.AST) -> str:
    while isinstance(node, ast.Attribute | ast.Subscript | ast.Call):
        node = node.func if isinstance(node, ast.Call) else node.value
    return node.id if isinstance(node, ast.Name) else ""


def _is_called(node: ast.AST) -> bool:
    return any(isinstance(one, ast.Call) for one in ast.walk(node))
