"""Recorders: how a device measures, filters and sends the values that a robot program logs.

    mechanism = RECORDERS["sparkmax"].record(MECHANISMS["drivetrain"])
    log = simulate(mechanism, Routine(), rng=rng, period=RECORDERS["sparkmax"].period)

A filter is one moving average with the published delay: Phoenix 5 averages differences over 100 ms
for 64 ms. Its delay of 81.5 ms is that of an average over 163 ms.

Sources: the measurement delays are those of WPILib SysId's presets, T(n - 1)/2 for n averaged
differences; the frame rates are the vendors' defaults (Phoenix 6: 50 Hz on CAN 2.0, 100 Hz on
CAN FD; Phoenix 5 and REV: 20 ms).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from sim.bench.mechanism import Mechanism
from sim.core.errors import refuse_unknown


@dataclass(frozen=True)
class Recorder:
    """A device that measures, and the loop that logs it.

    Args:
        summary: one line for a list.
        period: [s] time between two samples of the log.
        frame: [s] time between two status frames; 0 has no frames.
        filter: [s] time over which the velocity is averaged.
        latency: [s] delay from motion to reading.
    """

    summary: str
    period: float = 0.02
    frame: float = 0.0
    filter: float = 0.0
    latency: float = 0.0

    def record(self, mechanism: Mechanism) -> Mechanism:
        """A copy of the mechanism whose sensors sample as this recorder does."""
        sensor = replace(
            mechanism.sensor, frame=self.frame, filter=self.filter, latency=self.latency
        )
        return replace(mechanism, sensor=sensor)


RECORDERS: Mapping[str, Recorder] = {
    "roborio": Recorder("encoder wired to the roboRIO, logged each loop"),
    "roborio-2020": Recorder(
        "the same, with the 5 ms loop of the tools of 2019 to 2023", period=0.005
    ),
    "talonfx": Recorder("TalonFX with Phoenix 6 on CAN 2.0", frame=0.02, filter=0.002),
    "talonfx-canfd": Recorder("TalonFX with Phoenix 6 on CAN FD", frame=0.01, filter=0.002),
    "signal-logger": Recorder(
        "TalonFX, logged by CTRE's SignalLogger", period=0.004, frame=0.004, filter=0.002
    ),
    "phoenix5": Recorder("TalonFX or TalonSRX with Phoenix 5", frame=0.02, filter=0.163),
    "sparkmax": Recorder("Spark MAX with the encoder of a NEO", frame=0.02, filter=0.224),
    "sparkmax-encoder": Recorder(
        "Spark MAX with an encoder at its data port", frame=0.02, filter=0.163
    ),
    "venom": Recorder("Playing With Fusion Venom", frame=0.02, filter=0.01),
}
"""Name, as on the command line -> recorder."""


def find_recorder(name: str) -> Recorder:
    """Look up a recorder.

    Raises:
        BadRequest: no such recorder; the message lists those there are.
    """
    refuse_unknown("recorder", name, RECORDERS)
    return RECORDERS[name]
