"""What a learner's gains would do: their mechanism follows a profile by feedforward alone."""

from collections.abc import Mapping

from grader.answers.number_answer import AskedNumber, read_answer_number
from grader.check import WrongAnswer
from grader.consequence import Consequence, follow_profiles

SPINS = {"shooter"}  # mechanisms whose place does not matter


def outcome(
    given: Mapping[str, object], asked: Mapping[str, AskedNumber], *, kind: str, symbol: str
) -> Consequence | None:
    """What the gains would do; None where one is missing, or all are right.

    Args:
        given: the answers, by name.
        asked: the gains that are asked for.
        kind: the mechanism: ``drivetrain``.
        symbol: of its unit of position.
    """
    from sim.feedback import Plant  # noqa: PLC0415 - numpy only where it is needed
    from sim.feedback.following import follow_profile  # noqa: PLC0415 - the same
    from sim.feedback.profile import make_brisk_profile  # noqa: PLC0415 - the same

    try:
        gains = {name: read_answer_number(given.get(name), one) for name, one in asked.items()}
    except WrongAnswer:
        return None
    if all(one.is_right(gains[name]) for name, one in asked.items()):
        return None
    plant = Plant("simple", {name: one.expected for name, one in asked.items()})
    place = "" if kind in SPINS else "way"
    believed = Plant("simple", gains)
    return follow_profiles(
        [
            follow_profile(
                plant, believed, make_brisk_profile(plant), name=kind, symbol=symbol, place=place
            )
        ]
    )
