"""Exercise 10: gains from the analyzer into robot code, in the right units and the right order."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from pathlib import Path

from grader.answers.quantity import read_unit
from grader.checks.check import Check, NotReachedError, WrongAnswer, check
from grader.checks.consequence import Consequence
from grader.robotcode.bench.gains_run import GainConstant, Gains
from grader.robotcode.checks.causes import check_compiles, check_stop
from grader.robotcode.running import Runs, judge_runs, run_gains
from grader.student_data.student_files import Made

from .comment_units import find_commented_units, judge_comment
from .drawn import draw
from .feedforwards import (
    Seen,
    check_one_place,
    check_order,
    check_settings,
    explain,
    is_known,
    list_feedback_loops,
)
from .key import FEED_FORWARD, FULL, SLOT0, Variant, near
from .outcome import find_outcome
from .slips import find_constant_slip, find_feedback_slip, find_handed_slip

FILES = ("ExampleMechanism.java", "example_mechanism.py")
HOLDER = "CharacterizationConstants"
START = re.compile(
    r"start|tun(e|ing)|initial|first (guess|value|try)|begin|suggest|guess|adjust|preliminary",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Code:
    """The object that the checks read: the runs of the program, and the learner's mechanism."""

    runs: Runs
    variant: Variant


Look = Callable[[Seen], str | None]


def check_all_runs(points: float) -> Callable[[Look], Check[Code]]:
    """Make a check of a function that looks at one run: it judges all runs of a program."""

    def make(look: Look) -> Check[Code]:
        @wraps(look)
        def judge(code: Code) -> str | None:
            return judge_runs(code.runs, lambda facts: look(Seen(facts, code.variant)))

        return check(points=points)(judge)

    return make


def make_files(student: str) -> dict[str, Made]:
    """The analyzer's result for the learner's mechanism, as a file."""
    return {"given.toml": describe(draw(student))}


def describe(variant: Variant) -> str:
    """The facts that a learner reads in the task."""
    given, used = variant.symbol(used=False), variant.symbol(used=True)
    units = {
        "kV": f"V for a velocity of 1 {given}/s",
        "kA": f"V for an acceleration of 1 {given}/s every second",
        "kP": f"suggested for a velocity loop: V for an error of 1 {given}/s",
    }
    gains = [
        f"{name} = {value:g}  # {units.get(name, 'V')}" for name, value in variant.shown.items()
    ]
    rows = "\n".join(gains)
    duty = f'"duty cycle"  # from -1 to 1, where 1 stands for {FULL:g} V'
    thing = {"drivetrain": "wheel", "elevator": "drum"}.get(variant.kind, variant.kind)
    radius = f"\nradius = {variant.radius:g}  # [m] of the {thing}" if variant.radius else ""
    rotations = f"rotations of the {thing}: SensorToMechanismRatio is set"
    factors = f"{used}: both conversion factors are set"
    return f"""\
# Exercise 10: your own mechanism. Only read here; your answer goes into the code.
mechanism = "{variant.kind}"

[analyzer]  # what SysId shows
analysis = "{variant.analysis}"
units = "{variant.shown_in}"
{rows}

[robot]  # what your code needs
units = "{variant.used_in}"  # it measures, and asks for, velocities in {used}/s
loop_output = {duty if variant.duty else '"volts"'}

[motor_controller]  # only if you put the gains there, and not into a feedforward class
gear_ratio = {variant.ratio:g}  # turns of the motor for one turn of the {thing}{radius}
{SLOT0} = {{ counts = "{rotations}", loop_output = "volts" }}
{FEED_FORWARD} = {{ counts = "{factors}", loop_output = "duty cycle" }}
"""


def read(path: Path, *, student: str, run: bool = True) -> Code:
    """The gains that the program holds.

    Args:
        path: the file.
        student: whose it is.
        run: whether a learner's Python may be run; Java is interpreted by ourselves in any case.

    Raises:
        UnreadableFile: it cannot be read, or does not parse.
        NotRunError: it is Python, which may not be run.
    """
    return Code(run_gains(path, run=run), draw(student))


def consequence(code: Code) -> Consequence | None:
    """The motion that the learner's feedforward would cause."""
    return find_outcome(Seen(code.runs[0], code.variant))


@check_all_runs(1)
def named(seen: Seen) -> None:
    """A class CharacterizationConstants holds every gain under its own name."""
    wanted = (*seen.variant.gains, "kP")
    there = [one for one in wanted if seen.facts.find_constant(one)]
    if not there:
        check_compiles(seen.facts)
        check_stop(seen.facts, "start")
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
    outside = [one for one in seen.facts.constants if "haracteri" not in one.holder]
    if outside:
        raise WrongAnswer(
            f"{outside[0].name} in line {outside[0].line} is not in {HOLDER}",
            hint="Put measured gains into a separate class, apart from all other constants.",
            earned=0.5,
        )


@check_all_runs(1)
def volts(seen: Seen) -> None:
    """The constants kS, and kG if gravity pulls, have the analyzer's values."""
    for gain in seen.variant.gains:
        if gain in {"kS", "kG"}:
            _check_value(gain, seen)


@check_all_runs(1)
def kv(seen: Seen) -> None:
    """The constant kV has the analyzer's value, or that value converted to the robot's unit."""
    _check_value("kV", seen)


@check_all_runs(1)
def ka(seen: Seen) -> None:
    """The constant kA has the analyzer's value, or that value converted to the robot's unit."""
    _check_value("kA", seen)


def _check_value(gain: str, seen: Seen) -> None:
    constant = _get_constant(gain, seen)
    value = seen.get_value(constant.value, _describe(constant))
    if not _is_right(constant, value, seen):
        slip = find_constant_slip(value, gain, seen.variant, text=constant.text)
        raise explain(_describe(constant), slip)


def _is_right(constant: GainConstant, value: float, seen: Seen) -> bool:
    """Whether a constant is the gain in a unit of this robot, or in the unit of its comment."""
    told = seen.variant.list_units_of(constant.gain, value)
    return seen.variant.accepts(constant.gain, value) or any(
        judge_comment(constant.comment, unit, name=constant.name) for unit in told
    )


def _get_constant(gain: str, seen: Seen) -> GainConstant:
    found = seen.facts.find_constant(gain)
    if found is None:
        raise NotReachedError(f"checked after you write a constant {gain}")
    return found


def _describe(one: GainConstant) -> str:
    known = one.value is not None and f"{one.value:g}" not in one.text
    worked = f", which is {one.value:.4g}" if known else ""
    return f"{one.name} = {one.text} in line {one.line}{worked}"


@check_all_runs(1)
def units(seen: Seen) -> None:
    """A comment gives the unit of each gain of the feedforward."""
    found = [one for one in seen.facts.constants if one.gain in seen.variant.gains]
    if not found:
        raise NotReachedError("checked after you write the gains")
    for one in found:
        verdict = _is_unit_told(one, seen)
        shown = f'"{one.comment[:50]}" next to {one.name}' if one.comment else f"{one.name} alone"
        other = verdict is False and any(find_commented_units(one.comment))
        if verdict is False and not other:
            raise WrongAnswer(
                f"no unit of {one.name} in line {one.line}: {shown}",
                hint="Write it next to the number: next year nobody will remember it.",
            )
        if not verdict:
            hint = "This is the right kind of unit, but not the unit of this number."
            if other:
                hint = f"This unit does not belong to this {one.name}. Each gain times what it "
                hint += "is multiplied by gives volts."
            raise WrongAnswer(f"{shown}, line {one.line}", hint=hint, misconception="M-UNITS")


def _is_unit_told(one: GainConstant, seen: Seen) -> bool | None:
    """Whether a gain's unit is told; where the number itself is not right, either will do."""
    units_ = seen.variant.list_matching_units(one.gain, one.value)
    if one.value is not None:
        units_ += seen.variant.list_units_of(one.gain, one.value)
    verdicts = {judge_comment(one.comment, unit, name=one.name) for unit in units_}
    # Volts and seconds are the same per meter and per rotation.
    kinds = {read_unit(unit).powers[:2] for unit in units_}
    own = any(said.powers[:2] in kinds for said in find_commented_units(one.comment, one.name))
    if True in verdicts or (not own and any(judge_comment(seen.facts.general, u) for u in units_)):
        return True
    # per meter, where per rotation is right
    elsewhere = seen.variant.list_matching_units(one.gain, None)
    if any(judge_comment(one.comment, unit, name=one.name) for unit in elsewhere):
        return None
    return None if None in verdicts else False


@check_all_runs(1)
def feedforward(seen: Seen) -> None:
    """The feedforward is of the class, or has the settings, that fit the mechanism."""
    one, facts = seen.feedforwards[0], seen.facts
    check_one_place(facts)
    if one.kind != seen.variant.made:
        gravity = seen.variant.analysis != "Simple" and one.kind == "SimpleMotorFeedforward"
        hint = "Which analysis type did the analyzer use? Each type has its own class."
        if gravity:
            hint = (
                "This class has no argument for kG, but gravity pulls this mechanism down all the "
                "time."
            )
        misconception = "M-NO-KG-IN-SYSID" if gravity else ""
        raise WrongAnswer(f"{one.kind} in line {one.line}", hint=hint, misconception=misconception)
    check_settings(one, seen.variant)
    check_compiles(facts)
    check_stop(facts, "start", "periodic")


@check_all_runs(2)
def order(seen: Seen) -> None:
    """Each gain is in the place where the feedforward expects it."""
    for one in seen.feedforwards:
        check_order(one, seen, points=2)


@check_all_runs(2)
def conversion(seen: Seen) -> None:
    """The feedforward gets kV and kA in the unit that the robot's code uses."""
    wrong = []
    for one in seen.feedforwards:
        given = {seen.find_gain(v, place): v for place, v in one.gains.items() if v}
        for gain in ("kV", "kA"):
            try:
                _check_converted(gain, one, given.get(gain, one.gains.get(gain)), seen)
            except WrongAnswer as why:
                wrong.append(why)
    if wrong:
        wrong[0].earned = max(0.0, 2.0 - len(wrong))
        raise wrong[0]


def _check_converted(gain: str, one: Gains, given: float | None, seen: Seen) -> None:
    at = f"{one.kind} in line {one.line}"
    passed = given != 0 and gain in one.gains
    value = seen.get_value(given, f"{gain} of {at}") if passed else 0.0
    variant = seen.convert_for_place(one)
    if passed and near(value, variant.needed(gain)):
        return
    constant = seen.facts.find_constant(gain)
    if constant and constant.value is not None and not _is_right(constant, constant.value, seen):
        raise WrongAnswer(_describe(constant), hint=f"Correct the constant {gain} first.")
    if not passed:
        raise WrongAnswer(f"{at} gets no {gain}", hint="Pass it, too.")
    slip = find_handed_slip(value, gain, variant)
    raise explain(f"{at} gets {gain} = {value:.4g}", slip)


@check_all_runs(1)
def kp(seen: Seen) -> None:
    """The constant kP fits the robot's loop, and its comment says what kind of number it is."""
    constant = _get_constant("kP", seen)
    marked = bool(START.search(constant.comment))
    earned = 0.5 if marked else 0.0
    try:
        judgments = list(list_feedback_loops(seen))
    except WrongAnswer as wrong:
        wrong.earned = earned
        raise
    own = constant.value
    if not judgments or (own is not None and not is_known(own, seen.variant)):
        value = seen.get_value(own, _describe(constant))
        judgments.insert(0, (_describe(constant), value, seen.variant))
    for said, value, variant in judgments:
        if not near(value, variant.needed("kP")):
            slip = find_feedback_slip(value, variant, text=constant.text)
            raise explain(said, slip, earned)
    if not marked:
        raise WrongAnswer(
            f'"{constant.comment[:50]}" next to kP'
            if constant.comment
            else "no comment next to kP",
            hint="The number is right. Write in a comment how far to trust it: the analyzer has "
            "never seen your loop run. Is this the final value?",
            earned=0.5,
        )
