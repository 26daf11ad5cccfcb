"""A Jupyter server for each student, in a process of its own, over a home of its own."""

import contextlib
import os
import secrets
import socket
import subprocess
import sys
import sysconfig
import time
from dataclasses import dataclass
from pathlib import Path

from grader.start import QUIET, as_root
from sim.errors import BadRequest

PATIENCE = 60.0  # [s] until a server has to answer; a small laptop takes ten
IDLE = 3600  # [s] without a word until a server ends: memory for those who are there
PAUSE = 0.1  # [s] between two looks


@dataclass(frozen=True)
class Room:
    """A student's server.

    Args:
        student: whose.
        port: where it listens.
        token: what its address needs.
        process: that it is.
    """

    student: str
    port: int
    token: str
    process: "subprocess.Popen[bytes]"

    def alive(self) -> bool:
        """Whether it still runs."""
        return self.process.poll() is None


class Rooms:
    """All servers that run.

    Args:
        host: the address they listen on.
    """

    def __init__(self, host: str) -> None:
        self.host = host
        self._rooms: dict[str, Room] = {}

    def open(self, student: str, course: Path) -> Room:
        """The student's server; started if it does not run.

        Raises:
            BadRequest: it does not start.
        """
        there = self._rooms.get(student)
        if there and there.alive():
            return there
        self._rooms[student] = room = _start(student, course, host=self.host)
        return room

    def close(self) -> None:
        """End them all."""
        for room in self._rooms.values():
            room.process.terminate()
        for room in self._rooms.values():
            with contextlib.suppress(subprocess.TimeoutExpired):
                room.process.wait(timeout=10)
                continue
            room.process.kill()

    @property
    def running(self) -> int:
        """How many run."""
        return sum(room.alive() for room in self._rooms.values())


def _start(student: str, course: Path, *, host: str) -> Room:
    port, token = _free_port(host), secrets.token_hex(16)
    command = [
        sys.executable, "-m", "jupyterlab", *QUIET, *as_root(),
        "--no-browser", f"--ip={host}", f"--port={port}", "--ServerApp.port_retries=0",
        f"--IdentityProvider.token={token}", f"--ServerApp.root_dir={course}",
        f"--ServerApp.shutdown_no_activity_timeout={IDLE}",
        f"--MappingKernelManager.cull_idle_timeout={IDLE}",
    ]  # fmt: skip
    log = (course.parent / "server.log").open("wb")
    with log:
        process = subprocess.Popen(  # noqa: S603 - our own arguments, no shell
            command, cwd=course, env=_environment(course), stdout=log, stderr=log,
            start_new_session=True,
        )  # fmt: skip
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline and process.poll() is None:
        with contextlib.suppress(OSError), socket.create_connection((_near(host), port), 1.0):
            return Room(student, port, token, process)
        time.sleep(PAUSE)
    process.kill()
    raise BadRequest(
        "JupyterLab did not start",
        where=str(course.parent / "server.log"),
        advice="Read what it says there; is there memory left?",
    )


def _free_port(host: str) -> int:
    with socket.socket() as one:
        one.bind((host, 0))
        return int(one.getsockname()[1])


def _near(host: str) -> str:
    """Where this machine reaches what listens on all its addresses."""
    return "127.0.0.1" if host in {"0.0.0.0", "::", ""} else host  # noqa: S104 - compared, not bound


def _environment(course: Path) -> dict[str, str]:
    """Everything Jupyter writes goes into the student's home; their own copy is what runs."""
    own = course.parent / "jupyter"
    scripts = sysconfig.get_path("scripts")
    places = {
        "JUPYTER_CONFIG_DIR": "config", "JUPYTER_DATA_DIR": "data",
        "JUPYTER_RUNTIME_DIR": "runtime", "JUPYTERLAB_SETTINGS_DIR": "settings",
        "JUPYTERLAB_WORKSPACES_DIR": "workspaces", "IPYTHONDIR": "ipython",
    }  # fmt: skip
    return {
        **{name: value for name, value in os.environ.items() if name != "SYSID_SECRET"},
        **{name: str(own / folder) for name, folder in places.items()},
        "PYTHONPATH": str(course),
        "PATH": os.pathsep.join(part for part in (scripts, os.environ.get("PATH", "")) if part),
    }
