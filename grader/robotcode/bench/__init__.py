"""Robot programs on a simulated robot, and facts about their behavior.

``simulation`` turns the motors' shafts and runs the loop; ``routine_run`` runs the tests of a
SysIdRoutine, ``button_run`` presses the buttons, ``gains_run`` looks at gains. A program is a
subject: ``java_subject`` interprets Java here, ``grader.robotcode.python`` runs RobotPy in a
process of its own.
"""

import importlib
from typing import Any

BENCHES = {  # what is looked at: the bench, whose ``run`` gives the facts
    "routine": "routine_run.RoutineBench",
    "buttons": "button_run.ButtonBench",
    "gains": "gains_run.GainsBench",
}


def find_bench(kind: str) -> type[Any]:
    """The bench of a kind of run."""
    module, name = BENCHES[kind].split(".")
    return getattr(importlib.import_module(f"{__name__}.{module}"), name)  # type: ignore[no-any-return]
