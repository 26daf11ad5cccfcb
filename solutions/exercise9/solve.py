"""Exercise 9, answered: fit the learner's own log as SysId does, and write the numbers down.

The function stands beside this, in ``fit.py``.
"""

from pathlib import Path

from sim.fit import fit
from sim.io import read


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    found = fit(read(data / "log.wpilog"), method="sysid").in_log_units()
    numbers = {
        **found.gains,
        "acceleration_r2": found.acceleration_r2,
        "simulated_velocity_r2": found.simulated_velocity_r2,
    }
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    for name, value in numbers.items():
        text = text.replace(f'{name} = ""', f"{name} = {value:.4g}")
    function = Path(__file__).with_name("fit.py").read_text(encoding="utf-8")
    return {"answers.toml": text, "fit.py": function}
