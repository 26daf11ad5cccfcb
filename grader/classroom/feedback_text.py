"""The feedback to one check, as one text."""

from collections.abc import Mapping
from typing import Any

from grader.misconception import MISCONCEPTIONS
from sim.support.printable import make_printable


def compose_feedback(check: Mapping[str, Any]) -> str:
    """Feedback to a check: what was given, the likely cause, the next step, and why."""
    if check["status"] == "passed":
        return make_printable(str(check["hint"]))
    if check["status"] != "failed":
        return make_printable(str(check["seen"]))
    known = MISCONCEPTIONS.get(str(check["misconception"]))
    why = (known.says, f"see {known.reference}") if known else ()
    lines = (f"got {check['seen']}", str(check["hint"]), *why)
    return make_printable("\n".join(line for line in lines if line))
