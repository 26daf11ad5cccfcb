"""Exercise 11, answered: the right options, looked up under the learner's own letters."""

import re
from pathlib import Path

CHOICES = {
    "Q0_guess": "Which gain makes it behave",
    "Q0_sysid": "Which model of the physics",
    "Q0_brace": "kA",
    "kA_use": "It gives the robot's mass",
    "kS_flag": "First look for the part",
    "step_shape": "Did a current limit",
    "step_length": "It needs much more room",
    "null_consumer": "Into the WPILog",
    "status_frames": "Log as fast as",
    "three_logs": "Something changes between",
    "match_heat": "kS, kG and kA are larger",
    "schedule": "In the last two weeks",
    "KC1_answer": "Something stuck",
    "KC1_reason": "A few samples",
    "KC2_answer": "Keep the gains",
    "KC2_reason": "Feedforward never corrects",
    "KC3_answer": "Measure, or compute",
    "KC3_reason": "The piece adds weight",
}
ROWS = {
    "drivetrain": ("always", "It follows paths"),
    "shooter": ("always", "Its speed at one moment"),
    "arm": ("recommended", "The effect of gravity changes"),
    "elevator": ("recommended", "Gravity pulls on it all the time"),
    "intake": ("optional", "Only if its speed"),
    "climber": ("optional", "Only if it moves along"),
    "conveyor": ("usually not", "A fixed output"),
}


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    questions = (data / "questions.md").read_text(encoding="utf-8")
    parts = dict(re.findall(r"^### (\w+)\n(.*?)(?=^##|\Z)", questions, re.MULTILINE | re.DOTALL))
    answers = {name: _letter(parts[name], begins) for name, begins in CHOICES.items()}
    for name, (decision, begins) in ROWS.items():
        answers |= {name: decision, f"{name}_reason": _letter(parts["Reasons"], begins)}
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    text = text.replace('KC2_volts = ""', f"KC2_volts = {_volts(questions):.4g}")
    for name, word in answers.items():
        text = text.replace(f'{name} = ""', f'{name} = "{word}"')
    return {"answers.toml": text}


def _letter(part: str, begins: str) -> str:
    """The letter under which an option stands."""
    (found,) = re.findall(rf"^- \*\*(\w)\*\* {re.escape(begins)}", part, re.MULTILINE)
    return str(found)


def _volts(questions: str) -> float:
    """What kS and kV·v come to, with v in rotations per second."""
    (ks,), (kv,), (rpm,) = (
        re.findall(sign, questions, re.DOTALL)
        for sign in (
            r"A shooter has kS = ([\d.]+)",
            r"kV = ([\d.]+) V",
            r"Its target is\s+(\d+) rpm",
        )
    )
    return float(ks) + float(kv) * float(rpm) / 60.0
