"""What Rotational_Rate is measured in: the same for everybody.

A class's package lacks this module: see ``grader.answers.answer_key``.
"""

from grader.answers.choice_answer import check_choice

RATES = ("volts", "radians-per-second", "degrees-per-second", "rotations-per-second")
ALSO = {"V": RATES[0], "rad/s": RATES[1], "deg/s": RATES[2], "rot/s": RATES[3]}


def judge_rate_unit(raw: object) -> None:
    """Judge the unit of Rotational_Rate.

    Raises:
        WrongAnswer: it is another one, or none.
    """

    def why(found: str) -> tuple[str, str]:
        if found == "volts":
            return (
                "the routine calls it volts because SysId knows only volts. What does the "
                "program do with the number?"
            ), "M-UNITS"
        return (
            "compare it with the gyro's velocity at the end of a ramp: they are about equal only "
            "after you convert one"
        ), "M-UNITS"

    check_choice(raw, RATES[1], RATES, why=why, also=ALSO)
