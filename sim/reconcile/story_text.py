"""Plain sentences for a reconcile story."""

import math
from collections.abc import Sequence

from sim.physics.effects import EFFECTS
from sim.reconcile.story import (
    AMBIGUOUS,
    NOTHING_MISSING,
    UNEXPLAINED,
    Finding,
    ParameterEstimate,
    Story,
)

SHRINKS = 0.995  # [of the gap before] a gap after that is no less has not shrunk
CLOSE = 1.3  # [noise floors] a gap beyond it is not noise alone
HARDLY = 1e-4  # [of a value] a smaller error is told as that, as ``sysid fit`` does
FAULT, MAJOR, MINOR = "fault", "major", "minor"


def write_headline(story: Story) -> str:
    """The verdict in one plain sentence."""
    faults = [one.effect for one in story.findings if one.kind == FAULT]
    majors = list_effect_names(story, MAJOR)
    also = f"; the record is damaged too ({_listed(faults)})" if faults else ""
    if story.verdict == UNEXPLAINED:
        known = f"beside {_listed(majors)}, " if majors else ""
        none = "no effect of the catalogue explains"
        return f"Something is missing that {none}: {known}{_gap(story)}{also}."
    if story.verdict == NOTHING_MISSING or not (majors or faults):
        return _nothing(story)
    if not majors:
        rest = (
            "something remains that nothing explains"
            if story.remainder
            else "nothing big is missing"
        )
        return f"The record is damaged ({_listed(faults)}), and beside that {rest}."
    verb = "are" if len(majors) > 1 else "is"
    missing = _listed([_either(one) for one in story.findings if one.effect in majors])
    doubt = ", and these logs cannot tell which" if story.verdict == AMBIGUOUS else ""
    more = "; and something remains that nothing explains" if story.remainder else ""
    return f"Missing in the model {verb} {missing}{doubt}: {_gap(story)}{also}{more}."


def list_effect_names(story: Story, size: str) -> list[str]:
    """The names of the effects of one size that were found.

    Args:
        story: what was found.
        size: ``major`` or ``minor``.
    """
    return [one.effect for one in story.findings if one.kind != FAULT and one.size == size]


def is_gap_narrower(before: float, after: float) -> bool:
    """Whether a gap is narrower than it was."""
    return after < SHRINKS * before


def format_gap(gap: float, story: Story) -> str:
    """A gap in noise floors, as text."""
    if not (math.isfinite(gap) and story.noise_floor > 0.0):
        return "not known: the simulation ran away"
    return f"{gap / story.noise_floor:.3g}"


def describe_effect(effect: str) -> str:
    """An effect or a fault in a few plain words; empty where none are known."""
    return EFFECTS[effect].summary if effect in EFFECTS else ""


def describe_parameter(effect: str, parameter: str) -> str:
    """What a parameter of an effect means; empty where nobody knows."""
    known = EFFECTS[effect].parameters if effect in EFFECTS else ()
    return next((one.what for one in known if one.name == parameter), "")


def format_estimate(one: ParameterEstimate) -> tuple[str, str]:
    """An estimate and its standard error, as text with as many digits as they deserve."""
    if one.error is None or not (math.isfinite(one.error) and one.error > 0.0):
        chosen = one.error is None
        return _minus(f"{one.value:.4g}"), "chosen, not searched" if chosen else "not known"
    if one.error < HARDLY * abs(one.value):
        return _minus(f"{one.value:#.5g}".rstrip(".")), f"< {HARDLY:.2%} of it"
    size = max(abs(one.value), one.error)
    digits = 1 + math.floor(math.log10(size)) - math.floor(math.log10(one.error))
    return _minus(f"{one.value:#.{min(max(digits + 1, 2), 6)}g}".rstrip(".")), f"{one.error:.2g}"


def format_parameter(name: str, one: ParameterEstimate) -> str:
    """A parameter in one phrase: ``level 0.3600 ± 0.0064 V``."""
    value, error = format_estimate(one)
    unit = "" if one.unit == "1" else f" {one.unit}"
    known = f" ± {error}{unit}" if error[0].isdigit() else f"{unit} ({error})"
    return f"{name} {value}{known}"


def list_inspections(one: Finding) -> tuple[tuple[str, str], ...]:
    """What to look at on the robot, or to do: for a finding, and for each of its look-alikes."""
    if one.kind == FAULT:
        return (("What to do", one.inspect),)
    rivals = [(name, EFFECTS[name].inspect) for name in one.ambiguous_with if name in EFFECTS]
    return (("Look at", one.inspect), *((f"If it is {name}", text) for name, text in rivals))


def list_next_tests(story: Story) -> tuple[str, ...]:
    """Which tests to record next, each once; empty if none would tell more."""
    tests = dict.fromkeys(one.separating_test for one in story.findings if one.separating_test)
    return tuple(tests)


def list_remarks(story: Story) -> tuple[str, ...]:
    """Whatever else a person should know: what remains, a gap that does not shrink, notes."""
    said = [story.remains] if story.remains else []
    if list_effect_names(story, MAJOR) and not is_gap_narrower(story.gap_before, story.gap_after):
        said.append(
            "With what was found the gap on the shown log does not shrink: do not trust the "
            "finding before another log confirms it."
        )
    return (*said, *story.notes)


def _nothing(story: Story) -> str:
    minor = list_effect_names(story, MINOR)
    little = f"; a little of {_listed(minor)} shows" if minor else ""
    last = story.gap_after / story.noise_floor if story.noise_floor > 0.0 else math.inf
    if last > CLOSE:
        start = "No effect of the catalogue would narrow the gap by much"
        return f"{start}{little}, though {_off(story)}."
    big = " big" if minor else ""
    return f"Nothing{big} is missing{little}: {_off(story)}."


def _off(story: Story) -> str:
    floors = format_gap(story.gap_after, story)
    return f"the simulation is off by {floors} times the noise of the velocity"


def _gap(story: Story) -> str:
    before, after = (format_gap(gap, story) for gap in (story.gap_before, story.gap_after))
    several = len([*list_effect_names(story, MAJOR), *list_effect_names(story, MINOR)]) > 1
    with_ = "with all that was found" if several else "with it"
    if len(story.chapters) == 1:
        return _off(story)
    if is_gap_narrower(story.gap_before, story.gap_after):
        return f"{with_} the gap shrinks from {before} to {after} times the noise of the velocity"
    return (
        f"{with_} the gap does not shrink, {before} before and {after} times the noise of the "
        "velocity after"
    )


def _either(one: Finding) -> str:
    """A finding with its look-alikes, and what the first is."""
    short = describe_effect(one.effect).partition(" (")[0]
    told = f"{one.effect} ({short})" if short else one.effect
    return _listed([told, *one.ambiguous_with], word="or")


def _listed(names: Sequence[str], *, word: str = "and") -> str:
    *first, last = names or ("nothing",)
    return f"{', '.join(first)} {word} {last}" if first else last


def _minus(text: str) -> str:
    return text.replace("-", "−") if "e" not in text else text
