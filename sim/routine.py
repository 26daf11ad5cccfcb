"""SysIdRoutine: what WPILib commands during each test, loop by loop.

    quasistatic   V = ± ramp · t            dynamic   V = ± step

A test starts its timer in one loop of the robot program and drives in the loops after the next, so
the first voltage of a ramp is ``ramp`` times two periods, not zero. It ends after ``timeout``, or
when the person at the controller lets go. Source: WPILib 2026.2.2, ``SysIdRoutine``; the number of
loops from a run of RobotPy's.
"""

import math
from dataclasses import dataclass

from sim.errors import BadRequest
from sim.log import FOUR_TESTS

LOOPS_BEFORE_DRIVE = 2  # loops from the start of the timer to the first voltage


@dataclass(frozen=True)
class Routine:
    """The Config of a SysIdRoutine; its defaults are WPILib's.

    Args:
        ramp: [V/s] of the quasistatic tests.
        step: [V] of the dynamic tests.
        timeout: [s] after which a test ends by itself.

    Raises:
        BadRequest: a number is not positive and finite, or a voltage beyond the battery's.
    """

    ramp: float = 1.0
    step: float = 7.0
    timeout: float = 10.0

    def __post_init__(self) -> None:
        limits = {"ramp": ("V/s", 100.0), "step": ("V", 12.0), "timeout": ("s", 600.0)}
        for name, (symbol, most) in limits.items():
            value = getattr(self, name)
            if not (math.isfinite(value) and 0.0 < value <= most):
                raise BadRequest(
                    f"a {name} of {value:g} {symbol}",
                    advice=f"Choose a number above 0, at most {most:g} {symbol}.",
                )

    @property
    def tests(self) -> tuple[str, ...]:
        """The tests it runs, in the order one binds them."""
        return FOUR_TESTS

    def voltage(self, test: str, time: float) -> float:
        """The voltage of a test.

        Args:
            test: one of ``tests``.
            time: [s] since its timer started.

        Returns:
            [V], negative in a reverse test.
        """
        sign = 1.0 if test.endswith("forward") else -1.0
        return sign * (self.ramp * time if test.startswith("quasistatic") else self.step)
