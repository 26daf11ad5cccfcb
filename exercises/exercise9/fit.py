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
    # TODO: find the three. Take the tests one by one, make their acceleration, leave out
    #             the rows that stand still, and let least squares (np.linalg.lstsq) do the rest.
    return {"kS": ks, "kV": kv, "kA": ka}


if __name__ == "__main__":  # your own log, if you start this file yourself
    logs = Path(__file__).parent.glob("data/*/log.csv")
    log = max(logs, key=lambda path: path.stat().st_mtime)  # the newest
    rows = np.genfromtxt(log, delimiter=",", names=True, dtype=None, encoding="utf-8")
    names = ("time_s", "voltage", "position", "velocity", "test")
    print(fit(*(rows[name] for name in names)))
