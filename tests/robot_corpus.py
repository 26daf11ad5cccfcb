"""The corpus of robot code, whole: programs that are variants of another one are completed."""

import atexit
import shutil
import tempfile
from functools import cache
from pathlib import Path

AUTHORED = Path(__file__).with_name("robotcode")
DRIVE = Path("frc/robot/subsystems/drive")
ALWAYS = ("Drive", "Module", "ModuleIO")
VARIANTS = {  # of AdvantageKit's template: program -> its files that are those of the template
    "advantagekit_duty_on_one": ALWAYS,
    "advantagekit_one_spark": (*ALWAYS, "ModuleIOSim"),
    "advantagekit_one_talonfx": (*ALWAYS, "ModuleIOSim"),
    "advantagekit_real_and_simulated": ALWAYS,
    "advantagekit_simulated_only": (*ALWAYS, "ModuleIOSim"),
    "advantagekit_template_torque": (*ALWAYS, "ModuleIOSim", "ModuleIOTalonFX"),
    "advantagekit_voltage_or_torque": (*ALWAYS, "ModuleIOTalonFX"),
}


@cache
def whole_corpus() -> Path:
    """A copy of ``robotcode/`` in which every program has all its files."""
    folder = Path(tempfile.mkdtemp(prefix="robotcode-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    corpus = folder / AUTHORED.name
    shutil.copytree(AUTHORED, corpus, ignore=shutil.ignore_patterns("__pycache__"))
    template = corpus / "swerve" / "advantagekit_template" / DRIVE
    for program, files in VARIANTS.items():
        place = corpus / "swerve" / program
        if (place / "frc").exists():
            place /= DRIVE
        place.mkdir(parents=True, exist_ok=True)
        for file in files:
            shutil.copy(template / f"{file}.java", place)
    return corpus
