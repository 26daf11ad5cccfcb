"""The voltage that WPILib's SysIdRoutine commands in each test, loop by loop.

    quasistatic   V = ± ramp · t            dynamic   V = ± step

and further tests, which tell effects apart that the four tests cannot:

    coast         ± step, then zero         triangle  ± up to the step, down to minus it, and back
    multistep     ± steps of many sizes     chirp     ± a sine whose frequency rises

A test starts its timer in one loop of the robot program and applies a voltage from the second loop
after it on, so the first voltage of a ramp is ``ramp`` times two periods, not zero. It ends after
``timeout``, or when the button is released. Source: WPILib 2026.2.2, ``SysIdRoutine``; the number
of loops is from a run of RobotPy's, in which the command is scheduled before the scheduler runs. A
command that a button starts is scheduled while it runs, and drives one loop earlier.
"""

import math
from dataclasses import dataclass

from sim.core.errors import BadRequest
from sim.core.log import DIRECTIONS, KINDS

LOOPS_BEFORE_DRIVE = 2  # loops from the start of the timer to the first voltage
COAST_AFTER = 1.0  # [s] of the step before the coast
LEVELS = (0.4, 0.8, -0.4, 0.6, -0.8, 1.0, -0.6, 0.2, -1.0, -0.2)  # [share of the step] of multistep
LEVEL_LASTS = 0.5  # [s] length of each level
SLOWEST_SWING, FASTEST_SWING = 0.2, 4.0  # [Hz] frequency of a chirp at its start and timeout
TRIANGLE_RISES = 2.0  # [s] from zero to the step


@dataclass(frozen=True)
class Routine:
    """The Config of a SysIdRoutine; its defaults are WPILib's.

    Args:
        ramp: [V/s] ramp rate of the quasistatic tests.
        step: [V] voltage of the dynamic tests.
        timeout: [s] longest duration of a test.
        kinds: kinds of test, each run forward and reverse; SysIdRoutine has the first two.

    Raises:
        BadRequest: a number out of range, or a kind that is unknown or there twice.
    """

    ramp: float = 1.0
    step: float = 7.0
    timeout: float = 10.0
    kinds: tuple[str, ...] = KINDS[:2]

    def __post_init__(self) -> None:
        limits = {"ramp": ("V/s", 100.0), "step": ("V", 12.0), "timeout": ("s", 600.0)}
        for name, (symbol, most) in limits.items():
            value = getattr(self, name)
            if not (math.isfinite(value) and 0.0 < value <= most):
                raise BadRequest(
                    f"a {name} of {value:g} {symbol} is out of range",
                    advice=f"Choose a number above 0, at most {most:g} {symbol}.",
                )

        unknown = [kind for kind in self.kinds if kind not in KINDS]
        if unknown or not self.kinds or len(set(self.kinds)) < len(self.kinds):
            raise BadRequest(
                f"a kind of test is unknown, missing or there twice: {', '.join(self.kinds)}",
                advice=f"Choose from these, each at most once: {', '.join(KINDS)}.",
            )

    @property
    def tests(self) -> tuple[str, ...]:
        """Names of the tests that it runs, in order."""
        return tuple(f"{kind}-{way}" for kind in self.kinds for way in DIRECTIONS)

    def find_longest_duration(self, _test: str, /) -> float:
        """[s] duration of a test that does not reach the end of the travel."""
        return self.timeout

    def command_voltage(self, test: str, time: float) -> float:
        """[V] command of a test at a time.

        Args:
            test: one of ``tests``.
            time: [s] since the timer started.

        Returns:
            [V] the command of a forward test, negated in a reverse test.
        """
        kind, _, way = test.rpartition("-")
        return (1.0 if way == "forward" else -1.0) * self._command_forward(kind, time)

    def _command_forward(self, kind: str, time: float) -> float:
        """[V] commanded voltage in a forward test."""
        match kind:
            case "quasistatic":
                return self.ramp * time
            case "coast":
                return self.step if time < COAST_AFTER else 0.0
            case "triangle":  # up, down to the negative step, and back to zero
                phase = (time / TRIANGLE_RISES) % 4.0
                return self.step * (abs((phase + 3.0) % 4.0 - 2.0) - 1.0)
            case "multistep":
                return self.step * LEVELS[int(time / LEVEL_LASTS) % len(LEVELS)]
            case "chirp":  # the phase is the integral of a frequency that rises linearly
                rise = (FASTEST_SWING - SLOWEST_SWING) / self.timeout
                return self.step * math.sin(
                    2.0 * math.pi * (SLOWEST_SWING + 0.5 * rise * time) * time
                )
            case _:
                return self.step
