"""Seven mechanisms: is characterizing them worth it, and for what reason?"""

from dataclasses import dataclass

DECISIONS = ("always", "recommended", "optional", "usually not")

REASONS = {
    "path": "It follows paths, and with a wrong voltage it leaves the path.",
    "shot": (
        "Its speed at one moment decides the result, and the feedforward has to give this speed."
    ),
    "angle": (
        "The effect of gravity changes with its angle, so one guessed voltage is right at only "
        "one angle."
    ),
    "weight": "Gravity always pulls on it, and the load that it carries changes kG and kA.",
    "if-speed": (
        "Only if its code controls its speed; if any high speed is good enough, gains do not help."
    ),
    "if-profile": "Only if it follows a motion profile, so that it moves gently.",
    "on-off": (
        "It is enough to switch a fixed output on and off, because its exact speed is not "
        "important."
    ),
    "place": "Only its final position is important, and a high kP brings it there.",
    "light": "It is light and its travel is short: gains computed from its parts are enough.",
    "motor": "It has a motor, and teams should characterize everything that has a motor.",
    "heavy": "It is heavy, and mass changes kV more than the other gains.",
}
WRONG = {
    "motor": (
        "a test needs time, and the robot's parts wear. What would you use the gains for?",
        "",
    ),
    "heavy": ("the formula of kV does not contain the mass", "M-KV-MASS"),
}


@dataclass(frozen=True)
class Row:
    """One mechanism.

    Args:
        name: as in the answer file.
        told: what it does on the robot.
        decision: the one of ``DECISIONS`` most teams should take.
        reasons: keys of ``REASONS`` that go with it.
        argued: other decisions, each with the reason that carries it.
        ask: what to think about, after a wrong decision.
    """

    name: str
    told: str
    decision: str
    reasons: tuple[str, ...]
    ask: str
    argued: tuple[tuple[str, str], ...] = ()

    def argues(self, decision: str, reason: str) -> bool:
        """Whether a decision that is not the usual one comes with a reason that carries it."""
        return (decision, reason) in self.argued


ROWS = (
    Row(
        "drivetrain",
        "drives paths in autonomous",
        "always",
        ("path",),
        "What happens to an autonomous path when the wheels do not follow the commands?",
    ),
    Row(
        "shooter",
        "spins a wheel up to a speed, and shoots",
        "always",
        ("shot",),
        "What happens to a shot if the wheel is 3 % too slow?",
    ),
    Row(
        "arm",
        "swings a heavy claw from the floor to overhead",
        "recommended",
        ("angle",),
        "Can one guessed voltage hold it at every angle?",
    ),
    Row(
        "elevator",
        "lifts a carriage with and without game pieces",
        "recommended",
        ("weight",),
        "What does its motor do while the carriage stands still?",
    ),
    Row(
        "intake",
        "rollers that pull game pieces in",
        "optional",
        ("if-speed", "on-off"),
        "Does it matter how fast it turns? On every robot, or on some?",
        argued=(("usually not", "on-off"), ("recommended", "if-speed")),
    ),
    Row(
        "climber",
        "pulls the robot up, once",
        "optional",
        ("if-profile", "place"),
        "Does it matter how it gets there? On every robot, or on some?",
        argued=(("usually not", "place"), ("recommended", "if-profile")),
    ),
    Row(
        "conveyor",
        "moves game pieces from sensor to sensor",
        "usually not",
        ("on-off",),
        "What would a conveyor do better with measured gains?",
    ),
)
