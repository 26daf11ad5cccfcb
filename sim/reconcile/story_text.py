"""Plain sentences for a reconcile story."""

import math
from collections.abc import Sequence

from sim.core.doubt import Doubt
from sim.core.units import find_unit
from sim.fit import Fit
from sim.fit.replay import SENSOR_LAGS
from sim.physics.effects import EFFECTS
from sim.reconcile.gains import replace_gains
from sim.reconcile.story import (
    AMBIGUOUS,
    NOTHING_MISSING,
    UNEXPLAINED,
    Finding,
    ParameterEstimate,
    Story,
)
from sim.reconcile.thresholds import (
    LEAST_PROBABILITY,
    MAJOR_UNEXPLAINED,
    PROBABLE,
    VISIBLE_FLOORS,
)
from sim.support.printable import join_names, write_minus_sign

FAR = 3.0  # [standard errors] by which two estimates of one gain hardly ever differ
LEAST_ERROR = 1e-4  # [1] relative standard error below which only this limit is written
FAULT, MAJOR, MINOR = "fault", "major", "minor"
CUT_SHORT = "The search ended before it had tried every effect."


def write_headline(story: Story) -> str:
    """The verdict in a few plain sentences: what is missing, and how much that explains."""
    verdict = _write_verdict(story)
    return verdict if story.complete else f"{CUT_SHORT} {verdict}"


def _write_verdict(story: Story) -> str:
    found = [one for one in story.findings if one.kind == FAULT]
    remains = story.remainder and story.verdict != NOTHING_MISSING
    remains = remains and not _hides_in_noise(story)
    added = {one.added for one in story.chapters[1:]}
    suspected = [one for one in found if one.size == MINOR and remains and one.effect not in added]
    faults = [one for one in found if one not in suspected]
    majors = [one for one in story.findings if one.kind != FAULT and one.size == MAJOR]
    damaged = _describe_damage(faults, also="also " if majors else "")
    if story.verdict == UNEXPLAINED:
        known = f"{join_names([one.effect for one in majors])}, and " if majors else ""
        gaps = _write_gaps(story)
        cause = "no known effect explains" if story.complete else "the search has not found so far"
        said = [f"The model is missing {known}something that {cause}.", gaps]
    elif majors:
        missing = join_names([_name_with_rivals(one) for one in majors])
        doubt = "; these logs cannot tell which" if story.verdict == AMBIGUOUS else ""
        guess = "" if all(one.probability >= PROBABLE for one in majors) else "probably "
        lags = {one.effect for one in majors} <= SENSOR_LAGS  # a fit has estimated them, too
        model = "A model of gains alone" if lags else "The model"
        said = [f"{model} is {guess}missing {missing}{doubt}.", _write_gaps(story)]
    elif story.verdict == NOTHING_MISSING or not faults:
        return _describe_complete_model(story)
    else:
        rest = "nothing big is missing"
        if remains:
            rest = "something is missing that no known effect explains"
        if not story.complete:
            rest = "it has found nothing so far"
        return f"{damaged} Apart from that, {rest}."
    if faults:
        said.append(damaged)
    if majors and remains and story.complete and story.verdict != UNEXPLAINED:
        said.append("Something else remains that no known effect explains.")
    if suspected:
        names = join_names([one.effect for one in suspected])
        said.append(f"It may be what an inspection of the log finds: {names}.")
    return " ".join(said)


def _describe_damage(faults: Sequence[Finding], *, also: str) -> str:
    """The sentence about faults of the log, the surest first; empty without any."""
    sure = [one.effect for one in faults if one.probability >= PROBABLE]
    unsure = [one.effect for one in faults if one.effect not in sure]
    if not sure:
        return f"The log is probably {also}damaged: {join_names(unsure)}." if unsure else ""
    return (
        f"The log is {also}damaged: {join_names([*sure, *(f'probably {one}' for one in unsure)])}."
    )


def list_effect_names(story: Story, size: str) -> list[str]:
    """The names of the effects of one size that were found.

    Args:
        story: the result of reconcile.
        size: ``major`` or ``minor``.
    """
    return [one.effect for one in story.findings if one.kind != FAULT and one.size == size]


def format_gap(gap: float, story: Story) -> str:
    """A gap in noise floors, as text."""
    if not (math.isfinite(gap) and story.noise_floor > 0.0):
        return "not known: the simulated motion grew without limit"
    return f"{gap / story.noise_floor:.3g}"


def describe_effect(effect: str) -> str:
    """An effect in a few plain words; empty for a fault."""
    return EFFECTS[effect].summary if effect in EFFECTS else ""


def describe_size(one: Finding) -> str:
    """The size of a finding and its probability: ``major, 93 % likely``."""
    size = "damage to the log" if one.kind == FAULT else one.size
    share = f"{one.probability:.0%}".replace("%", " %")
    return f"{size}, {'over 99 %' if share == '100 %' else share} likely"


def format_estimate(one: ParameterEstimate) -> tuple[str, str]:
    """An estimate and its standard error, as text with as many digits as they deserve."""
    if one.error is None or not (math.isfinite(one.error) and one.error > 0.0):
        chosen = one.error is None
        return write_minus_sign(
            f"{one.value:.4g}"
        ), "chosen, not searched" if chosen else "not known"
    if one.error < LEAST_ERROR * abs(one.value):
        return write_minus_sign(f"{one.value:#.5g}".rstrip(".")), f"< {LEAST_ERROR:.2%} of it"
    size = max(abs(one.value), one.error)
    digits = 1 + math.floor(math.log10(size)) - math.floor(math.log10(one.error))
    return write_minus_sign(f"{one.value:#.{max(digits + 1, 2)}g}".rstrip(".")), f"{one.error:.2g}"


def format_parameter(name: str, one: ParameterEstimate) -> str:
    """A parameter in one phrase: ``level 0.3600 ± 0.0064 V``."""
    value, error = format_estimate(one)
    unit = "" if one.unit == "1" else f" {one.unit}"
    known = f" ± {error}{unit}" if error[0].isdigit() else f"{unit} ({error})"
    return f"{name} {value}{known}"


def list_gains(story: Story) -> tuple[tuple[str, str, str], ...]:
    """Name of each gain, the gain in the last model, and without the effects, as text."""
    return tuple(
        (
            "angle" if name == "offset_rad" else name,
            format_parameter("", one).strip(),
            format_parameter("", story.gains_without[name]).strip(),
        )
        for name, one in story.gains.items()
    )


def describe_gains(story: Story) -> str:
    """The heading of the gains: which effects the model has beside them."""
    added = [name for size in (MAJOR, MINOR) for name in list_effect_names(story, size)]
    return f"Gains with {join_names(added)}" if added else "Gains of the model without effects"


def list_gain_doubts(story: Story) -> tuple[Doubt, ...]:
    """Doubts about the gains with the effects; none if nothing speaks against them."""
    if story.verdict == UNEXPLAINED:
        text = "The last model lacks something, so its gains may be off by more than their errors."
        return (Doubt("model-lacks", text, gains=tuple(story.gains)),)
    moved = [name for name, one in story.gains.items() if _differ(one, story.gains_without[name])]
    if not moved or story.added <= SENSOR_LAGS or story.narrows(story.gap_after):
        return ()
    text = (
        f"The effects change {join_names(moved)} by far more than their errors allow. Before you "
        "use these gains, record another log, and compare."
    )
    return (Doubt("gains-move", text, gains=tuple(moved)),)


def apply_story(story: Story, plain: Fit) -> Fit:
    """A fit in the log's unit, with the gains, effects and doubts of a story's last model."""
    if story.gains == story.gains_without:
        return plain
    doubts, narrows = list_gain_doubts(story), narrows_gap(story)
    return replace_gains(plain, story.gains, story.model.parts, doubts, narrows=narrows)


def narrows_gap(story: Story) -> bool:
    """Whether the effects narrow the gap so much that their gains are taken unasked.

    Lags of the sensor do not count: the fit has estimated them, too.
    """
    return bool(story.added - SENSOR_LAGS) and story.narrows(story.gap_after)


def explain_unapplied_effects(story: Story) -> str:
    """Why the effects are not applied unasked; empty if they are."""
    if narrows_gap(story):
        return ""
    if story.added <= SENSOR_LAGS:
        return (
            "The fit of the gains accounts for this delay of the sensor already, in a way of its "
            "own, so its gains stay. Ticked, the effect brings the gains of the search: where they "
            "differ by more than their errors, trust both only to the difference."
        )
    share = 1.0 - MAJOR_UNEXPLAINED
    lags = f" beside {join_names(sorted(lags))}" if (lags := story.added & SENSOR_LAGS) else ""
    return (
        f"The effects{lags} narrow the gap by less than {share:.0%}, so they are not applied "
        "unasked."
    )


def list_outcomes(story: Story) -> dict[str, list[str]]:
    """What became of the effects of the catalogue, in a few words: outcome -> names of effects."""
    added = [one.added for one in story.chapters[1:]]
    beside = f" beside {' and '.join(added)}" if added else ""
    last = {one.effect: (one, chapter) for chapter in story.chapters for one in chapter.tried}
    known = dict.fromkeys(added, "added")
    known |= {
        rival: f"cannot be told apart from {one.effect}"
        for one in story.findings
        for rival in one.ambiguous_with
    }
    unlikely = (one.effect for one in story.judged if one.probability < LEAST_PROBABILITY)
    for effect in unlikely:
        known.setdefault(effect, f"fits better, but is too unlikely{beside}")
    for effect, (tried, chapter) in last.items():
        is_last = chapter is story.chapters[-1]
        fitted = "fits better, but is too unlikely" if is_last else "makes no difference"
        known.setdefault(effect, (tried.why or fitted) + beside * (is_last or tried.admitted))
    rest = (
        "not tried: promised too little" if story.complete else "not tried before the search ended"
    )
    outcomes: dict[str, list[str]] = {}
    for effect in dict.fromkeys([*known, *EFFECTS]):
        outcomes.setdefault(known.get(effect, rest), []).append(effect)
    return outcomes


def _differ(one: ParameterEstimate, other: ParameterEstimate) -> bool:
    """Whether two estimates differ by more than their errors allow."""
    spread = math.hypot(one.error or math.inf, other.error or math.inf)
    return abs(one.value - other.value) > FAR * spread


def list_inspections(one: Finding) -> tuple[tuple[str, str], ...]:
    """Things to inspect on the robot: for a finding, and for effects that look alike."""
    if one.kind == FAULT:
        return (("What to do", one.inspect),)
    rivals = [(name, EFFECTS[name].inspect) for name in one.ambiguous_with if name in EFFECTS]
    return (
        ("What to do", one.inspect),
        *((f"What to do if it is {name}", text) for name, text in rivals),
    )


def list_next_tests(story: Story) -> tuple[str, ...]:
    """The tests to record next, each once; empty if none would help."""
    return tuple(dict.fromkeys(filter(None, (one.separating_test for one in story.findings))))


def list_remarks(story: Story) -> tuple[str, ...]:
    """Remarks: what remains, what the fit has beyond the base model, and the notes."""
    lags = sorted(story.added & SENSOR_LAGS) if story.added - SENSOR_LAGS else []
    base = (
        f"The base model has the gains alone. With {join_names(lags)}, which a fit has, too, its "
        f"simulation error is {format_gap(story.gap_with_lags, story)} times the noise."
    )
    damaged = any(one.kind == FAULT for one in story.findings)
    remains = "" if damaged and _hides_in_noise(story) else story.remains
    return (*filter(None, (remains, base if lags else "")), *story.notes)


def _hides_in_noise(story: Story) -> bool:
    """Whether the last gap is no larger than the noise, so that nothing is seen to remain."""
    return story.gap_after <= story.noise_floor


def _describe_complete_model(story: Story) -> str:
    minor = list_effect_names(story, MINOR)
    little = f", only a little {join_names(minor)}" if minor else ""
    last = story.gap_after / story.noise_floor if story.noise_floor > 0.0 else math.inf
    if last > VISIBLE_FLOORS:
        small = f" (a little: {join_names(minor)})" if minor else ""
        which = "known effect" if story.complete else "effect that was tried"
        return f"No {which} makes the simulation error much smaller{small}. {_write_error(story)}"
    big = " big" if minor or story.remainder else ""
    if not story.complete:
        return f"So far it has found nothing{big}{little}. {_write_error(story)}"
    rest = " Something small remains that no known effect explains." if story.remainder else ""
    return f"Nothing{big} is missing{little}. {_write_error(story)}{rest}"


def _write_error(story: Story) -> str:
    gap = format_gap(story.gap_after, story)
    return f"The simulation error is {gap} times the sensor noise{_in_speed(story)}."


def _write_gaps(story: Story) -> str:
    before, after = (format_gap(gap, story) for gap in (story.gap_before, story.gap_after))
    added = [*list_effect_names(story, MAJOR), *list_effect_names(story, MINOR)]
    if len(story.chapters) == 1 or not added:
        return _write_error(story)
    named = {1: added[0], 2: "both"}.get(len(added), "all of them")
    every = [one.added for one in story.chapters[1:]]
    if not set(every) <= set(added):
        named = join_names(every)
    with_ = f"With {named} added, the simulation error"
    if len(added) > 1 and list_effect_names(story, MINOR):
        with_ = "With all found effects added, the simulation error"
    return f"{with_} drops from {before} to {after} times the sensor noise{_in_speed(story)}."


def _in_speed(story: Story) -> str:
    """The last gap in brackets, as a speed and a share of the top speed; empty if not known."""
    top = story.shown.top_speed
    if not (math.isfinite(story.gap_after) and top > 0.0):
        return ""
    unit = find_unit(story.shown.units)
    share = story.gap_after * unit.si / top
    return f" ({story.gap_after:.2g} {unit.symbol}/s, {share:.1%} of the top speed)"


def _name_with_rivals(one: Finding) -> str:
    """A finding, what it is, and its rivals: ``a (…), b or c``."""
    short = describe_effect(one.effect).partition(" (")[0]
    name = f"{one.effect} ({short})" if short else one.effect
    return join_names([name, *one.ambiguous_with], word="or")
