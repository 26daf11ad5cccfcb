"""``grade watch``: the answer is graded each time its file is saved."""

import sys
import time
from collections.abc import Callable

from grader.exercise.exercise import Exercise

PAUSE = 0.4  # [s] between looks; asking the disk works on every file system, being told does not
CLEAR = "\x1b[2J\x1b[H"  # an empty screen, from its top


def watch_exercise(
    exercise: Exercise,
    *,
    grade: Callable[[], int],
    wait: Callable[[float], None] = time.sleep,
) -> int:
    """Grade an exercise now and after each change of its files, until all is right.

    Args:
        exercise: which.
        grade: grades and shows it; the exit code.
        wait: lets some seconds pass; may end it by KeyboardInterrupt.

    Returns:
        The exit code of the last grading.
    """
    while True:
        seen = snapshot_files(exercise)
        if sys.stdout.isatty():
            sys.stdout.write(CLEAR)
        code = grade()
        sys.stdout.flush()
        if code == 0:
            return code
        while snapshot_files(exercise) == seen:
            wait(PAUSE)


def snapshot_files(exercise: Exercise) -> tuple[tuple[str, int, int], ...]:
    """Names, times and sizes of the exercise's files, which change when one is saved."""
    found = []
    for name in exercise.files:
        try:
            told = (exercise.folder / name).stat()
        except OSError:  # some editors remove a file before they write it anew
            continue
        found.append((name, told.st_mtime_ns, told.st_size))
    return tuple(found)
