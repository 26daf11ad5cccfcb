"""Logs of real robots, inspected and looked at."""

import json
from dataclasses import dataclass, field

import pytest

from sim.inspect.detect_faults import inspect
from sim.io import read

pytestmark = [pytest.mark.slow, pytest.mark.shared]


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
def test_visible_faults_of_real_logs_are_reported(shared, name, fault, runs):
    assert told(shared, name)[fault] == runs


def cases(shared):
    """Each development case: what was hidden in it, and what is reported of its training log."""
    folder = shared / "data" / "hidden-effects"
    key = json.loads((folder / "key.json").read_text(encoding="utf-8"))
    for name, case in sorted(key.items()):
        yield set(case["effects"]), inspect(read(folder / name / "train.csv")).damages


def test_planted_faults_are_found_and_effects_are_not_called_faults(shared, capsys):
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


ALL = (0, 1, 2, 3)


@dataclass(frozen=True)
class Seen:
    """What looking found in a log.

    Args:
        faults: name -> the runs it is in; none for a fault of the whole log.
        arguable: faults that a second person might see or not.
        lag: [ms] by which the velocity is late, to 15 ms; None where nobody looked.
    """

    faults: dict[str, tuple[int, ...]] = field(default_factory=dict)
    arguable: tuple[str, ...] = ()
    lag: int | None = None


SLIPS, DROPS = {"wheel-slip": (2, 3)}, {"voltage-dropout": ALL}
PIKE = "PikeRoboDevils+FRC-2022-Software~sysid~sysid_data2022"
SCIBORGS = "SciBorgs+ChargedUp-2023~sysid~"
KNIGHTS = "Team-501-The-PowerKnights+2020-characterization"

LOOKED_AT = {
    # stands for 5 s before its steps, gaps of 49 and 66 ms; a dip of 10 % at the launch
    "AndromedaOne+2021RobotCharacterization~characterization-data20210130-1520": Seen(
        arguable=("wheel-slip",), lag=140
    ),
    # slack is taken up at the launch of run 1, within 0.1 s
    "PikeRoboDevils+FRC-2022-Software~sysid-arm~sysid_data20220302-170828": Seen(),
    f"{PIKE}0124-181819": Seen(SLIPS),  # 2.0 to 1.5 m/s at 0.1 s; 2.4 to 1.7 m/s at 0.2 s
    f"{PIKE}0305-151809-angular": Seen(SLIPS),
    f"{PIKE}0305-152235": Seen({"wheel-slip": (3,)}),  # 2.2 to 1.85 m/s at 0.2 s
    f"{PIKE}0408-200048": Seen(SLIPS),
    # one rotation counted as one meter: 12 m/s at 12 V, twice the speed of its twin
    f"{PIKE}0408-201142": Seen({"unit-error": ()}, arguable=("wheel-slip",)),
    f"{PIKE}0409-125932": Seen({"wheel-slip": (2,)}),  # 1.9 to 1.4 m/s at 0.15 s
    f"{SCIBORGS}elbow~sysid_data20230222-162953": Seen(DROPS, lag=0),
    f"{SCIBORGS}elbow~sysid_data20230222-163221": Seen(DROPS, lag=0),
    f"{SCIBORGS}elbow~sysid_data20230304-161758": Seen(DROPS, lag=0),
    f"{SCIBORGS}elevator~sysid_data20230227-154527": Seen(DROPS, lag=0),
    f"{SCIBORGS}elevator~sysid_data20230308-162549": Seen(DROPS, lag=0),
    f"{SCIBORGS}elevator~sysid_data20230308-163032": Seen(DROPS, lag=0),
    # held by gravity at its end for 5 s
    f"{SCIBORGS}wrist~sysid_data20230306-171942": Seen({"hard-stop": (1,)}, lag=40),
    f"{SCIBORGS}wrist~sysid_data20230306-172331": Seen({"hard-stop": (3,)}, lag=40),
    f"{SCIBORGS}wrist~sysid_data20230306-172559": Seen({"hard-stop": (1,)}, lag=40),
    # 11.6 m/s at 12 V
    "StuyPulse+Edwin~sysid~data~drivetrain-angular": Seen(
        {"unit-error": ()}, arguable=("wheel-slip",), lag=140
    ),
    # 0.76 m/s at 12 V; at once to 80 % of its speed, 0.2 s later on from there
    "StuyPulse+Edwin~sysid~data~drivetrain": Seen({"unit-error": (), **SLIPS}, lag=140),
    # the velocity is 4.2 times the position, and the position goes against the voltage
    "StuyPulse+SwerveSysId~client~data": Seen({"unit-error": ALL}, arguable=("sign-flip",)),
    # at once to 80 % of the speed, 0.3 s later on from there
    f"{KNIGHTS}-realbot~data-logs~characterization-data20200225-1935": Seen(SLIPS, lag=150),
    f"{KNIGHTS}~data-logs~characterization-data20200126-1415": Seen(SLIPS, lag=150),
    f"{KNIGHTS}~data-logs~characterization-data20200308-1631": Seen(SLIPS, lag=150),
    "frc4646+2022-robot~sysid~sysid_data20220304-170104": Seen(
        arguable=("wheel-slip", "command-logged"), lag=140
    ),
    "frc4646+2022-robot~sysid~sysid_data20220306-111930": Seen(SLIPS, lag=140),
}
FOUND = 0.9  # [share] of what was seen


@pytest.fixture(scope="session")
def inspected(real_logs):
    """Every log that was looked at, inspected."""
    return {name: inspect(read(real_logs / f"{name}.json")) for name in LOOKED_AT}


def test_inspect_finds_the_faults_seen_by_eye(inspected):
    wanted = {
        (name, fault, run)
        for name, seen in LOOKED_AT.items()
        for fault, runs in seen.faults.items()
        for run in runs or (None,)
    }
    found = {
        (name, fault.fault, fault.where.run)
        for name, inspection in inspected.items()
        for fault in inspection.faults
    }

    assert len(wanted & found) >= FOUND * len(wanted), sorted(wanted - found, key=str)


@pytest.mark.parametrize("name", LOOKED_AT)
def test_real_logs_get_no_invented_faults(inspected, name):
    seen = LOOKED_AT[name]

    said = {fault.fault for fault in inspected[name].faults}

    assert said <= {*seen.faults, *seen.arguable}


@pytest.mark.parametrize("name", [name for name, seen in LOOKED_AT.items() if seen.lag is not None])
def test_the_delay_of_the_velocity_is_found_and_none_made_up(inspected, name):
    lag = LOOKED_AT[name].lag
    said = [doubt for doubt in inspected[name].doubts if doubt.code == "velocity-lag"]

    if not lag:
        assert said == []
    else:
        told = int(said[0].message.split(" ms")[0].rsplit(" ", 1)[1])
        assert told == pytest.approx(lag, abs=15)
