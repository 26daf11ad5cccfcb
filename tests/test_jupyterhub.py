"""JupyterHub as INSTRUCTORS.md starts it: two students log in, work, and cannot read each other.

The Hub runs on a system of its own: what it writes to /etc and /home is gone with the test, and its
students can reach a Python that lies in root's own folder.
"""

import asyncio
import contextlib
import csv
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

import psutil
import pytest
import requests
from places import ROOT
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from grader.cli import run_command
from grader.course.progress import find_course
from grader.exercise.course_check import solve
from grader.exercise.exercise import find_exercise
from sim.support.student_names import make_folder_name

pytestmark = pytest.mark.slow

ANSWER = "exercises/exercise1/answers.toml"
LESSON = "lessons/00_guess_or_measure.ipynb"
PATIENCE = 120  # [s] for a server to start, or a command to end
APART = """
set -e
work=$1; shift
mkdir "$work/etc" "$work/scratch" "$work/passable"; chmod 755 "$work/passable" "$work/etc"
mount -t overlay -o "lowerdir=/etc,upperdir=$work/etc,workdir=$work/scratch" overlay /etc
mount -t tmpfs -o mode=755 none /home
while [ "$1" != -- ]; do  # folders that nobody but root may pass
    mount -t overlay -o "lowerdir=$work/passable:$1" overlay "$1"; shift
done
shift
cd "$1"; shift
exec "$@"
"""


@pytest.fixture(scope="module")
def work():
    """A folder that every user may pass."""
    if not sys.platform.startswith("linux") or not shutil.which("unshare") or os.geteuid() != 0:
        pytest.skip("only root on Linux can start servers as other users, on a system of its own")
    pytest.importorskip("jupyterhub", reason="JupyterHub is not installed: pip install '.[hub]'")
    if not shutil.which("configurable-http-proxy"):
        pytest.skip("no configurable-http-proxy: npm install --global configurable-http-proxy@5")
    folder = Path(tempfile.mkdtemp(prefix="hub-"))
    folder.chmod(0o755)
    try:
        yield folder
    finally:
        shutil.rmtree(folder)


@pytest.fixture(scope="module")
def class_folder(work, root):
    """What lies around the Hub's folder, made by the commands of the guide."""
    place = work / "class"
    place.mkdir(mode=0o700)
    (place / "roster.csv").write_text("student\nAda\nBen Öztürk\n", encoding="utf-8")
    commands = (
        ["release", "-o", f"{place}/packages", "--roster", f"{place}/roster.csv",
         "--secret", f"{place}/class.secret"],
        ["export", "jupyterhub", "-o", f"{place}/hub/jupyterhub_config.py"],
    )  # fmt: skip
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(root)
        assert [run_command(command) for command in commands] == [0, 0]
    with zipfile.ZipFile(place / "packages" / "course.zip") as package:
        package.extractall(work)  # the course without solutions, which the Hub's students run
    return place


@contextlib.contextmanager
def hub(work, *options, code):
    """The Hub of the class, which finds the course in the folder ``code``: process and log."""
    needed = {Path(one).resolve() for one in (sys.base_prefix, sys.prefix)}
    private = {str(parent) for one in needed for parent in one.parents
               if not parent.stat().st_mode & 0o001}  # fmt: skip
    log = work / "hub.log"
    with log.open("wb") as stream:
        running = subprocess.Popen(
            ["unshare", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc",  # noqa: S607 - the system's
             "sh", "-c", APART, "sh", tempfile.mkdtemp(dir=work), *sorted(private), "--",
             work / "class" / "hub", Path(sys.executable).with_name("jupyterhub"), *options],
            env={**os.environ, "PYTHONPATH": str(code)}, stdin=subprocess.DEVNULL, stdout=stream,
            stderr=stream,
        )  # fmt: skip
    try:
        yield running, log
    finally:
        with contextlib.suppress(psutil.NoSuchProcess):  # it has ended
            for first in psutil.Process(running.pid).children():
                first.kill()  # and with it all of its system
        running.wait()


def wait_for(condition, log):
    """What the condition is, as soon as it is something."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        if found := condition():
            return found
        time.sleep(0.2)
    pytest.fail(f"nothing after {PATIENCE} s:\n{log.read_text('utf-8')[-3000:]}")


def is_open(port):
    """Whether somebody listens at a port of this machine."""
    with socket.socket() as one:
        return one.connect_ex(("127.0.0.1", port)) == 0


def find_free_ports(count):
    """Ports at which nobody listens."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


class Browser:
    """A student's browser: it keeps cookies, and sends back the word against forged requests."""

    def __init__(self, port, session):
        self.port = port
        self.session = session
        self.account = ""

    def log_in(self, name, code):
        """The status of the answer to a name and a code; the server begins to start."""
        page = f"http://127.0.0.1:{self.port}/hub/login"
        self.session.get(page)
        word = {"_xsrf": self._word("/hub/")}
        form = {"username": name, "password": code, **word}
        answer = self.session.post(page, params=word, data=form, timeout=PATIENCE)
        found = re.search(r"/(student-\w+)", answer.url)
        self.account = found[1] if found else ""
        return answer.status_code

    def _word(self, path):
        return next(one.value for one in self.session.cookies
                    if one.name == "_xsrf" and one.path == path)  # fmt: skip

    @property
    def home(self):
        """The path of the student's server."""
        return f"/user/{self.account}/"

    def is_in(self):
        """Whether the student's JupyterLab answers."""
        answer = self.ask("lab")
        return answer.status_code == 200 and f"{self.home}lab" in answer.url

    def ask(self, what, *, home=""):
        """The answer of a server: one's own, or that of another home."""
        address = f"http://127.0.0.1:{self.port}{home or self.home}{what}"
        return self.session.get(address, timeout=PATIENCE)

    def send(self, what, how, content=None):
        """What one's own server answers to JSON."""
        answer = self.session.request(
            how, f"http://127.0.0.1:{self.port}{self.home}{what}", json=content, timeout=PATIENCE,
            headers={"X-XSRFToken": self._word(self.home)},
        )  # fmt: skip
        assert answer.ok, answer.text
        return answer.json()

    def type(self, command):
        """What a terminal shows of a command, up to its exit code."""
        name = self.send("api/terminals", "POST", {"cwd": "lessons"})["name"]
        cookies = "; ".join(f"{one.name}={one.value}" for one in self.session.cookies
                            if one.path in {"/", self.home})  # fmt: skip
        address = f"ws://127.0.0.1:{self.port}{self.home}terminals/websocket/{name}"

        async def converse():
            line = await websocket_connect(HTTPRequest(address, headers={"Cookie": cookies}))
            await line.write_message(json.dumps(["stdin", f"{command}; echo code $?.\r"]))
            shown = ""
            while not (end := re.search(r"code (\d+)\.\r", shown)):
                kind, *text = json.loads(await line.read_message())
                shown += text[0] if kind == "stdout" else ""
            line.close()
            while await line.read_message() is not None:  # what it shows until it is closed
                pass
            return shown.partition("$?.")[2], int(end[1])

        return asyncio.run(asyncio.wait_for(converse(), PATIENCE))


def test_two_students_work_and_cannot_read_each_other(work, class_folder, root):
    port, inside, api = find_free_ports(3)
    options = (f"--port={port}", f"--JupyterHub.hub_port={inside}",
               f"--ConfigurableHTTPProxy.api_url=http://127.0.0.1:{api}")  # fmt: skip
    with (
        hub(work, *options, code=work / "course") as (running, log),
        requests.Session() as adas, requests.Session() as bens,
    ):  # fmt: skip
        wait_for(lambda: is_open(inside) or running.poll() is not None, log)
        if re.search("^(unshare|mount): ", said := log.read_text("utf-8"), re.MULTILINE):
            pytest.skip(f"no system of its own here: {said.strip()[-200:]}")
        wait_for(lambda: is_open(port), log)
        with (class_folder / "hub" / "codes.csv").open(encoding="utf-8", newline="") as stream:
            codes = {row["student"]: row["code"] for row in csv.DictReader(stream)}
        ada, ben = Browser(port, adas), Browser(port, bens)

        tries = [("Ada", codes["Ben Öztürk"]), ("nobody", codes["Ada"]), ("Ada", "")] * 4
        wrong = [ben.log_in(*one) for one in tries]
        assert set(wrong) == {403}
        # the right code works after them, as people type it
        assert ada.log_in(" ada", f"{codes['Ada'].lower()} ") == 200
        assert ben.log_in("Ben Öztürk", codes["Ben Öztürk"]) == 200
        for one in (ada, ben):
            wait_for(one.is_in, log)
            lesson = one.ask(f"api/contents/{LESSON}").json()
            assert (lesson["type"], lesson["path"]) == ("notebook", LESSON)

        right = find_right_answer(root, work, class_folder, "Ada")
        ada.send(
            f"api/contents/{ANSWER}", "PUT", {"type": "file", "format": "text", "content": right}
        )
        shown, code = ada.type("grade exercise1; grade exercise1 --student practice")
        assert code == 1, shown
        assert "of 12 points" in shown
        assert "6 of 6 answered" in shown

        place = f"/home/{ada.account}"
        closed = (
            place,
            f"{place}/course/{ANSWER}",
            class_folder,
            class_folder / "class.secret",
            class_folder / "hub" / "codes.csv",
        )
        shown, _ = ben.type("; ".join(f"cat {one}; ls {one}/; touch {one}" for one in closed))
        assert shown.count("Permission denied") == 3 * len(closed), shown
        assert ben.type(f"cat /home/{ben.account}/course/{ANSWER}")[1] == 0  # the attempt works
        assert "Permission denied" in ben.type("cat /proc/1/environ")[0]  # the Hub's
        assert ben.ask(f"api/contents/{ANSWER}", home=ada.home).status_code in {403, 404}
        assert ada.ask(f"api/contents/{ANSWER}").json()["content"] == right

        ben.send("api/kernels", "POST", {"name": "python3"})
        typed = "cat ~/.local/share/jupyter/runtime/kernel-*.json; ulimit -v"
        shown, _ = ben.type(f"sysid simulate drivetrain --seed 1 -o x.wpilog; {typed}")
        assert "x.wpilog: 4 tests" in shown  # within its memory, and without compiling anew
        assert '"transport": "ipc"' in shown
        assert re.search(rf"{4 * 2**20}\r$", shown, re.MULTILINE)

        shown, code = ben.type(f"ln -s {class_folder}/class.secret ../exercises/exercise2/x.toml")
        assert code == 0, shown
        psutil.Process(running.pid).children()[0].send_signal(signal.SIGINT)
        running.wait(PATIENCE)
    assert not list((class_folder / "handed-in").rglob("x.toml"))  # root follows no student's link
    graded = class_folder / "graded"
    place = str(class_folder)
    run_command(["class", f"{place}/handed-in", "--roster", f"{place}/roster.csv", "--secret",
                 f"{place}/class.secret", "--exercise", "1", "-o", str(graded)])  # fmt: skip
    with (graded / "gradebook.csv").open(encoding="utf-8-sig", newline="") as stream:
        points = {row["student"]: row["exercise1"] for row in csv.DictReader(stream)}
    assert points == {"Ada": "12", "Ben Öztürk": ""}


def find_right_answer(root, work, class_folder, student):
    """The right answers to exercise 1, to the numbers of a student's package."""
    folder = make_folder_name(student)
    with zipfile.ZipFile(class_folder / "packages" / "students" / f"{folder}.zip") as package:
        package.extractall(work / "unpacked")
    one = find_exercise("exercise1", find_course(root))
    data = work / "unpacked" / "course" / "exercises" / "exercise1" / "data" / folder
    return solve(one, data, solution=ROOT / "solutions" / one.name)["answers.toml"]


@pytest.mark.parametrize(
    ("mode", "code", "said"),
    [(0o755, "course", "Students could enter"), (0o700, ROOT, "folder with the solutions")],
)
def test_the_hub_does_not_start_where_students_could_read_too_much(
    work, class_folder, mode, code, said
):
    class_folder.chmod(mode)
    try:
        with hub(work, code=work / code) as (running, log):
            assert running.wait(PATIENCE) == 1
            assert said in log.read_text("utf-8")
    finally:
        class_folder.chmod(0o700)
