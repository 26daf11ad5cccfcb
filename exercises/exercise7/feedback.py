"""Feedback on a wrong log: how the claimed fault would look, and where to look next.

Nothing here names what it really is.
"""

from pathlib import Path

from grader.checks.texts import read_texts

_TEXTS = read_texts(Path(__file__).with_name("faults.toml"))
ACTIONS: dict[str, str] = _TEXTS["actions"]  # action -> what it is for
FAULTS = tuple(_TEXTS["faults"])


def list_actions(fault: str) -> list[str]:
    """What helps against a fault, the usual action first."""
    helps: list[str] = _TEXTS["faults"][fault]["helps"]
    return helps


def explain_wrong_samples(fault: str) -> str:
    """The samples that count as wrong, if that can be doubtful; else empty."""
    place: str = _TEXTS["faults"][fault].get("place", "")
    return place


def explain_mixed_up(said: str, really: str) -> str:
    """What to say of a fault that was taken for another one."""
    fault = _TEXTS["faults"][really]
    asks = fault.get("is_it", {}).get(said, "")
    return " ".join(part for part in (explain_false_alarm(said), asks, fault["plot"]) if part)


def explain_false_alarm(reported: str) -> str:
    """What the reported fault would look like, for a log without it."""
    return f"{reported} would look like this: {_TEXTS['faults'][reported]['looks']}."


def explain_overlooked(really: str) -> str:
    """Feedback about a fault that the learner overlooked."""
    return (
        "Something is wrong here. The R² may be good anyway: look at the signals. "
        f"{_TEXTS['faults'][really]['plot']}"
    )
