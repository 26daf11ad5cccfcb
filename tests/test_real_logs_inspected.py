"""What can be seen in logs of real robots is reported, and nothing absurd beside it.

What there is to see is written in the reference data's own README; the times are read off plots.
"""

import json

import pytest

from sim.inspect.detect_faults import inspect
from sim.io import read

pytestmark = [pytest.mark.slow, pytest.mark.shared]

MADE_UP = {"encoder-slip", "brownout", "loop-overrun", "mislabelled-test", "stuck-sensor"}
COMPLETE = ("simple-clean-20ms", "simple-light-5ms", "arm-rad-20ms", "arm-rot-20ms")


def told(shared, name):
    """Fault -> the runs it is reported in."""
    found = inspect(read(shared / "data" / "real" / f"{name}.json"))
    faults: dict[str, list[int]] = {}
    for damage in found.damages:
        faults.setdefault(damage.fault, []).append(damage.where.run)
    return faults


@pytest.mark.parametrize(
    ("name", "fault", "runs"),
    [
        ("sciborgs-2023-elbow-arm", "voltage-dropout", [0, 1, 2, 3]),
        ("sciborgs-2023-elevator", "voltage-dropout", [0, 1, 2, 3]),
        ("sciborgs-2023-wrist-arm", "hard-stop", [1]),
        ("sciborgs-2023-wrist-arm", "stale-samples", [0, 1, 2, 3]),
        ("frc4646-2022-drivetrain", "stale-samples", [0, 1, 2, 3]),
        ("frc501-2020-drivetrain", "wheel-slip", [2, 3]),  # waits at 84 % of its speed for 0.3 s
    ],
)
def test_what_is_visible_is_reported(shared, name, fault, runs):
    assert told(shared, name)[fault] == runs


def cases(shared):
    """Each development case: what was hidden in it, and what is reported of its training log."""
    folder = shared / "data" / "hidden-effects"
    key = json.loads((folder / "key.json").read_text(encoding="utf-8"))
    for name, case in sorted(key.items()):
        yield set(case["effects"]), inspect(read(folder / name / "train.csv")).damages


def test_hidden_faults_are_seen_and_effects_are_not_taken_for_them(shared, capsys):
    counts = {"encoder-slip": [0, 0, 0], "hard-stop": [0, 0, 0]}
    motions = complete = 0
    for hidden, damages in cases(shared):
        seen = {damage.fault for damage in damages}
        complete += not hidden
        if not hidden:
            motions += bool(seen & {"encoder-slip", "hard-stop", "brownout", "wheel-slip"})
        for fault, count in counts.items():
            count[0] += fault in hidden
            count[1] += fault in hidden and fault in seen
            count[2] += fault in seen and fault not in hidden

    with capsys.disabled():
        for fault, (there, found, wrong) in counts.items():
            print(f"\n{fault}: {found} of {there} seen, {wrong} made up", end="")  # noqa: T201
        print(f"\ncomplete models with a fault of motion: {motions} of {complete}")  # noqa: T201
    assert counts["hard-stop"][:2] == [4, 4]
    assert counts["encoder-slip"][1] >= 3  # the fourth reads 20 % less for 0.08 s
    assert all(wrong <= 1 for _, _, wrong in counts.values())
    assert motions == 0
