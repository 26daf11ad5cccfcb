"""Runs a learner's Python on the bench, inside the process that is confined for it.

Standard input holds a nonce. Once the run is over, the nonce is written to standard output with
the facts, as JSON, behind it: that shows that the program came to its end.
"""

import json
import os
import sys
import threading
import time
from pathlib import Path
from typing import Any

from grader.robotcode.bench import BENCHES, find_bench
from grader.robotcode.bench.facts import to_json
from grader.robotcode.bench.simulation import Mount
from grader.robotcode.library import timing
from grader.robotcode.library.world import WORLD
from grader.robotcode.python.imports import FakeFinder, restore
from grader.robotcode.python.subject import PythonSubject

WANTED = {
    "routine": "SysIdRoutine$",
    "buttons": "",
    "gains": "Feed[fF]orward|Slot0",
}  # in the class
for _one in BENCHES:  # and all that they need
    find_bench(_one)
COURSE = {name: one for name, one in sys.modules.items() if name.partition(".")[0] == "grader"}


def stop_clock() -> None:
    """Let Python's own clock be the bench's."""
    really_sleep = time.sleep

    def sleep(seconds: Any) -> None:
        own = threading.current_thread() is threading.main_thread()
        (timing.wait if own else really_sleep)(float(seconds))

    time.sleep = sleep
    time.time = time.monotonic = time.perf_counter = timing.Timer.getTimestamp


def main() -> None:
    """Carry out the orders of the command line."""
    nonce, orders = sys.stdin.read(), json.loads(sys.argv.pop())
    out = os.dup(1)
    os.dup2(2, 1)  # what the learner's code prints is no word of ours
    for name in [one for one in sys.modules if one.partition(".")[0] in {"child", "sim"}]:
        del sys.modules[name]
    sys.modules.update(COURSE)  # its files can no longer be read
    WORLD.reset("python", assume=orders["assume"])
    mounts = {port: Mount(**mount) for port, mount in orders["mounts"]}
    WORLD.stored = {port: {"inverted": one.inverted} for port, one in mounts.items()}
    sys.meta_path.insert(0, FakeFinder(every=False))
    stop_clock()
    kind = orders["kind"]
    subject = PythonSubject(Path(orders["path"]), Path(orders["root"]), WANTED[kind])
    facts = find_bench(kind)(subject, mounts).run()
    result = {"facts": to_json(facts), "undecided": bool(WORLD.undecided)}
    text = f"{nonce} {restore(json.dumps(result, ensure_ascii=False))}".encode(errors="replace")
    while text:
        text = text[os.write(out, text) :]
    os._exit(0)  # threads of the program may still run
