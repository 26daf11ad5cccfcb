"""All of a course that grading needs, as one piece that can travel to another machine."""

import hashlib
import io
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import MappingProxyType

from grader.student_data.fingerprint import list_authored_files

READABLE = 0o644


@dataclass(frozen=True)
class CourseBundle:
    """A course's exercises.

    Args:
        digest: of the content.
        content: a zip file.
    """

    digest: str
    content: bytes = field(repr=False)


def pack_course(course: Path) -> CourseBundle:
    """The exercises of a course, packed; the same files give the same bytes."""
    files = list_authored_files(course / "exercises")
    content = zip_files({path.relative_to(course).as_posix(): path.read_bytes() for path in files})
    return CourseBundle(hashlib.sha256(content).hexdigest(), content)


def zip_files(
    files: Mapping[str, bytes], *, rights: Mapping[str, int] = MappingProxyType({})
) -> bytes:
    """The content of a zip file; the same files give the same bytes.

    Args:
        files: path in it -> content.
        rights: path in it -> who may read and run the file, where that is not everybody's reading.
    """
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            info = zipfile.ZipInfo(name)  # its time is always 1980
            info.create_system = 3  # Unix, wherever it is packed: it keeps who may run a file
            info.external_attr = rights.get(name, READABLE) << 16
            archive.writestr(info, content, zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def unpack_course(given: Path | CourseBundle) -> Path:
    """The folder of a course: the given one, or one unpacked once in each process."""
    return given if isinstance(given, Path) else Path(_unpack_bundle(given).name)


@cache
def _unpack_bundle(given: CourseBundle) -> tempfile.TemporaryDirectory[str]:
    """A folder with the exercises, which is removed when this process ends."""
    folder = tempfile.TemporaryDirectory(prefix="course-", ignore_cleanup_errors=True)
    with zipfile.ZipFile(io.BytesIO(given.content)) as archive:
        archive.extractall(folder.name)
    return folder
