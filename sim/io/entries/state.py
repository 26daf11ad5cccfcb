"""The entry of a WPILOG file that says which test runs, and the stretches of time it names.

sysid-test-state-<mechanism> = quasistatic-forward | … | none
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, MissingSignal
from sim.core.log import TESTS
from sim.io.entries.entry import STRING, Entry
from sim.io.entries.names import find_requested_entry, find_test_name, quote_names, split_name
from sim.io.format import ReadOptions

WORD = "sysid-test-state"
IDLE = ("none", "")  # what stands there while no test runs
FILLERS = ("state", "k", "sysid", "sys", "id", "test", "routine")  # words beside a test's own
FOREVER = 2**62  # [µs] the end of a run that the file does not see end


@dataclass(frozen=True, eq=False)
class StateEntry:
    """The entry that names the tests of one mechanism.

    Args:
        mechanism: its name; empty if the entry is not named as SysId's are.
        path: what its logger puts before a name; empty, ``NT:/``, …
        entry: the entry itself.
        intervals: when tests ran, where no entry says it but the name of the file.
    """

    mechanism: str
    path: str
    entry: Entry
    intervals: "tuple[RunInterval, ...]" = ()


@dataclass(frozen=True)
class RunInterval:
    """The time of one run: begin <= t < end.

    Args:
        test: one of ``sim.core.log.TESTS``.
        begin, end: [µs].
    """

    test: str
    begin: int
    end: int


def find_state_entries(
    entries: Sequence[Entry], *, options: ReadOptions, where: str
) -> tuple[StateEntry, ...]:
    """The entries that name tests, one for each mechanism.

    Raises:
        MissingSignal: there is none; the advice names an entry that might be meant.
        BadRequest: one mechanism has several.
    """
    if "state" in options.entries:
        entry = find_requested_entry(
            options.entries["state"], role="state", kinds=(STRING,), entries=entries, where=where
        )
        if not names_tests(entry):
            raise _no_test([entry], where=where)
        return (_of_sysid(entry) or StateEntry("", "", entry),)
    texts = [entry for entry in entries if entry.type == STRING]
    named = [state for state in map(_of_sysid, texts) if state is not None]
    telling = [state for state in named if names_tests(state.entry)]
    if named and not telling:
        raise _no_test([state.entry for state in named], where=where)
    if not named:
        others = filter(names_tests, texts)
        telling = [StateEntry(_mechanism_in(entry.name), "", entry) for entry in others]
    if not telling:
        raise _no_state(where=where)
    mechanisms = dict.fromkeys(state.mechanism for state in telling)
    return tuple(_only(telling, mechanism, where=where) for mechanism in mechanisms)


def _of_sysid(entry: Entry) -> StateEntry | None:
    """An entry that is named as SysId names its own; None if it is not."""
    name = split_name(entry.name, WORD)
    return None if name is None else StateEntry(name.rest, name.path, entry)


def find_run_intervals(
    state: StateEntry, *, where: str
) -> tuple[tuple[RunInterval, ...], tuple[Doubt, ...]]:
    """The time of each run: from the first record of a test to the first that names another.

    Returns:
        The stretches in order, and a doubt if some states are not the name of a test.
    """
    if state.intervals:
        return state.intervals, ()
    words = _states(state.entry)
    times = state.entry.time.tolist()
    fresh = [i for i, word in enumerate(words) if i == 0 or word != words[i - 1]]
    ends = [times[i] for i in fresh[1:]] + [FOREVER]
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
    """Whether an entry names a test at all."""
    return any(state in TESTS for state in set(_states(entry)))


def _states(entry: Entry) -> list[str]:
    """The values of an entry, those that name a test in any spelling as the name of the test."""
    texts = entry.texts()
    plain = {text: text.strip().lower() for text in set(texts)}
    names = {
        text: said if said in TESTS else find_test_name(text, fillers=FILLERS) or said
        for text, said in plain.items()
    }
    return [names[text] for text in texts]


def _only(telling: Sequence[StateEntry], mechanism: str, *, where: str) -> StateEntry:
    """The one state entry of a mechanism: a copy with a path before its name stands back."""
    own = [state for state in telling if state.mechanism == mechanism]
    plain = [state for state in own if not state.path]
    if len(own) == 1 or plain:
        return (plain or own)[0]
    raise BadRequest(
        f"several entries name the tests of {mechanism!r}: "
        f"{quote_names([state.entry.name for state in own])}",
        where=where,
        advice="Choose one with --state ENTRY.",
    )


def _no_test(entries: Sequence[Entry], *, where: str) -> MissingSignal:
    said = list(dict.fromkeys(text for entry in entries for text in entry.texts()))
    words = f"says only {quote_names(said)}" if said else "holds no values"
    return MissingSignal(
        f"no test was recorded: {quote_names([entry.name for entry in entries])} {words}",
        where=where,
        advice="Run the four tests with the robot enabled, and use the log of these tests.",
    )


def _mechanism_in(name: str) -> str:
    """What is left of the name of another logger's state entry: ``Elevator-SysID-State``."""
    last = re.split(r"[/:]", name)[-1]
    parts = re.split(r"[-_ ]+", re.sub(r"(?i)sys[-_ ]?id|routine|state|test", " ", last))
    return "-".join(filter(None, parts))


def _no_state(*, where: str) -> MissingSignal:
    return MissingSignal(
        f"no entry says which test runs: expected '{WORD}-<mechanism>' (string)",
        where=where,
        advice="SysIdRoutine writes this entry while a test runs. Run the tests with the robot "
        "enabled, and use the log of these tests. If the file contains only one test, put the "
        "name of the test into the file name: dynamic-forward.wpilog. Or name another logger's "
        "entries with --state ENTRY --voltage ENTRY --position ENTRY --velocity ENTRY.",
    )
