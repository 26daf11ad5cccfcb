"""A WPILOG file read in windows gives what the whole file gives, for entries that are wanted."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from wpilog_file import HEADER, finish, metadata, record, start

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.io.formats.wpilog import contents
from sim.io.formats.wpilog.contents import read_contents

TMP = settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None, max_examples=200
)
KINDS = ("double", "int64", "boolean", "string", "raw")
IDS = st.integers(1, 4)
RECORD = st.one_of(
    st.builds(lambda n, kind: (0, start(n, f"entry {n % 3}", kind)), IDS, st.sampled_from(KINDS)),
    st.builds(lambda n: (0, finish(n)), IDS),
    st.builds(lambda n: (0, metadata(n, "later")), IDS),
    *[
        st.builds(lambda n, c=content: (n, c), IDS)
        for content in (b"\0" * 8, b"\1" * 8, b"\1", b"text " * 9)
    ],
    st.builds(lambda n, size: (n, b"x" * size), IDS, st.integers(0, 400)),
)


def make_comparable(values):
    """The values in a form in which a number that is not one equals itself."""
    return values.tolist() if values.dtype.kind in "OU" else values.tobytes()


def shape(found, wanted):
    """Entries that are wanted, and what is odd about a file."""
    rows = [
        (
            entry.name, entry.type, entry.metadata, entry.time.tolist(),
            entry.values.dtype, make_comparable(entry.values),
        )
        for entry in found.list_entries() if wanted(entry)
    ]  # fmt: skip
    return rows, found.damage, found.orphans


@TMP
@given(
    several=st.lists(RECORD, max_size=60),
    cut=st.integers(0, 60),
    tail=st.sampled_from((b"", b"\0" * 40, b"\xff" * 30)),
    name=st.sampled_from(("", "entry 1")),
)
def test_windows_change_nothing(tmp_path, several, cut, tail, name):
    path = tmp_path / "log.wpilog"
    body = b"".join(record(n, 7 * i, content) for i, (n, content) in enumerate(several))
    path.write_bytes(HEADER + body[: max(len(body) - cut, 0)] + tail)

    def wanted(entry):
        return not name or entry.name == name

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(contents, "WINDOW", 24)
        parts = read_contents(path, wanted)

    assert shape(parts, wanted) == shape(read_contents(path), wanted)


def test_a_log_of_other_things_takes_no_more_memory_than_a_window(tmp_path):
    log = simulate(
        MECHANISMS["drivetrain"], Routine(ramp=0.5, step=4.0), rng=np.random.default_rng(1)
    )
    path = tmp_path / "log.wpilog"
    sim.write(log, path)
    content = path.read_bytes()
    others = b"".join(
        record(0, 1, start(number, f"NT:/x/{number}", "double")) for number in range(500, 600)
    )
    block = b"".join(record(number, 1_000_000, b"\0" * 8) for number in range(500, 600))
    first = 12 + int.from_bytes(content[8:12], "little")
    path.write_bytes(content[:first] + others + block * 20_000 + content[first:])
    sim.read(path, units="meters")

    tracemalloc.start()
    read = sim.read(path, units="meters")
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert path.stat().st_size > 30_000_000
    assert most < path.stat().st_size
    assert [len(run) for run in read.runs] == [len(run) for run in log.runs]
