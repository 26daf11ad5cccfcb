"""The part of a preparation that spoils a gain most: the one whose repair helps most."""

from collections.abc import Iterator
from dataclasses import replace

from sim.core.errors import Refusal
from sim.core.log import FOUR_TESTS

from .drawn import Variant
from .preparation import Preparation, fit_prepared

HELPS = 0.9  # [times the error] what leaves more than that is not to blame

Said = tuple[str, str]  # what to say, and the misconception's code, or empty

LONG = (
    "A median of so many samples flattens the rise of the steps: how many samples does the "
    "rise take? Use the shortest window that removes the wrong readings."
)
SHORT = (
    "Single readings are far off, also in the steps, and SysId takes one of them for the "
    "largest acceleration. What removes a single wrong reading?"
)
EVEN = (
    "Two readings have no middle one, so a window of 2 is their mean, and half of a wrong reading "
    "stays. What is the smallest window with a middle?"
)
MUCH = (
    "You cut away too much of more than one test: compare your times with the length of each test."
)
HIGH = "Your threshold drops good samples, in which the mechanism moves."
LOW = (
    "You keep samples from before the mechanism moves: there, the voltage causes neither "
    "speed nor acceleration. How large is the noise of the velocity while the position does "
    "not change?"
)


def blame(gain: str, variant: Variant, preparation: Preparation) -> Said:
    """Feedback about a wrong gain; empty if no single part explains it."""
    errors = [
        (_compute_error(gain, variant, repaired), says)
        for repaired, says in _list_repairs(variant.reference, preparation)
    ]
    limit = HELPS * _compute_error(gain, variant, preparation)
    helped = [one for one in errors if one[0] < limit]
    if not helped:
        several = ("Several things are wrong: start with the hard stops.", "")
        return (MUCH, "M-TRIM-PRETTY") if limit == float("inf") else several
    return min(helped, key=lambda one: one[0])[1]


def _compute_error(gain: str, variant: Variant, preparation: Preparation) -> float:
    """The absolute error of a fitted gain, in its unit; infinite if there is no fit."""
    try:
        found = fit_prepared(variant.log, preparation).gains[gain]
    except Refusal:
        return float("inf")
    return abs(found - variant.asked[gain].expected)


def _list_repairs(reference: Preparation, given: Preparation) -> Iterator[tuple[Preparation, Said]]:
    """The preparation with one part of it repaired, and what was wrong with that part."""
    yield replace(given, median=reference.median), _explain_median(reference, given)
    yield replace(given, threshold=reference.threshold), _explain_threshold(reference, given)
    for test in FOUR_TESTS:
        keep = dict(given.keep)
        if test in reference.keep:
            keep[test] = reference.keep[test]
        else:
            keep.pop(test, None)
        yield replace(given, keep=keep), _explain_window(test, reference, given)


def _explain_median(reference: Preparation, given: Preparation) -> Said:
    if given.median > reference.median:
        return LONG, "M-FILTER-FREE"
    return (EVEN, "") if given.median == 2 else (SHORT, "")


def _explain_threshold(reference: Preparation, given: Preparation) -> Said:
    return (HIGH, "M-TRIM-PRETTY") if given.threshold > reference.threshold else (LOW, "")


def _explain_window(test: str, reference: Preparation, given: Preparation) -> Said:
    begin, end = given.keep.get(test, (0.0, float("inf")))
    if end > reference.keep.get(test, (0.0, float("inf")))[1]:
        return (f"{test}: you keep samples in which a hard stop holds the mechanism.", "")
    if test.startswith("dynamic") and begin > 0.0:
        return (
            f"{test}: you cut away its first rise, or a part of it. Only this rise contains kA.",
            "M-TRIM-PRETTY",
        )
    return (f"{test}: you cut away good samples.", "M-TRIM-PRETTY")
