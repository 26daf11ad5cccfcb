"""Each learner gets numbers of their own, drawn from a seed that is made of who they are.

    seed = HMAC-SHA256(secret, "student/exercise")

What was drawn is never written down: whoever grades draws it again.
"""

import hashlib
import hmac
import re
import unicodedata
from typing import TYPE_CHECKING

from sim.errors import BadRequest

if TYPE_CHECKING:
    import numpy as np

# Everybody who studies alone shares this: it keeps numbers apart, it keeps nothing secret.
SELF_STUDY = b"sysid-course: studying alone"

LONGEST = 64  # [characters] a student's name; it also names a folder
LEGIBLE = 32  # [characters] of it that are kept in a folder's name where some have to change
RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?")  # Windows has no such folders
PLAIN = re.compile(r"[\w@+-][\w@+. -]*(?<![. ])")


def student_name(text: str) -> str:
    """A student's name as it is shown, or a refusal.

    Raises:
        BadRequest: it is empty, too long, not printable, or holds a path separator.
    """
    name = unicodedata.normalize("NFC", text).strip()
    advice = f"Give a name of 1 to {LONGEST} characters, such as: --student ann"
    if not name:
        raise BadRequest("the student's name is empty", advice=advice)
    if len(name) > LONGEST:
        raise BadRequest(f"the student's name has {len(name)} characters", advice=advice)
    if not name.isprintable():
        raise BadRequest(f"the student's name {name!r} has a sign nobody can see", advice=advice)
    if "/" in name or "\\" in name:
        raise BadRequest(f"the student's name {name!r} has a path separator", advice=advice)
    return name


def same(student: str) -> str:
    """The one form of a name: Ann and ann are one person, as they are one folder on most disks."""
    return student_name(student).casefold()


def folder_name(student: str) -> str:
    """A folder's name that every system accepts, different for different students."""
    name = same(student)
    if name.isascii() and PLAIN.fullmatch(name) and not RESERVED.fullmatch(name):
        return name
    digest = hashlib.sha256(name.encode()).hexdigest()
    legible = re.sub(r"[^\w@+-]", "_", name)[:LEGIBLE]
    return f"{legible}-{digest[:8]}"


def seed(student: str, exercise: str, *, secret: bytes = SELF_STUDY) -> int:
    """The number everything of this student's exercise is drawn from."""
    message = f"{same(student)}/{exercise}".encode()
    return int.from_bytes(hmac.new(secret, message, hashlib.sha256).digest(), "big")


def generator(
    student: str, exercise: str, *, draw: int = 0, secret: bytes = SELF_STUDY
) -> "np.random.Generator":
    """A source of random numbers of this student's own, the same on every machine.

    Args:
        student: who.
        exercise: for what: ``exercise9``.
        draw: another number gives another, unrelated source: for what has to be drawn again.
        secret: a class's own, so that its numbers cannot be drawn outside it.
    """
    import numpy as np  # noqa: PLC0415 - most exercises draw nothing, and start at once

    name = f"{exercise}#{draw}" if draw else exercise
    return np.random.Generator(np.random.PCG64(seed(student, name, secret=secret)))
