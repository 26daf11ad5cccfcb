"""Exercise 1, answered: three terms at each of four moments, added up."""

import math
import tomllib
from pathlib import Path

CONVERTED = {  # what a dashboard shows -> how many of kV's own unit one of it is
    "ft/s": 0.3048,
    "rpm": 1 / 60,
    "deg/s": math.pi / 180,
}
MOMENTS = ("forward", "accelerating", "braking", "backward")


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in, with the terms beside each voltage.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    told = (data / "given.toml").read_text(encoding="utf-8")
    given = tomllib.loads(told)
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    times = next(size for unit, size in CONVERTED.items() if f"# {unit}\n" in told)
    terms = {}
    for name in MOMENTS:
        at = given[name]
        velocity = at["speed"] * {"forward": times, "backward": -1.0}.get(name, 1.0)
        terms[name] = {
            "kS": math.copysign(given["kS"], velocity),
            "kV": given["kV"] * velocity,
            "kA": given["kA"] * (at.get("faster_by", 0.0) - at.get("slower_by", 0.0)),
        }
        row = ", ".join(f"{gain} {volts:.4f} V" for gain, volts in terms[name].items())
        text = text.replace(
            f'{name} = "" ', f"{name} = {sum(terms[name].values()):.3f}  # {row}, 1:{times:.6g} "
        )
    sizes = {gain: abs(volts) for gain, volts in terms[given["largest_at"]].items()}
    position = given["velocity_unit"].removesuffix("/s")
    text = text.replace('kV_unit = ""', f'kV_unit = "V·s/{position}"')
    text = text.replace('largest = ""', f'largest = "{max(sizes, key=lambda one: sizes[one])}"')
    return {"answers.toml": text}
