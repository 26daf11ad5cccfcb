"""The runs of a problem as contiguous arrays, simulated together for many models."""

from dataclasses import dataclass

from sim.core.log import Array


@dataclass(frozen=True, eq=False)
class RunBatch:
    """Several runs in contiguous arrays, one after another.

    Args:
        edges: (runs + 1,) index of each run's first sample, and the number of samples, as floats.
        time: (n,) [s], increasing within a run.
        voltage: (n,) [V].
        voltage_slide: (n,) [V] linear change until the next sample; 0 is a zero-order hold.
        measured: (n, 2) position and velocity, nan where there is none.
        position: (runs,) [m or rad] at the start of each run.
        velocity: (runs,) [m/s or rad/s] at the start of each run.
        low: (runs,) [m or rad] lower stop; minus infinity is none.
        high: (runs,) [m or rad] upper stop; infinity is none.
        clocks: (runs,) [s] start of each run, since the start of the first log.
        memory_groups: (runs,) the memory of effects is kept between runs with the same number.
    """

    edges: Array
    time: Array
    voltage: Array
    voltage_slide: Array
    measured: Array
    position: Array
    velocity: Array
    low: Array
    high: Array
    clocks: Array
    memory_groups: Array
