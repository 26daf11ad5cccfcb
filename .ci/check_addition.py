"""Check an addition whole, and say in words what is missing.

    python .ci/check_addition.py sim/bench/mechanisms/wrist.py
    python .ci/check_addition.py exercises/exercise14

It runs the linters, then the tests of that folder's contract for what was added.
"""

import shlex
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
    "sim/bench/mechanisms": Contract(
        "simulate physics wpilib_simulations by_mujoco faults", "struck"
    ),
    "sim/physics/effects": Contract("effects engine by_mujoco"),
    "sim/inspect/faults": Contract(
        "faults contaminate sentences", "struck sound catalogue sentences_of_inspect"
    ),
    "sim/io/formats": Contract("formats", "formats"),
    "sim/report/robot_code": Contract("robot_code_snippet fit_command", "paste"),
    "exercises": Contract(
        "exercises traceability instructors readme package_keys package_files guessing",
        "every_exercise guide item list_of_starters",
    ),
    "lessons": Contract(
        "lessons traceability readme",
        "equals_its_derivation links_to pictures_of there_are guide_lists every_exercise pinned",
    ),
    "tests/robotcode": Contract("robotcode_corpus", "every_row"),
    "grader/classroom/exports": Contract("class_exports instructors", "export"),
}

LINTERS = (["ruff", "check", "."], ["ruff", "format", "--check", "."], ["mypy"])


def list_tests(path: Path) -> list[list[str]]:
    """The modules to run, with their arguments, that check an addition.

    Args:
        path: what was added, from the course's folder: a file or a folder.
    """
    folder = path.parent.as_posix()
    if folder not in CONTRACTS or not (ROOT / path).exists():
        sys.exit(f"{path.as_posix()}: name what you added in one of: {', '.join(CONTRACTS)}")
    contract = CONTRACTS[folder]
    name = path.name[:2] if folder == "lessons" else path.stem
    words = dict.fromkeys([name, name.replace("_", "-"), *contract.words.split()])
    files = [f"tests/test_{one}.py" for one in contract.tests.split()]
    tests = ["pytest", "-q", "-n", "0", "--tb=short", "-k", " or ".join(words), *files]
    return [["grader", "check-course", name], tests] if folder == "exercises" else [tests]


def run_module(command: list[str]) -> bool:
    """Run a module of Python with its arguments; whether it succeeded."""
    print(f"== python -m {shlex.join(command)}", flush=True)
    done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, check=False)
    return done.returncode == 0


if __name__ == "__main__":
    paths = sys.argv[1:] or sys.exit(__doc__)
    commands = [one for given in paths for one in list_tests(Path(given))]
    failed = [shlex.join(one) for one in (*LINTERS, *commands) if not run_module(one)]
    told = [f"not in order, see above: python -m {one}" for one in failed]
    print("\n".join(told) or "all in order")
    sys.exit(1 if failed else 0)
