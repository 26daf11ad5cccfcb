"""The runs of a problem as contiguous arrays, simulated together for many models."""

from dataclasses import dataclass

from sim.core.log import Array


@dataclass(frozen=True, eq=False)
class RunBatch:
    """Several runs in contiguous arrays, one after another.

    Args:
        edges: (runs + 1,) where each begins among all samples, as the engine reads it: in doubles.
        time: (n,) [s], increasing within a run.
        voltage: (n,) [V].
        voltage_slide: (n,) [V] by which it slides evenly to the next sample; 0 is held.
        measured: (n, 2) position and velocity, nan where there is none.
        position: (runs,) [m or rad] at which each begins.
        velocity: (runs,) [m/s or rad/s] with which.
        low: (runs,) [m or rad] a stop beneath it; minus infinity is none.
        high: (runs,) [m or rad] a stop above it.
        clocks: (runs,) [s] when each began, since the first log did.
        memory_groups: (runs,) a number; what effects remember goes on between runs with the same.
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
