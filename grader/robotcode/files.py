"""The file in hand and its neighbours of the same language, parsed when a name leads to them."""

import os
from pathlib import Path

from grader.robotcode.ir import Module
from grader.robotcode.source import LARGEST, detect_language, read_source
from sim.core.errors import UnreadableFile

MOST_FILES = 200  # neighbours looked at; a robot program has about fifty
MOST_FOLDERS = 500  # folders walked through on the way
LEVELS_UP = 2  # folders above its own in which a Python file may find its imports
_BUILT = frozenset({"build", "bin", "out", "node_modules", "__pycache__", "venv", "ctre_sim"})

Found = tuple[Module, tuple[str, ...]]  # a file, and the names still to be looked up in it


class Files:
    """A source file and those it may import.

    Args:
        path: the file in hand.

    Raises:
        UnreadableFile: it is no readable source text.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.main = _parsed(path)
        self._modules: dict[Path, Module | None] = {path: self.main}
        self._found: dict[tuple[str, int, Path], Found | None] = {}
        self._java: dict[str, list[Path]] | None = None

    def find(self, name: str, *, level: int = 0, seen_from: Module) -> Found | None:
        """Find the file that a dotted name begins with.

        Args:
            name: ``frc.robot.Constants.DriveConstants``, ``Constants``, ``constants.kRamp``.
            level: leading dots of a relative Python import.
            seen_from: the file that uses the name.

        Returns:
            The file, and the part of the name that is left; None where there is no such file, or
            more than one that it could be.
        """
        key = (name, level, seen_from.path)
        if key not in self._found:
            parts = tuple(part for part in name.split(".") if part)
            if seen_from.language == "java":
                self._found[key] = self._find_java(parts, seen_from)
            else:
                self._found[key] = self._find_python(parts, level, seen_from)
        return self._found[key]

    def find_by_word(self, word: str) -> list[Module]:
        """The Java files of the program whose text contains a word, in the order of their paths."""
        paths = sorted(path for several in self._java_files().values() for path in several)
        found = (self._module(path) for path in paths if _has_word(path, word))
        return [module for module in found if module is not None]

    def _find_java(self, parts: tuple[str, ...], seen_from: Module) -> Found | None:
        start = next((i for i, part in enumerate(parts) if part[:1].isupper()), None)
        if start is None:
            return None
        candidates = self._java_files().get(parts[start], [])
        package = parts[:start]
        if len(candidates) > 1 and package:
            candidates = [c for c in candidates if c.parent.parts[-start:] == package]
        elif len(candidates) > 1:
            candidates = [c for c in candidates if c.parent == seen_from.path.parent]
        module = self._module(candidates[0]) if len(candidates) == 1 else None
        return None if module is None else (module, parts[start:])

    def _find_python(self, parts: tuple[str, ...], level: int, seen_from: Module) -> Found | None:
        folder = seen_from.path.parent
        if level:
            folders = [folder, *folder.parents][level - 1 : level]
        else:
            folders = [folder, *folder.parents][: LEVELS_UP + 1]
        for top in folders:
            for length in range(len(parts), 0, -1):
                stem = top.joinpath(*parts[:length])
                for path in (stem.with_name(f"{stem.name}.py"), stem / "__init__.py"):
                    if _is_own_file(path):
                        module = self._module(path)
                        return None if module is None else (module, parts[length:])
        return None

    def _java_files(self) -> dict[str, list[Path]]:
        """The Java files of the program by their stem, from its package's top folder down."""
        if self._java is None:
            self._java = {self.path.stem: [self.path]}
            count = 0
            for path in _walk(self._top(), ".java"):
                if path != self.path:
                    self._java.setdefault(path.stem, []).append(path)
                    count += 1
                if count == MOST_FILES:
                    break
        return self._java

    def _top(self) -> Path:
        """The folder above all folders that the file's package names and that are really there."""
        folder = self.path.parent
        for part in reversed(self.main.package.split(".")):
            if not part or folder.name != part:
                break
            folder = folder.parent
        return folder

    def _module(self, path: Path) -> Module | None:
        """A neighbour, parsed; None if it cannot be read without doubt."""
        if path not in self._modules:
            try:
                module = _parsed(path) if len(self._modules) < MOST_FILES else None
            except UnreadableFile:
                module = None
            self._modules[path] = None if module is None or module.problems else module
        return self._modules[path]


def _has_word(path: Path, word: str) -> bool:
    """Whether a file's text has a word, so that only such files are parsed."""
    try:
        return word.encode() in path.read_bytes() if path.stat().st_size <= LARGEST else False
    except OSError:
        return False


def _is_own_file(path: Path) -> bool:
    """Whether there is such a file, and no link; a name that no system can hold is no file."""
    try:
        return path.is_file() and not path.is_symlink()
    except OSError:
        return False


def _walk(top: Path, suffix: str) -> list[Path]:
    """Source files under a folder; links and built or hidden folders are left alone."""
    found: list[Path] = []
    for visited, (folder, folders, files) in enumerate(os.walk(top)):
        folders[:] = sorted(f for f in folders if f not in _BUILT and not f.startswith("."))
        paths = (Path(folder, name) for name in sorted(files) if name.endswith(suffix))
        found += [path for path in paths if not path.is_symlink()]
        if len(found) > MOST_FILES or visited == MOST_FOLDERS:
            break
    return found


def _parsed(path: Path) -> Module:
    language = detect_language(path)
    text = read_source(path)
    if language == "java":
        from grader.robotcode import java  # noqa: PLC0415 - no tree-sitter for Python

        return java.parse(text, path)
    from grader.robotcode import python  # noqa: PLC0415 - no ast for Java

    return python.parse(text, path)
