"""Whether a test can be started by accident: test mode, a chord, a switch, another controller."""

from grader.check import WrongAnswer
from grader.robotcode.binding_facts import Binding, BindingFacts, Controller, Guard

from .four import TESTS

WAYS = (
    "Use something that never happens in a match: test mode, a second button that you hold at"
    " the same time, a switch on the dashboard, or a controller that is not plugged in."
)
NOT_IN_ROBOTPY = "RobotModeTriggers"  # as of 2026
UTILITY = 2027  # the season from which test mode is called utility mode
OLD_MODE = "test mode"  # ... and how a trigger's text tells its older name
HOLDS = frozenset({Guard.TEST_MODE, Guard.CHORD, Guard.TOGGLE})


def check_guard(facts: BindingFacts, *, points: float) -> str | None:
    """Whether every binding is guarded.

    Returns:
        A note, if there is something to say all the same.

    Raises:
        WrongAnswer: some or all are not.
    """
    open_ = [one for one in facts.bindings if not _guarded(one, facts)]
    bound = len(facts.bindings)
    if not open_ and bound < len(TESTS):
        hint = "The guard is right. It earns all its points when you have bound all four tests."
        earned = points * bound / len(TESTS)
        raise WrongAnswer(f"{bound} of {len(TESTS)} tests bound", hint=hint, earned=earned)
    if not open_:
        return _note(facts)
    first = open_[0]
    seen = f"nothing guards {first.text} in line {first.line}"
    if Guard.ASKED_ONCE in first.guards:
        raise WrongAnswer(
            f"line {first.line} checks test mode only once, while the program starts",
            hint="The robot is not in test mode then, and the answer never changes. Let the "
            "trigger check it every time.",
        )
    if Guard.OTHER_MODE in first.guards:
        raise WrongAnswer(
            (
                f"the guard of {first.text} in line {first.line} checks for another mode than test "
                "mode"
            ),
            hint="Then the test can start in a match, but not in test mode. Check for test mode "
            "directly: remove negate(), the ! or the word not.",
        )
    if first.trigger.startswith("or("):
        raise WrongAnswer(
            f"the trigger in line {first.line} joins two conditions with or",
            hint="Then each of the two starts the test alone. Both must be true: join them with "
            "and() (Python: and_()).",
        )
    guarded = bound - len(open_)
    if guarded:
        lines = ", ".join(str(one.line) for one in open_)
        said = f"{guarded} of {bound} bindings are guarded; not so: line {lines}"
        hint = (
            "One test without a guard is enough for an accident. Guard all four in the same way, "
            "and with another button than the test's own."
        )
        raise WrongAnswer(said, hint=hint, earned=points * guarded / max(bound, len(TESTS)))
    used = [one for one in _controllers(first, facts) if one.uses]
    if used and len(facts.controllers) > 1:
        text, line = used[0].uses[0]
        raise WrongAnswer(
            seen,
            hint=(f"The driver uses this controller in a match: {text} in line {line}. {WAYS}"),
        )
    raise WrongAnswer(seen, hint=WAYS)


def _note(facts: BindingFacts) -> str | None:
    """What to say about guards that are right."""
    if facts.language == "python" and any(NOT_IN_ROBOTPY in one.trigger for one in facts.bindings):
        return f"RobotPy 2026 has no {NOT_IN_ROBOTPY}; DriverStation.isTest checks the same."
    if facts.season >= UTILITY and any(OLD_MODE in one.trigger for one in facts.bindings):
        return (
            "WPILib 2027 calls test mode utility mode: RobotModeTriggers.utility(). Early alphas "
            "still have test(); the development branch does not."
        )
    if any(not HOLDS.intersection(one.guards) for one in facts.bindings):
        return "Unplug that controller before a match, so that nobody touches it."
    return None


def _guarded(one: Binding, facts: BindingFacts) -> bool:
    """Whether something in the trigger guards it, or its controller serves nothing else."""
    if HOLDS.intersection(one.guards):
        return True
    if Guard.ASKED_ONCE in one.guards:
        return False
    return any(_apart(controller, facts) for controller in _controllers(one, facts))


def _apart(controller: Controller, facts: BindingFacts) -> bool:
    """Whether a controller is there for the tests only, beside the driver's."""
    another = any(one.name != controller.name for one in facts.controllers)
    return not controller.uses and (another or bool(controller.port))


def _controllers(one: Binding, facts: BindingFacts) -> list[Controller]:
    return [controller for controller in facts.controllers if controller.name in one.controllers]
