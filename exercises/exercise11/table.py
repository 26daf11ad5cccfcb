"""Seven mechanisms: is characterizing them worth it, and for what reason?"""

from dataclasses import dataclass

DECISIONS = ("always", "recommended", "optional", "usually not")

REASONS = {
    "path": "It follows paths: every wrong volt leads away from the path.",
    "shot": "Its speed at one moment decides the result, and the feedforward has to hit it.",
    "angle": "Gravity pulls on it, more or less with its angle, so one guess fits one place only.",
    "weight": "Gravity pulls on it all the time, and its load changes kG and kA.",
    "if-speed": "Only if its speed is controlled; for 'fast enough' there is nothing to gain.",
    "if-profile": "Only if it moves along a motion profile, to be gentle on the robot.",
    "on-off": "A fixed output switched on and off is enough; its exact speed hardly matters.",
    "place": "Only where it ends up matters, and a high kP takes it there.",
    "light": "It is light and its way is short: gains computed from its parts will do.",
    "motor": "It has a motor, and whatever has a motor should be characterized.",
    "heavy": "It is heavy, and mass changes kV the most.",
}
WRONG = {
    "motor": ("a test costs time and wear. What would the gains be used for?", ""),
    "heavy": ("mass does not stand in the formula of kV", "M-KV-MASS"),
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
        "What happens to an autonomous path when the wheels do not do as they are told?",
    ),
    Row(
        "shooter",
        "spins a wheel up to a speed, and shoots",
        "always",
        ("shot",),
        "What happens to a shot at 3 % less speed?",
    ),
    Row(
        "arm",
        "swings a heavy claw from the floor to overhead",
        "recommended",
        ("angle",),
        "Can one guess of the voltage hold it everywhere?",
        argued=(("optional", "light"),),
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
        argued=(("usually not", "on-off"), ("recommended", "if-speed"), ("always", "shot")),
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
        "What would a characterized one do better?",
    ),
)
