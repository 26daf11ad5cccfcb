"""Exercise 6: plan four tests for each of four mechanisms, then look before they run."""

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import Any

from grader.answers.answer_key import load_answer_key
from grader.answers.asked_number import AskedNumber, Band
from grader.answers.choice_answer import normalize_choice
from grader.answers.number_answer import read_answer_number
from grader.answers.submission import StudentAnswers
from grader.checks.check import NotReachedError, WrongAnswer, check, make_check
from grader.checks.consequence import Consequence
from grader.student_data.student_files import Made

from .drawn import draw
from .outcome import find_outcome
from .plan import Machine, Plan, dynamic, quasistatic
from .rules import LONGEST, find_broken_rules

FILES = ("answers.toml",)
KINDS = ("drivetrain", "elevator", "turret", "shooter")
ITEMS = ("travel", "battery", "encoder", "log", "guard", "driver_station")  # of the checklist
POINTS = 1.5  # for a mechanism's plan
LEAST = 0.001  # of any part of a plan: less than that is nothing
MOST = {"ramp": ("V/s", 100.0), "step": ("V", 12.0), "timeout": ("s", 600.0)}  # as SysIdRoutine's
GAINS = {"kS": ("ks", "V"), "kG": ("kg", "V"), "kV": ("kv", "V·s/{}"), "kA": ("ka", "V·s²/{}")}
ANSWER_NAMES = (
    *(f"{kind}_{part}" for kind in KINDS for part in (*MOST, "release")),
    *(f"check_{item}" for item in ITEMS),
    "steps", "log_2026", "log_2027", "limit_a", "limit_b", "schedule",
)  # fmt: skip


class Answers(StudentAnswers):
    """The object that the checks read: the answers, and the learner's mechanisms."""

    @property
    def morning(self) -> Any:  # noqa: ANN401 - of a module that a class's package lacks
        """What the learner sees on the morning; raises NotReachedError in a class's package."""
        return load_answer_key(__name__).draw_morning(self.student)


def make_files(student: str) -> dict[str, Made]:
    """The learner's numbers."""
    lines = ["# Your own numbers for exercise 6. Only read here; answers go into answers.toml."]
    for machine in draw(student).machines.values():
        lines += ["", *_describe_machine(machine)]
    with suppress(NotReachedError):  # of a class's package, which has no answers to the words
        lines += _describe_morning(load_answer_key(__name__).draw_morning(student))
    return {"given.toml": "\n".join(lines) + "\n"}


def _describe_morning(morning: Any) -> list[str]:  # noqa: ANN401 - of a module that a class's package lacks
    """The things that are seen on the morning of the tests."""
    lines = ["", "[morning]  # what you see on the morning of the tests"]
    lines += [f'{item} = "{seen}"' for item, seen in morning.seen.items()]
    stick = "a USB stick, formatted as FAT32," if morning.stick else "no USB stick"
    lines += ["", "[robot]", f'usb = "{stick} is in the roboRIO"']
    return [*lines, *(f'{name} = "{told}"' for name, told in morning.limits.items())]


def _describe_machine(machine: Machine) -> list[str]:
    """One mechanism: gains are estimates, from the parts."""
    unit = machine.symbol
    lines = [f"[{machine.kind}]  # gains are estimates, computed from the parts"]
    for name, (field, per) in GAINS.items():
        if value := getattr(machine, field):
            lines.append(f"{name} = {value:g}  # [{per.format(unit)}]")
    lines.append(f"free_speed = {machine.free_speed:.3g}  # [{unit}/s] at 12 V")
    if machine.travel is not None:
        lines += [
            (
                f"travel = {machine.travel:g}  # [{unit}] from the start to where it must have "
                "stopped"
            ),
            (
                f"reaction = {machine.reaction:g}  # [s] from the mark until the thumb is off the "
                "button"
            ),
        ]
    lines += [
        f"stall_current = {machine.stall:g}  # [A] of one motor at standstill at 12 V",
        f"current_limit = {machine.limit:g}  # [A] of one motor, set in its controller",
        f"noise = {machine.noise:g}  # [{unit}/s] scatter of the velocity",
    ]
    if machine.grip:
        lines.append(f"grip = {machine.grip:g}  # friction of the wheels on the carpet")
    return lines


def consequence(answers: Answers) -> Consequence | None:
    """The motion of the learner's plans in the available space."""
    plans = {}
    for kind, machine in answers.variant.machines.items():
        with suppress(WrongAnswer):
            plans[kind] = _read_plan(machine, answers.given)
    return find_outcome(plans, answers.variant.machines)


def _judge_plan(kind: str, answers: Answers) -> str:
    """Compare a plan with the rules; a note on what it does."""
    machine = answers.variant.machines[kind]
    plan = _read_plan(machine, answers.given)
    found = find_broken_rules(machine, plan)
    slow, fast = quasistatic(machine, plan), dynamic(machine, plan)
    if not found:
        symbol = machine.symbol
        run = f"{slow.stop_position:.2f} {symbol} and {fast.stop_position:.2f} {symbol}"
        share = 100.0 * slow.end_speed / machine.free_speed
        return f"ramp and step need {run}; the ramp reaches {share:.0f} % of the free speed"
    codes = {one.misconception for one in found} - {""}
    hints = [one.says for one in found]
    exchanged = replace(plan, ramp=plan.step, step=plan.ramp)
    if plan.ramp > plan.step and len(find_broken_rules(machine, exchanged)) < len(found):
        hints.insert(0, "your ramp is larger than your step: did you swap them?")
    mark = "timeout" if math.isinf(plan.release) else f"{plan.release:g} {machine.symbol}"
    raise WrongAnswer(
        f"{plan.ramp:g} V/s, {plan.step:g} V, {plan.timeout:g} s, let go at {mark}",
        hint=". Also: ".join(hints).replace("?. ", "? "),
        misconception=codes.pop() if len(codes) == 1 else "",
        earned=POINTS / 2.0 if len(found) == 1 else 0.0,
    )


plans = tuple(
    make_check(
        kind,
        f"A plan for the {kind} that follows all the rules.",
        partial(_judge_plan, kind),
        points=POINTS,
    )
    for kind in KINDS
)


def _read_plan(machine: Machine, given: Mapping[str, object]) -> Plan:
    """Read a plan.

    Raises:
        WrongAnswer: a part of it is missing, or no robot could do it; the message names which.
    """
    raw = given.get(f"{machine.kind}_release")
    never = isinstance(raw, str) and normalize_choice(raw) == "timeout"
    values = [_read_positive(machine, name, given, *most) for name, most in MOST.items()]
    mark = math.inf if never else _read_positive(machine, "release", given, machine.symbol, 1e6)
    return Plan(*values, mark)


def _read_positive(
    machine: Machine, what: str, given: Mapping[str, object], unit: str, most: float
) -> float:
    name = f"{machine.kind}_{what}"
    try:
        value = read_answer_number(given.get(name), AskedNumber(name, 1.0, unit, Band(0.0, 0.0)))
    except WrongAnswer as wrong:
        wrong.seen = f"{name}: {wrong.seen}"
        if ", such as" in wrong.hint:
            wrong.hint = f"Write a number for {name}, in {unit}."
        if what == "release":
            wrong.hint += ' Or "timeout", if nobody lets go before it.'
        raise
    if not LEAST < value <= most:
        hint = f"Choose a number above {LEAST:g}, at most {most:.0f} {unit}."
        if what == "timeout" and value > most:
            hint = (
                f"No test may be longer than {LONGEST:g} s. Is this in milliseconds? Write seconds."
            )
        raise WrongAnswer(f"{name}: {value:g} {unit}", hint=hint)
    return value


@check(points=1)
def checklist(answers: Answers) -> None:
    """Six decisions on the morning of the tests: go or no-go."""
    right = {f"check_{item}": word for item, word in answers.morning.decisions.items()}
    load_answer_key(__name__).judge_all(answers.given, right, points=1.0)


@check(points=1)
def steps(answers: Answers) -> None:
    """The four steps of system identification, in order."""
    load_answer_key(__name__).judge_steps(answers.given.get("steps"))


@check(points=0.5)
def log_2026(answers: Answers) -> None:
    """Where your roboRIO keeps its log, season 2026."""
    load_answer_key(__name__).judge_choice("log_2026", answers.given, answers.morning.roborio)


@check(points=0.5)
def log_2027(answers: Answers) -> None:
    """Where a Systemcore keeps its log, season 2027."""
    load_answer_key(__name__).judge_choice("log_2027", answers.given)


@check(points=0.5)
def limits(answers: Answers) -> None:
    """What a test does to two limits: they act, or are bypassed."""
    load_answer_key(__name__).judge_all(answers.given, answers.morning.effects, points=0.5)


@check(points=0.5)
def schedule(answers: Answers) -> None:
    """When in the season to run the tests."""
    load_answer_key(__name__).judge_choice("schedule", answers.given)
