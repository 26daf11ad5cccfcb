"""Wrong answers to exercise 7, and what a learner must be told about each.

Most change the first log, which has one fault in a part of one test.
"""

import re
from collections.abc import Callable

from grader.exercise.mistake import Mistake, make_wrong_answer

ANSWERS = "answers.toml"
FIRST = re.compile(
    r'^log01 = "(?P<fault>[\w-]+), (?P<kind>\w+)-(?P<way>\w+), (?P<begin>[\d.]+) to '
    r'(?P<end>[\d.]+), (?P<action>[\w-]+)"$',
    re.MULTILINE,
)
TAKEN_FOR = {
    "encoder-slip": "wheel-slip",
    "brownout": "hard-stop",
    "hard-stop": "brownout",
    "loop-overrun": "stale-samples",
}
DIP = 1.0  # [s] more than the cut: about as long as the speed takes to come back
OTHER_WAY = {"forward": "reverse", "reverse": "forward"}


def first(line: str, **changes: Callable[[str], str]) -> Callable[[str], str]:
    """Make another line of the first, out of its parts: some of them changed."""

    def edit_text(text: str) -> str:
        found = FIRST.search(text)
        if found is None:
            raise ValueError("the first line of the solution is not what it was")
        parts = found.groupdict()
        parts |= {name: change(parts[name]) for name, change in changes.items()}
        return make_wrong_answer("log01", f'"{line.format(**parts)}"')(text)

    return edit_text


def name_whole_dip(text: str) -> str:
    """Let a brownout end where the speed is back, not where the motor is on again."""
    alone = re.compile(r'^(log\d+ = "brownout, \S+ [\d.]+ to )([\d.]+)(, rerun")$', re.MULTILINE)
    wrong = alone.sub(lambda one: f"{one[1]}{float(one[2]) + DIP:.2f}{one[3]}", text)
    if wrong == text:
        raise ValueError("the solution has no brownout alone")
    return wrong


def convert_to_milliseconds(seconds: str) -> str:
    """A time in milliseconds."""
    return f"{1000 * float(seconds):.0f}"


WHOLE = "{fault}, {kind}-{way}, {begin} to {end}, {action}"

MISTAKES = (
    Mistake("all sound, as R² is fine", ANSWERS, make_wrong_answer("log01", '"clean"'), "log01",
        "Something is wrong here. The R² may", "M-R2"),
    Mistake("nothing", ANSWERS, make_wrong_answer("log01", '""'), "log01", "nothing yet"),
    Mistake("what it is taken for", ANSWERS, first(WHOLE, fault=TAKEN_FOR.__getitem__), "log01",
        "would look like this"),
    Mistake("the other way", ANSWERS, first(WHOLE, way=OTHER_WAY.__getitem__), "log01",
        "the place"),
    Mistake("the whole dip of a brownout", ANSWERS, name_whole_dip, "log*",
        "from the moment when the velocity begins to fall until it begins to rise"),
    Mistake("milliseconds", ANSWERS, first(WHOLE, begin=convert_to_milliseconds,
        end=convert_to_milliseconds), "log01", "Are your times in milliseconds?"),
    Mistake("no place", ANSWERS, first("{fault}, {action}"), "log01", "Where is it?"),
    Mistake("no action", ANSWERS, first("{fault}, {kind}-{way}, {begin} to {end}"), "log01",
        "What should you do? Add one of"),
    Mistake("a filter for everything", ANSWERS, first(WHOLE, action=lambda _: "filter"), "log01",
        "filter helps if single samples are noisy"),
    Mistake("a fault too many", ANSWERS, first(f"{WHOLE} + sign-flip whole fix-config"), "log01",
        "Can you find that in a plot? Something"),
    Mistake("a word that is none", ANSWERS, make_wrong_answer("log01", '"sensor broke, rerun"'),
        "log01", "Choose one of: clean, encoder-slip"),
)  # fmt: skip
