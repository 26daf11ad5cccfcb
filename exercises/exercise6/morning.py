"""The morning of the tests: what is seen of six things, two limits, and a USB stick."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.checks.texts import read_texts
from grader.student_data.variant import choose, make_student_rng

_TEXTS = read_texts(Path(__file__).with_name("answer_key.toml"))
SEEN: Mapping[str, dict[str, list[str]]] = _TEXTS["seen"]  # item -> decision -> what may be seen
LIMITS: Mapping[str, list[str]] = _TEXTS["limits"]  # what a test does to it -> how it is told
WHY: Mapping[str, str] = _TEXTS["why"]  # item -> what a wrong decision overlooks
FOLDERS = ("/u/logs", "/home/lvuser/logs", "/home/lvuser/deploy", "/home/systemcore/logs")
LEAST_BAD, MOST_BAD = 2, 4  # items that say no-go


@dataclass(frozen=True)
class Morning:
    """The things that a learner sees that morning.

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
    seen = {item: choose(SEEN[item][decisions[item]], rng) for item in items}
    order = rng.permutation(list(LIMITS)).tolist()
    effects = dict(zip(("limit_a", "limit_b"), order, strict=True))
    limits = {name: choose(LIMITS[effect], rng) for name, effect in effects.items()}
    return Morning(seen, decisions, limits, effects, bool(rng.integers(2)))
