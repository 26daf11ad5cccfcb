"""The HTTP server of the page, for this machine and this session only.

It listens on 127.0.0.1. A request that names another host, or comes from another site's page, is
refused, so that no site can reach it through the browser (DNS rebinding, cross-site requests). Its
address holds a random word, so that other users of the machine cannot read the logs.

Python's own ``http.server`` is enough for one person's browser, and adds nothing to the install.
"""

import json
import secrets
from collections.abc import Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from sim.cli.open import page_data
from sim.cli.open.reconcile_job import ReconcileJob
from sim.cli.open.saved_page import PAGE, SHARED, render_saved_page
from sim.cli.open.session import OpenLog, Reading, Session
from sim.core.errors import BadRequest, Refusal
from sim.io.format import LARGEST_FILE

KINDS = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'self'; img-src 'self' data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'; object-src 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
RAW = ("summary", "entries", "samples", "entry")  # requests that --raw allows: the data alone
ROLES = ("validation", "held_out")  # of other logs in a search
PIECE = 2**20  # [bytes] read at a time
PROBLEM = "application/problem+json"  # content type of a refusal (RFC 9457)
TIMEOUT = 30.0  # [s] to wait for the rest of a request


class PageServer(ThreadingHTTPServer):
    """HTTP server of the page and of the data about a session's logs.

    Args:
        session: the logs that are open.
        port: port on this machine; 0 takes a free one.

    Raises:
        BadRequest: the port is taken.
    """

    daemon_threads = True

    def __init__(self, session: Session, *, port: int = 0) -> None:
        self.session = session
        self.word = secrets.token_urlsafe(12)
        try:
            super().__init__(("127.0.0.1", port), PageRequest)
        except OSError as error:
            raise BadRequest(
                f"port {port} cannot be used ({error.strerror or error})",
                advice="Leave out --port; a free one is taken.",
            ) from None

    @property
    def hosts(self) -> tuple[str, ...]:
        """The values of the Host header that a request of our own page may have."""
        port = self.server_address[1]
        return (f"127.0.0.1:{port}", f"localhost:{port}")

    @property
    def address(self) -> str:
        """The address to open in a browser."""
        return f"http://{self.hosts[0]}/{self.word}/"

    def handle_error(self, request: object, client_address: object) -> None:
        """Print nothing when a browser closes its connection."""


class PageRequest(BaseHTTPRequestHandler):
    """The handler of one HTTP request."""

    server: PageServer
    protocol_version = "HTTP/1.1"
    server_version = "sysid"
    sys_version = ""
    timeout = TIMEOUT

    def do_GET(self) -> None:
        """Answer a request; an error is sent to the page, and the server keeps running."""
        try:
            address = urlsplit(self.path)
            steps = address.path.strip("/").split("/")
            if not self._is_ours():
                self._refuse(HTTPStatus.FORBIDDEN, "this page answers only to itself")
            elif not secrets.compare_digest(steps[0].encode(), self.server.word.encode()):
                self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")
            else:
                query = {name: values[-1] for name, values in parse_qs(address.query).items()}
                self._answer(steps[1:], query)
        except Refusal as refusal:
            folder = str(self.server.session.folder)
            error_data = page_data.describe_refusal(refusal, folder)
            # an answer like others; a browser's console would call another status an error
            self._send_refusal(error_data, HTTPStatus.OK)
        except (ConnectionError, TimeoutError):
            self.close_connection = True
        except Exception as error:  # noqa: BLE001 - one broken log must not end the others
            what = f"our mistake, not yours ({type(error).__name__}: {error})"
            error_data = {"what": what, "where": "", "advice": "Try sysid fit, which says more."}
            self._send_refusal(error_data, HTTPStatus.INTERNAL_SERVER_ERROR)

    do_POST = do_DELETE = do_GET  # noqa: N815 - the names in http.server

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - the name in http.server
        """Print nothing: the terminal is for the address."""

    def _is_ours(self) -> bool:
        """Whether the Host and Origin headers are from our own page."""
        hosts = self.server.hosts
        origin = self.headers.get("Origin")
        return self.headers.get("Host") in hosts and (
            origin is None or origin in {f"http://{host}" for host in hosts}
        )

    def _answer(self, steps: list[str], query: Mapping[str, str]) -> None:
        """Answer a request: send a file of the page or data about a log, or open, close or stop."""
        session = self.server.session
        match self.command, steps:
            case "GET", [] | [""]:
                self._send_file("index.html")
            case "GET", ["logs" | "view" | "live" as what]:
                self._send_json(page_data.describe_session(session)[what])
            case "GET", ["feedback"]:
                self._send_json(page_data.describe_feedback(query))
            case "GET", ["logs", number, what]:
                self._send_of_log(self._find_log(number), what, query)
            case "GET", [name]:
                self._send_file(name)
            case "POST", ["logs"]:
                name, path = session.choose_place(query.get("name", "log"))
                self._receive(path)
                self._send_json(page_data.name_log(session.add(name, path)))
            case "POST", ["example"]:
                self._discard_body()
                self._send_json(page_data.name_log(session.add_example()))
            case "DELETE", ["logs", number]:
                self._discard_body()
                session.close(self._find_log(number).number)
                self._send_json({})
            case "DELETE", ["logs", number, "reconcile"]:
                self._discard_body()
                self._start_search(self._find_log(number), query).stop()
                self._send_json({})
            case _:
                self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")

    def _find_log(self, number: str) -> OpenLog:
        return self.server.session.find(int(number) if number.isdecimal() else 0)

    def _send_of_log(self, one: OpenLog, what: str, query: Mapping[str, str]) -> None:
        """Answer a request about one log.

        Raises:
            Refusal: the log cannot be read or fitted, or the page shows the data alone.
        """
        if self.server.session.view.raw and what not in RAW:
            raise BadRequest(
                "this page shows the data alone", advice="Open the log with sysid open FILE."
            )
        reading = Reading.from_query(query)
        wanted = what == "reconcile" or query.get("effects") or query.get("story")
        search = self._start_search(one, query) if wanted else None
        if what == "samples":
            content = page_data.pack_samples(one.combine_runs(reading))
            self._send(content, "application/octet-stream")
        elif what == "entry":
            content = page_data.pack_entry(one, one.combine_runs(reading), query.get("name", ""))
            self._send(content, "application/octet-stream")
        elif what == "report.html":
            text = render_saved_page(one, reading, search.story if search else None, query)
            self._send(text.encode(), KINDS[".html"], page=True)
        elif search and what == "reconcile":
            self._send_json(search.to_json())
        else:
            chosen = (
                search.refit(query["effects"].split(","))
                if search and query.get("effects")
                else None
            )
            data = page_data.answer_request(one, reading, what, query, chosen)
            if data is None:
                self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")
            else:
                self._send_json(data)

    def _start_search(self, one: OpenLog, query: Mapping[str, str]) -> ReconcileJob:
        """The search that a request names; it begins if there is none yet."""
        others = {role: self._find_log(query[role]) for role in ROLES if query.get(role)}
        effort = 5.0 if query.get("longer") else 1.0
        return one.reconcile(Reading.from_query(query), others, effort)

    def _receive(self, path: Path) -> None:
        """Write the body of a request into a file.

        Raises:
            BadRequest: the body has no length, or is too large.
            ConnectionAbortedError: the body ends early.
        """
        length = self.headers.get("Content-Length", "")
        if not length.isdecimal():
            self.close_connection = True
            raise BadRequest("the file has no length", advice="Drop it again.")
        left = int(length)
        if left > LARGEST_FILE:
            self.close_connection = True
            raise BadRequest(
                f"the file has {left / 2**30:.1f} GiB, the most that is read is "
                f"{LARGEST_FILE / 2**30:.0f} GiB",
                advice="Export only the four tests from it, with AdvantageScope for example.",
            )
        with path.open("wb") as stream:
            while left:
                piece = self.rfile.read(min(left, PIECE))
                if not piece:
                    raise ConnectionAbortedError
                stream.write(piece)
                left -= len(piece)

    def _discard_body(self) -> None:
        """Read a body that is not needed, so that the next request of this connection is found."""
        length = self.headers.get("Content-Length", "0")
        if length.isdecimal() and int(length) <= PIECE:
            self.rfile.read(int(length))
        else:
            self.close_connection = True

    def _send_file(self, name: str) -> None:
        """Send a file of the page; only names of files in its folder are accepted."""
        files = {path.name: path for path in [*PAGE.iterdir(), *SHARED] if path.suffix in KINDS}
        if name in files:
            self._send(files[name].read_bytes(), KINDS[files[name].suffix])
        else:
            self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")

    def _send_json(self, data: object) -> None:
        self._send(json.dumps(data, allow_nan=False).encode(), "application/json")

    def _send_refusal(self, data: object, status: HTTPStatus) -> None:
        self._send(json.dumps({"refusal": data}).encode(), PROBLEM, status=status)

    def _refuse(self, status: HTTPStatus, what: str) -> None:
        self.close_connection = True  # the request's body, if any, is not read
        error_data = {
            "what": what,
            "where": "",
            "advice": "Open the address that sysid open printed.",
        }
        self._send_refusal(error_data, status)

    def _send(
        self, content: bytes, kind: str, *, status: HTTPStatus = HTTPStatus.OK, page: bool = False
    ) -> None:
        """Send a whole answer; a saved page (``page``) has a Content-Security-Policy of its own."""
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        for name, value in HEADERS.items():
            if not (page and name == "Content-Security-Policy"):
                self.send_header(name, value)
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(content)
