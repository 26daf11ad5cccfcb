"""Small effects, lags and the errors of gains, on logs that the simulation did not make."""

import numpy as np
import pytest
from made_elsewhere import KINDS, error_logs, lag_logs

from sim.fit import fit

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def fits():
    """Kind, truth and fit of every other log of one seed."""
    logs = [case for number, case in enumerate(error_logs(seeds=1, first=7)) if number % 2]
    return [(kind, truth, fit(log, type=truth.type)) for _, kind, truth, log in logs]


@pytest.mark.parametrize("kind", KINDS)
def test_errors_hold_under_noise_a_recorder_and_everyday_physics(fits, kind):
    inside: dict[str, list[bool]] = {}
    for made, truth, found in fits:
        if made == kind:
            for gain, value in truth.gains.items():
                near = abs(found.gains[gain] - value) < 2.0 * found.errors[gain]
                inside.setdefault(gain, []).append(near)

    assert {gain: np.mean(near) >= 0.85 for gain, near in inside.items()} == dict.fromkeys(
        inside, True
    )


def test_everyday_physics_leaves_kv_and_ka_where_they_are(fits):
    # charged to the gains, it moves kV by 0.3 % and kA by 0.6 % in the middle of such logs
    off = {"kV": [], "kA": []}
    for kind, truth, found in fits:
        if kind == "everyday":
            for gain, errors in off.items():
                errors.append(abs(found.gains[gain] / truth.gains[gain] - 1.0))

    assert np.median(off["kV"]) < 0.001
    assert np.median(off["kA"]) < 0.002


def test_an_averaged_velocity_and_a_late_voltage_are_distinguished_from_inertia():
    logs = [case for number, case in enumerate(lag_logs(seeds=1, first=7)) if number % 3 == 0]
    off = {name: fit(log).gains["kA"] / truth.gains["kA"] - 1.0 for name, truth, log in logs}

    assert {name: share for name, share in off.items() if abs(share) > 0.1} == {}
