"""Exercise 10: gains from the analyzer into robot code, in the right units and the right order."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from grader.check import NotReachedError, WrongAnswer, check
from grader.consequence import Consequence
from grader.robotcode.gain_constants import DeployFacts, Feedforward, GainConstant, read_gains
from grader.student_files import write_student_files
from grader.submission import read_text
from grader.sysid_routine_checks import READ as READ_ONLY
from grader.sysid_routine_checks import check_compiles
from sim.core.errors import UnreadableFile

from .comment_units import find_commented_units, judge_comment
from .drawn import draw
from .handed import check_choices, check_one_place, check_order, feedforward_of, place_of
from .key import FEED_FORWARD, FULL, PLACES, SLOT0, Variant, near
from .outcome import outcome
from .slips import constant_slip, feedback_slip, handed_slip

FILES = ("ExampleMechanism.java", "example_mechanism.py")
HERE = Path(__file__).resolve().parent
GIVEN = "given.toml"
HOLDER = "CharacterizationConstants"
START = re.compile(
    r"start|tun(e|ing)|initial|first (guess|value|try)|begin|suggest|guess|adjust|preliminary",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Code:
    """What the checks look at."""

    facts: DeployFacts
    variant: Variant  # with the gains where this code puts them


def prepare(student: str, *, say: Callable[[str], None]) -> None:
    """Write down what the analyzer showed for the learner's mechanism."""
    made = {GIVEN: told(draw(student))}
    write_student_files(made, exercise=HERE, student=student, what="numbers", say=say)


def told(variant: Variant) -> str:
    """What a learner gets to know."""
    given, used = variant.symbol(used=False), variant.symbol(used=True)
    units = {
        "kS": "V",
        "kG": "V",
        "kV": f"V for a velocity of 1 {given}/s",
        "kA": f"V for an acceleration of 1 {given}/s every second",
        "kP": f"suggested for a velocity loop: V for an error of 1 {given}/s",
    }
    rows = "".join(
        f"{name} = {value:g}  # {units[name]}\n" for name, value in variant.shown.items()
    )
    output = (
        f'"duty cycle"  # from -1 to 1, where 1 stands for {FULL:g} V'
        if variant.duty
        else '"volts"'
    )
    return f"""\
# Exercise 10: your own mechanism. Only read here; your answer goes into the code.
mechanism = "{variant.kind}"

[analyzer]  # what SysId shows
analysis = "{variant.analysis}"
units = "{variant.shown_in}"
{rows}
[robot]  # what your code needs
units = "{variant.used_in}"  # it measures, and asks for, velocities in {used}/s
loop_output = {output}

[motor_controller]  # only if you put the gains there, and not into a feedforward class
{_controller(variant)}"""


def _controller(variant: Variant) -> str:
    """What a learner gets to know of the motor controller."""
    thing = {"drivetrain": "wheel", "elevator": "drum"}.get(variant.kind, variant.kind)
    used = variant.symbol(used=True)
    radius = f"radius = {variant.radius:g}  # [m] of the {thing}\n" if variant.radius else ""
    rows = (
        (SLOT0, f"rotations of the {thing}: SensorToMechanismRatio is set", "volts"),
        (FEED_FORWARD, f"{used}: both conversion factors are set", "duty cycle"),
    )
    tables = "".join(
        f'{name} = {{ counts = "{counts}", loop_output = "{output}" }}\n'
        for name, counts, output in rows
    )
    return (
        f"gear_ratio = {variant.ratio:g}  # turns of the motor for one turn of the {thing}\n"
        f"{radius}{tables}"
    )


def read(path: Path, *, student: str) -> Code:
    """What the file says about its gains.

    Raises:
        UnreadableFile: it cannot be read, or does not parse.
    """
    read_text(path)
    facts = read_gains(path)
    if facts.problems:
        first = facts.problems[0]
        raise UnreadableFile(
            first.message,
            where=f"{path}, line {first.line}",
            advice="Fix that line first: code with a mistake like this does not compile.",
        )
    return Code(facts, draw(student).held_by(place_of(facts)))


def consequence(code: Code) -> Consequence | None:
    """What the learner's feedforward would do on their mechanism."""
    return outcome(code.facts, code.variant)


@check(points=1)
def named(code: Code) -> None:
    """A class CharacterizationConstants holds every gain under its own name."""
    wanted = (*code.variant.gains, "kP")
    there = [one for one in wanted if code.facts.find_constant(one)]
    if not there:
        raise WrongAnswer(
            "no gain in this file",
            hint=f"Write them into {HOLDER}, one constant for each: {', '.join(wanted[:1])} and "
            "so on.",
        )
    lacking = [one for one in wanted if one not in there]
    if lacking:
        raise WrongAnswer(
            f"no {' and no '.join(lacking)}",
            hint="Every gain the analyzer shows gets a constant, by the name it has there.",
            earned=0.5 * len(there) / len(wanted),
        )
    outside = [one for one in code.facts.constants if "haracteri" not in one.holder]
    if outside:
        raise WrongAnswer(
            f"{outside[0].name} in line {outside[0].line} is not in {HOLDER}",
            hint="Put measured gains into a separate class, apart from all other constants.",
            earned=0.5,
        )


@check(points=1)
def volts(code: Code) -> None:
    """The constants kS, and kG if gravity pulls, have the analyzer's values."""
    for gain in code.variant.gains:
        if gain in {"kS", "kG"}:
            _valued(gain, code)


@check(points=1)
def kv(code: Code) -> None:
    """The constant kV has the analyzer's value, or that value converted to the robot's unit."""
    _valued("kV", code)


@check(points=1)
def ka(code: Code) -> None:
    """The constant kA has the analyzer's value, or that value converted to the robot's unit."""
    _valued("kA", code)


def _valued(gain: str, code: Code) -> None:
    constant = _constant(gain, code)
    value = _known(constant.value, f"{constant.name} = {constant.text}", constant.line)
    if _right(constant, code.variant):
        return
    slip = constant_slip(value, gain, code.variant, text=constant.text)
    raise WrongAnswer(_at(constant), hint=slip.says, misconception=slip.misconception)


def _right(constant: GainConstant, variant: Variant) -> bool:
    """Whether a constant is the analyzer's number, or the one the robot needs."""
    return constant.value is not None and variant.accepts(constant.gain, constant.value)


def _constant(gain: str, code: Code) -> GainConstant:
    found = code.facts.find_constant(gain)
    if found is None:
        raise NotReachedError(f"checked after you write a constant {gain}")
    return found


def _known(value: float | None, text: str, line: int) -> float:
    if value is None:
        raise WrongAnswer(
            f"the grader cannot see the number by reading {text} in line {line}",
            hint="Write it as a number, or as a calculation with numbers and named constants.",
        )
    return value


def _at(constant: GainConstant) -> str:
    worked = "" if f"{constant.value:g}" in constant.text else f", which is {constant.value:.4g}"
    return f"{constant.name} = {constant.text} in line {constant.line}{worked}"


@check(points=1)
def units(code: Code) -> None:
    """A comment gives the unit of each gain of the feedforward."""
    found = [one for one in code.facts.constants if one.gain in code.variant.gains]
    if not found:
        raise NotReachedError("checked after you write the gains")
    for one in found:
        verdict = _unit_told(one, code)
        shown = f'"{one.comment[:50]}" next to {one.name}' if one.comment else f"{one.name} alone"
        if verdict is False and any(find_commented_units(one.comment)):
            raise WrongAnswer(
                f"{shown}, line {one.line}",
                hint=f"That is a unit of something else than {one.name}. Each gain times what it "
                "is multiplied by gives volts.",
                misconception="M-UNITS",
            )
        if verdict is False:
            raise WrongAnswer(
                f"no unit of {one.name} in line {one.line}: {shown}",
                hint="Write it next to the number: next year nobody will remember it.",
            )
        if verdict is None:
            raise WrongAnswer(
                f"{shown}, line {one.line}",
                hint="This is the right kind of unit, but not the unit of this number.",
                misconception="M-UNITS",
            )


def _unit_told(one: GainConstant, code: Code) -> bool | None:
    """Whether a gain's unit is told; where the number itself is not right, either will do."""
    units_ = code.variant.list_matching_units(one.gain, one.value)
    beside = {judge_comment(one.comment, unit, name=one.name) for unit in units_}
    if True in beside or (
        beside == {False} and any(judge_comment(code.facts.general, u) for u in units_)
    ):
        return True
    # per meter, where per rotation is right
    elsewhere = code.variant.list_matching_units(one.gain, None)
    if any(judge_comment(one.comment, unit, name=one.name) for unit in elsewhere):
        return None
    return None if None in beside else False


@check(points=1)
def feedforward(code: Code) -> str:
    """The feedforward is of the class, or has the settings, that fit the mechanism."""
    one = feedforward_of(code.facts, code.variant)
    check_one_place(code.facts)
    if one.kind == code.variant.made:
        if one.kind in PLACES:
            check_choices(one, code.variant)
        check_compiles(code.facts.compile_errors, language=code.facts.language)
        return READ_ONLY[code.facts.language].partition(":")[0] + "."
    gravity = code.variant.analysis != "Simple" and one.kind == "SimpleMotorFeedforward"
    raise WrongAnswer(
        f"{one.kind} in line {one.line}",
        hint=(
            "This class has no argument for kG, but gravity pulls this mechanism down all the time."
        )
        if gravity
        else "Which analysis type did the analyzer use? Each type has its own class.",
        misconception="M-NO-KG-IN-SYSID" if gravity else "",
    )


@check(points=2)
def order(code: Code) -> None:
    """Each gain is in the place where the feedforward expects it."""
    one = feedforward_of(code.facts, code.variant)
    check_order(one, code.facts, code.variant, points=2)


@check(points=2)
def conversion(code: Code) -> None:
    """The feedforward gets kV and kA in the unit that the robot's code uses."""
    one = feedforward_of(code.facts, code.variant)
    wrong = []
    for gain in ("kV", "kA"):
        try:
            _converted(gain, one, code)
        except WrongAnswer as why:
            wrong.append(why)
    if wrong:
        wrong[0].earned = 2.0 - len(wrong)
        raise wrong[0]


def _converted(gain: str, one: Feedforward, code: Code) -> None:
    given = next(
        (arg for arg in one.arguments.values() if arg.gain == gain), one.arguments.get(gain)
    )
    constant = code.facts.find_constant(gain)
    if given is None and one.spread:
        hint = "Write the arguments one by one."
        raise WrongAnswer(f"the grader cannot see by reading what {gain} it gets", hint=hint)
    if given is None:
        raise WrongAnswer(
            f"the feedforward in line {one.line} gets no {gain}", hint="Pass it, too."
        )
    if constant is None and given.value is None:
        raise WrongAnswer(f"no constant {gain}", hint="Write it down first.")
    if constant is not None and constant.value is not None and not _right(constant, code.variant):
        raise WrongAnswer(_at(constant), hint=f"Correct the constant {gain} first.")
    value = _known(given.value, given.text, one.line)
    if near(value, code.variant.needed(gain)):
        return
    slip = handed_slip(value, gain, code.variant)
    seen = f"{given.text} in line {one.line}, which is {value:.4g}"
    raise WrongAnswer(seen, hint=slip.says, misconception=slip.misconception)


@check(points=1)
def kp(code: Code) -> None:
    """The constant kP fits the robot's loop, and its comment says what kind of number it is."""
    constant = _constant("kP", code)
    handed = code.facts.feedback
    at = f"{constant.name} = {constant.text}"
    value = _known(handed.value if handed else constant.value, at, constant.line)
    marked = bool(START.search(constant.comment))
    if not near(value, code.variant.needed("kP")):
        slip = feedback_slip(value, code.variant, text=constant.text)
        seen = _at(constant) if constant.value is not None else at
        earned = 0.5 if marked else 0.0
        raise WrongAnswer(seen, hint=slip.says, misconception=slip.misconception, earned=earned)
    if not marked:
        raise WrongAnswer(
            f'"{constant.comment[:50]}" next to kP'
            if constant.comment
            else "no comment next to kP",
            hint="The number is right. Write in a comment how far to trust it: the analyzer has "
            "never seen your loop run. Is this the final value?",
            earned=0.5,
        )
