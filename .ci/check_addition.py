"""Check an addition whole, and say in words what is missing.

    python .ci/check_addition.py sim/bench/mechanisms/wrist.py
    python .ci/check_addition.py exercises/exercise14

It runs the tests of that folder's contract for what was added, then the linters.
"""

import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]


class Contract(NamedTuple):
    """The tests of what a folder may hold.

    Args:
        tests: names of the files in ``tests/``.
        words: tests to run besides those with the addition's name in theirs.
    """

    tests: str
    words: str = ""


CONTRACTS = {
    "sim/bench/mechanisms": Contract("simulate physics wpilib_simulations"),
    "sim/physics/effects": Contract("effects"),
    "sim/inspect/faults": Contract("faults contaminate", "sound or list"),
    "sim/io/formats": Contract("formats", "formats"),
    "sim/report/robot_code": Contract("controller_snippet fit_command", "paste"),
    "exercises": Contract(
        "exercises traceability instructors readme package_keys package_files guessing",
        "every_exercise or guide or item or list_of_starters",
    ),
    "lessons": Contract("lessons traceability readme", "lessons"),
    "tests/robotcode": Contract("robotcode_corpus", "every_row"),
    "grader/classroom/exports": Contract("class_exports instructors", "export"),
}


def check_addition(path: Path) -> bool:
    """Run all checks of an addition; whether it is in order.

    Args:
        path: what was added, from the course's folder: a file or a folder.
    """
    folder = path.parent.as_posix()
    if folder not in CONTRACTS or not (ROOT / path).exists():
        print(f"{path.as_posix()}: name what you added in one of: {', '.join(CONTRACTS)}")
        return False
    contract = CONTRACTS[folder]
    name = re.match(r"\d\d|[^.]+", path.name)[0]  # a lesson goes by its number
    words = " or ".join(filter(None, (name, name.replace("_", "-"), contract.words)))
    files = [f"tests/test_{one}.py" for one in contract.tests.split()]
    commands = [
        ["pytest", "-q", "-n", "0", "--tb=short", "-k", words, *files],
        ["ruff", "check", "."],
        ["ruff", "format", "--check", "."],
        ["mypy"],
    ]
    if folder == "exercises":
        commands.insert(0, ["grader", "check-course", name])
    return not [one for one in commands if not _run(one)]


def _run(command: list[str]) -> bool:
    print(f"== {' '.join(command)}", flush=True)
    return subprocess.run([sys.executable, "-m", *command], cwd=ROOT, check=False).returncode == 0


if __name__ == "__main__":
    passed = [check_addition(Path(given)) for given in sys.argv[1:]]
    print("In order." if passed and all(passed) else "Not in order: see above.")
    sys.exit(not (passed and all(passed)))
