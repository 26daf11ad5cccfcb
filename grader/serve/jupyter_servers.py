"""A Jupyter server for each student, in a process of its own, over a home of its own."""

import contextlib
import http.client
import os
import secrets
import shutil
import socket
import subprocess
import sys
import sysconfig
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from grader.serve.student_folders import assign_account
from grader.start import QUIET, choose_root_option
from sim.bench.dataset.secret import VARIABLE
from sim.core.errors import BadRequest
from sim.support.work.cache import CACHE

PATIENCE = 60.0  # [s] until a server has to answer; a small laptop takes ten
IDLE = 3600  # [s] without a word until a server ends: memory for those who are there
PAUSE = 0.1  # [s] between two looks
ONE_ANSWER = 5.0  # [s] for one answer, before it is asked again
EVERY_ADDRESS = "0.0.0.0"  # noqa: S104 - compared with, not listened on here
KEPT = {"PATH", "LANG", "LANGUAGE", "TZ", "LD_LIBRARY_PATH", "VIRTUAL_ENV"}  # of the operator's


@dataclass(frozen=True)
class JupyterServer:
    """A student's server.

    Args:
        student: whose.
        port: where it listens.
        token: what its address needs.
        process: that it is.
        runtime: the folder of its sockets and connection files.
    """

    student: str
    port: int
    token: str
    process: "subprocess.Popen[bytes]"
    runtime: Path

    def is_alive(self) -> bool:
        """Whether the server still runs."""
        return self.process.poll() is None


class JupyterServers:
    """All servers that run.

    Args:
        host: the address they listen on.
        separate: each under a user id of its own; needs root.
    """

    def __init__(self, host: str, *, separate: bool = False) -> None:
        self.host = host
        self.separate = separate
        self._servers: dict[str, JupyterServer] = {}
        self._closed = False

    def open(self, student: str, course: Path) -> JupyterServer:
        """The student's server; started if it does not run.

        Raises:
            BadRequest: it does not start.
        """
        if there := self.find(student):
            return there
        if ended := self._servers.pop(student, None):
            shutil.rmtree(ended.runtime, ignore_errors=True)
        course = course.absolute()  # a link that the student made is not followed
        account = assign_account(course.parent) if self.separate else None
        self._servers[student] = server = _start_server(
            student, course, host=self.host, account=account
        )
        if self._closed:  # ended while this one started
            server.process.terminate()
        return server

    def find(self, student: str) -> JupyterServer | None:
        """The student's server if it runs."""
        there = self._servers.get(student)
        return there if there and there.is_alive() else None

    def close(self) -> None:
        """End all servers, and those that are still starting once they have started."""
        self._closed = True
        for server in tuple(self._servers.values()):
            server.process.terminate()
        for server in tuple(self._servers.values()):
            with contextlib.suppress(subprocess.TimeoutExpired):
                server.process.wait(timeout=10)
            if server.is_alive():
                server.process.kill()
            shutil.rmtree(server.runtime, ignore_errors=True)


def _start_server(student: str, course: Path, *, host: str, account: int | None) -> JupyterServer:
    port, token = _find_free_port(host), secrets.token_hex(16)
    command = [
        sys.executable, "-m", "jupyterlab", *QUIET, *choose_root_option(),
        "--no-browser", f"--ip={host}", f"--port={port}", "--ServerApp.port_retries=0",
        f"--ServerApp.root_dir={course}",
        f"--ServerApp.shutdown_no_activity_timeout={IDLE}",
        f"--MappingKernelManager.cull_idle_timeout={IDLE}",
    ]  # fmt: skip
    if account is not None:  # a port of this machine is open to every user of it, a socket is not
        command.append("--KernelManager.transport=ipc")
    runtime = _make_runtime_folder(account)
    environment = {
        **make_server_environment(course, runtime, own=account is not None),
        "JUPYTER_TOKEN": token,
    }
    try:
        process = _run_server(command, course.parent, environment, account)
    except OSError as error:
        raise BadRequest(
            f"JupyterLab cannot be started: {error.strerror}",
            where=str(course.parent),
            advice="Is there memory and room on the disk?",
        ) from None
    deadline = time.monotonic() + PATIENCE
    listening = runtime / f"jpserver-{process.pid}.json"  # written once the port is its own
    while time.monotonic() < deadline and process.poll() is None:
        if listening.exists() and _is_answering(host, port):
            return JupyterServer(student, port, token, process, runtime)
        time.sleep(PAUSE)
    process.kill()
    shutil.rmtree(runtime, ignore_errors=True)
    raise BadRequest(
        "JupyterLab did not start",
        where=str(course.parent / "server.log"),
        advice="Read what it says there; is there memory left?",
    )


def _is_answering(host: str, port: int) -> bool:
    """Whether the server answers a request: its port is open some seconds before it does."""
    connection = http.client.HTTPConnection(
        "127.0.0.1" if host == EVERY_ADDRESS else host, port, timeout=ONE_ANSWER
    )
    try:
        connection.request("GET", "/api")  # needs no token
        connection.getresponse().read()
    except (OSError, http.client.HTTPException):
        return False
    else:
        return True
    finally:
        connection.close()


def _make_runtime_folder(account: int | None) -> Path:
    """A folder that nobody but the student may enter.

    It does not lie in the home, because a socket's path may not be longer than some 100 signs.
    """
    folder = Path(tempfile.mkdtemp(prefix="grade-"))
    if account is not None:
        os.chown(folder, account, account)
    return folder


def _run_server(
    command: list[str], place: Path, environment: dict[str, str], account: int | None
) -> "subprocess.Popen[bytes]":
    """Start it in the home, whose name nobody but the operator can change."""
    path = place / "server.log"
    path.unlink(missing_ok=True)  # made anew: the student may have put a link there
    with path.open("xb") as log:
        if account is None:
            return subprocess.Popen(  # noqa: S603 - our own arguments, no shell
                command, cwd=place, env=environment, stdin=subprocess.DEVNULL, stdout=log,
                stderr=log, start_new_session=True,
            )  # fmt: skip
        return subprocess.Popen(  # noqa: S603 - our own arguments, no shell
            command, cwd=place, env=environment, stdin=subprocess.DEVNULL, stdout=log,
            stderr=log, start_new_session=True, user=account, group=account, extra_groups=[],
            umask=0o077,
        )  # fmt: skip


def _find_free_port(host: str) -> int:
    with socket.socket() as one:
        one.bind((host, 0))
        return int(one.getsockname()[1])


def make_server_environment(course: Path, runtime: Path, *, own: bool) -> dict[str, str]:
    """Environment variables of a student's server: its files and caches go into their home.

    Args:
        course: the student's copy of the course, which is what runs.
        runtime: the folder for sockets and connection files.
        own: whether the server has a user id of its own, and so a HOME of its own and nothing of
            the operator's environment but the language, the time zone and where programs lie.
    """
    place = course.parent
    scripts = sysconfig.get_path("scripts")
    places = {
        "JUPYTER_CONFIG_DIR": "config", "JUPYTER_DATA_DIR": "data",
        "JUPYTERLAB_SETTINGS_DIR": "settings", "JUPYTERLAB_WORKSPACES_DIR": "workspaces",
        "IPYTHONDIR": "ipython",
        "XDG_CACHE_HOME": "cache", "NUMBA_CACHE_DIR": "cache/numba",
        "MPLCONFIGDIR": "cache/matplotlib", CACHE: "cache/sysid-course",
        "PYTHONPYCACHEPREFIX": "cache/python",
    }  # fmt: skip
    mine = {"HOME": str(place), "USER": "student", "LOGNAME": "student"} if own else {}
    return {
        **{
            name: value
            for name, value in os.environ.items()
            if (name in KEPT or name.startswith("LC_") if own else name != VARIABLE)
        },
        **{name: str(place / "jupyter" / folder) for name, folder in places.items()},
        **mine,
        "JUPYTER_RUNTIME_DIR": str(runtime),
        "PYTHONPATH": str(course),
        "PATH": os.pathsep.join(part for part in (scripts, os.environ.get("PATH", "")) if part),
    }
