"""The scatter of gains that sensor noise causes in some tests of a mechanism."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.fit.information_matrix import compute_information
from sim.fit.sysid_rows import Rows, prepare_rows

ROW = 0.02  # [s] between two rows


def simulate_rows(mechanism: Mechanism, routine: Routine) -> dict[str, Rows]:
    """The rows that a fit sees of each test, as they would be without noise.

    Args:
        mechanism: the mechanism to test.
        routine: ramp and step of its tests.
    """
    sensor = replace(mechanism.sensor, velocity_noise=0.0, jitter=0.0, resolution=1e-9)
    quiet = simulate(replace(mechanism, sensor=sensor), routine, rng=np.random.default_rng(0))
    return dict(prepare_rows(quiet).rows)


def compute_gain_errors(mechanism: Mechanism, rows: Mapping[str, Rows]) -> dict[str, float]:
    """The standard error of each gain as a share of the gain; infinite where it is unknown.

    Args:
        mechanism: with the noise of its velocity sensor.
        rows: test -> its rows, of ``simulate_rows``.

    Raises:
        BadRequest: there are no rows.
    """
    gains = mechanism.gains
    noise = gains["kA"] * mechanism.sensor.velocity_noise / (np.sqrt(2) * ROW)  # [V] of a row
    errors = compute_information(rows, type=mechanism.type, noise=noise).errors
    return {gain: error / gains[gain] for gain, error in errors.items()}
