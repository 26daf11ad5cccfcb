"""SysId's analysis type and WPILib's class for each mechanism: the same for everybody.

A class's package lacks this module: see ``grader.answers.answer_key``.
"""

from grader.answers.choice_answer import check_choice

RIGHT = {
    "elevator_type": "Elevator",
    "elevator_class": "ElevatorFeedforward",
    "arm_type": "Arm",
    "arm_class": "ArmFeedforward",
}
TYPES = ("Simple", "Arm", "Elevator")
CLASSES = ("SimpleMotorFeedforward", "ArmFeedforward", "ElevatorFeedforward")
ALSO = {"SimpleMotorFeedforwardMeters": CLASSES[0]}


def judge_word(name: str, raw: object) -> None:
    """Judge a type or a class, however it is written.

    Raises:
        WrongAnswer: it is another one, or none.
    """
    types = name.endswith("_type")
    choices = TYPES if types else CLASSES

    def explain_wrong_choice(found: str) -> tuple[str, str]:
        ask = f"Choose one of: {', '.join(choices)}."
        if found.startswith("Simple"):
            says = "Simple has no gravity term. Does yours stay where it is without a voltage? "
            return says + ask, "M-NO-KG-IN-SYSID"
        says = (
            "Is the voltage against gravity the same everywhere, or does it change with an angle? "
        )
        return says + ask, ""

    check_choice(raw, RIGHT[name], choices, why=explain_wrong_choice, also=None if types else ALSO)
