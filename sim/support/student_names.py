"""A student's name: its normalized form, and the folder named after it."""

import hashlib
import re
import unicodedata

from sim.core.errors import BadRequest

LONGEST = 64  # [characters] of a student's name, which also names a folder
LEGIBLE = 32  # [characters] of a name in a folder's name with a digest
RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?")  # no folder names on Windows
PLAIN = re.compile(r"[\w@+-][\w@+. -]*(?<![. ])")


def check_student_name(text: str) -> str:
    """A student's name as it is displayed.

    Raises:
        BadRequest: it is empty, too long, not printable, or contains a path separator.
    """
    name = unicodedata.normalize("NFC", text).strip()
    advice = f"Give a name of 1 to {LONGEST} characters, such as: ann"
    if not name:
        raise BadRequest("the student's name is empty", advice=advice)
    if len(name) > LONGEST:
        raise BadRequest(f"the student's name is too long: {len(name)} characters", advice=advice)
    if not name.isprintable():
        raise BadRequest(
            f"the student's name {name!r} contains an invisible character", advice=advice
        )
    if "/" in name or "\\" in name:
        raise BadRequest(f"the student's name {name!r} has a path separator", advice=advice)
    return name


def normalize_name(student: str) -> str:
    """A name in the form that is compared: Ann and ann are the same student.

    Raises:
        BadRequest: as ``check_student_name``.
    """
    return check_student_name(student).casefold()


def make_folder_name(student: str) -> str:
    """A folder's name that is valid on every system, different for different students.

    Raises:
        BadRequest: as ``check_student_name``.
    """
    name = normalize_name(student)
    if name.isascii() and PLAIN.fullmatch(name) and not RESERVED.fullmatch(name):
        return name
    digest = hashlib.sha256(name.encode()).hexdigest()
    legible = re.sub(r"[^\w@+-]", "_", name)[:LEGIBLE]
    return f"{legible}-{digest[:8]}"
