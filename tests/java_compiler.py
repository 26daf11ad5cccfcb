"""Compiles robot code with javac, against stubs of the library classes that it uses.

The stubs in ``java_stubs/season2026`` are signatures without bodies, one file a class of WPILib,
Phoenix 6 or REVLib, and each names its source.
"""

import re
import shutil
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import pytest

STUBS = Path(__file__).with_name("java_stubs")
OLDEST = 17  # the JDK of WPILib 2026
TIME = 300.0  # [s] for all programs, on a busy machine


@dataclass(frozen=True)
class JavaProgram:
    """Java files that are compiled together.

    Args:
        files: its source files.
    """

    files: tuple[Path, ...]


@dataclass(frozen=True)
class JavaError:
    """One error of javac."""

    file: Path
    line: int
    message: str


def find_java() -> str:
    """The program java of a JDK that is new enough; skips the test where there is none."""
    compiler = shutil.which("javac")
    if compiler is None:
        pytest.skip(f"no javac on PATH: install a JDK, version {OLDEST} or newer")
    # macOS has a javac without a JDK, which says so and fails.
    asked = subprocess.run(
        [compiler, "-version"], capture_output=True, encoding="utf-8", timeout=TIME, check=False
    )
    version = re.search(r"javac (\d+)", asked.stdout)
    if asked.returncode or version is None or int(version[1]) < OLDEST:
        said = (asked.stdout + asked.stderr).strip() or "nothing"
        pytest.skip(f"javac -version says {said!r}: install a JDK, version {OLDEST} or newer")
    java = shutil.which("java", path=str(Path(compiler).resolve().parent)) or shutil.which("java")
    return java or pytest.skip("no java beside javac")


def compile_java(programs: Iterable[JavaProgram], folder: Path) -> list[list[JavaError]]:
    """Compile programs, each for itself, in one Java process.

    Args:
        programs: what to compile.
        folder: an empty folder for the stubs and their classes.

    Returns:
        The errors of each program, in the order of the programs.
    """
    java = find_java()
    stubs = shutil.copytree(STUBS, folder, dirs_exist_ok=True) / "season2026"
    given = list(programs)
    rows = ["\t".join(map(str, (stubs, *one.files))) + "\n" for one in given]
    done = subprocess.run(
        [java, "-XX:TieredStopAtLevel=1", str(STUBS / "CompileEach.java")],
        input="".join(rows),
        capture_output=True,
        encoding="utf-8",
        timeout=TIME,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found: list[list[JavaError]] = [[] for _ in given]
    for row in done.stdout.splitlines():
        number, file, line, message = row.split("\t", 3)
        found[int(number)].append(JavaError(Path(file), int(line), message))
    return found
