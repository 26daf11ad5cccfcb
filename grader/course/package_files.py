"""The files of a course that students get, chosen from a list and never by what lies about.

An instructor's course folder also holds solved exercises, notes, and what students handed in. A
file is packed if it is

    exercises/starters.toml and what it lists     the starters, as their authors wrote them
    README.md, hints.toml and checks.py           of an exercise, the modules checks.py imports, and
                                                  what these read: Path(__file__).with_name("…")
    answer_key.py                                 of an exercise, and what it imports and reads, but
                                                  not for a class that is graded
    lessons/NAME.py and lessons/NAME.ipynb        a notebook as it was derived, without outputs
    grader/ and sim/                              their Python files and page templates
    README.md, LICENSE, pyproject.toml            of the course

Everything else stays out and is named, so that nobody misses a file without knowing why.
"""

import ast
import hashlib
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from grader.answers.answer_key import FILE_NAME as KEY
from grader.answers.submission import explain_restore
from grader.exercise.exercise import Exercise, list_exercises
from grader.student_data.fingerprint import PACKAGES
from sim.core.errors import BadRequest
from sim.support.os_errors import refuse_os_errors

TOPS = ("LICENSE", "README.md", "pyproject.toml")
FOLDERS = ("exercises", "lessons")
STARTERS = "exercises/starters.toml"
AUTHORED = ("README.md", "hints.toml")  # of an exercise, besides checks.py and its modules
SOURCES = (
    ".py", ".md", ".html", ".jinja", ".js", ".css", ".svg", ".toml", "overrides.json",
    "probability.json", "setup.sh", "run_autograder",
)  # fmt: skip
"""Ends of names of what belongs to the packages."""
MADE = {"__pycache__", "data", "build", "dist"}  # by Python, and a learner's own data
IGNORED = {"Thumbs.db", "desktop.ini"}  # by Windows
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}
ID = 12  # [characters] of a cell's digest that name it: see .ci/derive_notebooks.py


@dataclass(frozen=True)
class PackageFiles:
    """The files of a course that students get.

    Args:
        files: path in the course folder -> content, in the order of the paths.
        left_out: files of exercises, lessons, grader and sim that are not part of the course.
    """

    files: dict[str, bytes]
    left_out: tuple[str, ...]

    def refuse_secret(self, secret: bytes) -> None:
        """Refuse to pack a class's secret.

        Args:
            secret: of the class; empty if there is none.

        Raises:
            BadRequest: a file holds it.
        """
        for name, content in self.files.items():
            if secret and secret in content:
                raise BadRequest(
                    "this file holds the class's secret, and would give it away",
                    where=name,
                    advice="Take the secret out of it.",
                )


def select_package_files(course: Path, *, with_keys: bool = True) -> PackageFiles:
    """The files of a course that students get.

    Args:
        course: the course folder. Where it holds no grader/ or sim/, those of the running
            installation are taken.
        with_keys: also the exercises' answer keys (``grader.answers.answer_key``), so that
            ``grade`` can check everything at home. A class that is graded gets none.

    Raises:
        BadRequest: it is not the whole course, or a starter or a notebook is not as it was written.
    """
    missing = [name for name in (*TOPS, *FOLDERS, STARTERS) if not (course / name).exists()]
    if missing:
        raise BadRequest(
            f"{missing[0]} is missing: this is not the whole course",
            where=str(course),
            advice="Run this in the folder the course was fetched into.",
        )
    starters = _read_starters(course)
    listed = {
        f"exercises/{name}/{file}": digest
        for name, files in starters.items()
        for file, digest in files.items()
    }
    chosen = {name: course / name for name in (*TOPS, STARTERS, *listed)}
    keys: dict[str, Path] = {}
    for one in list_exercises(course):
        _refuse_unlisted(one, starters.get(one.name, {}), course)
        checks, key = (find_imported_modules(one.folder / name) for name in ("checks.py", KEY))
        texts = {one.folder / name for name in AUTHORED if (one.folder / name).is_file()}
        chosen |= _name_files(checks | texts, top=course)
        keys |= _name_files(key - checks, top=course)
    chosen |= keys if with_keys else {}
    chosen |= _name_files(_list_lesson_files(course), top=course)
    packages = {one.name: _find_package_folder(course, one) for one in PACKAGES}
    for folder in packages.values():
        sources = [path for path in _list_files(folder) if path.name.endswith(SOURCES)]
        chosen |= _name_files(sources, top=folder.parent)
    chosen = {name: path for name, path in chosen.items() if not path.is_symlink()}
    files = {name: _read_content(name, chosen[name], course) for name in sorted(chosen)}
    _refuse_changed(files, listed, course)
    every = [path for top in (*FOLDERS, *packages) for path in _list_files(course / top)]
    left_out = _name_files(every, top=course).keys() - files.keys() - keys.keys()
    return PackageFiles(files, tuple(sorted(left_out)))


def _name_files(paths: Iterable[Path], *, top: Path) -> dict[str, Path]:
    """Path as seen from a folder -> file."""
    return {path.relative_to(top).as_posix(): path for path in paths}


def digest_starter(content: bytes) -> str:
    """The SHA-256 digest of a starter; Git may have turned its line ends into Windows's."""
    return hashlib.sha256(content.replace(b"\r\n", b"\n")).hexdigest()


@cache
def read_listed_files(exercise: Exercise) -> dict[str, str]:
    """Name -> digest, of an exercise's files that are listed as starters; empty without a list."""
    try:
        return _read_starters(exercise.folder.parents[1])[exercise.name]
    except (BadRequest, LookupError):
        return {}


def _read_starters(course: Path) -> dict[str, dict[str, str]]:
    """Exercise -> file name -> digest, of every starter.

    Raises:
        BadRequest: the list cannot be read.
    """
    path = course / STARTERS
    try:
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
        return {name: {**files} for name, files in raw.items()}
    except (OSError, ValueError, TypeError):
        raise BadRequest(
            "the list of starters cannot be read",
            where=str(path),
            advice=f"Get it back: {explain_restore(course, STARTERS)}",
        ) from None


def _refuse_unlisted(one: Exercise, listed: Mapping[str, str], course: Path) -> None:
    """Refuse an exercise with a starter that is not on the list."""
    unlisted = [file for file in one.starters if file not in listed]
    if unlisted:
        raise BadRequest(
            f"{one.name} has a starter {unlisted[0]} that is not listed",
            where=str(course / STARTERS),
            advice="List the unsolved starters again: python .ci/list_starters.py",
        )


def find_imported_modules(*modules: Path) -> set[Path]:
    """Modules of an exercise, with all modules and files that they import and read."""
    found: set[Path] = set()
    left = {path for path in modules if path.is_file()}
    while left:
        path = left.pop()
        found.add(path)
        if path.suffix == ".py":
            left |= {beside for beside in _find_imports(path) if beside.is_file()} - found
    return found


def _find_imports(module: Path) -> Iterator[Path]:
    for node in ast.walk(ast.parse(module.read_bytes())):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            names = [node.module] if node.module else [one.name for one in node.names]
            yield from (module.with_name(f"{name.partition('.')[0]}.py") for name in names)
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith(".with_name"):
            named = (one.value for one in node.args if isinstance(one, ast.Constant))
            yield from (module.with_name(str(name)) for name in named)


def _list_lesson_files(course: Path) -> Iterator[Path]:
    """Each lesson's text and the notebook derived from it."""
    for text in sorted((course / "lessons").glob("*.py")):
        if text.with_suffix(".ipynb").is_file():
            yield from (text, text.with_suffix(".ipynb"))


def _find_package_folder(course: Path, installed: Path) -> Path:
    """Where a package's files are taken from: the course folder, else the installation."""
    own = course / installed.name
    return own if (own / "__init__.py").is_file() else installed


def _list_files(top: Path) -> Iterator[Path]:
    """The files of a folder, without those that Python, Jupyter or a system made."""
    for path in sorted(top.rglob("*")):
        parts = path.relative_to(top).parts
        made = MADE & {*parts} or any(part.startswith(".") for part in parts)
        if not made and path.name not in IGNORED and (path.is_file() or path.is_symlink()):
            yield path


def _read_content(name: str, path: Path, course: Path) -> bytes:
    advice = f"Get it back: {explain_restore(course, name)}"
    with refuse_os_errors("students need it, and it cannot be read", Path(name), advice=advice):
        content = path.read_bytes()
    if not name.endswith(".ipynb"):
        return content
    return strip_notebook(content, name=name, course=course)


def strip_notebook(content: bytes, *, name: str, course: Path) -> bytes:
    """A notebook without outputs and without Jupyter's metadata.

    Args:
        content: of the notebook's file.
        name: of the notebook, for a refusal.
        course: the course folder, for a refusal.

    Raises:
        BadRequest: it is no notebook, or a cell was changed: its id, a digest of its text, does not
            fit.
    """
    from nbformat import reads, v4, writes  # noqa: PLC0415 - only who packs a course needs it

    try:
        notebook = reads(content.decode("utf-8"), 4)
        cells = [_strip_cell(cell) for cell in notebook.cells if cell.source.strip()]
    except (ValueError, TypeError, LookupError, AttributeError):
        raise BadRequest(
            "the notebook was edited (its cells are not those of the lesson's .py), and students "
            "would get that",
            where=name,
            advice="Keep a copy if you need it; then get it back: " + explain_restore(course, name),
        ) from None
    metadata = {"kernelspec": KERNEL, "language_info": {"name": "python"}}
    return f"{writes(v4.new_notebook(cells=cells, metadata=metadata))}\n".encode()


def _strip_cell(cell: Any) -> Any:  # noqa: ANN401 - nbformat has no types
    """A cell with its pictures, without outputs; of its metadata, whether its code is folded.

    Raises:
        ValueError: its text is not the one that its id was made of.
    """
    from nbformat import v4  # noqa: PLC0415 - the same

    if cell.id.partition("-")[0] != hashlib.sha256(cell.source.encode()).hexdigest()[:ID]:
        raise ValueError
    hidden = cell.metadata.get("jupyter", {}).get("source_hidden") is True
    make: Any = v4.new_code_cell if cell.cell_type == "code" else v4.new_markdown_cell
    kept = {"jupyter": {"source_hidden": True}} if hidden else {}
    pictures = {"attachments": cell.attachments} if "attachments" in cell else {}
    return make(cell.source, id=cell.id, metadata=kept, **pictures)


def _refuse_changed(files: dict[str, bytes], listed: dict[str, str], course: Path) -> None:
    """Refuse starters that are not as their authors wrote them: they may hold answers.

    Raises:
        BadRequest: one is missing or was changed.
    """
    changed = [
        name
        for name, digest in listed.items()
        if name not in files or digest_starter(files[name]) != digest
    ]
    if changed:
        several = "are starters that were" if len(changed) > 1 else "is a starter that was"
        raise BadRequest(
            f"{', '.join(changed)} {several} changed, and students would get your answers",
            where=str(course),
            advice="Copy away what you want to keep; then get the starters back: "
            + explain_restore(course, *changed),
        )
