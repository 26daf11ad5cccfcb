"""A list of causes in the order in which one looks: cheap things first."""

from grader.check import WrongAnswer
from grader.choice_answer import read_choice

from .team import KINDS, ORDER, Variant

LEAST, MOST = 2, 4  # causes to name: whoever names them all has not looked

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

    The three points do not depend on each other, but order and evidence need at least two
    possible causes.

    Raises:
        WrongAnswer: it is no such list, or a point is lost; the hint names every reason.
    """
    causes = _read(raw)
    refused = {one: why for one in causes if (why := _refused(one, variant))}
    possible = [one for one in causes if one not in refused]
    found = [(f"{one}: {says}", code) for one, (says, code) in refused.items()]
    if len(causes) > MOST:
        found.append((f"name at most {MOST}: the list says what to check first", ""))
    lost = 1 if found else 0
    if len(possible) < LEAST:
        found.append((f"name at least {LEAST} causes that are possible", ""))
        lost = 3
    else:
        further = [_about_order(possible, variant), _about_evidence(possible, variant)]
        found += [(one, "") for one in further if one]
        lost += sum(bool(one) for one in further)
    if found:
        codes = {code for _, code in found if code}
        raise WrongAnswer(
            ", ".join(causes),
            hint="; ".join(says for says, _ in found).replace("?; name", "? Also name"),
            misconception=codes.pop() if len(codes) == 1 else "",
            earned=3.0 - lost,
        )


def _refused(cause: str, variant: Variant) -> Problem | None:
    """Why a cause cannot be behind this kV, by physics or by the student's own file."""
    if not variant.valid(cause):
        return _impossible(cause, variant)
    line = variant.ruled_out(cause)
    return (DISAGREES[line], "") if line else None


def _about_order(causes: list[str], variant: Variant) -> str:
    """What is wrong with the order; the cause that the file shows may also stand first."""
    kinds = [KINDS[one] for one in causes]
    rest = kinds[1:] if causes[0] == variant.evident else kinds
    if rest == sorted(rest, key=ORDER.index):
        return ""
    return (
        "which can you check at a desk, and which needs a wrench? Check the easiest first; only"
        " a cause that your file already shows may come before that"
    )


def _about_evidence(causes: list[str], variant: Variant) -> str:
    """What the list lacks: the cause that the file shows or, on a sound mechanism, two kinds."""
    if variant.evident:
        if variant.evident in causes:
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


def _read(raw: object) -> list[str]:
    """The causes, each once."""
    if isinstance(raw, str) and raw:
        raw = raw.split(",")
    ask = f'Write at least two, in a list: ["...", "..."]. Choose from: {", ".join(sorted(KINDS))}.'
    if raw is None or raw in ("", []):
        raise WrongAnswer("nothing yet", hint=ask)
    if not isinstance(raw, list):
        raise WrongAnswer(f"{raw}, which is not a list", hint=ask)
    return list(dict.fromkeys(read_choice(one, sorted(KINDS)) for one in raw))


def _impossible(cause: str, variant: Variant) -> tuple[str, str]:
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
