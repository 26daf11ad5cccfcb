"""A prediction before an experiment, compared with the answer afterwards, without a grade."""

from html import escape
from typing import Any, ClassVar

from sim.core.errors import BadRequest
from sim.teaching.answers import read_answer


class Prediction:
    """A question with a few answers to choose from, as buttons in a notebook.

    Without buttons, plain code does the same: ``guess.value = "kA"``.

    Args:
        question: text of the question.
        options: the answers to choose from.
    """

    _results: ClassVar[dict[str, bool]] = {}  # question -> whether the prediction was right

    def __init__(self, question: str, *options: str) -> None:
        import ipywidgets  # type: ignore[import-untyped]  # noqa: PLC0415 - no types; for notebooks

        self.question = question
        self.options = options
        self._buttons = ipywidgets.RadioButtons(
            options=options, value=None, layout={"width": "max-content"}
        )
        self._box = ipywidgets.VBox([ipywidgets.HTML(escape(question)), self._buttons])

    @property
    def value(self) -> str | None:
        """The chosen answer; None before one is chosen.

        Raises:
            BadRequest: an answer is set that is not one of the options.
        """
        chosen: str | None = self._buttons.value
        return chosen

    @value.setter
    def value(self, chosen: str | None) -> None:
        if chosen is not None and chosen not in self.options:
            raise BadRequest(
                f"{chosen!r} is not one of the answers",
                advice=f"Choose one of: {', '.join(self.options)}.",
            )
        self._buttons.value = chosen

    def reveal(self, name: str) -> str:
        """The answer, with whether the prediction was right, and the score in this notebook.

        Without a prediction, only the answer is returned.

        Args:
            name: the name of the answer in ``lesson_answers.toml``: ``lesson9.ka``.

        Raises:
            BadRequest: there is no such name, or the answer is not one of the options.
        """
        answer = read_answer(name)
        if answer not in self.options:
            raise BadRequest(
                f"{answer!r} is not one of the answers",
                advice=f"Choose one of: {', '.join(self.options)}.",
            )
        if self.value is None:
            return f"Answer: {answer}."
        right = self.value == answer
        self._results[self.question] = right
        score = f"({sum(self._results.values())} of {len(self._results)} predictions right so far.)"
        if right:
            return f"You predicted: {answer}. That is right. {score}"
        return f"You predicted: {self.value}. The answer is: {answer}. {score}"

    def __str__(self) -> str:
        """The chosen answer, or ``nothing yet``."""
        return self.value or "nothing yet"

    def __repr__(self) -> str:
        return f"Prediction({self.question!r}: {self})"

    def _repr_mimebundle_(self, **how: object) -> Any:  # noqa: ANN401 - ipywidgets has no types
        answers = (f"  \N{WHITE CIRCLE} {option}" for option in self.options)
        plain = "\n".join((self.question, *answers))  # where no buttons can be shown
        return self._box._repr_mimebundle_(**how) | {"text/plain": plain}
