"""An exercise's ``answer_key.py``: answers that can be looked up, so a class's package lacks it.

A question with one right answer for everybody, or a table from what is seen to the right word, is
a key: whoever reads it needs to know nothing. It stands in ``answer_key.py`` beside ``checks.py``,
with all that is said about wrong answers, and ``grade release --roster`` leaves that module out,
and those that only it imports. What has to be computed from a student's own numbers is no key.
"""

from importlib import import_module
from types import ModuleType

from grader.checks.check import NotReachedError

FILE_NAME = "answer_key.py"
AT_HOME = (
    "only your instructor can check this: the package of your class does not contain the answers"
)


def load_answer_key(package: str) -> ModuleType:
    """The module ``answer_key.py`` of an exercise.

    Args:
        package: ``__name__`` of the exercise's ``checks.py``.

    Raises:
        NotReachedError: a class's package lacks it.
    """
    name = f"{package}.{FILE_NAME.removesuffix('.py')}"
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise NotReachedError(AT_HOME) from None
