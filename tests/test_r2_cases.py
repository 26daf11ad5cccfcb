"""What R² hides: the table of the reference, made again by our own bench, and where they differ."""

import numpy as np
import pytest

from sim.fit import fit
from sim.teaching.r2_cases import GOOD, make_cases
from sim.teaching.r2_cases.drivetrains import GOOD_BATTERY, LIMITED, WEAK_BATTERY

SEEDS = range(5)  # the median of five: where a gap falls is luck
GAINS = ("kS", "kV", "kA")
TWICE = 2.0  # two benches agree on an error if one is at most twice the other
SMALL = 10.0  # [%] or both are this small
NEAR_KV, NEAR_R2 = 5.0, 0.06  # [%], [1] the same for kV and for the simulated velocity R²

# name: our bench, median of five logs (kS [%], kV [%], kA [%], acceleration R², simulated velocity
# R²), then the same from the reference's scratch simulation. None: not given there.
TABLE = {
    "clean": ((6, 0, -1, 0.91, 0.993), (-3, 0, 2, 0.84, 0.989)),
    "1 encoder spike": ((-35, 0, 56, 0.16, 0.953), (-49, 0, 66, 0.18, 0.953)),
    "3 encoder spikes": ((-149, 1, 177, 0.04, 0.909), (-174, 2, 220, 0.05, 0.911)),
    "10 encoder spikes": ((-455, 3, 567, 0.01, 0.813), (-511, 5, 648, 0.01, 0.839)),
    "10 spikes, median of 5": ((21, 0, -26, 0.91, 0.865), (-1, 0, 0, 0.93, 0.992)),
    "encoder slips 10 %": ((-138, 15, 26, 0.71, 0.945), (-98, 15, 24, 0.70, 0.972)),
    "encoder slips 30 %": ((-940, 66, 572, 0.16, 0.842), (-670, 71, 450, 0.23, 0.895)),
    "sudden jump": ((-133, 1, 157, 0.19, 0.915), (-101, 1, 149, 0.14, 0.926)),
    "stop during the rise": ((-10, 0, 37, 0.46, 0.973), (-9, 0, 22, 0.46, 0.987)),
    "commanded volts, 7 V step": ((-4, -1, 38, 0.96, 0.991), (15, -4, 51, 0.96, 0.975)),
    "commanded volts, 10 V step": ((-101, 0, 226, 0.93, 0.982), (-152, -2, 347, 0.97, 0.986)),
    "brownout, commanded volts": ((15, -1, 38, 0.60, 0.961), (-12, 0, 43, 0.59, 0.960)),
    "gaps up to 100 ms": ((-4, 0, 20, 0.84, 0.989), (-16, 0, 27, 0.75, 0.984)),
    "gaps up to 300 ms": ((-17, 0, 46, 0.60, 0.978), (-33, 0, 47, 0.61, 0.965)),
    "slow velocity filter": ((81, 0, -3, 0.76, 0.953), (52, 0, 32, 0.65, 0.987)),
    "40 A limit, commanded volts": ((-25, 0, 62, 0.81, 0.984), (-28, -1, 71, 0.84, 0.982)),
    "wheel slip, 3.5 V step": ((-5, 0, 23, 0.80, 0.990), (-18, 0, 39, 0.70, 0.978)),
    "wheel slip, 4 V step": ((-10, 0, 33, 0.64, 0.986), (-18, 0, 48, 0.56, 0.969)),
    "wheel slip, 7 V step": ((-20, 0, 49, 0.24, 0.965), (-46, 1, 66, 0.21, 0.922)),
    "friction differs": ((-22, 0, 58, 0.64, 0.961), (-66, 2, 145, 0.53, 0.934)),
    "wrong gear ratio": ((8, 25, 25, 0.91, 0.993), (-2, 25, 27, 0.84, 0.989)),
    "encoder the wrong way": ((-207, -200, -200, 0.91, 0.993), (None, None, None, 0.84, 0.989)),
}
# Where the two benches do not agree about kA or R², and why, as far as it is known.
DIFFERS = {
    "10 spikes, median of 5": "the window of 100 ms flattens a rise of 76 ms, which costs us kA; "
    "and our R² counts the spikes: the recipe compares with what was recorded, not with what was "
    "filtered",
    "slow velocity filter": "ours is a running mean over 0.224 s, read every loop; then the ramp's "
    "lag goes to kS, and kA stays by accident",
    "friction differs": "the reference does not say how long its ramps are; the longer they are "
    "beside the steps, the more of it goes to kA",
}
LUCKY = {
    "gaps up to 100 ms",
    "gaps up to 300 ms",
    "40 A limit, commanded volts",
}  # they spread widely

each_case = pytest.mark.parametrize("name", TABLE)


@pytest.fixture(scope="module")
def cases_by_name():
    """Name -> five logs of that case."""
    by_name = {}
    for seed in SEEDS:
        for case in make_cases(rng=np.random.default_rng(seed)):
            by_name.setdefault(case.name, []).append(case)
    return by_name


def measured(five):
    """As a row of the table."""
    rows = [
        (
            *(100.0 * case.compute_gain_error(gain) for gain in GAINS),
            case.fit.acceleration_r2,
            case.fit.simulated_velocity_r2,
        )
        for case in five
    ]
    return np.median(rows, axis=0)


def test_there_is_a_case_for_every_row_of_the_table(cases_by_name):
    assert list(cases_by_name) == list(TABLE)


@each_case
def test_simulated_cases_agree_with_the_table(name, cases_by_name):
    found, expected = measured(cases_by_name[name]), np.array(TABLE[name][0])
    most = np.array([6.0, 1.5, 6.0, 0.05, 0.01])
    most[:3] += 0.08 * np.abs(expected[:3])
    if name in LUCKY:
        most[[0, 2, 3]] = 30.0, 45.0, 0.15

    assert np.all(np.abs(found - expected) <= most), found.round(3)


@each_case
def test_two_benches_agree_or_the_table_says_why_not(name, cases_by_name):
    assert agree(measured(cases_by_name[name]), TABLE[name][1]) == (name not in DIFFERS)


def agree(ours, theirs):
    """Whether two rows say the same of kV, of kA and of whether R² passes."""
    kv, ka, r2 = theirs[1], theirs[2], theirs[4]
    gains = kv is None or (abs(ours[1] - kv) < NEAR_KV and about(ours[2], ka))
    return gains and abs(ours[4] - r2) < NEAR_R2 and (ours[4] > GOOD) == (r2 > GOOD)


def about(one, other):
    """Whether two errors [%] are both small, or of one sign and one size."""
    if max(abs(one), abs(other)) < SMALL:
        return True
    return one * other > 0 and 1 / TWICE <= one / other <= TWICE


def test_seventeen_of_nineteen_damaged_logs_have_a_good_r2(cases_by_name):
    """The reference's count leaves the weak battery out: it would be a twentieth, and passes."""
    wrong = [five for name, five in cases_by_name.items() if five[0].harmful]
    counted = [five for five in wrong if five[0].name != "commanded volts, 10 V step"]
    passing = [five for five in counted if all(case.has_good_r2 for case in five)]

    assert len(counted) == 19
    assert len(passing) == 17
    assert {five[0].name for five in counted if five not in passing} == {
        "10 encoder spikes",
        "encoder slips 30 %",
    }


def test_ka_is_fragile_kv_robust_and_ks_between(cases_by_name):
    scales = ("wrong gear ratio", "encoder the wrong way")  # these are no damage but another unit
    rows = np.array([measured(five) for name, five in cases_by_name.items() if name not in scales])
    kv, ks, ka = (np.median(np.abs(rows[:, column])) for column in (1, 0, 2))

    assert kv < 1.0 < ks < ka
    assert ka > 30.0


def test_logging_the_applied_voltage_gives_the_right_ka():
    for setup in (GOOD_BATTERY, WEAK_BATTERY, LIMITED):
        log = setup.log(rng=np.random.default_rng(1))
        ka = fit(log, method="sysid").gains["kA"]
        assert ka == pytest.approx(setup.mechanism.gains["kA"], rel=0.06)
