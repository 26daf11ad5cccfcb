"""The examiner: checks a learner's answers and says what to do next. Knows no exercise by name.

from grader import submit
submit("exercise9", kS=0.12, kV=2.4, kA=0.3)   # in a notebook: writes answers.toml, grades it
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from grader.notebook.lesson_questions import ask_question, enable_checkboxes
    from grader.notebook.submit import ExerciseQuestions, submit

__all__ = ["ExerciseQuestions", "ask_question", "enable_checkboxes", "submit"]

_WHERE = {
    "submit": "notebook.submit",
    "ExerciseQuestions": "notebook.submit",
    "ask_question": "notebook.lesson_questions",
    "enable_checkboxes": "notebook.lesson_questions",
}


def __getattr__(name: str) -> object:
    """Import a name for notebooks on first use: the command starts without it."""
    if name not in _WHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_WHERE[name]}"), name)
