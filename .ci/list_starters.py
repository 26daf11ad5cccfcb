"""List the starters of all exercises with their digests: exercises/*/ -> exercises/starters.toml.

    python .ci/list_starters.py            write the list
    python .ci/list_starters.py --check    only say whether it is out of date; exit code 1 if so

grade release packs a starter only if it is as listed, so that nobody's answers reach students.
Besides what an exercise names in FILES and BESIDE, the list keeps every file that stands in it
already, such as a script that learners run.
"""

import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from grader.course.package_files import STARTERS, digest_starter  # noqa: E402 - the same
from grader.exercise.exercise import Exercise, list_exercises  # noqa: E402 - the course in this folder

LIST = ROOT / STARTERS
HEAD = "# Digests of the starters as authored. Written by: python .ci/list_starters.py\n"


def list_starters(old: dict[str, dict[str, str]]) -> str:
    """The text of the list.

    Args:
        old: exercise -> file -> digest, as listed so far.
    """
    return HEAD + "".join(
        _write_section(one, old.get(one.name, {})) for one in list_exercises(ROOT)
    )


def _write_section(one: Exercise, old: dict[str, str]) -> str:
    names = {name for name in old if (one.folder / name).is_file()} | {
        *one.files,
        *one.companion_files,
    }
    lines = [
        f'"{name}" = "{digest_starter((one.folder / name).read_bytes())}"\n'
        for name in sorted(names)
    ]
    return "".join([f"\n[{one.name}]\n", *lines])


def main(arguments: list[str]) -> int:
    """Write the list, or check it."""
    before = LIST.read_text(encoding="utf-8") if LIST.exists() else ""
    now = list_starters(tomllib.loads(before))
    if now == before:
        return 0
    if "--check" in arguments:
        print("a starter was changed: run  python .ci/list_starters.py")
        return 1
    LIST.write_text(now, encoding="utf-8", newline="\n")
    print(f"wrote {STARTERS}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
