"""Exercise 11, answered: the right options, looked up under the learner's own letters."""

import re
from pathlib import Path

CHOICES = {
    "Q0_guess": "With which gain does",
    "Q0_sysid": "Which model of the physics",
    "Q0_brace": "kA",
    "kA_use": "The robot's mass",
    "kS_flag": "First look for a part",
    "step_shape": "Whether a current limit",
    "step_length": "The test needs much more room",
    "null_consumer": "Into the WPILog",
    "status_frames": "Make the times equal",
    "three_logs": "Something changes between",
    "match_heat": "kS, kG and kA are larger",
    "schedule": "In the last two weeks",
    "KC1_answer": "Some part got stuck",
    "KC1_reason": "kS is too small",
    "KC2_answer": "Keep the gains",
    "KC2_reason": "Feedforward never corrects",
    "KC3_answer": "Measure or compute",
    "KC3_reason": "The game piece adds weight",
}
ROWS = {
    "drivetrain": ("always", "It follows paths"),
    "shooter": ("always", "Its speed at one moment"),
    "arm": ("recommended", "The effect of gravity changes"),
    "elevator": ("recommended", "Gravity always pulls on it"),
    "intake": ("optional", "Only if its code controls"),
    "climber": ("optional", "Only if it follows a motion"),
    "conveyor": ("usually not", "It is enough to switch"),
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
    answers = {name: _find_letter(parts[name], begins) for name, begins in CHOICES.items()}
    for name, (decision, begins) in ROWS.items():
        answers |= {name: decision, f"{name}_reason": _find_letter(parts["Reasons"], begins)}
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    text = text.replace('KC2_volts = ""', f"KC2_volts = {_read_volts(questions):.4g}")
    for name, word in answers.items():
        text = text.replace(f'{name} = ""', f'{name} = "{word}"')
    return {"answers.toml": text}


def _find_letter(part: str, begins: str) -> str:
    """The letter under which an option stands."""
    (found,) = re.findall(rf"^- \*\*(\w)\*\* {re.escape(begins)}", part, re.MULTILINE)
    return str(found)


def _read_volts(questions: str) -> float:
    """What kS and kV·v come to, with v in rotations per second."""
    (ks,), (kv,), (rpm,) = (
        re.findall(sign, questions, re.DOTALL)
        for sign in (
            r"A shooter has kS = ([\d.]+)",
            r"kV = ([\d.]+) V",
            r"target\s+speed\s+is\s+(\d+) rpm",
        )
    )
    return float(ks) + float(kv) * float(rpm) / 60.0
