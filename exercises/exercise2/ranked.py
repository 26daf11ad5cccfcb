"""A list of causes in the order in which one looks: cheap things first."""

from grader.check import Wrong
from grader.word import word

from .team import KINDS, ORDER, Variant

LEAST = 2  # causes to name, and kinds of them
SOME = 1.0  # points for causes that are possible, in an order that is not
NEARLY = 2.0  # points for a good list on which the team's own trouble is missing


def judge_list(raw: object, variant: Variant) -> None:
    """Hold a list of causes against what is possible, cheap to check, and there to be seen.

    Raises:
        Wrong: it is no such list, or one of them does not hold.
    """
    causes = _read(raw)
    seen = ", ".join(causes)
    valid = [one for one in causes if variant.valid(one)]
    some = SOME if len(valid) >= LEAST else 0.0
    for one in causes:
        if one not in valid:
            says, code = _impossible(one, variant)
            raise Wrong(seen, hint=f"{one}: {says}", misconception=code, earned=some)
    kinds = [KINDS[one] for one in causes]
    if len(set(kinds)) < LEAST:
        raise Wrong(
            seen,
            hint="all possible, and all of one kind. Name at least two causes, of two "
            "kinds: mechanical, written down wrong, electrical",
            earned=some,
        )
    if kinds != sorted(kinds, key=ORDER.index):
        hint = "possible, all of them. Which can you check at a desk, and which needs a wrench?"
        raise Wrong(seen, hint=f"{hint} Look first where looking costs least", earned=some)
    if variant.planted and not set(causes) & set(variant.planted):
        hint = "a good list. But one line of your given.toml does not fit the others, or is not as "
        hint += "it should be, and what it points to is not on your list. Read it line by line"
        raise Wrong(seen, hint=hint, earned=NEARLY)


def _read(raw: object) -> list[str]:
    """The causes, each once."""
    if isinstance(raw, str) and raw:
        raw = raw.split(",")
    ask = f'Write at least two, in a list: ["...", "..."]. Choose from: {", ".join(sorted(KINDS))}.'
    if raw is None or raw in ("", []):
        raise Wrong("nothing yet", hint=ask)
    if not isinstance(raw, list):
        raise Wrong(f"{raw}, which is not a list", hint=ask)
    return list(dict.fromkeys(word(one, sorted(KINDS)) for one in raw))


def _impossible(cause: str, variant: Variant) -> tuple[str, str]:
    """Why a cause cannot be behind this kV, and the misconception's code."""
    if cause == "mass":
        return "at a steady speed, does it take more volts to move more mass?", "M-KV-MASS"
    if cause == "constant-friction":
        return "what takes the same volts at every speed shows in another gain than kV", ""
    if cause == "sensor-noise":
        return "noise scatters to both sides; it does not make a sound velocity slower", ""
    if cause == "wheel-size" and not variant.parts.diameter:
        return "there is no wheel between your motor and the angle that is logged", ""
    if cause == "unpowered-motor" and variant.parts.motors == 1:
        return "you have one motor, and it moves", ""
    says = "that makes a mechanism slower. Yours is faster than its motor allows"
    return says, "M-BELOW-THEORY-OK"
