"""The regulator in closed form gives what SciPy's general routines give."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.linalg import expm, fractional_matrix_power, solve_discrete_are

from sim.feedback.linear_quadratic import design_two_state_regulator

VOLTS, POSITION = 7.0, 0.1


def by_scipy(rate, push, *, period, q, r, loops):
    discrete = expm(np.array([[0.0, 1.0, 0.0], [0.0, rate, push], [0.0, 0.0, 0.0]]) * period)
    a, b = discrete[:2, :2], discrete[:2, 2:]
    s = solve_discrete_are(a, b, np.diag(q), np.array([[r]]))
    k = np.linalg.solve(b.T @ s @ b + r, b.T @ s @ a)
    return np.real(k @ fractional_matrix_power(a - b @ k, loops))[0] if loops else k[0]


@pytest.mark.parametrize("period", [0.001, 0.020])
@pytest.mark.parametrize("delay", [0.0, 0.001, 0.0815, 0.112])
@pytest.mark.parametrize(
    ("kv", "ka"),
    [(2.0, 0.3), (0.12, 0.01), (35.0, 0.2), (0.0, 0.5), (0.02, 0.1), (1.3, 0.003), (0.5, 40.0)],
)
def test_gains_are_those_of_scipy(kv, ka, period, delay):
    q = (POSITION**-2, (0.25 * 12.0 / kv if kv else 1.5) ** -2)
    asked = {"period": period, "q": q, "r": VOLTS**-2, "loops": delay / period}

    found = design_two_state_regulator(-kv / ka, 1.0 / ka, **asked)

    expected = by_scipy(-kv / ka, 1.0 / ka, **asked)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_a_fit_in_json_imports_no_scipy(tmp_path):
    code = (
        "import sys, numpy as np, sim\n"
        "from sim.bench.mechanisms import MECHANISMS\n"
        "from sim.bench.simulate import simulate\n"
        "log = simulate(MECHANISMS['drivetrain'], sim.Routine(), rng=np.random.default_rng(1))\n"
        "sim.write(log, sys.argv[1])\n"
        "from sim.cli import sysid\n"
        "from sim.support.command_line import run_command\n"
        "code = run_command(sysid, name='sysid', arguments=['fit', '--json', sys.argv[1]])\n"
        "assert code == 0 and not [name for name in sys.modules if name.startswith('scipy')]\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "a.wpilog")],
        capture_output=True, text=True, check=False,
    )  # fmt: skip

    assert done.returncode == 0, done.stderr
