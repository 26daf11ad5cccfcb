"""The morning of the tests: what is seen of six things, two limits, and a USB stick."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from grader.student_data.variant import make_student_rng

if TYPE_CHECKING:
    import numpy as np

SEEN: Mapping[str, Mapping[str, tuple[str, ...]]] = {  # item -> decision -> what may be seen
    "travel": {
        "go": (
            "15 m of free carpet ahead and as much behind; the motors are set to brake",
            "nothing in the way for 12 m ahead and 12 m behind; motors in brake mode",
        ),
        "no-go": (
            "free carpet ahead; the table with the laptops is right behind the robot",
            "the robot stands on blocks, its wheels in the air",
            "room ahead and behind for the plan, which brakes; the motors are set to coast",
        ),
    },
    "battery": {
        "go": ("12.8 V at rest, just off the charger", "12.6 V at rest, charged overnight"),
        "no-go": (
            "11.7 V at rest; the robot has driven since nine o'clock",
            ("11.4 V at rest; there is no other battery"),
        ),
    },
    "encoder": {
        "go": (
            "moved forward by hand, the position rises smoothly",
            "moved back and forth by hand, the position follows smoothly",
        ),
        "no-go": (
            "moved forward by hand, the position falls",
            "moved forward by hand, the position rises, with a jump now and then",
        ),
    },
    "log": {
        "go": (
            "AdvantageScope is open, and lists the files on the robot",
            "the log tool is open; we have fetched yesterday's file with it",
        ),
        "no-go": (
            "we will look for the file in the evening",
            "nobody knows yet where the robot saves it",
        ),
    },
    "guard": {
        "go": (
            "the test buttons do nothing until the characterization switch is on",
            "the tests are on a separate controller, which is not plugged in during matches",
        ),
        "no-go": (
            "the tests are on the driver's A, B, X and Y, at all times",
            "a test starts when the trigger that also shoots is pressed",
        ),
    },
    "driver_station": {
        "go": (
            "one of us sits at the Driver Station and does nothing but wait to disable",
            "one of us keeps a finger on the key that disables",
        ),
        "no-go": (
            "we all stand next to the robot, to see it better",
            "the person who disables also holds the gamepad and reads the plot",
        ),
    },
}
LIMITS = {  # who sets it -> what a test does to it, and how it is told
    "command": (
        "bypassed",
        (
            "the elevator's own command stops raising it above 1.2 m",
            "the default command of the drivetrain slows down near the wall",
        ),
    ),
    "controller": (
        "acts",
        (
            "a soft limit at 1.2 m is set in the motor controller's configuration",
            "a current limit of 60 A is set in the motor controller's configuration",
        ),
    ),
}
FOLDERS = ("/u/logs", "/home/lvuser/logs", "/home/lvuser/deploy", "/home/systemcore/logs")
LEAST_BAD, MOST_BAD = 2, 4  # items that say no-go


@dataclass(frozen=True)
class Morning:
    """What a learner sees that morning.

    Args:
        seen: item -> what is seen.
        decisions: item -> ``go`` or ``no-go``.
        limits: ``limit_a`` and ``limit_b`` -> what is set.
        effects: the same -> ``acts`` or ``bypassed``.
        stick: whether a USB stick is in the roboRIO.
    """

    seen: Mapping[str, str]
    decisions: Mapping[str, str]
    limits: Mapping[str, str]
    effects: Mapping[str, str]
    stick: bool

    @property
    def roborio(self) -> str:
        """Where the roboRIO keeps its log."""
        return FOLDERS[0] if self.stick else FOLDERS[1]


def draw_morning(student: str) -> Morning:
    """A learner's morning, always the same one; some things are not as they should be."""
    rng = make_student_rng(student, "exercise6 morning")
    items = list(SEEN)
    bad = set(rng.permutation(items)[: int(rng.integers(LEAST_BAD, MOST_BAD + 1))].tolist())
    decisions = {item: "no-go" if item in bad else "go" for item in items}
    seen = {item: _one(SEEN[item][decisions[item]], rng) for item in items}
    order = rng.permutation(list(LIMITS)).tolist()
    names = dict(zip(("limit_a", "limit_b"), order, strict=True))
    return Morning(
        seen,
        decisions,
        {name: _one(LIMITS[who][1], rng) for name, who in names.items()},
        {name: LIMITS[who][0] for name, who in names.items()},
        bool(rng.integers(2)),
    )


def _one(of: tuple[str, ...], rng: "np.random.Generator") -> str:
    return of[int(rng.integers(len(of)))]
