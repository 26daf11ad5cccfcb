"""The door: a page that asks for a name and a code, and leads to the student's own server."""

import asyncio
import contextlib
import signal
import socket
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from tornado import template
from tornado.httpserver import HTTPServer
from tornado.web import Application, RequestHandler

from grader.serve.homes import find, right
from grader.serve.rooms import Room, Rooms
from sim.errors import Refusal

PAGE = template.Loader(str(Path(__file__).parent)).load("door.html")
WAIT = 1.0  # [s] after a wrong code: trying them all takes longer than any school
CLOSED = {
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; form-action *",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}


@dataclass(frozen=True)
class House:
    """What the door needs to know.

    Args:
        codes: student -> code.
        home: student -> their course folder; may take a moment the first time.
        rooms: the servers.
        first: what a student sees first, seen from the course folder.
        wait: seconds to wait after a wrong code.
    """

    codes: Mapping[str, str]
    home: Callable[[str], Path]
    rooms: Rooms
    first: str
    wait: float = WAIT

    def enter(self, student: str) -> Room:
        """The student's server, started if need be.

        Raises:
            Refusal: home or server cannot be made.
        """
        return self.rooms.open(student, self.home(student))


class Door(RequestHandler):
    """Asks who is there."""

    house: House
    opening: asyncio.Lock

    def initialize(self, house: House, opening: asyncio.Lock) -> None:
        """Tornado's own way to hand something in."""
        self.house, self.opening = house, opening

    def set_default_headers(self) -> None:
        """Nothing from elsewhere, and nothing kept."""
        for name, value in CLOSED.items():
            self.set_header(name, value)

    def get(self) -> None:
        """Show the page."""
        self.finish(PAGE.generate(wrong="", student=""))

    async def post(self) -> None:
        """Let a student in, or say what was wrong; in no words that help who tries."""
        name = self.get_body_argument("student", "")
        student = find(self.house.codes, name)
        code = self.get_body_argument("code", "")
        if student is None or not right(code, self.house.codes[student]):
            await asyncio.sleep(self.house.wait)
            self._again(name, "No student of that name has that code. Look at both once more.")
            return
        try:
            async with (
                self.opening
            ):  # one at a time: a server takes all of a small machine to start
                room = await asyncio.to_thread(self.house.enter, student)
        except Refusal as refusal:
            self._again(name, f"{refusal} Tell your instructor.")
            return
        host = self.request.host_name
        place = f"http://{host}:{room.port}/lab/tree/{self.house.first}?token={room.token}"
        self.redirect(place, status=303)

    def _again(self, name: str, wrong: str) -> None:
        self.set_status(403)
        self.finish(PAGE.generate(wrong=wrong, student=name))


def application(house: House) -> Application:
    """The door as a web application."""
    return Application([("/", Door, {"house": house, "opening": asyncio.Lock()})])


async def stand(house: House, *, port: int, ready: Callable[[int], None]) -> None:
    """Keep the door until the task is ended, or the process is asked to; then end all servers.

    Args:
        house: what it leads to.
        port: where it listens; 0 takes a free one.
        ready: called with the port once it does.

    Raises:
        OSError: the port is taken.
    """
    listening = socket.create_server((house.rooms.host, port))
    listening.setblocking(False)  # noqa: FBT003 - the socket's own way to say so
    server = HTTPServer(application(house))
    server.add_socket(listening)
    ended = asyncio.Event()
    with contextlib.suppress(NotImplementedError):  # Windows ends a program without asking it
        asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, ended.set)
    try:
        ready(listening.getsockname()[1])
        await ended.wait()
    finally:
        server.stop()
        house.rooms.close()
