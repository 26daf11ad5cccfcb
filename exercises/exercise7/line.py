"""One line of an answer: the fault, its place, and the action, in any order.

    log04 = "hard-stop, dynamic-forward, 1.20 to 1.66, trim"

Two faults of one log are joined by ``+``, or stand in a list.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from grader.checks.check import WrongAnswer, shorten
from sim.core.log import Log
from sim.core.vocabulary import FOUR_TESTS

from .drawn import Case
from .feedback import ACTIONS, FAULTS, list_actions

CLEAN = "clean"
PLACES = (*FOUR_TESTS, "quasistatic", "dynamic", "forward", "reverse", "whole")
SPELLED = {"mislabeled-test": "mislabelled-test", "all": "whole", "re-run": "rerun"}  # people write
FILLERS = {"from", "to", "until", "till", "s", "sec", "seconds", "at", "in", "the", "test", "tests"}
FILLERS |= {"log", "run", "t", "between"}
NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
MANY = 6  # claims about one log; more are a list of all there are

Span = tuple[int, float, float]  # which run, from [s], to [s] in the log's own time


@dataclass(frozen=True)
class Claim:
    """A learner's claim about one fault.

    Args:
        fault: one of ``FAULTS``, or ``CLEAN``.
        places: of ``PLACES``: which tests.
        times: [s] from, to; None if none are given.
        action: one of ``ACTIONS``, or empty.
    """

    fault: str
    places: tuple[str, ...]
    times: tuple[float, float] | None
    action: str

    def _includes_test(self, test: str) -> bool:
        """Whether a test is one of those that are named, or has all the marks that are."""
        named = [place for place in self.places if place in FOUR_TESTS]
        if named:
            return test in named
        return all(place in ("whole", *test.split("-")) for place in self.places)

    def spans(self, log: Log, *, whole: bool) -> list[list[Span]]:
        """The parts of a log that a claim may refer to; none if it names no place.

        Args:
            log: which the claim is about.
            whole: only the tests count, not the times.

        Returns:
            Ways to read it: times may count from the beginning of the log, or of the test.
        """
        named = [
            (index, float(run.time[0]), float(run.time[-1]))
            for index, run in enumerate(log.runs)
            if self._includes_test(run.test)
        ]
        if self.times is None:
            return [named] if self.places else []
        ways = []
        for since_test in (False, True) if self.places else (False,):
            first, last = self.times
            cut = [
                (index, max(begin, first + shift), min(end, last + shift))
                for index, begin, end in named
                for shift in (begin if since_test else 0.0,)
            ]
            kept = {index for index, begin, end in cut if end > begin}
            part = [one for one in (named if whole else cut) if one[0] in kept]
            ways.append(part)
        return ways


def describe_case(case: Case) -> str:
    """The line that earns everything for a log."""
    said = []
    for one in case.damage:
        tests = ", ".join(dict.fromkeys(part.test for part in one.where))
        first = one.where[0]
        begin = case.log.runs[first.run or 0].time[0]
        times = [] if one.whole else [f"{first.start - begin:.2f} to {first.end - begin:.2f}"]
        said.append(", ".join([one.fault, tests, *times, list_actions(one.fault)[0]]))
    return " + ".join(said) or CLEAN


def read_claims(raw: object) -> tuple[Claim, ...]:
    """Read one line of the answers.

    Raises:
        WrongAnswer: there is nothing, no fault in it, or a word that nobody knows.
    """
    if raw is None or raw in ("", []):
        raise WrongAnswer(
            "nothing yet", hint=(f'Write "{CLEAN}", or the fault, the place, and what to do.')
        )
    parts = raw if isinstance(raw, list) else [raw]
    if not all(isinstance(part, str) for part in parts):
        raise WrongAnswer(
            f"{raw}, which is not text in quotes", hint=f"Write words in quotes. {_list_words()}"
        )
    said = [part for whole in parts for part in re.split(r"[+;&\n]|\band\b", whole)]
    claims = tuple(_parse_claim(part) for part in said if part.strip())
    if not claims or len(claims) > MANY:
        raise WrongAnswer(f"{len(claims)} faults", hint=f"Name those you can see. {_list_words()}")
    if len(claims) > 1 and any(one.fault == CLEAN for one in claims):
        raise WrongAnswer(f'"{CLEAN}" and a fault', hint="It cannot be both. Write only one.")
    return claims


def _list_words() -> str:
    return f"Choose one of: {', '.join((CLEAN, *FAULTS))}."


def _parse_claim(text: str) -> Claim:
    left = re.sub(r"[\s_]+", " ", text.lower().replace("backward", "reverse"))
    faults, left = _extract_words(left, (CLEAN, *FAULTS))
    actions, left = _extract_words(left, tuple(ACTIONS))
    places, left = _extract_words(left, PLACES)
    times = [float(number.replace(",", ".")) for number in NUMBER.findall(left)]
    unknown = [word for word in re.findall(r"[^\W\d_]+", left) if word not in FILLERS]
    shown = f'"{shorten(text)}"'
    if re.search(r"\d\s*m(illi)?s", left):
        raise WrongAnswer(shown, hint="Write the times in seconds: 1.20 to 1.66.")
    if unknown:
        hint = (
            f"What is wrong? {_list_words()} Where? One of: {', '.join(PLACES)}. What to do? "
            f"One of: {', '.join(ACTIONS)}."
        )
        raise WrongAnswer(f'{shown}, in which "{shorten(unknown[0])}" is not known', hint=hint)
    if len(faults) != 1:
        raise WrongAnswer(
            f"{shown}, with {len(faults) or 'no'} faults in it", hint=_format_examples(faults)
        )
    if len(actions) > 1:
        raise WrongAnswer(f"{shown}, with {len(actions)} actions", hint="Write only one.")
    if len(times) not in (0, 2):
        hint = "Write two times, the start and the end: 1.20 to 1.66."
        count = "one time" if len(times) == 1 else f"{len(times)} times"
        raise WrongAnswer(f"{shown}, with {count} in it", hint=hint)
    span = (min(times), max(times)) if times else None
    return Claim(faults[0], tuple(places), span, "".join(actions))


def _format_examples(faults: Sequence[str]) -> str:
    return "Put a + between two faults, each with its own place." if faults else _list_words()


def _extract_words(text: str, words: Sequence[str]) -> tuple[list[str], str]:
    """The known words found in a text, and the text without them."""
    known = {word: word for word in words}
    known |= {other: word for other, word in SPELLED.items() if word in words}
    found = []
    for other, word in known.items():
        text, count = re.subn(rf"\b{other.replace('-', '[ -]?')}\b", " ", text)
        found += [word] * count
    return list(dict.fromkeys(found)), text
