"""Try effects on your own logs.

    python exercises/exercise12/try_it.py delay backlash
    python exercises/exercise12/try_it.py delay --logs mystery/me

Their parameters are fitted to your log. What counts is the gap of the validation.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from grader.check import WrongAnswer
from grader.course import find_course, load_progress
from grader.exercise import Exercise, find_exercise
from sim import read
from sim.core.errors import Refusal
from sim.core.units import convert_gains, find_unit
from sim.physics.replay import replay_log
from sim.reconcile.residual_map import map_residuals

TOLD = 4  # places


def main() -> int:
    """Show what some effects do for the gap."""
    parser = argparse.ArgumentParser(description="Try effects on your own logs.")
    parser.add_argument("effects", nargs="*", help="names, as sysid effects lists them")
    parser.add_argument("--student", help="whose logs; yours by default")
    parser.add_argument(
        "--held-out",
        action="store_true",
        help=("also show the gap of the held-out log: only at the end"),
    )
    parser.add_argument("--logs", type=Path, help="folder with other logs, those of a mystery, say")
    asked = parser.parse_args()
    course = find_course(Path(__file__).resolve().parent)
    exercise = find_exercise("12", course)
    room = exercise.module
    data = asked.logs or _prepare_own(exercise, asked.student or load_progress(course)[0].student)
    kinds = ("log", "validation", *(("held-out",) if asked.held_out else ()))
    logs = {name: read(data / f"{name}.wpilog") for name in kinds}
    names = room.names_of(asked.effects) if asked.effects else ()
    model = room.with_effects(logs["log"], names)
    per = find_unit(logs["log"].units)
    gains = convert_gains(model.gains, factor=per.si)
    _say(", ".join(f"{name} = {value:.4g}" for name, value in gains.items()))
    for part in model.parts:
        for name, one in part.to_json(per).items():
            _say(f"{part.effect}.{name} = {one['value']:.5g}  # [{one['unit']}]")
    for name, log in logs.items():
        wide = room.gap(model, log) / room.noise(log)
        _say(f"gap of the {name}: {wide:.3g} times the noise of the velocity")
    _say("Where simulation and validation differ most:")
    shown = logs["validation"]
    tracks = [np.column_stack((one.position, one.seen)) for one in replay_log(model, shown)]
    found = map_residuals(shown, tracks, compared=room.compared(shown), floor=room.noise(shown))
    places = found.find_places(TOLD, signal="velocity") if found else ()
    for place in places:
        _say(f"  {place.sentence}")
    if not places:
        _say("  no difference is clearly larger than the noise")
    return 0


def _prepare_own(exercise: Exercise, student: str) -> Path:
    """Make a learner's own logs, and say where they are."""
    exercise.prepare(student, say=_say)
    folder: Path = exercise.folder / "data" / exercise.module.make_folder_name(student)
    return folder


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refusal as refusal:
        sys.exit(str(refusal))
    except WrongAnswer as wrong:
        sys.exit(f"{wrong.seen}. {wrong.hint}")
