"""A running page of `sysid open`, and logs to drop on it."""

import json
import threading
import urllib.error
import urllib.request
from contextlib import contextmanager

import numpy as np
from old_tools import RUNS

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli.open.server import PageServer
from sim.cli.open.session import Session
from sim.inspect.contaminate import contaminate
from sim.io import write

BROKEN = {
    "empty.wpilog": b"",
    "short.wpilog": b"WPILOG",
    "garbage.wpilog": b"WPILOG\x00\x01" + bytes(range(256)) * 9,
    "noise.wpilog": np.random.default_rng(1).bytes(5000),
    "text.csv": b"this is,not a log\n1,2\n",
    "nan.csv": b"test,time_s,voltage,position,velocity\ndynamic-forward,0,nan,0,0\n",
    "one.csv": b"test,time_s,voltage,position,velocity\ndynamic-forward,0,1,0,0\n",
    "list.json": b"[1, 2, 3]",
    "cut.json": b'{"sysid": true, "slow-forward": [[1',
    "picture.png": b"\x89PNG\r\n\x1a\n0000",
}


@contextmanager
def served(folder, *files, view=None):
    """A server of the page with these files open."""
    server = PageServer(Session(folder, files, view=view))
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02})
    thread.start()
    try:
        yield server
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


def ask(server, path, *, body=None, method=None, headers=(), word=None):
    """The status and the content of an answer."""
    address = f"http://{server.hosts[0]}/{server.word if word is None else word}/{path}"
    asked = urllib.request.Request(address, data=body, method=method, headers=dict(headers))
    try:
        with urllib.request.urlopen(asked, timeout=60) as answer:  # noqa: S310 - ours
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()


def ask_json(server, path, **how):
    """The same, of an answer in JSON."""
    status, content = ask(server, path, **how)
    return status, json.loads(content)


def drive_log(seed=1, mechanism="drivetrain", **routine):
    """An ordinary log."""
    return simulate(MECHANISMS[mechanism], Routine(**routine), rng=np.random.default_rng(seed))


def slipped_log():
    """A log with a slip of the encoder, between 5.5 and 6 s."""
    rng = np.random.default_rng(4)
    return contaminate(
        drive_log(4), "encoder-slip", severity=1.0, test="quasistatic-forward", at=4.5, rng=rng
    ).log


def write_old_json(log, path):
    """A log as SysId wrote it until 2023."""
    keys = {test: key for key, test in RUNS.items()}
    rows = {
        keys[run.test]: np.column_stack(
            [run.time, run.voltage, run.position, run.velocity]
        ).tolist()
        for run in reversed(log.runs)
    }
    words = {"test": "Simple", "units": "Meters", "unitsPerRotation": 1.0, "sysid": True}
    path.write_text(json.dumps(rows | words), encoding="utf-8")
    return path


def write_log(log, path):
    """A log in the format of the path's suffix; the path."""
    write(log, path)
    return path
