"""Where the project lies, and what lies in a folder."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def read_all(folder: Path) -> dict[str, bytes]:
    """Everything in a folder, by its path there."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
