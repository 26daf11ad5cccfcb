"""What a person sees in plots of real robots' logs, and what an inspection says of them.

The table was written by looking at a plot of each run (voltage, velocity, slope of the position,
position) before the inspection was run on it. The logs are not part of the project.
"""

from dataclasses import dataclass, field

import pytest

from sim.inspect.detect_faults import inspect
from sim.io import read

pytestmark = [pytest.mark.slow, pytest.mark.shared]

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
FOUND, FALSE = 0.9, 0.1  # [share] of what was seen, and of the logs in which nothing was


@pytest.fixture(scope="session")
def inspected(real_logs):
    """Every log that was looked at, inspected."""
    return {name: inspect(read(real_logs / f"{name}.json")) for name in LOOKED_AT}


def test_what_is_seen_is_found(inspected):
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
def test_nothing_is_made_up(inspected, name):
    seen = LOOKED_AT[name]

    said = {fault.fault for fault in inspected[name].faults}

    assert said <= {*seen.faults, *seen.arguable}


@pytest.mark.parametrize("name", [name for name, seen in LOOKED_AT.items() if seen.lag is not None])
def test_the_delay_of_the_velocity_is_told_and_none_made_up(inspected, name):
    lag = LOOKED_AT[name].lag
    said = [doubt for doubt in inspected[name].doubts if doubt.code == "velocity-lags"]

    if not lag:
        assert said == []
    else:
        told = int(said[0].message.split(" ms")[0].rsplit(" ", 1)[1])
        assert told == pytest.approx(lag, abs=15)
