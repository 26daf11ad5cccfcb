"""How much the gains of one mechanism differ from one recording to the next.

The error of a fit says how well one recording determines the gains. It cannot say what changes
before the next one: battery, heat, a chain that lies differently, another carpet. ``SHARES`` was
measured on 241 logs of real robots, as ``tests/benchmarks/bench_real.py`` does it: by how much two
recordings of one mechanism on one day differ, the median over all pairs.
"""

from collections.abc import Mapping

from sim.fit.result import Fit
from sim.support.printable import join_names

SHARES: Mapping[str, float] = {"kS": 0.06, "kV": 0.03, "kA": 0.16, "kG": 0.11}
"""Gain -> median difference of two recordings, as a share of it."""


def describe_next_recording(found: Fit) -> tuple[str, ...]:
    """A sentence on how much another recording's gains will differ.

    Args:
        found: the fit of one recording.

    Returns:
        The sentence; nothing if no error is small enough for this to matter.
    """
    told = [
        f"{gain} by about {100.0 * SHARES[gain]:.0f} %"
        for gain, error in found.errors.items()
        if error < SHARES.get(gain, 0.0) * abs(found.gains[gain])
    ]
    said = (
        f"These errors are of this log alone. The next recording will differ: {join_names(told)}, "
        "as on most robots. To see yours, record twice and fit both: sysid fit ONE TWO"
    )
    return (said,) if told else ()
