"""The files of one submission: a folder, a zip file or a single file, read but never unpacked.

Zip files inside it are looked into once. Links are left out, and limits keep a file that unpacks
to gigabytes from being read.
"""

import io
import os
import stat
import struct
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

MOST_SEEN = 20_000  # [entries] of one student's: a whole robot project with its build has fewer
LARGEST_WHOLE = 40_000_000  # [bytes] of everything that is read of one student's
MOST_PACKED = (
    50  # [bytes for one in a zip file] logs come to 10, and text that says nothing to 1000
)
LONGEST_SHOWN = 80  # [characters] of a file's name in a message
NOT_THEIRS = {"__pycache__", "__MACOSX", ".git", ".gradle", "build"}
UNREADABLE = (
    OSError, zipfile.BadZipFile, zlib.error, EOFError, struct.error, RuntimeError,
    NotImplementedError, ValueError,
)  # fmt: skip


def format_file_name(name: str, *, most: int = LONGEST_SHOWN) -> str:
    """A file's name as it can be printed."""
    return "".join(sign if sign.isprintable() else "?" for sign in name)[:most]


@dataclass(frozen=True)
class SubmittedFile:
    """A file that may be an answer: where it stood, and how to get at it."""

    path: PurePosixPath
    read: Path | tuple[zipfile.ZipFile, zipfile.ZipInfo]

    def content(self, most: int) -> bytes:
        """Its bytes, one more than ``most`` at most."""
        if isinstance(self.read, Path):
            with self.read.open("rb") as stream:
                return stream.read(most + 1)
        archive, info = self.read
        if info.file_size > max(MOST_PACKED * info.compress_size, most // MOST_PACKED):
            raise ValueError(
                f"{format_file_name(info.filename)} unpacks to {info.file_size / 1e6:.1f} MB"
            )
        with archive.open(info) as stream:
            return stream.read(most + 1)


def list_submitted_files(place: Path, *, name: str = "") -> Iterator[SubmittedFile]:
    """All files of one thing that was handed in.

    Args:
        place: a folder, a zip file or a single file.
        name: what the student called that file; empty if it is called so still.

    Raises:
        ValueError: there are too many files, or they unpack to too much. Damaged zip files and
            files that cannot be opened raise other errors; ``UNREADABLE`` lists them all.
    """
    if place.is_dir():
        for one in _read_folder(place):
            yield from _read_inner_zip(one) if _is_zip(one.path) else (one,)
        return
    name = name or place.name
    if not _is_zip(PurePosixPath(name)):
        yield SubmittedFile(PurePosixPath(name), place)
        return
    top = PurePosixPath(PurePosixPath(name).stem)  # exercise4.zip may hold answers.toml alone
    with zipfile.ZipFile(place) as archive:
        for one in _read_zip(archive, top):
            yield from _read_inner_zip(one) if _is_zip(one.path) else (one,)


def _is_zip(path: PurePosixPath) -> bool:
    return path.suffix.lower() == ".zip"


def _read_inner_zip(found: SubmittedFile) -> Iterator[SubmittedFile]:
    """Files of a zip file inside what was handed in; zip files in that are nobody's answer."""
    content = found.content(LARGEST_WHOLE)
    if len(content) > LARGEST_WHOLE:
        raise ValueError(
            f"{format_file_name(found.path.name)} is larger than {LARGEST_WHOLE / 1e6:g} MB"
        )
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for one in _read_zip(archive, found.path.with_suffix("")):
            if not _is_zip(one.path):
                yield one


def _read_folder(place: Path) -> Iterator[SubmittedFile]:
    """Files of a folder; a link is nobody's answer: it may lead anywhere."""
    seen = 0
    for top, folders, names in os.walk(place, followlinks=False):
        folders[:] = sorted((name for name in folders if name not in NOT_THEIRS), key=os.fsencode)
        for name in sorted(names, key=os.fsencode):
            seen += 1
            if seen > MOST_SEEN:
                raise ValueError(f"more than {MOST_SEEN} files")
            path = Path(top) / name
            if path.is_file() and not path.is_symlink():
                yield SubmittedFile(PurePosixPath(path.relative_to(place).as_posix()), path)


def _read_zip(archive: zipfile.ZipFile, top: PurePosixPath) -> Iterator[SubmittedFile]:
    if len(archive.infolist()) > MOST_SEEN:
        raise ValueError(f"more than {MOST_SEEN} files")
    for info in sorted(archive.infolist(), key=lambda one: one.filename):
        path = top / info.filename.replace("\\", "/").lstrip("/")
        link = stat.S_ISLNK(info.external_attr >> 16)
        if not (info.is_dir() or link or {*path.parts} & NOT_THEIRS):
            yield SubmittedFile(path, (archive, info))
