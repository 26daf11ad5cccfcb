"""Numbers that several subsystems use."""

HALF = 1 / 2
RAMP = HALF


class Lift:
    STEP = 7 * HALF
    TIMEOUT = 10
