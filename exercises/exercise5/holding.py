"""Whether a test runs while its button is held, and on a button of its own."""

from grader.check import WrongAnswer
from grader.robotcode.binding_facts import (
    Binding,
    BindingFacts,
    HindranceKind,
    Hold,
)

from .four import TESTS

PRESSED = 1 / 3  # [share] of the points for a test that starts, but does not stop on release

SAYS = {
    Hold.PRESS: "Once started, the test runs to its timeout even after you release the button. "
    "It must stop when you let go",
    Hold.TOGGLE: "You need a second press to stop it, and in a hurry nobody finds the button. "
    "It must stop when you let go",
    Hold.RELEASED: "Then it runs as long as nobody presses the button. It must run while you "
    "hold the button",
    Hold.UNKNOWN: "It must run while you hold the button",
}

HINDERED = {  # what is seen, and what to do about it
    HindranceKind.NEVER: (
        "{text} keeps the test of line {line} from starting",
        (
            "The test never starts, although somebody holds the button. Remove it, or check "
            "something that can change."
        ),
    ),
    HindranceKind.CLOSED: (
        "the trigger of line {line} never becomes true: {text}",
        "A part of it is always false. Use a condition that can become true.",
    ),
    HindranceKind.CUT: (
        "{text} ends the test of line {line} early",
        (
            "The test must run while you hold its button, up to the routine's own timeout. Remove "
            "it."
        ),
    ),
    HindranceKind.DELAYED: (
        "{text} delays the trigger of line {line}",
        (
            "The test must start and stop with its button. Debounce for at most 0.5 s, written as a"
            " number."
        ),
    ),
    HindranceKind.CLEARED: (
        "{text} removes the binding of line {line} again",
        "After it this button does nothing. Remove it.",
    ),
    HindranceKind.DISABLED: (
        "{text} turns the command scheduler off, and the test of line {line} never runs",
        "No command runs while the scheduler is off. Remove it.",
    ),
    HindranceKind.EMPTIED: (
        "{text} leaves the test of line {line} without its routine",
        "The program stops with a null pointer when somebody presses the button. Remove it.",
    ),
    HindranceKind.UNREAD: (
        "the grader cannot see by reading whether {text} lets the test of line {line} run",
        "Pass the test itself to whileTrue(), or use WPILib's decorators with numbers.",
    ),
}


def check_hold(one: Binding, facts: BindingFacts, *, earned: float) -> None:
    """Whether a binding holds its test, and no other test shares its trigger.

    Args:
        one: the binding.
        facts: all of them.
        earned: points all the same, if it does not.

    Raises:
        WrongAnswer: it does not, or it cannot be told.
    """
    at = f"{one.text} in line {one.line}"
    if one.hold is not Hold.WHILE and one.stopped:
        hint = "There is a simpler way to run it while the button is held: whileTrue()."
        raise WrongAnswer(f"the grader cannot see when {at} stops", hint=hint, earned=earned)
    if one.hold is not Hold.WHILE:
        raise WrongAnswer(at, hint=f"{SAYS[one.hold]}: whileTrue().", earned=earned)
    if one.scheduled:
        hint = (
            "The button only starts another command, which then runs to its timeout. Pass the "
            "test itself to whileTrue()."
        )
        raise WrongAnswer(at, hint=hint, earned=earned)
    for first in one.hindrances:
        said, hint = HINDERED[first.kind]
        raise WrongAnswer(said.format(text=first.text, line=one.line), hint=hint, earned=earned)
    for name, line in facts.uncalled:
        raise WrongAnswer(
            f"nothing calls {name} in line {line}",
            hint="Call it where the RobotContainer is made. Until then no button does anything.",
            earned=earned,
        )
    if not one.trigger:
        hint = "Write the button into the line that binds it, for example controller.a()."
        raise WrongAnswer(
            f"the grader cannot see which button line {one.line} binds", hint=hint, earned=earned
        )
    for other in facts.bindings:
        if other.line != one.line and other.trigger == one.trigger and other.tests != one.tests:
            raise WrongAnswer(
                f"lines {one.line} and {other.line} share the trigger {one.trigger}",
                hint="Both tests would start at the same time and fight for the motors. Give "
                "each its own button.",
                earned=earned,
            )


def held_share(facts: BindingFacts) -> float:
    """The share of the points: whole for a test that is held, part of it for one that is not."""
    best: dict[str, float] = {}
    for one in facts.bindings:
        good = one.hold is Hold.WHILE and not one.scheduled and not facts.uncalled
        started = one.hold is Hold.PRESS or one.scheduled
        if one.hindrances:
            cut = {first.kind for first in one.hindrances} == {HindranceKind.CUT}
            good, started = False, (good or started) and cut
        share = 1.0 if good else PRESSED if started else 0.0
        if one.trigger:
            best[one.trigger] = max(best.get(one.trigger, 0.0), share)
    return min(sum(best.values()) / len(TESTS), 1.0)
