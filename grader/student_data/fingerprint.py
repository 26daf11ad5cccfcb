"""Digests of the code and of folders, by which stored results are known to be valid."""

import hashlib
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

KINDS = (".py", ".toml", ".md", ".java")  # of a course's files; its data are drawn, not sent
PACKAGES = tuple(Path(__file__).resolve().parents[2] / name for name in ("grader", "sim"))


def fingerprint_folders(*tops: Path) -> str:
    """A digest of these folders, and of the packages ``grader`` and ``sim``."""
    return fingerprint_packages((*tops, *PACKAGES))


def fingerprint_packages(tops: Iterable[Path]) -> str:
    """A digest of the authored files in these folders."""
    found = hashlib.sha256()
    for top in tops:
        for path in list_authored_files(top):
            found.update(f"{top.name}/{path.relative_to(top).as_posix()}\0".encode())
            with suppress(OSError):  # whoever needs it says so; a digest does not
                found.update(hashlib.sha256(path.read_bytes()).digest())
    return found.hexdigest()


def list_authored_files(top: Path) -> list[Path]:
    """The files that an author wrote in a folder, in order."""
    return sorted(
        path
        for path in top.rglob("*")
        if path.suffix in KINDS and not {"data", "__pycache__"} & {*path.relative_to(top).parts}
    )
