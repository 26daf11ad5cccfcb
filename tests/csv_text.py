"""A small CSV log as text, and how tests read one."""

from pathlib import Path

import sim
from sim.core.log import Log

HEADER = "test,time_s,voltage,position,velocity"
PLAIN = f"""{HEADER}
quasistatic-forward,0.0,0.5,1.0,0.25
quasistatic-forward,0.02,0.75,1.5,0.5
dynamic-reverse,3.0,-7.0,2.0,-1.0
"""


def read_text(folder: Path, text: str | bytes, **asked: object) -> Log:
    path = folder / "log.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return sim.read(path, **asked)
