"""The login page: it asks for a name and a code, and leads to the student's own server."""

import asyncio
import contextlib
import secrets
import signal
import socket
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import parse_qs, quote

from tornado import template
from tornado.httpserver import HTTPServer
from tornado.web import Application, RequestHandler, stream_request_body

from grader.serve.jupyter_servers import JupyterServer, JupyterServers
from grader.serve.student_folders import find_student, is_code_right
from sim.core.errors import Refusal

_PAGES = template.Loader(str(Path(__file__).parent))
PAGE, QUEUE = _PAGES.load("login.html"), _PAGES.load("queue.html")
WAIT = 1.0  # [s] after the first wrong code; doubled by each further one
DOUBLINGS = 5  # up to 32 s: who guesses is stopped, who is guessed at still comes in
LONGEST = 60.0  # [s] that a request is kept waiting before it is refused
AT_ONCE = 2  # servers that start at the same time: each takes a core
SHORT = 0.5  # [s] that a start may take before the page of the queue is shown
BODY = 4096  # [bytes] of a form; a name and a code need less
CLOSED = {
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; form-action *",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}


@dataclass(frozen=True)
class ServedClass:
    """The class that the login page serves.

    Args:
        codes: student -> code.
        find_home: student -> their course folder; may take a moment the first time.
        servers: the servers.
        first_page: what a student sees first, seen from the course folder.
        wait: seconds to wait after a wrong code.
    """

    codes: Mapping[str, str]
    find_home: Callable[[str], Path]
    servers: JupyterServers
    first_page: str
    wait: float = WAIT

    def enter(self, student: str) -> JupyterServer:
        """The student's server, started if need be.

        Raises:
            Refusal: home or server cannot be made.
        """
        return self.servers.open(student, self.find_home(student))


class LoginDelays:
    """Growing waits after wrong codes, one for each student and one for each address.

    Args:
        wait: seconds after the first wrong code.
    """

    def __init__(self, wait: float) -> None:
        self.wait = wait
        self._wrong: dict[str, int] = {}
        self._until: dict[str, float] = {}

    async def hold(self, keys: tuple[str, ...]) -> bool:
        """Wait until none of these keys is delayed; False if that takes too long."""
        deadline = time.monotonic() + LONGEST
        while True:
            now = time.monotonic()
            until = max((self._until.get(key, 0.0) for key in keys), default=0.0)
            if until <= now:
                return True
            if until > deadline:
                return False
            await asyncio.sleep(until - now)

    def count_wrong(self, keys: tuple[str, ...]) -> None:
        """Make the next try of each of these wait twice as long."""
        for key in keys:
            wrong = self._wrong[key] = self._wrong.get(key, 0) + 1
            self._until[key] = time.monotonic() + self.wait * 2 ** min(wrong - 1, DOUBLINGS)

    def forget(self, keys: tuple[str, ...]) -> None:
        """Remove the delays of these keys after a right code."""
        for key in keys:
            self._wrong.pop(key, None)
            self._until.pop(key, None)


@dataclass
class StartQueue:
    """Students whose servers start, in the order they came.

    Args:
        served_class: what starts them.
        slots: as many start at once.
        starts: student -> their start, which may be over.
        tickets: what a waiting browser shows instead of a code -> student.
        waiting: who has no running server yet.
    """

    served_class: ServedClass
    slots: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(AT_ONCE))
    starts: "dict[str, asyncio.Task[JupyterServer]]" = field(default_factory=dict)
    tickets: dict[str, str] = field(default_factory=dict)
    waiting: list[str] = field(default_factory=list)

    def join(self, student: str) -> "asyncio.Task[JupyterServer]":
        """The task that starts the student's server; the running one, else a new one."""
        there = self.starts.get(student)
        if there is None or there.done():
            there = self.starts[student] = asyncio.create_task(self._start(student))
            self.waiting.append(student)
        return there

    def issue_ticket(self, student: str) -> str:
        """A new ticket for the student; an earlier one is no longer valid."""
        self.tickets = {one: who for one, who in self.tickets.items() if who != student}
        ticket = secrets.token_urlsafe(16)
        self.tickets[ticket] = student
        return ticket

    def find_position(self, student: str) -> int:
        """Where the student stands: 1 is next or already starting."""
        return self.waiting.index(student) + 1 if student in self.waiting else 1

    async def _start(self, student: str) -> JupyterServer:
        try:
            async with self.slots:
                return await asyncio.to_thread(self.served_class.enter, student)
        finally:
            self.waiting.remove(student)


class BasePage(RequestHandler):
    """The base class of both pages."""

    queue: StartQueue
    delays: LoginDelays

    def initialize(self, queue: StartQueue, delays: LoginDelays) -> None:
        """Take what the application passes to each request (Tornado calls this)."""
        self.queue, self.delays = queue, delays

    def set_default_headers(self) -> None:
        """Set headers: load nothing from elsewhere, cache nothing."""
        for name, value in CLOSED.items():
            self.set_header(name, value)

    def redirect_to_server(self, student: str, start: "asyncio.Task[JupyterServer]") -> None:
        """Redirect to the server that started, or back to the page with the reason."""
        try:
            room = start.result()
        except Refusal as refusal:
            self.refuse(student, f"{refusal} Tell your instructor.")
            return
        place = f"/lab/tree/{self.queue.served_class.first_page}?token={room.token}"
        self.redirect(f"http://{self.request.host_name}:{room.port}{place}", status=303)

    def refuse(self, name: str, wrong: str, status: int = 403) -> None:
        """Show the page again with what was wrong."""
        self.set_status(status)
        self.finish(PAGE.generate(wrong=wrong, student=name))


@stream_request_body
class LoginPage(BasePage):
    """The page that asks a student for name and code."""

    def prepare(self) -> None:
        """Refuse a request whose body is no form or too long, before it is read."""
        self.body = bytearray()
        length = self.request.headers.get("Content-Length", "0")
        if not length.isdecimal() or int(length[:12]) > BODY:
            self.refuse("", "That is too long for a name and a code.", 413)

    def data_received(self, chunk: bytes) -> None:
        """Collect a part of the form; a form without a declared length is refused here, too."""
        self.body += chunk
        if len(self.body) > BODY and not self._finished:
            self.body.clear()
            self.refuse("", "That is too long for a name and a code.", 413)

    def get(self) -> None:
        """Show the page."""
        self.finish(PAGE.generate(wrong="", student=""))

    async def post(self) -> None:
        """Let a student in, or refuse with a message that tells an attacker nothing."""
        form = parse_qs(self.body.decode("utf-8", "replace"))
        name, code = (form.get(one, [""])[0] for one in ("student", "code"))
        known = self.queue.served_class.codes
        student = find_student(known, name)
        keys: tuple[str, ...] = (f"address {self.request.remote_ip}",)
        keys += (f"student {student}",) if student is not None else ()
        if not await self.delays.hold(keys):
            self.refuse(name, "Too many wrong codes. Wait a minute, then try again.", 429)
            return
        if student is None or not is_code_right(code, known[student]):
            self.delays.count_wrong(keys)
            self.refuse(name, "No student of that name has that code. Check both.")
            return
        self.delays.forget(keys)
        start = self.queue.join(student)
        done, _ = await asyncio.wait({start}, timeout=SHORT)
        if done:
            self.redirect_to_server(student, start)
        else:
            self.redirect(f"/wait?ticket={quote(self.queue.issue_ticket(student))}", status=303)


class WaitingPage(BasePage):
    """Tells a student their place until their server runs."""

    def get(self) -> None:
        """Show the student's place in the queue, or redirect to their server."""
        student = self.queue.tickets.get(self.get_query_argument("ticket", ""))
        start = self.queue.starts.get(student) if student is not None else None
        if student is None or start is None:
            self.redirect("/", status=303)
        elif start.done():
            self.redirect_to_server(student, start)
        else:
            self.finish(QUEUE.generate(place=self.queue.find_position(student)))


def make_application(served_class: ServedClass) -> Application:
    """The login page as a web application."""
    shared = {"queue": StartQueue(served_class), "delays": LoginDelays(served_class.wait)}
    return Application([("/", LoginPage, shared), ("/wait", WaitingPage, shared)])


async def serve_forever(
    served_class: ServedClass, *, port: int, ready: Callable[[int], None]
) -> None:
    """Serve the login page until the task or the process is ended; then end all servers.

    Args:
        served_class: what it leads to.
        port: where it listens; 0 takes a free one.
        ready: called with the port once it does.

    Raises:
        OSError: the port is taken.
    """
    listening = socket.create_server((served_class.servers.host, port))
    listening.setblocking(False)  # noqa: FBT003 - the socket's own way to say so
    server = HTTPServer(make_application(served_class))
    server.add_socket(listening)
    ended = asyncio.Event()
    with contextlib.suppress(NotImplementedError):  # Windows ends a program without asking it
        asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, ended.set)
    try:
        ready(listening.getsockname()[1])
        await ended.wait()
    finally:
        server.stop()
        served_class.servers.close()
