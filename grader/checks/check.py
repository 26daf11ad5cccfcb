"""A check: one function that looks at an answer; its docstring is the line the learner reads.

    @check(points=1, after=routine)
    def ramp(facts: RoutineFacts) -> None:
        \"\"\"The quasistatic voltage rises by 0.5 V every second.\"\"\"
        if facts.ramp.value != 0.5:
            raise WrongAnswer(facts.ramp.text, hint="Volts.of(0.5).per(Second) is 0.5 V/s.")

A check that returns has passed; what it returns, if anything, is a note for the learner.
WrongAnswer says the answer is wrong, NotReachedError that there is nothing to look at yet,
NotRunError that it takes running the learner's code and that this was not allowed, and anything
else that our own code broke, for which nobody is blamed.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, TypeVar

from sim.core.errors import Refusal

Subject = TypeVar("Subject")


NOTHING = "nothing yet"  # how ``seen`` ends where a question has no answer
LONGEST_SHOWN = 40  # [characters] of an answer that is shown back


def shorten(raw: object) -> str:
    """An answer as messages quote it: on one line, and not too long."""
    text = " ".join(str(raw).split())
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}…"


class Status(StrEnum):
    """The status of a check."""

    PASSED = "passed"
    FAILED = "failed"
    NOT_REACHED = "not-reached"  # something before it has to be right first
    NOT_RUN = "not-run"  # it takes running the learner's code, and that was not allowed
    ERROR = "error"  # our code broke; no fault of the learner's


class WrongAnswer(Exception):  # noqa: N818 - a wrong answer is no error of the program
    """The answer is wrong.

    Args:
        seen: what was given, as the learner wrote it: ``Volts.of(3) (line 12)``.
        hint: the likely cause and the next step; never the answer.
        misconception: its code, a key of ``grader.checks.misconception.MISCONCEPTIONS``, or empty.
        earned: points all the same, less than the check's full points.
    """

    def __init__(
        self, seen: str, *, hint: str, misconception: str = "", earned: float = 0.0
    ) -> None:
        self.seen = seen
        self.hint = hint
        self.misconception = misconception
        self.earned = earned
        super().__init__(seen, hint)


class NotReachedError(Exception):
    """A check has nothing to read yet; the message says what is missing."""


class NotRunError(Exception):
    """Only running the learner's code could tell, and it was not run; the message says why."""


@dataclass(frozen=True)
class Result:
    """The result of one check.

    Args:
        id: the check's name in lower case with dashes: ``applied-voltage``.
        description: the sentence the learner reads.
        status: passed, failed, not-reached, not-run or error.
        points: points earned.
        max_points: the most points that it gives.
        seen: what was given; for ``not-reached``, ``not-run`` and ``error`` the reason.
        hint: likely cause and next step; a note where the check passed.
        misconception: its code, or empty.
    """

    id: str
    description: str
    status: Status
    points: float
    max_points: float
    seen: str = ""
    hint: str = ""
    misconception: str = ""

    @property
    def is_unanswered(self) -> bool:
        """Whether the question has no answer yet, which is no mistake."""
        return self.status is Status.FAILED and self.seen.endswith(NOTHING) and not self.points


@dataclass(frozen=True)
class Check(Generic[Subject]):
    """A check that can be run on an answer.

    Args:
        id: its function's name, with dashes.
        description: the first line of the function's docstring.
        points: for a full pass.
        after: the checks that have to pass first.
        judge: the function.
    """

    id: str
    description: str
    points: float
    after: tuple["Check[Subject]", ...]
    judge: Callable[[Subject], str | None]

    def run(self, subject: Subject) -> Result:
        """Run the check on an answer; an exception becomes a result, too."""
        try:
            note = self.judge(subject) or ""
        except WrongAnswer as wrong:
            points = min(max(wrong.earned, 0.0), self.points)
            found = (wrong.seen, wrong.hint, wrong.misconception)
            return self._make_result(Status.FAILED, points, *found)
        except (NotReachedError, Refusal) as reason:  # of a further file, for instance
            return self._make_result(Status.NOT_REACHED, 0.0, str(reason))
        except MemoryError:  # whoever grades says it: this check is not broken
            raise
        except NotRunError as reason:
            return self._make_result(Status.NOT_RUN, 0.0, str(reason))
        except Exception as error:  # noqa: BLE001 - whatever it is, the learner is not to blame
            return self._make_result(Status.ERROR, 0.0, f"{type(error).__name__}: {error}")
        return self._make_result(Status.PASSED, self.points, "", note)

    def _make_result(
        self, status: Status, points: float, seen: str, hint: str = "", misconception: str = ""
    ) -> Result:
        head = (self.id, self.description, status, points, self.points)
        return Result(*head, seen, hint, misconception)


def check(
    *, points: float, after: Check[Subject] | tuple[Check[Subject], ...] = ()
) -> Callable[[Callable[[Subject], str | None]], Check[Subject]]:
    """Make a check of a function.

    Args:
        points: for a full pass.
        after: the check, or checks, that have to pass first.

    Raises:
        ValueError: the function has no docstring, so the learner could not be told what it wants.
    """

    def made(look: Callable[[Subject], str | None]) -> Check[Subject]:
        sentence = (look.__doc__ or "").strip().partition("\n")[0].removesuffix(".")
        if not sentence:
            raise ValueError(f"the check {look.__name__} needs a docstring: the learner reads it")
        return make_check(look.__name__, sentence, look, points=points, after=after)

    return made


def make_check(
    name: str,
    description: str,
    judge: Callable[[Subject], str | None],
    *,
    points: float,
    after: Check[Subject] | tuple[Check[Subject], ...] = (),
) -> Check[Subject]:
    """Make one of several checks that differ in a name: ``check`` is for one that is alone.

    Args:
        name: of the check; capitals and underscores are for Python.
        description: the line that the learner reads.
        judge: looks at an answer.
        points: for a full pass.
        after: the check, or checks, that have to pass first.
    """
    before = after if isinstance(after, tuple) else (after,)
    id_ = name.lower().replace("_", "-")
    return Check(id_, description.removesuffix("."), float(points), before, judge)


def run_checks(checks: Sequence[Check[Subject]], subject: Subject) -> tuple[Result, ...]:
    """Run the checks in order; a check is not reached if the one that it needs did not pass."""
    results: dict[str, Result] = {}
    for one in checks:
        blocked = [first for first in one.after if results[first.id].status is not Status.PASSED]
        if blocked:
            first = blocked[0].description
            results[one.id] = skip_check(one, f"checked after this is right: {first}")
        else:
            results[one.id] = one.run(subject)
    return tuple(results.values())


def skip_check(one: Check[Subject], reason: str) -> Result:
    """The result of a check that was not run."""
    return Result(one.id, one.description, Status.NOT_REACHED, 0.0, one.points, reason)
