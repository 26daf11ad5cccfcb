"""Runs the Java programs of this folder under Java and checks, or rewrites, what they print.

    python tests/java_programs/run_java.py [--write] [TOPIC ...]

A file holds the programs of one topic. A program is a line ``=== its name``, a whole source file
with a class ``Main``, a line ``--- prints``, and what Java prints. An exception that the program
does not catch is the last line of it: ``!! java.lang.ArithmeticException: / by zero``. Trailing
newlines of the whole output do not count. Needs a JDK, version 17 or newer.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

FOLDER = Path(__file__).parent
TIME = 600.0  # [s] for all programs, on a busy machine


@dataclass(frozen=True)
class JavaTestProgram:
    """A Java program and what it prints."""

    name: str
    source: str
    prints: str


def read_programs(path: Path) -> list[JavaTestProgram]:
    """The programs of one topic, in the order of the file."""
    _, *parts = re.split(r"^=== (.+)\n", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    programs = []
    for name, text in zip(parts[::2], parts[1::2], strict=True):
        source, _, prints = text.partition("\n--- prints\n")
        programs.append(JavaTestProgram(name, source.rstrip() + "\n", prints.rstrip("\n")))
    return programs


def run_under_java(programs: list[JavaTestProgram], java: str = "java") -> list[str]:
    """What each program prints under Java; all run in one Java process."""
    with tempfile.TemporaryDirectory() as name:
        folders = [Path(name, str(number)) for number, _ in enumerate(programs)]
        for folder, program in zip(folders, programs, strict=True):
            folder.mkdir()
            (folder / "Main.java").write_text(program.source, encoding="utf-8")
        options = ("-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1")  # they start faster
        subprocess.run(
            [java, *options, str(FOLDER / "RunEach.java"), name], check=True, timeout=TIME
        )
        return [(one / "prints").read_text(encoding="utf-8").rstrip("\n") for one in folders]


def main(arguments: list[str]) -> None:
    """Check, or with ``--write`` rewrite, what the programs of all or some topics print."""
    topics = [FOLDER / f"{name}.txt" for name in arguments if name != "--write"]
    found = {path: read_programs(path) for path in topics or sorted(FOLDER.glob("*.txt"))}
    outputs = iter(run_under_java([one for programs in found.values() for one in programs]))
    faults = []
    for path, programs in found.items():
        run = [replace(one, prints=next(outputs)) for one in programs]
        for old, new in zip(programs, run, strict=True):
            if new.prints.startswith("?? ") or ("--write" not in arguments and old != new):
                faults.append(f"{path.name}, {new.name!r}: Java prints\n{new.prints}")
        if "--write" in arguments:
            texts = [f"=== {one.name}\n{one.source}--- prints\n{one.prints}\n" for one in run]
            path.write_text("\n".join(texts), encoding="utf-8")
    if faults:
        sys.exit("\n\n".join(faults))
    sys.stdout.write(f"{sum(map(len, found.values()))} programs in {len(found)} files\n")


if __name__ == "__main__":
    shutil.which("javac") or sys.exit("no javac on PATH: install a JDK, version 17 or newer")
    main(sys.argv[1:])
