"""Exercise 9: find kS, kV and kA in any log of a mechanism without gravity.

Try it on your own log: python exercises/exercise9/fit.py
"""

from pathlib import Path

import numpy as np


def fit(time, voltage, position, velocity, test):
    """Find the gains in the rows of a log.

    Every argument is a column, a numpy array with one value for each row of the log.

    Args:
        time: [s]; between two tests there is a pause.
        voltage: [V], what the motor got.
        position: in meters or rotations, for example.
        velocity: in the same unit per second.
        test: the name of the test the row belongs to, such as "quasistatic-forward".

    Returns:
        A dict with three numbers: {"kS": ..., "kV": ..., "kA": ...}.
    """
    ks = kv = ka = None
    # --- answer: find the three. Take the tests one by one, make their acceleration, leave out
    # ---         the rows that stand still, and let least squares (np.linalg.lstsq) do the rest.
    columns, accelerations = [], []
    for name in np.unique(test):
        rows = test == name
        v, u = velocity[rows], voltage[rows]
        a = np.gradient(v, time[rows])
        moving = np.abs(v) > 0.05 * np.abs(v).max()
        columns.append(np.column_stack((v, u, np.sign(v)))[moving])
        accelerations.append(a[moving])
    # The acceleration is the noisiest of the columns. That is the one to explain, by alpha times
    # the velocity, beta times the voltage and gamma times the sign of the velocity.
    alpha, beta, gamma = np.linalg.lstsq(
        np.vstack(columns), np.concatenate(accelerations), rcond=None
    )[0]
    ks, kv, ka = -gamma / beta, -alpha / beta, 1 / beta
    # --- end
    return {"kS": ks, "kV": kv, "kA": ka}


if __name__ == "__main__":  # your own log, if you start this file yourself
    logs = Path(__file__).parent.glob("data/*/log.csv")
    log = max(logs, key=lambda path: path.stat().st_mtime)  # the newest
    rows = np.genfromtxt(log, delimiter=",", names=True, dtype=None, encoding="utf-8")
    names = ("time_s", "voltage", "position", "velocity", "test")
    print(fit(*(rows[name] for name in names)))
