"""Packages for students: the course without solutions, and each student's own numbers.

course.zip               for everybody: no solutions, no tests, no secret; for a class that is
                         graded, no answer keys
students/NAME.zip        to be unpacked over it: data drawn with the class's secret
"""

import io
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import tomlkit

from grader.classroom.bundle import CourseBundle, zip_files
from grader.classroom.secret import seal_identity
from grader.exercise.exercise import list_exercises
from grader.student_data.class_package import PLACE
from grader.student_data.variant import use_class_secret
from sim.support.student_names import make_folder_name


@dataclass(frozen=True)
class StudentPackage:
    """The package of one student.

    Args:
        student: whose numbers these are.
        secret: of the class.
        name: of the class.
        course: the course's exercises.
    """

    student: str
    secret: bytes = field(repr=False)  # a message may hold this
    name: str
    course: CourseBundle


def make_student_package(package: StudentPackage) -> tuple[str, bytes]:
    """One student's numbers: their name, and the zip file to unpack over the course."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as there:
        course = Path(there)
        with zipfile.ZipFile(io.BytesIO(package.course.content)) as archive:
            archive.extractall(course)
        with use_class_secret(package.secret):
            for one in list_exercises(course):
                one.prepare(package.student, say=lambda _: None)
        made = {
            path.relative_to(course).as_posix(): path.read_bytes()
            for path in sorted(
                (course / "exercises").glob(f"*/data/{make_folder_name(package.student)}/*")
            )
        }
    mark = seal_identity(package.secret, student=package.student, name=package.name)
    identity = {"class": package.name, "student": package.student, "seal": mark}
    beside = {Path(name).with_name(PLACE.name).as_posix() for name in made}
    files = made | dict.fromkeys(
        (PLACE.as_posix(), *sorted(beside)), tomlkit.dumps(identity).encode()
    )
    return package.student, pack_course_folder(files)


def pack_course_folder(files: Mapping[str, bytes]) -> bytes:
    """The content of a zip file with one folder, ``course``."""
    return zip_files({f"course/{name}": content for name, content in files.items()})
