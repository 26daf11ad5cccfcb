"""Voltages that are probably not in volts: duty cycles and millivolts."""

from sim.core.doubt import Doubt
from sim.core.log import Log

LEAST = 1.0  # [V] largest duty cycle; real tests use more
MOST = 50.0  # [V] far more than any robot has
FEWEST = 20  # [samples] shorter logs are not checked


def check_voltage(log: Log) -> Log:
    """The log, with a doubt if its voltages are probably not in volts."""
    moving = [run for run in log.runs if run.top_speed > 0.0]
    peak = max((float(abs(run.voltage).max()) for run in moving), default=0.0)
    known = any(doubt.code == "rate-as-voltage" for doubt in log.doubts)
    if known or peak == 0.0 or sum(map(len, moving)) < FEWEST:
        return log
    start = f"{log.source}: the largest voltage is {peak:.4g} V"
    if peak > MOST:
        message = (
            f"{start}, and no robot has so many volts. These are probably millivolts. Log volts, "
            "and divide by 1000 what you have."
        )
        return log.add_doubts(Doubt("not-volts", message, grave=True))
    if peak > LEAST:
        return log
    message = (
        f"{start}, and a test of a robot needs more. This is probably a duty cycle (-1 to 1). Then "
        "all gains are some 12 times too small. Log the applied voltage."
    )
    return log.add_doubts(Doubt("not-volts", message))
