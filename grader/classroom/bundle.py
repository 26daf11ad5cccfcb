"""All of a course that grading needs, as one piece that can travel to another machine."""

import hashlib
import io
import tempfile
import zipfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from grader.fingerprint import list_authored_files


@dataclass(frozen=True)
class CourseBundle:
    """A course's exercises.

    Args:
        digest: of the content.
        content: a zip file.
    """

    digest: str
    content: bytes

    def __repr__(self) -> str:
        """Without the content."""
        return f"Bundle({self.digest[:8]})"


def pack_course(course: Path) -> CourseBundle:
    """The exercises of a course, packed; the same files give the same bytes."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in list_authored_files(course / "exercises"):
            info = zipfile.ZipInfo(path.relative_to(course).as_posix())  # its time is always 1980
            archive.writestr(info, path.read_bytes(), zipfile.ZIP_DEFLATED)
    content = stream.getvalue()
    return CourseBundle(hashlib.sha256(content).hexdigest(), content)


def unpack_course(given: Path | CourseBundle) -> Path:
    """The folder of a course: as it is, or unpacked once in each process."""
    return given if isinstance(given, Path) else _unpack_bundle(given)


@cache
def _unpack_bundle(given: CourseBundle) -> Path:
    folder = tempfile.TemporaryDirectory(prefix="course-", ignore_cleanup_errors=True)
    _KEPT.append(folder)  # removed when this process ends
    with zipfile.ZipFile(io.BytesIO(given.content)) as archive:
        archive.extractall(folder.name)
    return Path(folder.name)


_KEPT: list[tempfile.TemporaryDirectory[str]] = []
