"""Compiles robot code with javac, against stubs of the library classes that it uses.

The stubs in ``java_stubs/`` are signatures without bodies, one file a class, and each names its
source. ``season2026`` has WPILib, Phoenix 6, REVLib and AdvantageKit. ``season2027`` has the WPILib
classes that changed with it; the others are those of 2026 under their new packages.
"""

import re
import shutil
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import pytest

STUBS = Path(__file__).with_name("java_stubs")
MOVED_IN_2027 = {  # packages of which nothing else changed that the stubs have
    "edu.wpi.first.units": "org.wpilib.units",
    "edu.wpi.first.math": "org.wpilib.math",
    "edu.wpi.first.wpilibj.event": "org.wpilib.event",
    "edu.wpi.first.wpilibj2.command": "org.wpilib.command2",
    "edu.wpi.first.wpilibj.motorcontrol": "org.wpilib.hardware.motor",
}
VENDORS = ("com.ctre", "com.revrobotics", "org.littletonrobotics")  # ... which keep theirs
RENAMED_IN_2027 = {  # what WPILib's MotorController wants of every motor controller
    "void set(double speed)": "void setThrottle(double throttle)",
    "double get()": "double getThrottle()",
}
GONE_IN_2027 = re.compile(r"  public \w+\(int deviceId, String canbus\) \{\}\n\n")  # Phoenix 6
LEFT_OUT_IN_2027 = ("button", "sysid", "motorcontrol")  # folders that season2027 has of its own
OLDEST = 17  # the JDK of WPILib 2026
TIME = 300.0  # [s] for all programs, on a busy machine


@dataclass(frozen=True)
class JavaProgram:
    """Java files that are compiled together.

    Args:
        files: its source files.
        season: whose classes it is compiled against.
    """

    files: tuple[Path, ...]
    season: int = 2026


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


def write_stubs(folder: Path) -> None:
    """Write the stubs of each season into ``folder/season2026`` and ``folder/season2027``."""
    shutil.copytree(STUBS / "season2026", folder / "season2026")
    newer = folder / "season2027"
    for path in sorted((STUBS / "season2026").rglob("*.java")):
        package = ".".join(path.relative_to(STUBS / "season2026").parts[:-1])
        own = package.startswith("edu.wpi") and package.endswith(LEFT_OUT_IN_2027)
        if own or not package.startswith((*MOVED_IN_2027, *VENDORS)):
            continue
        text = GONE_IN_2027.sub("", path.read_text(encoding="utf-8"))
        for old, new in (MOVED_IN_2027 | RENAMED_IN_2027).items():
            text = text.replace(old, new)
        home = re.search(r"^package ([\w.]+);", text, re.MULTILINE)
        assert home, path
        place = newer.joinpath(*home[1].split("."), path.name)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
    shutil.copytree(STUBS / "season2027", newer, dirs_exist_ok=True)


def compile_java(programs: Iterable[JavaProgram], folder: Path) -> list[list[JavaError]]:
    """Compile programs, each for itself, in one Java process.

    Args:
        programs: what to compile.
        folder: an empty folder for the stubs and their classes.

    Returns:
        The errors of each program, in the order of the programs.
    """
    java = find_java()
    write_stubs(folder)
    given = list(programs)
    rows = [
        "\t".join(map(str, (folder / f"season{one.season}", *one.files))) + "\n" for one in given
    ]
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
