"""The files of one submission: a folder, a zip file or a single file, read but never unpacked.

Zip files inside it are looked into once. Links are left out, and a folder is read through the
folders that were opened, so that nobody who can still write to it can exchange a file for a link
between the look and the reading. Limits keep a file that unpacks to gigabytes from being read.
"""

import io
import os
import stat
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import BinaryIO

MAX_FILES = 20_000  # of one student's: a whole robot project with its build has fewer
MAX_ZIP_ENTRIES = 200_000  # in one zip file, also of folders that nobody reads
MAX_TOTAL = 40_000_000  # [bytes] of everything that is read of one student's
MAX_PACKED = 50  # [bytes for one in a zip file] logs come to 10, and text that says nothing to 1000
LONGEST_SHOWN = 80  # [characters] of a file's name in a message
# What a computer makes and no student writes: caches, builds, and environments with their packages.
NOT_THEIRS = {"__pycache__", "__MACOSX", "build", "node_modules", "site-packages", "venv"}
COURSE_FOLDER = ".course"  # the only hidden folder that says something: whose numbers these are
ARCHIVES = (".zip", ".tar", ".tgz", ".tar.gz", ".tar.xz", ".tar.bz2", ".rar", ".7z")
UNREADABLE = (
    OSError, zipfile.BadZipFile, zlib.error, EOFError, struct.error, RuntimeError,
    NotImplementedError, ValueError,
)  # fmt: skip


def format_file_name(name: str, *, most: int = LONGEST_SHOWN) -> str:
    """A file's name as it can be printed."""
    return "".join(sign if sign.isprintable() else "?" for sign in name)[:most]


def is_archive(name: str) -> bool:
    """Whether a file's name is that of an archive; of these, only zip files can be read."""
    return name.lower().endswith(ARCHIVES)


@dataclass(frozen=True)
class SubmittedFile:
    """A file that may be an answer.

    Args:
        path: where it lies in the submission.
        read: its first bytes, as many as asked for; valid until the next file is taken.
    """

    path: PurePosixPath
    read: Callable[[int], bytes]

    def content(self, most: int) -> bytes:
        """Its bytes, one more than ``most`` at most.

        Raises:
            ValueError: it unpacks to far more than that.
        """
        return self.read(most + 1)


def list_submitted_files(place: Path, *, name: str = "") -> Iterator[SubmittedFile]:
    """All files of one submission.

    Args:
        place: a folder, a zip file or a single file.
        name: original name of that file; empty if it was not renamed.

    Raises:
        ValueError: there are too many files, they unpack to too much, or it is an archive that is
            no zip file. Damaged zip files and files that cannot be opened raise other errors;
            ``UNREADABLE`` lists them all.
    """
    for number, one in enumerate(_list_all_files(place, PurePosixPath(name or place.name))):
        if number >= MAX_FILES:
            raise ValueError(f"more than {MAX_FILES} files")
        if one.path.suffix.lower() != ".zip":  # in a zip file in a zip file is nobody's answer
            yield one


def _list_all_files(place: Path, name: PurePosixPath) -> Iterator[SubmittedFile]:
    for one in _list_outer_files(place, name):
        yield from _read_inner_zip(one) if one.path.suffix.lower() == ".zip" else (one,)


def _list_outer_files(place: Path, name: PurePosixPath) -> Iterator[SubmittedFile]:
    if place.is_dir():
        yield from _read_folder(place)
    elif name.suffix.lower() == ".zip":
        with _open_file(os.open(place, _OPEN)) as stream, zipfile.ZipFile(stream) as archive:
            yield from _read_zip(archive, PurePosixPath(name.stem))  # exercise4.zip: answers.toml
    elif is_archive(name.name):
        raise ValueError("it is an archive, but no zip file. Unpack it, or ask for a zip file")
    else:
        yield SubmittedFile(name, lambda size: _read_file(os.open(place, _OPEN), size))


def _read_inner_zip(found: SubmittedFile) -> Iterator[SubmittedFile]:
    """Files of a zip file inside a submission."""
    content = found.content(MAX_TOTAL)
    if len(content) > MAX_TOTAL:
        raise ValueError(
            f"{format_file_name(found.path.name)} is larger than {MAX_TOTAL / 1e6:g} MB"
        )
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        yield from _read_zip(archive, found.path.with_suffix(""))


# A link is never followed, and a pipe never waited for; Windows knows neither flag.
_OPEN = (
    os.O_RDONLY
    | getattr(os, "O_NOFOLLOW", 0)
    | getattr(os, "O_NONBLOCK", 0)
    | getattr(os, "O_BINARY", 0)
)


def _open_file(descriptor: int) -> BinaryIO:
    """An opened file to read.

    Raises:
        ValueError: it is a pipe or a device.
    """
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise ValueError("it contains something that is not a file")
    return os.fdopen(descriptor, "rb")


def _read_file(descriptor: int, size: int) -> bytes:
    with _open_file(descriptor) as stream:
        return stream.read(size)


def _read_folder(place: Path) -> Iterator[SubmittedFile]:
    """Files of a folder without its links, which may lead anywhere."""
    for top, folders, names, opened in _walk_folders(place):
        folders[:] = sorted((name for name in folders if _is_theirs(name)), key=os.fsencode)
        for name in sorted(names, key=os.fsencode):
            path = top / name
            status = os.stat(path if opened is None else name, dir_fd=opened, follow_symlinks=False)
            if stat.S_ISREG(status.st_mode):
                yield SubmittedFile(
                    PurePosixPath(path.relative_to(place).as_posix()),
                    lambda size, path=path, name=name, opened=opened: _read_file(  # type: ignore[misc]
                        os.open(path if opened is None else name, _OPEN, dir_fd=opened), size
                    ),
                )


def _walk_folders(place: Path) -> Iterator[tuple[Path, list[str], list[str], int | None]]:
    """Folder, names of its folders, names of its files, and the opened folder where there is one.

    Raises:
        OSError: a folder cannot be read.
    """

    def refuse(error: OSError) -> None:
        raise error

    if hasattr(os, "fwalk"):
        for top, folders, names, opened in os.fwalk(place, onerror=refuse, follow_symlinks=False):
            yield Path(top), folders, names, opened
    else:  # Windows, where a link needs a right that students do not have
        for top, folders, names in os.walk(place, onerror=refuse, followlinks=False):
            yield Path(top), folders, names, None


def _is_theirs(folder: str) -> bool:
    """Whether a folder may hold files that a student wrote."""
    return folder == COURSE_FOLDER or not (folder.startswith(".") or folder in NOT_THEIRS)


def _read_zip(archive: zipfile.ZipFile, top: PurePosixPath) -> Iterator[SubmittedFile]:
    if len(archive.infolist()) > MAX_ZIP_ENTRIES:
        raise ValueError(f"more than {MAX_ZIP_ENTRIES} files")
    for info in sorted(archive.infolist(), key=lambda one: one.filename):
        path = top / info.filename.replace("\\", "/").lstrip("/")
        link = stat.S_ISLNK(info.external_attr >> 16)
        if not (info.is_dir() or link) and all(map(_is_theirs, path.parts[:-1])):
            yield SubmittedFile(path, lambda size, info=info: _unpack_file(archive, info, size))  # type: ignore[misc]


def _unpack_file(archive: zipfile.ZipFile, info: zipfile.ZipInfo, size: int) -> bytes:
    if info.file_size > max(MAX_PACKED * info.compress_size, size // MAX_PACKED):
        raise ValueError(
            f"{format_file_name(info.filename)} unpacks to {info.file_size / 1e6:.1f} MB"
        )
    with archive.open(info) as stream:
        return stream.read(size)
