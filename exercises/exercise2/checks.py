"""Exercise 2: the kV from a log, held against the one the motor's free speed promises."""

from dataclasses import replace

from grader.answers.answer_key import load_answer_key
from grader.answers.asked_number import AskedNumber, Band
from grader.answers.choice_answer import check_choice
from grader.answers.number_answer import LARGEST, judge_number, read_answer_number
from grader.answers.submission import StudentAnswers
from grader.answers.wrong_number import AnswerKey, Scene
from grader.checks.check import WrongAnswer, check
from grader.student_data.student_files import Made

from .drawn import draw
from .slips import list_lookalikes, list_rarer_slips
from .team import FLAGS, VERDICTS, Variant, find_verdict

FILES = ("answers.toml",)
ANSWER_NAMES = ("kV_theory", "difference", "verdict", "ks_flag", "inspection")
LARGE = 1000.0  # [%] from here on a difference is shown without decimals
POINT = 1.0  # [%] that a difference may be off, or 1 % of measured over theory if that is more


def make_files(student: str) -> dict[str, Made]:
    """The learner's numbers."""
    return {"given.toml": _describe(draw(student))}


def _describe(variant: Variant) -> str:
    """The facts that a learner reads: parts, log, code, and the team's notes."""
    parts, symbol = variant.parts, variant.symbol
    part = {"drivetrain": "wheel", "elevator": "drum"}.get(variant.kind, variant.kind)
    lines = [
        "# Your own numbers for exercise 2. Only read here; your answers go into answers.toml.",
        "",
        f'mechanism = "{variant.kind}"',
        "",
        "[log]  # what SysId found in the four tests",
        f"kV = {variant.measured:g}  # [V·s/{symbol}]",
        f"kS = {variant.friction:g}  # [V]",
        f"typical_speed = {variant.speed:g}  # [{symbol}/s] in a match",
        "",
        "[parts]  # what is built in: two people counted the teeth and measured",
        f'motor = "{parts.motor}"',
        f"motors = {parts.motors}",
        f"free_speed = {parts.free_rpm:g}  # [rpm] of the motor at 12 V, by its data sheet",
        f"ratio = {parts.ratio:g}  # turns of the motor for one turn of the {part}",
    ]
    if parts.diameter:
        lines.append(f"{part}_diameter = {parts.diameter:g}  # [m]")
    for title, about in (("code", "what the robot's code says"), ("noticed", "by the team")):
        lines += ["", f"[{title}]  # {about}"]
        lines += [f"{name} = {value}" for name, value in variant.told[title].items()]
    return "\n".join(lines) + "\n"


@check(points=3)
def kv_theory(answers: StudentAnswers) -> str | None:
    """The theoretical kV, which follows from the free speed."""
    variant = answers.variant
    value = read_answer_number(answers.given.get("kv_theory"), variant.asked)
    nearest = min(variant.theories, key=lambda one: abs(one - value))
    key = AnswerKey(
        {"kV_theory": replace(variant.asked, expected=nearest)},
        Scene(
            lookalikes={"kV_theory": list_lookalikes(variant)},
            rarer={"kV_theory": list_rarer_slips(variant)},
        ),
    )
    return judge_number("kV_theory", {"kV_theory": answers.given["kv_theory"]}, key, points=3)


@check(points=2)
def difference(answers: StudentAnswers) -> None:
    """How far the measured kV is above the theoretical one, in percent."""
    variant, value, theirs = answers.variant, _read_percent(answers), _read_theory(answers)
    if _is_accepted(value, answers):
        return
    if theirs > 0.0 and _is_near(value, variant.compute_percent_above(theirs), variant):
        says = "it fits your kV_theory, but your kV_theory is not right yet"
        raise WrongAnswer(_format_percent(value), hint=says, earned=1.0)
    raise WrongAnswer(_format_percent(value), hint=_explain_percent(value, variant))


def _read_theory(answers: StudentAnswers) -> float:
    """The student's kV_theory; 0 if it is not a number."""
    try:
        return read_answer_number(answers.given.get("kv_theory"), answers.variant.asked)
    except WrongAnswer:
        return 0.0


def _is_accepted(value: float, answers: StudentAnswers) -> bool:
    """Whether a difference [%] follows from a kV_theory that is right."""
    variant, theirs = answers.variant, _read_theory(answers)
    known = (*variant.theories, *((theirs,) if variant.right(theirs) else ()))
    return any(_is_near(value, variant.compute_percent_above(one), variant) for one in known)


def _format_percent(percent: float) -> str:
    """A percentage with at most one decimal where it is large, and no powers of ten."""
    size = abs(percent)
    return f"{percent:.4g} %" if size < LARGE or size > LARGEST else f"{percent:.0f} %"


def _read_percent(answers: StudentAnswers) -> float:
    """The student's difference [%].

    Raises:
        WrongAnswer: it is not a number.
    """
    raw = answers.given.get("difference")
    raw = raw.replace("%", "").replace("percent", "") if isinstance(raw, str) else raw
    return read_answer_number(raw, AskedNumber("difference", 0.0, "", Band(0.0, 0.0)))


def _read_difference(answers: StudentAnswers) -> float | None:
    try:
        return _read_percent(answers)
    except WrongAnswer:
        return None


def _is_near(value: float, percent: float, variant: Variant) -> bool:
    ratio = variant.measured / variant.parts.theoretical_kv
    return abs(value - percent) <= POINT * max(1.0, ratio)


def _explain_percent(value: float, variant: Variant) -> str:
    """The likely cause of a wrong percentage."""
    percent = variant.compute_percent_above(variant.parts.theoretical_kv)
    undone = (
        (100.0 * value, "is this a fraction? Write percent, 100 times as much"),
        (-value, "the size is right, the sign is not: above theory is positive, below negative"),
        (
            value - 100.0,
            "is this the measured kV in percent of theory? Then subtract 100 %",
        ),
        (
            100.0 * value - 100.0,
            "is this measured divided by theory? How much more than 1 is it?",
        ),
    )
    for once, says in undone:
        if _is_near(once, percent, variant):
            return says
    of_measured = 100.0 * (1.0 - variant.parts.theoretical_kv / variant.measured)
    if _is_near(value, of_measured, variant):
        return "percent of what? Is it of the measured kV? Divide by the theoretical one"
    return (
        "outside the accepted ±1 %. Compute measured minus theory, divide by theory, and "
        "multiply by 100"
    )


@check(points=2)
def verdict(answers: StudentAnswers) -> None:
    """The verdict on the difference: bookkeeping, ok, watch or inspect."""
    right = answers.variant.verdict
    theirs = _read_difference(answers)
    sound = theirs is not None and (theirs < 0.0) == (right == "bookkeeping")
    off = theirs is not None and not any(_is_accepted(one, answers) for one in (theirs, -theirs))

    def why(found: str) -> tuple[str, str]:
        if off and theirs is not None and found == find_verdict(theirs):
            first = "it" if answers.variant.right(_read_theory(answers)) else "kV_theory"
            says = "your verdict fits your difference, but your difference is not right yet."
            return f"{says} Correct {first} first", ""
        if right == "bookkeeping":
            says = "can a mechanism be faster than its motor's free speed allows?"
            more = "Your difference is below zero: which line of the table in the README is that?"
            if not sound:
                more = "Check the sign of your difference"
            return f"{says} {more}", "M-BELOW-THEORY-OK"
        if found == "bookkeeping":
            says = "that is for a kV below the theoretical one."
            more = "Your difference is above zero" if sound else "Which sign has your difference?"
            return f"{says} {more}", ""
        return "find your difference, with its sign, in the table of the README", ""

    check_choice(answers.given.get("verdict"), right, VERDICTS, why=why)


@check(points=3)
def inspection(answers: StudentAnswers) -> None:
    """The causes to check, in the order in which you would check them."""
    load_answer_key(__name__).judge_list(answers.given.get("inspection"), answers.variant)


@check(points=1)
def ks_flag(answers: StudentAnswers) -> None:
    """What kS says about friction: fine, watch or stop."""

    def why(found: str) -> tuple[str, str]:
        if found == "stop":
            says = "stop is for a kS above kV times the typical speed. Compute that in volts"
        elif found == "watch":
            says = "compare kS with both limits: 0.5 V, and kV times the typical speed"
        else:
            says = "is it less than 0.5 V? Then compare it with kV times the typical speed, too"
        return says, ""

    check_choice(answers.given.get("ks_flag"), answers.variant.flag, FLAGS, why=why)
