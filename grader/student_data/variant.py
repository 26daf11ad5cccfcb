"""Each learner's own numbers, drawn from a seed made of their name.

    seed = HMAC-SHA256(secret, "student/exercise")

What is drawn for a class is never written down: whoever grades draws it again, with a secret that
only whoever grades the class holds (`of_class`).
"""

import hashlib
import hmac
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache, wraps
from typing import TYPE_CHECKING, TypeVar

from sim.support.student_names import normalize_name

if TYPE_CHECKING:
    import numpy as np

Drawn = TypeVar("Drawn")

# Everybody who studies alone shares this: it keeps numbers apart, it keeps nothing secret.
SELF_STUDY = b"sysid-course: studying alone"
_SECRET = ContextVar("secret", default=SELF_STUDY)


@contextmanager
def use_class_secret(secret: bytes) -> Iterator[None]:
    """Draw the numbers of a class with this secret, as long as the block lasts."""
    token = _SECRET.set(secret)
    try:
        yield
    finally:
        _SECRET.reset(token)


def is_self_study() -> bool:
    """Whether numbers are drawn for self-study, and not for a class."""
    return _SECRET.get() == SELF_STUDY


def derive_student_seed(student: str, exercise: str, *, secret: bytes | None = None) -> int:
    """The number everything of this student's exercise is drawn from.

    Args:
        student: who.
        exercise: for what: ``exercise9``.
        secret: a class's own; None takes that of the class at hand, or of self-study.
    """
    secret = _SECRET.get() if secret is None else secret
    message = f"{normalize_name(student)}/{exercise}".encode()
    return int.from_bytes(hmac.new(secret, message, hashlib.sha256).digest(), "big")


def make_student_rng(
    student: str, exercise: str, *, draw: int = 0, secret: bytes | None = None
) -> "np.random.Generator":
    """A source of random numbers of this student's own, the same on every machine.

    Args:
        student: who.
        exercise: for what: ``exercise9``.
        draw: another number gives another, unrelated source: for what has to be drawn again.
        secret: a class's own, so that its numbers cannot be drawn outside it; None takes that of
            the class at hand, or of self-study.
    """
    import numpy as np  # noqa: PLC0415 - most exercises draw nothing, and start at once

    name = f"{exercise}#{draw}" if draw else exercise
    return np.random.Generator(np.random.PCG64(derive_student_seed(student, name, secret=secret)))


def draw_until(
    draw: Callable[[int], Drawn | None],
    accept: Callable[[Drawn], bool],
    *,
    most: int = 2000,
) -> Drawn:
    """The first draw that is accepted, such as numbers with distinguishable slips.

    Args:
        draw: the number of a draw -> what was drawn, or None where that came to nothing.
        accept: whether a student may get it.
        most: draws; a few are enough, and so many in a row would be a fault of the exercise.

    Raises:
        RuntimeError: none was accepted.
    """
    for attempt in range(most):
        drawn = draw(attempt)
        if drawn is not None and accept(drawn):
            return drawn
    raise RuntimeError(f"none of {most} draws is good enough for a student")


def choose(among: Sequence[Drawn], rng: "np.random.Generator") -> Drawn:
    """One of several, each as likely as the others."""
    return among[int(rng.integers(len(among)))]


def round_digits(value: float, digits: int) -> float:
    """A number with so many digits, as a student reads and writes it."""
    return float(f"{value:.{digits}g}")


def cache_draws(draw: Callable[[str], Drawn]) -> Callable[[str], Drawn]:
    """Decorator: cache the data of the last few students in memory, each class's apart.

    What a learner works on is drawn when it is handed out and again when it is graded.

    Args:
        draw: a student -> what is theirs.
    """

    @lru_cache(maxsize=8)
    def kept(student: str, _secret: bytes) -> Drawn:
        return draw(student)

    @wraps(draw)
    def drawn(student: str) -> Drawn:
        return kept(normalize_name(student), _SECRET.get())

    return drawn
