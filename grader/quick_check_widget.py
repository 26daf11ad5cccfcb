"""Quick checks in a lesson: immediate feedback, neither stored nor graded.

Quick("Which gain moved?", {"kS": "Friction did not change …", "kA": "It holds the mass."},
      right="kA")
QuickNumber("kV = 0.12 V·s/rot. And per radian?", 0.0191, "V·s/rad")
"""

from collections.abc import Mapping
from html import escape
from typing import Any

from grader.answers.number_answer import AnswerKey, AskedNumber, Band, judge_number
from grader.answers.wrong_number import Scene
from grader.check import WrongAnswer
from grader.misconception import MISCONCEPTIONS
from sim.core.errors import BadRequest
from sim.teaching.prediction import Prediction

RIGHT, NOT_YET = "Right.", "Not yet."


class QuickCheck(Prediction):
    """A question with a few answers, and a feedback to each.

    Without buttons, plain code does the same: ``check.answer("kA")``.

    Args:
        question: what is asked.
        options: answer -> what is said to it.
        right: the right one of the answers.

    Raises:
        BadRequest: the right one is not among them.
    """

    def __init__(self, question: str, options: Mapping[str, str], *, right: str) -> None:
        import ipywidgets  # type: ignore[import-untyped]  # noqa: PLC0415 - no types; for notebooks

        super().__init__(question, *options)
        if right not in options:
            raise BadRequest(f"{right!r} is none of the answers", advice="Add it to the options.")
        self._says, self._right = options, right
        self._told = ipywidgets.HTML()
        self._box.children = (*self._box.children, self._told)
        self._buttons.observe(self._show_feedback, "value")

    def answer(self, chosen: str) -> str:
        """Choose an answer; returns the feedback to it.

        Raises:
            BadRequest: it is none of the answers.
        """
        self.value = chosen
        return self.feedback

    @property
    def feedback(self) -> str:
        """The feedback to the chosen answer; empty where none is chosen."""
        if self.value is None:
            return ""
        return f"{RIGHT if self.value == self._right else NOT_YET} {self._says[self.value]}"

    def _show_feedback(self, _: object = None) -> None:
        self._told.value = f"<p><b>{escape(self.feedback)}</b></p>" if self.feedback else ""


class QuickNumberCheck:
    """A question for a number; a wrong one is explained.

    Without a box to type in, plain code does the same: ``check.answer("0.019 V·s/rad")``.

    Args:
        question: what is asked.
        expected: the right number, in ``unit``.
        unit: of the answer; empty for a bare number.
        tolerance: share by which it may be off.
        gain: which gain it is, whose slips are known; empty for any other number.
        angular: whether rotations and radians may be taken for each other.
    """

    def __init__(
        self,
        question: str,
        expected: float,
        unit: str = "",
        *,
        tolerance: float = 0.03,
        gain: str = "",
        angular: bool = False,
    ) -> None:
        import ipywidgets  # noqa: PLC0415 - for notebooks

        self.question = question
        self._name = gain or "answer"
        asked = AskedNumber(self._name, expected, unit, Band(tolerance, tolerance))
        self._key = AnswerKey({self._name: asked}, Scene(angular=angular))
        self._typed = ipywidgets.Text(placeholder=f"a number [{unit}]" if unit else "a number",
                                      continuous_update=False)  # fmt: skip
        self._told = ipywidgets.HTML()
        self._box = ipywidgets.VBox([ipywidgets.HTML(escape(question)), self._typed, self._told])
        self._typed.observe(self._show_feedback, "value")

    def answer(self, given: object) -> str:
        """The feedback to an answer: a number, or a text with a unit."""
        try:
            note = judge_number(self._name, {self._name: given}, self._key, points=1)
        except WrongAnswer as wrong:
            why = MISCONCEPTIONS[wrong.misconception].says if wrong.misconception else ""
            hint = wrong.hint[:1].upper() + wrong.hint[1:]
            hint += "" if hint.endswith((".", "?")) else "."
            return f"{NOT_YET} {wrong.seen}. {hint} {why}".strip()
        return f"{RIGHT} {note}" if note else RIGHT

    def _show_feedback(self, _: object = None) -> None:
        given = str(self._typed.value)
        said = self.answer(given) if given.strip() else ""
        self._told.value = f"<p><b>{escape(said)}</b></p>" if said else ""

    def __repr__(self) -> str:
        return f"QuickNumber({self.question!r})"

    def _repr_mimebundle_(self, **how: object) -> Any:  # noqa: ANN401 - ipywidgets has no types
        plain = f"{self.question}\n  Answer: {self._typed.placeholder}"  # where there is no box
        return self._box._repr_mimebundle_(**how) | {"text/plain": plain}
