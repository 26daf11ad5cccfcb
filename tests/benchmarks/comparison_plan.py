"""What the comparison of methods simulates: sections of rows, each row a way to make a log.

All logs but those of real robots are of one mechanism as a textbook has it: friction, back-EMF and
inertia, nothing else, under a ramp of 1 V/s and a step of 7 V for 10 s each way; an encoder of
0.1 mm, and a velocity with white noise.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim.bench.mechanism import Sensor
from sim.bench.sensor_model import read_sensor
from sim.bench.simulate import move_gains_only
from sim.core.log import FOUR_TESTS, Log, Run

GAINS = {"kS": 0.25, "kV": 2.0, "kA": 0.3}  # [V, V·s/m, V·s²/m] a drivetrain: kA/kV is 150 ms
LENGTH = 10.0  # [s] of a test
STEP = 7.0  # [V]
QUIET = 0.05  # [m/s] slower than this the velocity is less noisy
TICK = 1e-4  # [m] of the encoder
SHAKEN = 0.05  # [m/s] of noise where the period differs
NIMBLE = 0.05  # [V·s²/m] kA where the lag differs: kA/kV is 25 ms


@dataclass(frozen=True)
class Row:
    """A way to make a log of the textbook's mechanism.

    Args:
        name: what the row says it is.
        noise: [m/s] standard deviation of the velocity.
        period: [s] between samples.
        ka: [V·s²/m].
        frame: [s] between new readings; 0 has one in every sample.
        window: [s] over which the velocity is averaged.
        lag: [s] by which every reading is late.
    """

    name: str
    noise: float = 0.02
    period: float = 0.02
    ka: float = GAINS["kA"]
    frame: float = 0.0
    window: float = 0.0
    lag: float = 0.0

    @property
    def truth(self) -> Mapping[str, float]:
        """The gains it is made with."""
        return {**GAINS, "kA": self.ka}

    @property
    def late(self) -> float:
        """[s] from motion to the velocity that is logged."""
        return self.lag + 0.5 * self.window

    def log(self, seed: int) -> Log:
        """Its four tests; the seed says which noise."""
        chance, runs = np.random.default_rng(seed), []
        sensor = Sensor(
            TICK, self.noise, QUIET, jitter=0.0,
            filter=self.window, latency=self.lag, frame=self.frame,
        )  # fmt: skip
        time = np.arange(round(LENGTH / self.period)) * self.period
        for index, test in enumerate(FOUR_TESTS):
            sign = 1.0 if test.endswith("forward") else -1.0
            ramp = test.startswith("quasistatic")
            volts = sign * (time if ramp else np.full(time.size, STEP))
            x, v = move_gains_only(self.truth, time=time, voltage=volts)
            seen = read_sensor(sensor, position=x, velocity=v, time=time, rng=chance)
            runs.append(Run(test, 2.0 * index * LENGTH + time, volts, *seen))
        return Log(tuple(runs), type="simple")


@dataclass(frozen=True)
class Section:
    """Rows of which one thing differs.

    Args:
        title: of the section.
        about: what differs, a sentence or two.
        first: head of the first column.
        rows: in the order of the table.
        told: name of the row by which the section is told first.
    """

    title: str
    about: str
    first: str
    rows: tuple[Row, ...]
    told: str


NOISE = Section(
    "Velocity noise",
    "Standard deviation of a velocity sample, at 20 ms. An encoder behind a gearbox has about "
    "0.01 m/s; one differentiated at a high rate, or shaken by a chain, 0.1 m/s and more.",
    "noise",
    tuple(Row(f"{noise:.2f} m/s", noise=noise) for noise in (0.02, 0.05, 0.10, 0.20)),
    "0.10 m/s",
)
PERIOD = Section(
    "Sampling period",
    f"At {SHAKEN} m/s of noise. Logging faster helps a fit that simulates, and harms one that "
    "differentiates. In the last row a motor controller sends every 20 ms what is logged every "
    "5 ms.",
    "logged every",
    (
        *(Row(f"{ms} ms", noise=SHAKEN, period=1e-3 * ms) for ms in (20, 10, 5)),
        Row("5 ms, in frames of 20 ms", noise=SHAKEN, period=0.005, frame=0.02),
    ),
    "5 ms, in frames of 20 ms",
)
LIGHT = Section(
    "Light mechanisms",
    "Less inertia, at 20 ms: with a kA of 0.02 V·s²/m the mechanism is at its speed after two "
    "samples.",
    "kA, noise",
    tuple(
        Row(f"{ka:.2f} V·s²/m, {noise:.2f} m/s", ka=ka, noise=noise)
        for noise in (0.02, 0.10)
        for ka in (0.10, 0.05, 0.02)
    ),
    "0.02 V·s²/m, 0.10 m/s",
)
LAG = Section(
    "Hidden lag",
    f"A kA of {NIMBLE} V·s²/m at 0.02 m/s of noise and 20 ms, no word of the lag in the log. Motor "
    "controllers average a velocity over some 10 to 110 ms before they send it.",
    "velocity",
    tuple(
        Row(name, ka=NIMBLE, window=window, lag=lag)
        for name, window, lag in (
            ("as it is", 0.0, 0.0),
            ("averaged over 20 ms", 0.02, 0.0),
            ("averaged over 50 ms", 0.05, 0.0),
            ("averaged over 100 ms", 0.1, 0.0),
            ("all 20 ms late", 0.0, 0.02),
            ("all 20 ms late, averaged over 100 ms", 0.1, 0.02),
        )
    ),
    "averaged over 100 ms",
)
SECTIONS = (NOISE, PERIOD, LIGHT, LAG)
