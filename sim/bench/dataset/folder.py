"""The folder of a dataset: files are written atomically, and foreign files are left alone."""

import hashlib
import os
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from sim.bench.dataset.key import Entry
from sim.bench.dataset.plan import LogJob
from sim.core.errors import BadRequest

MODIFIED = 946_684_800  # [s] 2000-01-01: real times would show how long each log took


@dataclass(frozen=True)
class FolderSurvey:
    """Which files of a planned dataset are in its folder already.

    Args:
        kept: entries of the finished logs.
        todo: jobs of the other logs.
        foreign: files with the name of a planned one, but another content.
        stale: entries of finished files that are no longer planned.
    """

    kept: tuple[Entry, ...]
    todo: tuple[LogJob, ...]
    foreign: tuple[str, ...]
    stale: tuple[Entry, ...]


def survey_folder(folder: Path, jobs: Sequence[LogJob], *, known: Iterable[Entry]) -> FolderSurvey:
    """Compare a folder with the files of a planned dataset.

    Args:
        folder: folder of the dataset; need not exist.
        jobs: the planned jobs.
        known: entries of logs that were finished earlier.

    Raises:
        BadRequest: it is not a folder, or cannot be read.
    """
    entries = {entry["plan"]: entry for entry in known}
    kept, todo, foreign = [], [], []
    try:
        if folder.exists() and not folder.is_dir():
            raise BadRequest(
                "this is not a folder", where=str(folder), advice="Name another with -o."
            )
        for job in jobs:
            entry = entries.pop(job.fingerprint, None)
            hashes = {file: compute_file_digest(folder / file) for file in job.files}
            there = {file: found for file, found in hashes.items() if found}
            if entry and hashes == entry["files"]:
                kept.append(entry)
                continue
            todo.append(job)
            foreign += [
                file for file, found in there.items() if not entry or entry["files"][file] != found
            ]
        stale = [
            entry
            for entry in entries.values()
            if any((folder / file).exists() for file in entry["files"])
        ]
    except OSError as error:
        raise _cannot(error, folder) from None
    return FolderSurvey(tuple(kept), tuple(todo), tuple(foreign), tuple(stale))


def compute_file_digest(path: Path) -> str:
    """SHA-256 of a file; empty if there is none.

    Raises:
        OSError: it exists, but cannot be read.
    """
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except FileNotFoundError:
        return ""


def list_unknown_logs(folder: Path, *, known: Iterable[str]) -> tuple[str, ...]:
    """Log files in the folder that do not belong to the dataset."""
    mine = set(known)
    endings = {Path(file).suffix for file in mine}
    found = (
        path.relative_to(folder).as_posix()
        for path in sorted(folder.rglob("*"))
        if path.suffix in endings
    )
    return tuple(file for file in found if file not in mine)


class DatasetFolder:
    """The folder that a dataset is written to; each file is written atomically.

    Args:
        folder: folder of the dataset; created if needed.
        mine: files in it that may be replaced; None if all may.
    """

    def __init__(self, folder: Path, *, mine: Iterable[str] | None) -> None:
        self.folder = folder
        self.mine = None if mine is None else set(mine)
        self._made: list[Path] = []

    def create(self) -> None:
        """Create the folder.

        Raises:
            BadRequest: it cannot be created.
        """
        self._create_folder(self.folder)

    def write_files(self, contents: Mapping[str, bytes]) -> None:
        """Write the files of one log.

        Args:
            contents: path in the folder -> bytes of the file.

        Raises:
            BadRequest: the disk is full, for example, or another program wrote such a file.
        """
        for file, content in contents.items():
            path = self.folder / file
            part = path.with_name(f".{path.name}.part")
            self._create_folder(path.parent)
            if self.mine is not None and file not in self.mine and path.exists():
                raise BadRequest(
                    "another program wrote this file in the meantime",
                    where=str(path),
                    advice="Let the other program finish, then run the same command again.",
                )
            try:
                part.write_bytes(content)
                os.utime(part, (MODIFIED, MODIFIED))
                part.replace(path)
            except OSError as error:
                raise _cannot(error, path) from None
            finally:
                with suppress(OSError):  # it exists only after an error
                    part.unlink()

    def remove_empty_folders(self) -> None:
        """Remove the folders that were created here and are empty."""
        for folder in reversed(self._made):
            with suppress(OSError):  # it is not empty
                folder.rmdir()

    def _create_folder(self, folder: Path) -> None:
        """Create a folder and its parents, and remember which were missing."""
        missing = []
        try:
            while not folder.exists():
                missing.append(folder)
                folder = folder.parent
            for one in reversed(missing):
                folder = one
                folder.mkdir(exist_ok=True)
                self._made.append(folder)
        except OSError as error:
            raise _cannot(error, folder) from None


def _cannot(error: OSError, path: Path) -> BadRequest:
    """The error for a path that cannot be written."""
    return BadRequest(
        f"cannot be written ({error.strerror or error})",
        where=str(path),
        advice="Make room there, or name a folder you may write to; then run the same command "
        "again: what is finished is kept.",
    )
