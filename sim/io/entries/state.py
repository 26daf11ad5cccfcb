"""The entry that names the running test, and the intervals of its tests.

sysid-test-state-<mechanism> = quasistatic-forward | … | none
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, MissingSignal
from sim.core.log import TESTS
from sim.io.entries.entry import STRING, Entry
from sim.io.entries.names import find_requested_entry, find_test_name, quote_names, split_name
from sim.io.format import ReadOptions

WORD = "sysid-test-state"
IDLE = ("none", "")  # its values while no test runs
# Words allowed in addition to a test's name.
FILLERS = ("state", "k", "sysid", "sys", "id", "test", "routine")
NO_END = 2**62  # [µs] end of a run whose end is not in the file


@dataclass(frozen=True, eq=False)
class StateEntry:
    """The entry that names the tests of one mechanism.

    Args:
        mechanism: name of the mechanism; empty if the entry does not have SysId's name.
        path: path that the logger puts before a name; empty, ``NT:/``, …
        entry: the entry itself.
        intervals: intervals of tests, if only the name of the file names the test.
    """

    mechanism: str
    path: str
    entry: Entry
    intervals: "tuple[RunInterval, ...]" = ()


@dataclass(frozen=True)
class RunInterval:
    """The interval of one run: begin <= t < end.

    Args:
        test: one of ``sim.core.log.TESTS``.
        begin: first time [µs].
        end: time after the last [µs].
    """

    test: str
    begin: int
    end: int


def find_state_entries(
    entries: Sequence[Entry], *, options: ReadOptions, where: str
) -> tuple[StateEntry, ...]:
    """The entries that name tests, one for each mechanism.

    Raises:
        MissingSignal: there is no such entry, or it names no test.
        BadRequest: one mechanism has several such entries.
    """
    if "state" in options.entries:
        entry = find_requested_entry(
            options.entries["state"], role="state", kinds=(STRING,), entries=entries, where=where
        )
        if not names_tests(entry):
            raise _make_no_test_error([entry], where=where)
        return (_read_as_sysid_entry(entry) or StateEntry("", "", entry),)
    texts = [entry for entry in entries if entry.type == STRING]
    named = [state for state in map(_read_as_sysid_entry, texts) if state is not None]
    naming = [state for state in named if names_tests(state.entry)]
    if named and not naming:
        raise _make_no_test_error([state.entry for state in named], where=where)
    if not named:
        others = filter(names_tests, texts)
        naming = [StateEntry(_guess_mechanism(entry.name), "", entry) for entry in others]
    if not naming:
        raise _make_no_state_error(where=where)
    mechanisms = dict.fromkeys(state.mechanism for state in naming)
    return tuple(_choose_entry(naming, mechanism, where=where) for mechanism in mechanisms)


def _read_as_sysid_entry(entry: Entry) -> StateEntry | None:
    """The state entry, if the entry has SysId's name; else None."""
    name = split_name(entry.name, WORD)
    return None if name is None else StateEntry(name.rest, name.path, entry)


def find_run_intervals(
    state: StateEntry, *, where: str
) -> tuple[tuple[RunInterval, ...], tuple[Doubt, ...]]:
    """The interval of each run: from the first value that names a test to the next other value.

    Returns:
        The intervals in order, and a doubt if some values do not name a test.
    """
    if state.intervals:
        return state.intervals, ()
    words = _read_states(state.entry)
    times = state.entry.time.tolist()
    fresh = [i for i, word in enumerate(words) if i == 0 or word != words[i - 1]]
    ends = [times[i] for i in fresh[1:]] + [NO_END]
    found = tuple(
        RunInterval(words[i], times[i], end)
        for i, end in zip(fresh, ends, strict=True)
        if words[i] in TESTS
    )
    unknown = list(dict.fromkeys(words[i] for i in fresh if words[i] not in (*TESTS, *IDLE)))
    if not unknown:
        return found, ()
    doubt = Doubt(
        "unknown-test",
        f"{where}: {state.entry.name!r} also says {quote_names(unknown)}, which is the name of no "
        "test; those times were left out. Tests are named like quasistatic-forward.",
    )
    return found, (doubt,)


def names_tests(entry: Entry) -> bool:
    """Whether any value of an entry names a test."""
    return any(state in TESTS for state in set(_read_states(entry)))


def _read_states(entry: Entry) -> list[str]:
    """The values of an entry; a test in another spelling gets its own name."""
    texts = entry.texts()
    plain = {text: text.strip().lower() for text in set(texts)}
    names = {
        text: text_ if text_ in TESTS else find_test_name(text, fillers=FILLERS) or text_
        for text, text_ in plain.items()
    }
    return [names[text] for text in texts]


def _choose_entry(naming: Sequence[StateEntry], mechanism: str, *, where: str) -> StateEntry:
    """The state entry of a mechanism; one without a path has priority.

    Raises:
        BadRequest: there are several.
    """
    own = [state for state in naming if state.mechanism == mechanism]
    plain = [state for state in own if not state.path]
    if len(own) == 1 or plain:
        return (plain or own)[0]
    raise BadRequest(
        f"several entries name the tests of {mechanism!r}: "
        f"{quote_names([state.entry.name for state in own])}",
        where=where,
        advice=Action("option", "with --state ENTRY"),
    )


def _make_no_test_error(entries: Sequence[Entry], *, where: str) -> MissingSignal:
    text_ = list(dict.fromkeys(text for entry in entries for text in entry.texts()))
    words = f"says only {quote_names(text_)}" if text_ else "holds no values"
    return MissingSignal(
        f"no test was recorded: {quote_names([entry.name for entry in entries])} {words}",
        where=where,
        advice="Run the four tests with the robot enabled, and use the log of these tests.",
    )


def _guess_mechanism(name: str) -> str:
    """The mechanism in the name of a state entry: ``Elevator`` in ``Elevator-SysID-State``."""
    last = re.split(r"[/:]", name)[-1]
    parts = re.split(r"[-_ ]+", re.sub(r"(?i)sys[-_ ]?id|routine|state|test", " ", last))
    return "-".join(filter(None, parts))


def _make_no_state_error(*, where: str) -> MissingSignal:
    return MissingSignal(
        "no entry says which test runs",
        where=where,
        advice=Action(
            "name-entries",
            before=f"SysIdRoutine writes '{WORD}-<mechanism>' (string) while a test runs. Run the "
            "tests with the robot enabled, and use the log of these tests. If the file contains "
            "only one test, put the name of the test into the file name: dynamic-forward.wpilog.",
        ),
    )
