"""The motion of a learner's mechanism that follows a profile by feedforward alone."""

from collections.abc import Mapping

from grader.answers.asked_number import AskedNumber
from grader.answers.number_answer import read_wrong_numbers
from grader.checks.consequence import Consequence, follow_profiles
from sim.feedback import Plant
from sim.feedback.following import follow_profile
from sim.feedback.profile import make_brisk_profile

SPINS = {"shooter"}  # mechanisms whose place does not matter


def find_outcome(
    given: Mapping[str, object], asked: Mapping[str, AskedNumber], *, kind: str, symbol: str
) -> Consequence | None:
    """The motion under the gains; None if one is missing, or all are right.

    Args:
        given: the answers, by name.
        asked: the gains that are asked for.
        kind: the mechanism: ``drivetrain``.
        symbol: of its unit of position.
    """
    gains = read_wrong_numbers(given, asked)
    if gains is None:
        return None
    plant = Plant("simple", {name: one.expected for name, one in asked.items()})
    place = "" if kind in SPINS else "way"
    wanted, believed = make_brisk_profile(plant), Plant("simple", gains)
    return follow_profiles(
        [follow_profile(plant, believed, wanted, name=kind, symbol=symbol, place=place)]
    )
