"""Students who come to ``grade serve`` at once: seconds to a place in the queue and to JupyterLab.

    python tests/benchmarks/bench_serve.py [STUDENTS] [PATIENCE in s]

Servers run without kernels. Run as root, each has a system user of its own where Python allows it.
"""

import asyncio
import re
import statistics
import sys
import tempfile
import time
from pathlib import Path
from urllib.parse import urlencode

from tornado.httpclient import AsyncHTTPClient, HTTPResponse
from tornado.httpserver import HTTPServer
from tornado.testing import bind_unused_port

from grader.release import make_common_package
from grader.serve.jupyter_servers import JupyterServers
from grader.serve.login_page import ServedClass, make_application
from grader.serve.student_folders import (
    can_separate,
    load_login_codes,
    prepare_separation,
    prepare_student_folder,
)
from sim.core.errors import BadRequest

PAUSE = 2.0  # [s] between two looks, as the page of the queue says


async def come_in(door: str, student: str, code: str, until: float) -> tuple[float, float | None]:
    """Seconds from the click to the first answer that helps, and to JupyterLab (None: too late)."""
    client, begun = AsyncHTTPClient(), time.monotonic()

    async def ask(path: str, **more: object) -> HTTPResponse:
        return await client.fetch(
            door + path, follow_redirects=False, raise_error=False, request_timeout=90, **more
        )

    answer = await ask("/", method="POST", body=urlencode({"student": student, "code": code}))
    place = answer.headers.get("Location", "")
    if "/lab" not in place:
        page = await ask(place)
        if page.code == 200 and not re.search(rb"place in the queue: [0-9]+", page.body):
            raise RuntimeError(page.body)
    told = time.monotonic() - begun
    wait = place
    while "/lab" not in place and time.monotonic() < until:
        await asyncio.sleep(PAUSE)
        place = (await ask(wait)).headers.get("Location", "")
    return told, time.monotonic() - begun if "/lab" in place else None


async def measure(folder: Path, count: int, patience: float) -> None:
    """Let them come, and print what each waited."""
    try:
        prepare_separation(folder)
        separate = can_separate()
    except BadRequest as refusal:
        print(refusal)
        separate = False
    known = load_login_codes(folder, [f"student{number}" for number in range(count)])
    shared = make_common_package(Path.cwd())
    rooms = JupyterServers("127.0.0.1", separate=separate)
    house = ServedClass(
        known,
        lambda who: prepare_student_folder(folder, who, packages=[shared]),
        rooms,
        "exercises",
    )
    socket, port = bind_unused_port()
    HTTPServer(make_application(house)).add_socket(socket)
    AsyncHTTPClient.configure(None, max_clients=count)
    try:
        until = time.monotonic() + patience
        door = f"http://127.0.0.1:{port}"
        waits = await asyncio.gather(*[come_in(door, *one, until) for one in known.items()])
    finally:
        rooms.close()
    told, inside = [one[0] for one in waits], [one[1] for one in waits if one[1] is not None]
    print(f"{count} students, separate system users: {'yes' if separate else 'no'}")
    print(f"told a place or let in: median {statistics.median(told):.1f} s, last {max(told):.1f} s")
    if inside:
        print(
            f"JupyterLab within {patience:.0f} s: {len(inside)}, first {min(inside):.1f} s, "
            f"median {statistics.median(inside):.1f} s, last {max(inside):.1f} s"
        )


if __name__ == "__main__":
    number, seconds = (int(one) for one in (*sys.argv[1:], *("30", "300")[len(sys.argv) - 1 :]))
    with tempfile.TemporaryDirectory() as made:
        Path(made).chmod(0o711)
        asyncio.run(measure(Path(made) / "homes", number, seconds))
