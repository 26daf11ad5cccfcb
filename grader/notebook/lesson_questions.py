"""The questions of a lesson: answered at a click, neither stored nor graded.

ask_question("lesson2.hold", kG=1.5, kS=0.2, less=1.35)
"""

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from grader.answers.asked_number import AskedNumber, Band
from grader.answers.number_answer import judge_number
from grader.answers.wrong_number import AnswerKey, Scene
from grader.checks.check import WrongAnswer
from grader.checks.misconception import MISCONCEPTIONS
from sim.core.errors import BadRequest
from sim.teaching.answers import read_answer

RIGHT, NOT_YET = "Right.", "Not yet."
# JupyterLab draws the boxes of a text dead. The browser keeps each tick under the text beside it.
ENABLE = """<script>
(() => {
  const dead = "li input[type=checkbox]:disabled";
  const enable = () => document.querySelectorAll(dead).forEach(box => {
    const key = "system check: " + box.closest("li").textContent.trim();
    box.disabled = false;
    box.checked = localStorage.getItem(key) !== null;
    box.onchange = () => box.checked ? localStorage.setItem(key, "") : localStorage.removeItem(key);
  });
  enable();
  new MutationObserver(enable).observe(document.body, {childList: true, subtree: true});
})();
</script>"""


def enable_checkboxes() -> object:
    """HTML that makes the checkboxes of a lesson's system check work."""
    from IPython.display import HTML  # noqa: PLC0415 - for notebooks

    return HTML(ENABLE)  # type: ignore[no-untyped-call]  # no types


def ask_question(name: str, **values: float) -> "Question":
    """The question of a lesson, to be shown by a cell.

    Args:
        name: of the question in ``lesson_answers.toml``, such as ``lesson2.hold``.
        values: the numbers that its text names in braces.

    Raises:
        BadRequest: there is no such name.
    """
    asked = dict(read_answer(name))
    asked["question"] = asked["question"].format(**values)
    return NumberQuestion(**asked) if "expected" in asked else ChoiceQuestion(**asked)


class Question:
    """A question with something to answer it by, and feedback as soon as it is answered.

    Args:
        question: what is asked.
        entry: the widget that takes the answer.
        plain: the lines below the question where no widgets can be shown.
    """

    def __init__(self, question: str, entry: Any, plain: Sequence[str]) -> None:  # noqa: ANN401 - ipywidgets has no types
        from ipywidgets import HTML, VBox  # type: ignore[import-untyped]  # noqa: PLC0415 - no types; for notebooks

        self.question, self._entry, self._plain = question, entry, plain
        self._told = HTML()
        self._box = VBox([HTML(escape(question)), entry, self._told])
        entry.observe(self._show_feedback, "value")

    @property
    def feedback(self) -> str:
        """The feedback to the answer; empty where there is none."""
        raise NotImplementedError

    def _show_feedback(self, _: object = None) -> None:
        said = self.feedback
        self._told.value = f"<p><b>{escape(said)}</b></p>" if said else ""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.question!r})"

    def _repr_mimebundle_(self, **how: object) -> Any:  # noqa: ANN401 - ipywidgets has no types
        plain = "\n".join((self.question, *(f"  {line}" for line in self._plain)))
        return self._box._repr_mimebundle_(**how) | {"text/plain": plain}


class ChoiceQuestion(Question):
    """A question with a few answers as buttons.

    Without buttons, plain code does the same: ``question.answer("kA")``.

    Args:
        question: what is asked.
        options: answer -> what is said to it; only the answers where an experiment follows, which
            shows the reason.
        right: the right one of the answers.

    Raises:
        BadRequest: the right one is not among them.
    """

    def __init__(
        self, question: str, options: Mapping[str, str] | Sequence[str], *, right: str
    ) -> None:
        from ipywidgets import RadioButtons  # noqa: PLC0415 - for notebooks

        if right not in options:
            raise BadRequest(f"{right!r} is none of the answers", advice="Add it to the options.")
        self._options, self._right = options, right
        wide = {"width": "max-content"}
        buttons = RadioButtons(options=tuple(options), value=None, layout=wide)
        super().__init__(question, buttons, [f"\N{WHITE CIRCLE} {option}" for option in options])

    def answer(self, chosen: str) -> str:
        """Choose an answer; returns the feedback to it.

        Raises:
            BadRequest: it is none of the answers.
        """
        if chosen not in self._options:
            raise BadRequest(
                f"{chosen!r} is not one of the answers",
                advice=f"Choose one of: {', '.join(self._options)}.",
            )
        self._entry.value = chosen
        return self.feedback

    @property
    def feedback(self) -> str:
        """The feedback to the chosen answer; empty where none is chosen."""
        chosen = self._entry.value
        if chosen is None:
            return ""
        if isinstance(self._options, Mapping):
            return f"{RIGHT if chosen == self._right else NOT_YET} {self._options[chosen]}"
        verdict = RIGHT if chosen == self._right else f"No. The answer is: {self._right}."
        return f"{verdict} Go on, and see why."


class NumberQuestion(Question):
    """A question for a number; a wrong one is explained.

    Without a box to type in, plain code does the same: ``question.answer("0.019 V·s/rad")``.

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
        from ipywidgets import Text  # noqa: PLC0415 - for notebooks

        self._name = gain or "answer"
        asked = AskedNumber(self._name, expected, unit, Band(tolerance, tolerance))
        self._key = AnswerKey({self._name: asked}, Scene(angular=angular))
        wanted = f"a number [{unit}]" if unit else "a number"
        typed = Text(placeholder=wanted, continuous_update=False)
        super().__init__(question, typed, [f"Answer: {wanted}"])

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

    @property
    def feedback(self) -> str:
        """The feedback to the number that was typed; empty where none was."""
        given = str(self._entry.value)
        return self.answer(given) if given.strip() else ""
