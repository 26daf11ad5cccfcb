"""A student's name: its normalized form, and the folder named after it."""

import hashlib
import re
import unicodedata

from sim.core.errors import BadRequest

LONGEST = 64  # [characters] a student's name; it also names a folder
LEGIBLE = 32  # [characters] of it that are kept in a folder's name where some have to change
RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?")  # Windows has no such folders
PLAIN = re.compile(r"[\w@+-][\w@+. -]*(?<![. ])")


def check_student_name(text: str) -> str:
    """A student's name as it is shown; raises if it cannot be a name.

    Raises:
        BadRequest: it is empty, too long, not printable, or holds a path separator.
    """
    name = unicodedata.normalize("NFC", text).strip()
    advice = f"Give a name of 1 to {LONGEST} characters, such as: ann"
    if not name:
        raise BadRequest("the student's name is empty", advice=advice)
    if len(name) > LONGEST:
        raise BadRequest(f"the student's name has {len(name)} characters", advice=advice)
    if not name.isprintable():
        raise BadRequest(
            f"the student's name {name!r} contains an invisible character", advice=advice
        )
    if "/" in name or "\\" in name:
        raise BadRequest(f"the student's name {name!r} has a path separator", advice=advice)
    return name


def normalize_name(student: str) -> str:
    """A name in the form by which people are told apart: Ann and ann are one person."""
    return check_student_name(student).casefold()


def make_folder_name(student: str) -> str:
    """A folder's name that every system accepts, different for different students."""
    name = normalize_name(student)
    if name.isascii() and PLAIN.fullmatch(name) and not RESERVED.fullmatch(name):
        return name
    digest = hashlib.sha256(name.encode()).hexdigest()
    legible = re.sub(r"[^\w@+-]", "_", name)[:LEGIBLE]
    return f"{legible}-{digest[:8]}"
