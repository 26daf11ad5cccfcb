"""Possible causes behind a kV, and the order to look for them: cheap ones first.

A class's package lacks this module: see ``grader.answers.answer_key``.
"""

from grader.answers.choice_answer import read_choices
from grader.checks.check import WrongAnswer

from .team import Variant

LEAST, MOST = 2, 4  # causes to name: whoever names them all has not looked

KINDS = {  # word -> where to look for it; "" cannot move kV
    "gear-ratio": "units",
    "wheel-size": "units",
    "velocity-unit": "units",
    "motor-type": "units",
    "logged-voltage": "electrical",
    "unpowered-motor": "electrical",
    "dragging-belt": "mechanical",
    "dry-bearing": "mechanical",
    "mass": "",
    "constant-friction": "",
    "sensor-noise": "",
}
BRAKES = ("dragging-belt", "dry-bearing")
RULED_OUT_BY = {  # cause -> what the student's file says about it
    "gear-ratio": "ratio",
    "wheel-size": "radius",
    "logged-voltage": "logged_voltage",
}
ORDER = ("units", "electrical", "mechanical")

Problem = tuple[str, str]  # what to tell the student, and the misconception's code
DISAGREES = {  # line of the student's file -> what it says of a cause it rules out
    "ratio": "your file has the same ratio in [code] as in [parts]",
    "radius": "twice the radius in [code] is the diameter in [parts]",
    "logged_voltage": "your file says that the log contains the applied voltage",
    "mechanic": (
        "read what your mechanic noticed: nothing gets hot, and nothing brakes more at high speed"
    ),
}


def judge_list(raw: object, variant: Variant) -> None:
    """Grade a list of causes: one point each for possible causes, their order and the evidence.

    Evidence needs at least two possible causes, and the order counts only with the evidence: else a
    list that fits everybody earned it. Each cause that is not possible, and each one too many,
    costs a point: so a list of everything earns nothing.

    Raises:
        WrongAnswer: it is no such list, or a point is lost; the hint names every reason.
    """
    words = sorted(KINDS)
    ask = f'Write at least two, in a list: ["...", "..."]. Choose from: {", ".join(words)}.'
    causes = list(dict.fromkeys(read_choices(raw, words, ask=ask)))
    refused = {one: why for one in causes if (why := _refuse_cause(one, variant))}
    possible = [one for one in causes if one not in refused]
    found = [(f"{one}: {says}", code) for one, (says, code) in refused.items()]
    lost = len(refused)
    if len(causes) > MOST:
        found.append((f"name at most {MOST}: the list says what to check first", ""))
        lost += len(causes) - MOST
    if len(possible) < LEAST:
        found.append((f"name at least {LEAST} causes that are possible", ""))
        lost = 3
    else:
        order, evidence = _explain_order(possible, variant), _explain_evidence(possible, variant)
        found += [(one, "") for one in (order, evidence) if one]
        lost += 2 if evidence else 1 if order else 0
    if found:
        codes = {code for _, code in found if code}
        raise WrongAnswer(
            ", ".join(causes),
            hint="; ".join(says for says, _ in found).replace("?; name", "? Also name"),
            misconception=codes.pop() if len(codes) == 1 else "",
            earned=3.0 - lost,
        )


def find_evident(variant: Variant) -> str:
    """The one cause that the student's own file shows; empty if nothing went wrong."""
    return variant.planted[0] if variant.planted else ""


def is_possible(word: str, variant: Variant) -> bool:
    """Whether a cause can be behind a kV that is off as this one is, by physics alone."""
    if word == "wheel-size" and not variant.parts.diameter:
        return False
    if word == "unpowered-motor" and variant.parts.motors == 1:
        return False
    down = KINDS[word] == "units" or word == "logged-voltage"
    return bool(KINDS[word]) and (down or variant.verdict != "bookkeeping")


def _find_ruling_line(word: str, variant: Variant) -> str:
    """The line of the student's file that rules a cause out; empty if none does.

    A sound mechanism rules out nothing: its student names causes for another day.
    """
    if not variant.planted or word in variant.planted:
        return ""
    if word in BRAKES:
        return "" if find_evident(variant) in BRAKES else "mechanic"
    return RULED_OUT_BY.get(word, "")


def _refuse_cause(cause: str, variant: Variant) -> Problem | None:
    """Why a cause cannot be behind this kV, by physics or by the student's own file."""
    if not is_possible(cause, variant):
        return _explain_impossible(cause, variant)
    line = _find_ruling_line(cause, variant)
    return (DISAGREES[line], "") if line else None


def _explain_order(causes: list[str], variant: Variant) -> str:
    """The fault in the order; the cause that the file shows may also stand first."""
    kinds = [KINDS[one] for one in causes]
    rest = kinds[1:] if causes[0] == find_evident(variant) else kinds
    if rest == sorted(rest, key=ORDER.index):
        return ""
    return (
        "which can you check at a desk, and which needs a wrench? Check the easiest first; only"
        " a cause that your file already shows may come before that"
    )


def _explain_evidence(causes: list[str], variant: Variant) -> str:
    """The missing causes: the one that the file shows or, on a sound mechanism, two kinds."""
    evident = find_evident(variant)
    if evident:
        if evident in causes:
            return ""
        return (
            "one line of your given.toml does not agree with the others, or is not as it should"
            " be, and its cause is not on your list. Read the file line by line"
        )
    if len({KINDS[one] for one in causes}) < LEAST:
        return (
            "all are of one kind. Nothing is wrong yet, so name causes of at least two kinds: "
            "written numbers, electrical, mechanical"
        )
    return ""


def _explain_impossible(cause: str, variant: Variant) -> tuple[str, str]:
    """Why a cause cannot be behind this kV, and the misconception's code."""
    if cause == "mass":
        return "does a heavier robot need more volts at a steady speed?", "M-KV-MASS"
    if cause == "constant-friction":
        return (
            "friction that needs the same voltage at every speed changes another gain than kV"
        ), ""
    if cause == "sensor-noise":
        return "noise goes to both sides; it does not make the velocity slower", ""
    if cause == "wheel-size" and not variant.parts.diameter:
        return "there is no wheel between your motor and the logged angle", ""
    if cause == "unpowered-motor" and variant.parts.motors == 1:
        return "you have only one motor, and it turns", ""
    says = "this makes a mechanism slower. Yours is faster than its motor allows"
    return says, "M-BELOW-THEORY-OK"
