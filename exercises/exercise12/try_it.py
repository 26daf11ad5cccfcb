"""Try effects on your own logs.

    python exercises/exercise12/try_it.py delay backlash
    python exercises/exercise12/try_it.py delay --logs mystery/me

Their parameters are fitted to your log. What counts is the gap of the validation.
"""

import argparse
import sys
from pathlib import Path

from grader.checks.check import WrongAnswer
from grader.course.progress import find_course, load_progress
from grader.exercise.exercise import Exercise, find_exercise
from sim.core.errors import Refusal
from sim.plot.effect_search import EffectSearch

PAGE = "gap.html"


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
    names = exercise.module.read_names(asked.effects) if asked.effects else ()
    data = asked.logs or _prepare_own(exercise, asked.student or load_progress(course)[0].student)
    search = EffectSearch.read(data)
    for name in names:
        _print_wrapped(search.add(name))
    _print_wrapped(", ".join(f"{name} = {value:.4g}" for name, value in search.gains.items()))
    for name, gap in search.gaps.items():
        _print_wrapped(f"gap of the {name}: {gap:.3g} times the noise of the velocity")
    _print_wrapped(search.open() if asked.held_out else "\n".join(search.answer))
    for variable, view in search.views.views.items():
        _print_wrapped(f"{variable}: explains {100.0 * view.explains:.0f} % of what is left")
    _print_wrapped(search.views.headline)
    search.write_page(data / PAGE)
    _print_wrapped(f"The pictures are in {data / PAGE}: open this file in a browser.")
    return 0


def _prepare_own(exercise: Exercise, student: str) -> Path:
    """Make a learner's own logs, and say where they are."""
    exercise.prepare(student, say=_print_wrapped)
    folder: Path = exercise.folder / "data" / exercise.module.make_folder_name(student)
    return folder


def _print_wrapped(line: str) -> None:
    sys.stdout.write(f"{line}\n")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refusal as refusal:
        sys.exit(str(refusal))
    except WrongAnswer as wrong:
        sys.exit(f"{wrong.seen}. {wrong.hint}")
