"""Each learner gets numbers of their own, drawn from a seed that is made of who they are.

    seed = HMAC-SHA256(secret, "student/exercise")

What was drawn is never written down: whoever grades draws it again.
"""

import hashlib
import hmac
from typing import TYPE_CHECKING

from sim.student import folder_name, same, student_name

if TYPE_CHECKING:
    import numpy as np

__all__ = ["SELF_STUDY", "folder_name", "generator", "same", "seed", "student_name"]

# Everybody who studies alone shares this: it keeps numbers apart, it keeps nothing secret.
SELF_STUDY = b"sysid-course: studying alone"


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
