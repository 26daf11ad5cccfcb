"""One laptop, many browsers: each student has a home, a code, and a Jupyter server of their own."""

import asyncio
import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import urlopen

import psutil
import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.testing import AsyncHTTPTestCase
from tornado.websocket import websocket_connect

from grader.cli import run_command
from grader.course import load_progress
from grader.release import make_common_package
from grader.serve.jupyter_servers import JupyterServers, make_server_environment
from grader.serve.login_page import ServedClass, make_application
from grader.serve.student_folders import (
    can_separate,
    find_student,
    is_code_right,
    load_login_codes,
    prepare_separation,
    prepare_student_folder,
)
from sim.core.errors import BadRequest

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
PATIENCE = 90_000  # [ms] for two Jupyter servers on a busy machine
CELL = "open('mine.txt', 'w').write('{}')"


class Room:
    """A server that is none: it only has an address."""

    port, token = 9999, "secret-token"


class NoRooms:
    """Rooms that are always ready."""

    host = "127.0.0.1"

    def open(self, student, _course):
        """Give the same one to everybody."""
        if student == "bob":
            raise BadRequest("JupyterLab did not start", advice="Look.")
        return Room()


class SlowRooms(NoRooms):
    """Rooms where some take until they are let go."""

    free = threading.Event()

    def open(self, student, course):
        """Wait for those called slow."""
        if student.startswith("slow"):
            self.free.wait(20)
        return super().open(student, course)


class TestDoor(AsyncHTTPTestCase):
    """The page in front of the servers."""

    def get_app(self):
        """The door to a house of three."""
        known = {"Ann": "ABC234", "bob": "XYZ567", "<Eve>": "EVE222",
                 "slow1": "AAA222", "slow2": "BBB222", "slow3": "CCC222"}  # fmt: skip
        return make_application(
            ServedClass(known, lambda _: None, SlowRooms(), "lessons/00.ipynb", wait=0.01)
        )

    def ask(self, student, code):
        """Say who one is."""
        body = f"student={student}&code={code}"
        return self.fetch("/", method="POST", body=body, follow_redirects=False)

    def test_the_page_asks_and_loads_nothing(self):
        """It is whole without anything from elsewhere."""
        page = self.fetch("/")
        text = page.body.decode()

        assert page.code == 200
        assert "script" not in text
        assert re.findall(r"(?:src|href)=", text) == []
        assert page.headers["Content-Security-Policy"].startswith("default-src 'none'")

    def test_the_right_code_leads_to_ones_own_server(self):
        """In whatever case name and code are typed."""
        came = self.ask("ANN", "abc234%20")

        assert came.code == 303
        where = urlsplit(came.headers["Location"])
        assert (where.port, where.path) == (9999, "/lab/tree/lessons/00.ipynb")
        assert where.query == "token=secret-token"

    def test_a_wrong_name_and_a_wrong_code_get_the_same_words(self):
        """Who tries names learns nothing."""
        texts = set()
        for name, code in (("Ann", "XYZ567"), ("nobody", "ABC234"), ("Ann", ""), ("", "ABC234")):
            answer = self.ask(name, code)
            assert answer.code == 403
            texts.add(answer.body.decode().replace(f'value="{name}"', 'value=""'))
        assert len(texts) == 1

    def test_a_server_that_does_not_start_is_said(self):
        """To somebody who can tell the instructor."""
        assert b"Tell your instructor" in self.ask("bob", "XYZ567").body

    def test_a_form_that_is_too_long_is_refused(self):
        """With its length said or not."""
        assert self.ask("Ann", "A" * 5000).code == 413

        async def parts(write):
            for _ in range(3):
                await write(b"A" * 2000)

        answer = self.fetch("/", method="POST", body_producer=parts, raise_error=False)
        assert answer.code == 413

    def test_wrong_codes_of_one_student_wait_for_each_other(self):
        """However many are tried at the same time: 0 + 10 + 20 + 40 + 80 ms."""

        async def at_once():
            return await asyncio.gather(*[
                self.http_client.fetch(
                    self.get_url("/"), method="POST", body="student=Ann&code=x", raise_error=False
                )
                for _ in range(5)
            ])  # fmt: skip

        begun = time.monotonic()
        answers = self.io_loop.run_sync(at_once)
        assert {one.code for one in answers} == {403}
        assert time.monotonic() - begun >= 0.15

    def test_who_waits_is_told_their_place_and_led_in(self):
        """Two start at once; the third is told so, and the page looks again by itself."""
        SlowRooms.free.clear()
        for name, code in (("slow1", "AAA222"), ("slow2", "BBB222"), ("slow3", "CCC222")):
            came = self.ask(name, code)
            assert came.code == 303
        where = came.headers["Location"]
        page = self.fetch(where, follow_redirects=False)
        assert b"Your place in the queue: 3" in page.body
        assert b'http-equiv="refresh"' in page.body
        SlowRooms.free.set()
        for _ in range(100):
            page = self.fetch(where, follow_redirects=False)
            if page.code == 303:
                break
            time.sleep(0.02)
        assert urlsplit(page.headers["Location"]).port == 9999
        assert self.fetch("/wait?ticket=other", follow_redirects=False).headers["Location"] == "/"

    def test_a_name_is_shown_as_text(self):
        """Whatever it holds."""
        assert b"<Eve>" not in self.ask("<Eve>", "wrong").body


def test_codes_stay_and_new_students_get_one(tmp_path):
    first = load_login_codes(tmp_path, ["ann", "Zoë"])
    again = load_login_codes(tmp_path, ["Ann", "Zoë", "ben"])

    assert again["Ann"] == first["ann"]
    assert again["Zoë"] == first["Zoë"]
    assert len({*again.values()}) == 3
    assert all(re.fullmatch(r"[A-Z2-9]{6}", code) for code in again.values())
    assert find_student(again, " zoë ") == "Zoë"
    assert find_student(again, "nobody") is None


@pytest.mark.parametrize(
    ("given", "same"),
    [("ABC234", True), (" abc234 ", True), ("ABC235", False), ("", False), ("é", False)],
)
def test_a_code_may_be_typed_in_any_case(given, same):
    assert is_code_right(given, "ABC234") is same


def test_a_home_is_made_once_and_work_in_it_stays(root, tmp_path):
    packages = [make_common_package(root)]
    course = prepare_student_folder(tmp_path, "Zoë", packages=packages)
    answers = course / "exercises" / "exercise1" / "answers.toml"
    answers.write_text("forward = 3\n", encoding="utf-8")

    assert prepare_student_folder(tmp_path, "zoë", packages=packages) == course
    assert answers.read_text("utf-8") == "forward = 3\n"
    assert load_progress(course)[0].student == "Zoë"
    assert not (course / "solutions").exists()


def test_a_port_that_is_taken_is_one_line(root, tmp_path, monkeypatch, capsys):
    import socket  # noqa: PLC0415 - only here

    monkeypatch.chdir(root)
    (tmp_path / "r.csv").write_text("student\nann\n", encoding="utf-8")
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        command = ["serve", str(tmp_path / "homes"), "--roster", str(tmp_path / "r.csv"),
                   "--host", "127.0.0.1", "--port", port, "--unprotected"]  # fmt: skip
        assert run_command(command) == 2
    assert f"port {port} cannot be used" in capsys.readouterr().err


def test_personal_packages_are_not_served_unprotected_unasked(root, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(root)
    monkeypatch.setattr("grader.serve.student_folders.can_separate", lambda: False)
    (tmp_path / "r.csv").write_text("student\nann\n", encoding="utf-8")
    command = ["serve", str(tmp_path / "homes"), "--roster", str(tmp_path / "r.csv"),
               "--packages", str(tmp_path)]  # fmt: skip
    assert run_command(command) == 2
    assert "--unprotected" in capsys.readouterr().err
    assert not (tmp_path / "homes").exists()


def test_jupyter_starts_in_a_home_named_by_a_relative_path(root, tmp_path, monkeypatch):
    (tmp_path / "Robotik für alle").mkdir()
    monkeypatch.chdir(tmp_path / "Robotik für alle")
    course = prepare_student_folder(Path("homes"), "Zoë B", packages=[make_common_package(root)])
    rooms = JupyterServers("127.0.0.1")
    try:
        room = rooms.open("Zoë B", course)
        url = f"http://127.0.0.1:{room.port}/api/contents/exercises?token={room.token}"
        with urlopen(url, timeout=PATIENCE / 1000) as answer:
            assert b"exercise1" in answer.read()
        assert not [word for word in psutil.Process(room.process.pid).cmdline()
                    if room.token in word]  # fmt: skip
    finally:
        rooms.close()


@pytest.fixture
def separate_homes():
    """A folder that other users may pass through, on a machine where students can be separated."""
    if not can_separate():
        pytest.skip("only root can give each student a system user")
    folder = Path(tempfile.mkdtemp())
    folder.chmod(0o711)
    try:
        prepare_separation(folder / "homes")
    except BadRequest as refusal:
        pytest.skip(str(refusal))
    else:
        yield folder / "homes"
    finally:
        shutil.rmtree(folder)


TRY = """
import pathlib, sys
for path in sys.argv[1:]:
    for what in ("read", "write"):
        try:
            if pathlib.Path(path).is_dir():
                list(pathlib.Path(path).iterdir()) if what == "read" else \
                    pathlib.Path(path, "x").touch()
            else:
                pathlib.Path(path).open({"read": "rb", "write": "r+b"}[what]).read(1)
        except OSError:
            continue
        print("CAN", what, path, flush=True)
for every in pathlib.Path("/proc").glob("[0-9]*"):
    for name in ("cmdline", "environ"):
        try:
            sys.stdout.buffer.write((every / name).read_bytes())
        except OSError:
            pass
"""


EAVESDROP = """
import sys, zmq
ear = zmq.Context().socket(zmq.SUB)
ear.setsockopt(zmq.SUBSCRIBE, b"")
ear.setsockopt(zmq.RCVTIMEO, 3000)
for port in sys.argv[1:]:
    ear.connect("tcp://127.0.0.1:" + port)
print("ready", flush=True)
sys.stdin.readline()
try:
    while True:
        print(ear.recv())
except zmq.Again:
    pass
"""


def overheard(room, by):
    """What another user hears on the ports of a room while its student works."""
    assert calculate(room, "6 * 7") == "42"  # a kernel runs, and its ports are there
    server = psutil.Process(room.process.pid)
    ports = {str(one.laddr.port)
             for process in (server, *server.children(recursive=True))
             for one in process.net_connections("tcp")
             if one.status == psutil.CONN_LISTEN and one.laddr.port != room.port}  # fmt: skip
    with subprocess.Popen(
        [sys.executable, "-c", EAVESDROP, *ports], user=by, group=by, extra_groups=[], cwd="/",
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8",
    ) as ear:  # fmt: skip
        assert ear.stdout.readline() == "ready\n"
        kernel = max(room.runtime.glob("kernel-*.json"), key=lambda file: file.stat().st_mtime)
        calculate(room, "'answer of ann'", kernel=kernel.stem.removeprefix("kernel-"))
        return ear.communicate("\n", timeout=30)[0]


def calculate(room, expression, kernel=""):
    """What a kernel of a room's server answers; a new one unless it is named."""

    async def ask():
        address = f"http://127.0.0.1:{room.port}/api/kernels"
        head = {"Authorization": f"token {room.token}"}
        client = AsyncHTTPClient()
        made = (
            kernel
            or json.loads(
                (await client.fetch(address, method="POST", headers=head, body="{}")).body
            )["id"]
        )
        line = await websocket_connect(
            HTTPRequest(f"ws{address[4:]}/{made}/channels", headers=head)
        )
        await line.write_message(json.dumps({
            "header": {"msg_id": "1", "msg_type": "execute_request", "username": "",
                       "session": "1", "version": "5.3"},
            "parent_header": {}, "metadata": {}, "channel": "shell",
            "content": {"code": expression, "silent": False},
        }))  # fmt: skip
        while True:
            said = json.loads(await asyncio.wait_for(line.read_message(), 60))
            if said["msg_type"] == "execute_result":
                line.close()
                return said["content"]["data"]["text/plain"]

    return asyncio.run(ask())


def test_two_students_cannot_reach_each_others_files(root, separate_homes, monkeypatch):
    known = load_login_codes(separate_homes, ["ann", "ben"])
    packages = [make_common_package(root)]
    course = {who: prepare_student_folder(separate_homes, who, packages=packages) for who in known}
    monkeypatch.setenv("SYSID_SECRET", "class-secret-value")
    monkeypatch.setenv("GITHUB_TOKEN", "of-the-operator")
    rooms = JupyterServers("127.0.0.1", separate=True)
    try:
        room = {who: rooms.open(who, course[who]) for who in known}
        url = f"http://127.0.0.1:{room['ann'].port}/api/contents/exercises?token="
        with urlopen(url + room["ann"].token, timeout=20) as answer:  # noqa: S310 - our own
            assert b"exercise1" in answer.read()
        place = {who: path.parent for who, path in course.items()}
        account = {who: one.stat().st_uid for who, one in place.items()}
        assert account["ann"] != account["ben"]
        assert psutil.Process(room["ben"].process.pid).uids().real == account["ben"]
        theirs = [
            "course/exercises/exercise1/answers.toml", "course/exercises", "jupyter/cache",
            "server.log", ".",
        ]  # fmt: skip

        def attempt(who, victim):
            paths = [str(place[victim] / one) for one in theirs]
            paths += [str(one) for one in (room[victim].runtime, *room[victim].runtime.iterdir())]
            return subprocess.run(
                [sys.executable, "-c", TRY, *paths, str(separate_homes / "codes.csv")],
                user=account[who], group=account[who], extra_groups=[], cwd=place[who],
                env=make_server_environment(course[who], room[who].runtime, own=True),
                capture_output=True, check=True, timeout=30,
            ).stdout.decode("utf-8", "replace")  # fmt: skip

        assert "answer of ann" not in overheard(room["ann"], by=account["ben"])
        own, others = attempt("ben", "ben"), attempt("ben", "ann")
        assert f"CAN write {place['ben']}/course/exercises" in own  # the attempt itself works
        assert room["ben"].token in own
        assert f"CAN read {room['ben'].runtime}" in own
        kept = rf"{separate_homes}/(?:ann|codes)|{room['ann'].runtime}"
        assert not re.findall(rf"CAN \w+ (?:{kept})\S*", own + others)
        assert room["ann"].token not in others
        assert "class-secret-value" not in own
        assert "of-the-operator" not in own
        assert (separate_homes / "codes.csv").stat().st_mode & 0o077 == 0
        rooms.close()
        again = JupyterServers("127.0.0.1", separate=True)
        try:
            again.open("ben", prepare_student_folder(separate_homes, "ben", packages=packages))
            assert place["ben"].stat().st_uid == account["ben"]
        finally:
            again.close()
    finally:
        rooms.close()


PASSABLE = """
set -e
aside=$1; shift
number=0
while [ "$1" != -- ]; do  # pairs: a folder that nobody may pass, and one in it that is needed
    number=$((number + 1)); mkdir -p "$aside/$number"; mount --bind "$2" "$aside/$number"
    echo "$1" >> "$aside/private"; echo "$2" >> "$aside/needed"
    shift 2
done
shift
sort -u "$aside/private" | while read -r folder; do mount -t tmpfs -o mode=755 none "$folder"; done
number=0
while read -r folder; do
    number=$((number + 1)); mkdir -p "$folder"; mount --move "$aside/$number" "$folder"
done < "$aside/needed"
exec "$@"
"""


def private_parent(path):
    """The outermost folder around a path that other users may not pass; None if all may."""
    return next((one for one in [*path.parents][::-1] if not one.stat().st_mode & 0o001), None)


def test_two_students_are_kept_apart_where_python_lies_in_roots_own_folder(root, tmp_path):
    """The test above once more, with Python and the course where every user may reach them."""
    if not can_separate() or not sys.platform.startswith("linux") or not shutil.which("unshare"):
        pytest.skip("only root on Linux can look at the same files in another way")
    needed = {Path(one).resolve() for one in (sys.base_prefix, sys.prefix, root)}
    pairs = [(private_parent(one), one) for one in sorted(needed)]
    hidden = [str(path) for private, one in pairs if private for path in (private, one)]
    if not hidden:
        pytest.skip("every user can reach Python here: the test above has run")
    test = f"{__file__}::test_two_students_cannot_reach_each_others_files"
    done = subprocess.run(
        ["unshare", "--mount", "sh", "-c", PASSABLE, "sh", str(tmp_path), *hidden, "--",  # noqa: S607
         sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", test],
        cwd=root, capture_output=True, encoding="utf-8", check=False, timeout=300,
    )  # fmt: skip
    if "unshare:" in done.stderr or "mount:" in done.stderr:
        pytest.skip(f"no mounts of one's own here: {done.stderr.strip()[-200:]}")

    assert "1 passed" in done.stdout, done.stdout + done.stderr


@pytest.mark.browser
def test_two_students_work_at_the_same_time_each_in_a_home_of_their_own(root, tmp_path):
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.skip(f"no browser found: install one of {', '.join(BROWSERS)}")
    (tmp_path / "r.csv").write_text("student\nann\nben\n", encoding="utf-8")
    homes = tmp_path / "homes"
    with (
        serving(root, homes, tmp_path / "r.csv") as address,
        playwright.sync_playwright() as driver,
    ):
        chromium = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        known = dict(
            line.split(",") for line in (homes / "codes.csv").read_text("utf-8").split()[1:]
        )
        pages = {who: come_in(chromium, address, who, code) for who, code in known.items()}
        for who, page in pages.items():
            run_a_cell(page, CELL.format(who))
        chromium.close()

    assert not [one for one in psutil.process_iter(["cmdline"])
                if any(str(homes) in word for word in one.info["cmdline"] or ())]  # fmt: skip
    for who in ("ann", "ben"):
        (written,) = (homes / who / "course").rglob("mine.txt")
        assert written.read_text("utf-8") == who


@contextlib.contextmanager
def serving(root, homes, roster):
    """The command, running; the address of its door."""
    command = [sys.executable, "-c", "from grader.cli import main; main()", "serve", str(homes),
               "--roster", str(roster), "--host", "127.0.0.1", "--port", "0",
               "--unprotected"]  # fmt: skip
    environment = {**os.environ, "PYTHONPATH": str(root)}
    environment.pop("PYTHONUNBUFFERED", None)
    running = subprocess.Popen(
        command, cwd=root, env=environment, stdout=subprocess.PIPE, encoding="utf-8"
    )
    try:
        yield next(re.search(r"http://\S+", line)[0] for line in running.stdout if "http" in line)
    finally:
        running.terminate()
        running.wait(timeout=30)
        running.stdout.close()


def come_in(chromium, address, who, code):
    """A browser of one's own, at the first lesson."""
    page = chromium.new_context(viewport={"width": 1280, "height": 900}).new_page()
    page.set_default_timeout(PATIENCE)
    page.goto(address)
    page.get_by_label("Your name").fill(who)
    page.get_by_label("Your code").fill(code)
    page.get_by_role("button", name="Come in").click()
    page.locator("#jp-main-statusbar").get_by_text("| Idle").wait_for()
    return page


def run_a_cell(page, code):
    """Type a cell below the first one, run it, and wait until it is done."""
    page.locator(".jp-Cell").first.click()
    page.keyboard.press("Escape")
    page.keyboard.press("b")
    page.keyboard.press("Enter")
    page.keyboard.type(code)
    page.keyboard.press("Shift+Enter")
    page.locator(".jp-OutputPrompt", has_text=re.compile(r"\[1\]")).first.wait_for()
