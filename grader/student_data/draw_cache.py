"""A cache on disk of the data drawn for a learner who studies alone.

To draw twelve logs, and to see that the damage of each can be found, takes longer than all the rest
of grading; who changes one word and asks again should not wait for it again. It is kept in the
user's cache and gives nothing away: self-study numbers are drawn from a seed that everybody knows.
What a class draws is never kept.
"""

import hashlib
import pickle
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from functools import cache, wraps
from pathlib import Path
from typing import TypeVar

from grader.student_data.fingerprint import fingerprint_folders
from grader.student_data.variant import is_self_study
from sim.support.student_names import normalize_name
from sim.support.work import cache as kept_files

Drawn = TypeVar("Drawn")

MOST = 60  # files: what some learners at one machine work on
_KEEPING = ContextVar("keeping", default=False)


@contextmanager
def enable_draw_cache() -> Iterator[None]:
    """A context in which a student's random data are cached on disk."""
    token = _KEEPING.set(True)
    try:
        yield
    finally:
        _KEEPING.reset(token)


def cache_generated_data(draw: Callable[[str], Drawn]) -> Callable[[str], Drawn]:
    """Decorator: read a student's random data from the cache if it is on, else generate them.

    Args:
        draw: a student -> what is theirs; in a module of an exercise's folder.
    """

    @wraps(draw)
    def drawn(student: str) -> Drawn:
        place = find_cache_path(Path(draw.__code__.co_filename).parent, student, "drawn")
        if place is None:
            return draw(student)
        content = kept_files.read_cached(place)
        if content is not None:
            # whatever is wrong with an old file: it is drawn again
            with suppress(Exception):
                found: Drawn = pickle.loads(content)  # noqa: S301 - the user's own cache, as Python's
                return found
        found = draw(student)
        write_cached_data(place, pickle.dumps(found))
        return found

    return drawn


def find_cache_path(exercise: Path, student: str, what: str) -> Path | None:
    """The path of a student's cached data for an exercise; None if nothing is cached.

    Args:
        exercise: the exercise's folder.
        student: whose.
        what: what of it.
    """
    if not (_KEEPING.get() and is_self_study()):
        return None
    whole = f"{exercise.resolve()}\0{normalize_name(student)}\0{_fingerprint_code(exercise)}"
    name = f"{exercise.name}-{hashlib.sha256(whole.encode()).hexdigest()[:20]}.{what}"
    return kept_files.find_cache_folder() / "drawn" / name


@cache
def _fingerprint_code(exercise: Path) -> str:
    """The fingerprint of all code that decides a draw; cached while one answer is graded."""
    return fingerprint_folders(exercise)


def write_cached_data(place: Path, content: bytes) -> None:
    """Write a student's random data into the cache, and remove the oldest of many."""
    with suppress(OSError):
        kept_files.write_cached(place, content)
        kept_files.remove_files(kept_files.select_older(place.parent.iterdir(), than=MOST))
