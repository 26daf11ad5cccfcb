"""Whether a tag may be published: it names the version, and the changelog has it with its date.

    python .ci/check_release.py v0.1.0

Exit code 0 if it may, else 2 with one line that says why.
"""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def find_problem(tag: str, *, pyproject: str, changelog: str) -> str:
    """What is wrong with a release, in one line; empty if nothing is.

    Args:
        tag: as git has it: ``v`` and the version.
        pyproject: text of pyproject.toml.
        changelog: text of CHANGELOG.md.
    """
    version = tomllib.loads(pyproject)["project"]["version"]
    if tag != f"v{version}":
        return (
            f"the tag is {tag}, and pyproject.toml has version {version}. "
            f"Change one of them: the tag has to be v{version}."
        )
    heading = re.search(rf"^## {re.escape(version)} \((.*)\)$", changelog, re.MULTILINE)
    if heading is None or not re.fullmatch(r"\d{4}-\d{2}-\d{2}", heading[1]):
        return (
            f"CHANGELOG.md has no date for version {version}. "
            f"Write the day into its heading: ## {version} (2026-02-14)"
        )
    return ""


def main(arguments: list[str]) -> int:
    """Check a tag; 0 if it may be published, 2 if not."""
    if len(arguments) != 1:
        print("check_release: give one tag: python .ci/check_release.py v0.1.0", file=sys.stderr)
        return 2
    problem = find_problem(
        arguments[0],
        pyproject=(ROOT / "pyproject.toml").read_text(encoding="utf-8"),
        changelog=(ROOT / "CHANGELOG.md").read_text(encoding="utf-8"),
    )
    if problem:
        print(f"check_release: {problem}", file=sys.stderr)
    return 2 if problem else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
