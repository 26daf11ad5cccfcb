"""The consequence of an answer for the robot's motion, in words and as a picture.

An exercise's ``checks.py`` may offer it, for answers that are not all right:

    def consequence(subject) -> Consequence | None    None where there is nothing to see

It shows motion: the learner's numbers at work on the learner's own mechanism, beside what was
wanted. It never tells a gain.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sim.feedback.following import FollowedProfile


class Picture(Protocol):
    """A picture, as ``sim.plot`` makes them."""

    @property
    def html(self) -> str:
        """The picture, its words and its numbers, as a piece of HTML."""

    def save(self, path: str | os.PathLike[str], /) -> None:
        """Write it into a file.

        Raises:
            BadRequest: the name ends in no kind of picture, or the file cannot be written.
        """


@dataclass(frozen=True)
class Consequence:
    """The effect of an answer on the robot, in words and as a picture.

    Args:
        words: what happens, in sentences with rounded numbers.
        draw: makes the picture; only then is a drawing library loaded.
    """

    words: str
    draw: Callable[[], Picture]


def show_motions(motions: "Sequence[tuple[Any, ...]]", *, words: str) -> Consequence:
    """Motions in one panel each.

    Args:
        motions: of each the arguments of ``sim.plot.consequence.Trace``.
        words: what happens.
    """

    def draw() -> Picture:
        from sim.plot.consequence import Trace, plot_consequence  # noqa: PLC0415 - only who draws waits for it

        return plot_consequence([Trace(*one) for one in motions], words=words)

    return Consequence(words, draw)


def follow_profiles(followed: "Sequence[FollowedProfile]") -> Consequence:
    """How mechanisms follow a motion profile with a learner's feedforward alone.

    Args:
        followed: at least one.
    """
    told = " ".join(one.description for one in followed)
    words = f"This is what your numbers do as feedforward, without feedback. {told}"

    def draw() -> Picture:
        from sim.plot.consequence import make_profile_traces, plot_consequence  # noqa: PLC0415 - only who draws waits for it

        return plot_consequence(
            [trace for one in followed for trace in make_profile_traces(one)], words=words
        )

    return Consequence(words, draw)
