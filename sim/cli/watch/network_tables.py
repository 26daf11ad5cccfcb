"""Records the NetworkTables of a robot or a simulation in log files while they arrive.

The command follows these files, as it follows those of a robot: every value is recorded with the
robot's own time, counted from the beginning of the recording. So `sysid fit` reads the same
numbers from the same file later.

NetworkTables sends a value when it changes, so a constant voltage comes once. Logs that hold only
changes are read by that rule (``sim/io/entries/clock.py``): a value holds until the next one.
"""

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from sim.cli.watch.recordings import Recording
from sim.core.errors import BadRequest
from sim.core.vocabulary import TESTS
from sim.io.entries.entry import STRING
from sim.io.entries.names import find_test_name
from sim.io.entries.state import FILLERS
from sim.io.formats.wpilog.signals import SignalRecorder
from sim.support.extras import format_install_command
from sim.support.os_errors import refuse_os_errors

TYPES = {"double": "double", "float": "float", "int": "int64", "boolean": "boolean", STRING: STRING}
"""Type of a topic -> type of its log entry; arrays and structures hold no signal."""
PORT = 5810  # default port of NetworkTables 4
INTERRUPTED = "interrupted"  # replaces the name of a test whose end was not recorded
LARGEST_TEAM = 25599  # 10.255.99.2
"""The largest team number that fits into an address."""


class NetworkTablesSource:
    """Follows NetworkTables 4, and writes a recording for each connection.

    A lost connection, also by a restart of the robot program, ends a recording; the next connection
    begins a new one. A test that was running then does not count: its name is replaced by one that
    is no test, but its samples stay in the file.

    Args:
        address: ``localhost``, ``10.12.34.2``, either with ``:PORT``, or the number of a team.
        folder: where the recordings are written; created if it does not exist.
        state: the entry that names the tests; None finds it by name.

    Raises:
        BadRequest: pyntcore is not installed, or the folder or the address cannot be used.
    """

    def __init__(self, address: str, *, folder: Path, state: str | None = None) -> None:
        self._ntcore = _import_ntcore()
        self._server = _split_address(address)
        advice = "Choose another folder for --save."
        with refuse_os_errors("this folder cannot be made", folder, advice=advice):
            folder.mkdir(parents=True, exist_ok=True)
        self._address, self._folder, self._state = address, folder, state
        self._recordings: list[Recording] = []
        self._recorder: _TopicRecorder | None = None
        self._connected = False
        self._since = 0  # [µs] robot's clock when the connection began
        self._client = _Client(self._ntcore, *self._server)

    @property
    def status(self) -> str:
        """The status: waiting for a server, or following one."""
        if self._connected:
            return f"following NetworkTables of {self._address}"
        again = " again" if self._recordings else ""
        return f"waiting for NetworkTables of {self._address}{again}"

    def poll(self) -> Sequence[Recording]:
        """All recordings so far, with the values that have arrived since the last call."""
        flags, lost = self._ntcore.EventFlags, False
        for event in self._client.poller.readQueue():
            if event.is_(flags.kConnected):
                self._connected = True
            elif event.is_(flags.kDisconnected):
                self._connected, lost = False, True
                self._end_recording()
            elif isinstance(event.data, self._ntcore.TimeSyncEventData):
                self._store_start(event.data)
            elif isinstance(event.data, self._ntcore.ValueEventData):
                self._record_value(event.data.topic, event.data.value)
        if lost and not self._connected:
            # a client drops values older than its latest, and a robot's clock restarts at zero
            self._client.close()
            self._client = _Client(self._ntcore, *self._server)
        if self._recorder is not None:
            self._recorder.flush()
        return self._recordings

    def close(self) -> None:
        """Close the connection."""
        self._end_recording()
        self._client.close()

    def _store_start(self, sync: Any) -> None:  # noqa: ANN401 - ntcore ships no types
        """Store the robot's time at which the connection began."""
        if sync.valid and self._recorder is None:
            now = int(self._ntcore.Value.makeDouble(0.0).time())
            self._since = now + int(sync.serverTimeOffset)

    def _record_value(self, topic: Any, value: Any) -> None:  # noqa: ANN401 - ntcore ships no types
        kind = TYPES.get(topic.getTypeString())
        if kind is None:
            return
        name, time = topic.getName(), int(value.server_time())
        if self._recorder is None:
            path = _find_unused_path(self._folder)
            self._recorder = _TopicRecorder(path, since=self._since or time)
            self._recordings.append(Recording(path, state=self._state))
        self._recorder.record(name, kind, time, value.value(), topic.getProperties())

    def _end_recording(self) -> None:
        """Close the file; a test that is running does not count."""
        if self._recorder is not None:
            self._recorder.close()
            self._recorder = None


class _Client:
    """A client of NetworkTables that subscribes to every value of every topic.

    Args:
        ntcore: the Python module of NetworkTables.
        host: the server, or a team number.
        port: port of the server.
    """

    def __init__(self, ntcore: Any, host: str, port: int) -> None:  # noqa: ANN401 - it ships no types
        self._destroy = ntcore.NetworkTableInstance.destroy
        self._instance = ntcore.NetworkTableInstance.create()
        self._subscriber = ntcore.MultiSubscriber(
            self._instance, [""], ntcore.PubSubOptions(sendAll=True, keepDuplicates=True)
        )
        self.poller = ntcore.NetworkTableListenerPoller(self._instance)
        self.poller.addListener(self._subscriber, ntcore.EventFlags.kValueAll)
        self.poller.addConnectionListener(True)  # noqa: FBT003 - RobotPy takes it by position
        self.poller.addTimeSyncListener(True)  # noqa: FBT003 - the same
        self._instance.startClient4("sysid-watch")
        if host.isdecimal():
            self._instance.setServerTeam(int(host), port)
        else:
            self._instance.setServer(host, port)

    def close(self) -> None:
        """Close the connection."""
        self._instance.stopClient()
        self.poller.close()
        self._subscriber.close()
        self._destroy(self._instance)


class _TopicRecorder:
    """Writes the values of one connection, in the order of each topic's own times.

    Args:
        path: the file.
        since: start of the recording by the robot's clock [µs]; older values get this time.
    """

    def __init__(self, path: Path, *, since: int) -> None:
        self._file = SignalRecorder(path)
        self._since = since
        self._tests: dict[str, tuple[int, str]] = {}  # topic -> (start [µs], test that it names)

    def record(self, name: str, kind: str, time: int, value: float | str, properties: Any) -> None:  # noqa: ANN401 - ntcore ships no types
        """Write a value, unless it names a test that began before the recording."""
        if isinstance(value, str):
            test = find_test_name(value, fillers=FILLERS) or value
            if test in TESTS and time < self._since:
                return
            if self._tests.get(name, (0, ""))[1] != test:
                self._tests[name] = (self._count_microseconds(time), test)
        metadata = json.dumps({"properties": properties, "source": "NT"})  # as DataLogManager
        self._file.record(
            _make_entry_name(name), kind, self._count_microseconds(time), value, metadata=metadata
        )

    def _count_microseconds(self, time: int) -> int:
        """The time since the recording began [µs]."""
        return max(time - self._since, 0)

    def flush(self) -> None:
        """Write buffered values to the file, so that it can be read."""
        self._file.flush()

    def close(self) -> None:
        """Close the file, and replace the name of a test that was still running."""
        for name, (since, test) in self._tests.items():
            if test in TESTS:
                self._file.record(_make_entry_name(name), STRING, since, INTERRUPTED)
        self._file.close()


def _make_entry_name(topic: str) -> str:
    """The name that WPILib's DataLogManager gives to a topic in a log."""
    return f"NT:{topic}"


def _import_ntcore() -> Any:  # noqa: ANN401 - ntcore ships no types
    """The Python module of NetworkTables.

    Raises:
        BadRequest: pyntcore is not installed.
    """
    try:
        import ntcore  # noqa: PLC0415 - an extra
    except ImportError:
        raise BadRequest(
            "following NetworkTables needs pyntcore",
            advice=f"Install it with: {format_install_command('live')}. A .wpilog file that grows "
            "can be followed without it.",
        ) from None
    return ntcore


def _split_address(address: str) -> tuple[str, int]:
    """The host or team number, and the port, of an address.

    Raises:
        BadRequest: the text is not an address.
    """
    host, _, port = address.partition(":")
    if not re.fullmatch(r"[\w.-]+", host) or (port and not port.isdecimal()):
        raise BadRequest(
            f"{address!r} is not an address",
            advice="Give localhost, an address like 10.12.34.2, or the number of your team.",
        )
    if host.isdecimal() and not 0 < int(host) <= LARGEST_TEAM:
        raise BadRequest(
            f"there is no team {host}", advice="Give localhost, or the number of your team."
        )
    return host, int(port or PORT)


def _find_unused_path(folder: Path) -> Path:
    """The first path ``networktables-1.wpilog``, ``networktables-2.wpilog``, … without a file."""
    number = 1
    while (path := folder / f"networktables-{number}.wpilog").exists():
        number += 1
    return path
