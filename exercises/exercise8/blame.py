"""The part of a preparation that spoils a gain most: the one whose repair helps most."""

from dataclasses import replace

from sim.core.errors import Refusal
from sim.core.log import FOUR_TESTS

from .drawn import Variant
from .preparation import Preparation, fit_prepared

HELPS = 0.9  # [times the error] what leaves more than that is not to blame

BEGIN, END = range(2)
WHOLE = (0.0, float("inf"))  # [s] the window of a test that is kept whole

Part = str | tuple[str, int]  # a setting, or a test and which end of its window
Said = tuple[str, str]  # what to say, and the misconception's code, or empty

PARTS: tuple[Part, ...] = (
    "median", "threshold", *((test, end) for test in FOUR_TESTS for end in (BEGIN, END))
)  # fmt: skip

LONG = (
    "How many samples does the rise of the steps take? A median of as many samples flattens it. "
    "Use the shortest window that removes the wrong readings."
)
SHORT = (
    "Single readings are far off. In a step, SysId may take one of them for the largest "
    "acceleration. What removes a single wrong reading?"
)
EVEN = (
    "Two readings have no middle one, so a window of 2 is their mean, and half of a wrong reading "
    "stays. What is the smallest window with a middle?"
)
MUCH = (
    "Too little is left of more than one test: compare your times with the length of each test, "
    "and your threshold with its speed."
)
NEAR = (
    "You cut no good sample, and keep nothing that is surely bad. Move the ends of your windows a "
    "little, and look at what changes."
)
HIGH = "Does your threshold drop good samples, in which the mechanism moves?"
LOW = (
    "Do you keep samples in which the mechanism stands, before it moves or at a stop? There, the "
    "voltage causes neither speed nor acceleration. How large is the noise of the velocity while "
    "the position does not change?"
)


def blame(gain: str, variant: Variant, preparation: Preparation) -> Said:
    """Feedback about a wrong gain: the part whose repair helps most, or that alone harms most."""
    reference = variant.reference
    errors: dict[Part, float] = {
        part: _compute_error(gain, variant, _copy_part(part, reference, preparation))
        for part in PARTS
    }
    limit = HELPS * _compute_error(gain, variant, preparation)
    parts = [part for part in PARTS if _may_be_blamed(part, variant, preparation)]
    best = min(parts, key=errors.__getitem__)
    if errors[best] < limit:
        return _explain_part(best, reference, preparation)
    if limit == float("inf"):
        return MUCH, "M-TRIM-PRETTY"
    alone = {part: _copy_part(part, preparation, reference) for part in parts}
    wrong = [part for part in parts if alone[part] != reference]
    if not wrong:
        return NEAR, ""
    worst = max(wrong, key=lambda part: _compute_error(gain, variant, alone[part]))
    says, code = _explain_part(worst, reference, preparation)
    return f"No single change that was tried mends this. Begin with this one. {says}", code


def _compute_error(gain: str, variant: Variant, preparation: Preparation) -> float:
    """The absolute error of a fitted gain, in its unit; infinite if there is no fit."""
    try:
        found = fit_prepared(variant.log, preparation).gains[gain]
    except Refusal:
        return float("inf")
    return abs(found - variant.asked[gain].expected)


def _copy_part(part: Part, source: Preparation, target: Preparation) -> Preparation:
    """The target with one part of the source: a setting, or an end of a test's window."""
    if isinstance(part, str):
        return replace(target, **{part: getattr(source, part)})
    test, end = part
    window = list(target.keep.get(test, WHOLE))
    window[end] = source.keep.get(test, WHOLE)[end]
    keep = {**target.keep, test: (window[BEGIN], window[END])}
    return replace(target, keep={one: span for one, span in keep.items() if span != WHOLE})


def _may_be_blamed(part: Part, variant: Variant, given: Preparation) -> bool:
    """Whether a part may be blamed: not the end of a window that cuts off no good sample."""
    if isinstance(part, str):
        return True
    test, end = part
    here, there = (one.keep.get(test, WHOLE)[end] for one in (given, variant.reference))
    if (here > there) == (end == END) and here != there:  # it keeps more than the reference
        return True
    run = next(one for one in variant.log.runs if one.test == test)
    since = run.time - run.time[0]
    lost = since < here if end == BEGIN else since > here
    return bool((lost & variant.valid[test]).any())


def _explain_part(part: Part, reference: Preparation, given: Preparation) -> Said:
    if part == "median":
        return _explain_median(reference, given)
    if isinstance(part, str):
        return _explain_threshold(reference, given)
    return _explain_window(*part, reference, given)


def _explain_median(reference: Preparation, given: Preparation) -> Said:
    if given.median > reference.median:
        return LONG, "M-FILTER-FREE"
    return (EVEN, "") if given.median == 2 else (SHORT, "")


def _explain_threshold(reference: Preparation, given: Preparation) -> Said:
    return (HIGH, "M-TRIM-PRETTY") if given.threshold > reference.threshold else (LOW, "")


def _explain_window(test: str, end: int, reference: Preparation, given: Preparation) -> Said:
    late = given.keep.get(test, WHOLE)[end] > reference.keep.get(test, WHOLE)[end]
    if end == END and late:
        return f"{test}: do you keep samples in which a hard stop holds the mechanism?", ""
    if end == BEGIN and not late:
        return f"{test}: do you keep samples from before it moves?", ""
    if end == BEGIN and test.startswith("dynamic"):
        return (
            f"{test}: you cut away its first rise, or a part of it. Only this rise contains kA.",
            "M-TRIM-PRETTY",
        )
    return f"{test}: you cut away good samples.", "M-TRIM-PRETTY"
