"""The part of a preparation that spoils a gain most: the one whose repair helps most."""

from dataclasses import replace

from sim.core.errors import Refusal
from sim.core.log import FOUR_TESTS

from .drawn import Variant
from .preparation import Preparation, fit_prepared

HELPS = 0.9  # [times the error] what leaves more than that is not to blame

PARTS = ("median", "threshold", *FOUR_TESTS)

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
    "Of all your choices, another threshold helps this gain most. Do you keep samples in which the "
    "mechanism stands, before it moves or at a stop? There, the voltage causes neither speed nor "
    "acceleration. How large is the noise of the velocity while the position does not change?"
)


def blame(gain: str, variant: Variant, preparation: Preparation) -> Said:
    """Feedback about a wrong gain: the part whose repair helps most, or that alone harms most."""
    reference = variant.reference
    errors = {
        part: _compute_error(gain, variant, _copy_part(part, reference, preparation))
        for part in PARTS
    }
    limit = HELPS * _compute_error(gain, variant, preparation)
    best = min(PARTS, key=errors.__getitem__)
    if errors[best] < limit:
        return _explain_part(best, reference, preparation)
    if limit == float("inf"):
        return MUCH, "M-TRIM-PRETTY"
    alone = {part: _copy_part(part, preparation, reference) for part in PARTS}
    wrong = [part for part in PARTS if alone[part] != reference]
    worst = max(wrong, key=lambda part: _compute_error(gain, variant, alone[part]))
    says, code = _explain_part(worst, reference, preparation)
    return f"Several things are wrong. Begin with this one. {says}", code


def _compute_error(gain: str, variant: Variant, preparation: Preparation) -> float:
    """The absolute error of a fitted gain, in its unit; infinite if there is no fit."""
    try:
        found = fit_prepared(variant.log, preparation).gains[gain]
    except Refusal:
        return float("inf")
    return abs(found - variant.asked[gain].expected)


def _copy_part(part: str, source: Preparation, target: Preparation) -> Preparation:
    """The target with one part of the source: a setting, or the window of a test."""
    if part == "median":
        return replace(target, median=source.median)
    if part == "threshold":
        return replace(target, threshold=source.threshold)
    keep = {test: window for test, window in target.keep.items() if test != part}
    if part in source.keep:
        keep[part] = source.keep[part]
    return replace(target, keep=keep)


def _explain_part(part: str, reference: Preparation, given: Preparation) -> Said:
    if part == "median":
        return _explain_median(reference, given)
    if part == "threshold":
        return _explain_threshold(reference, given)
    return _explain_window(part, reference, given)


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
