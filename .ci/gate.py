"""The gate: the README's two commands as printed, then slow tests, lint, types, spelling, pages.

Everything runs in a virtual environment made for this run, so nothing that happens to be installed
on the machine can help.
"""

import io
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path
from typing import NoReturn
from urllib.error import URLError
from urllib.request import Request, urlopen

ROOT = Path(__file__).resolve().parents[1]
NODE = ROOT / "build" / "node" / "bin"  # where prepare_machine.py puts what comes from npm
SCREEN = 10.0  # [s] from the end of the install to the first useful screen
PATIENCE = 1320.0  # [s] for one command: the tests have to leave time for the rest
SCREEN_SAYS = "Next:"  # how the line begins that says what to do
EVERYTHING = ("-n", "logical", "--dist", "loadscope", "--no-loadscope-reorder")
INSTALLED_SAYS = "Installed"  # how the line begins that ends the install
# what people read, and the code that prints it
PROSE = (
    "README.md INSTRUCTORS.md CONTRIBUTING.md CHANGELOG.md lessons exercises solutions grader sim"
)
OK = 200  # HTTP's word for it


def main() -> None:
    """Run every step; leave with 1 at the first that fails."""
    started = time.monotonic()
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")  # a Windows console may lack a sign
    with tempfile.TemporaryDirectory(prefix="gate-") as folder:
        environment = make_environment(Path(folder) / "env")
        start, test = list_commands()
        say(f"README, first command: {start}")
        watch(start, environment)
        say(f"README, second command: {test}")
        run(shlex.split(test), environment)
        say("the slow tests")
        run(["python", "-m", "pytest", *EVERYTHING, "-m", "slow"], environment)
        for step in (
            "ruff check .",
            "ruff format --check .",
            "mypy",
            "lint-imports",
            f"codespell {PROSE}",
            "mkdocs build --strict -f .ci/mkdocs.yml",
        ):
            say(step)
            run(step.split(), environment)
    say(f"all green after {time.monotonic() - started:.0f} s")


def say(line: str) -> None:
    """Print a step's name at once."""
    print(f"\n=== {line}", flush=True)


def list_commands() -> tuple[str, str]:
    """The README's two set-up commands, word for word."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    section = text.partition("\n## Set up\n")[2].partition("\n## ")[0]
    found = [block.strip() for block in re.findall(r"```shell\n(.*?)```", section, flags=re.DOTALL)]
    if len(found) != 2 or any("\n" in command for command in found):  # noqa: PLR2004 - two it says
        fail(f"README.md, 'Set up': expected two shell blocks of one line each, found {found}")
    return found[0], found[1]


def make_environment(folder: Path) -> dict[str, str]:
    """Make a virtual environment and the process environment that enters it."""
    venv.create(folder, with_pip=True)
    scripts = folder / ("Scripts" if os.name == "nt" else "bin")
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "PIP_REQUIRE"))}
    return kept | {
        "PATH": os.pathsep.join((str(scripts), str(NODE), os.environ["PATH"])),
        "VIRTUAL_ENV": str(folder),
        "JUPYTER_CONFIG_DIR": str(folder / "jupyter"),
    }


def run(command: list[str], environment: dict[str, str]) -> None:
    """Run a command in the project's folder; its failure is ours."""
    program = shutil.which(command[0], path=environment["PATH"]) or fail(f"no {command[0]} on PATH")
    code = subprocess.run(
        [program, *command[1:]], cwd=ROOT, env=environment, check=False, timeout=PATIENCE
    ).returncode
    if code:
        fail(f"{shlex.join(command)} left with exit code {code}")


def watch(command: str, environment: dict[str, str]) -> None:
    """Run the command that ends in JupyterLab until the lab answers, then close it."""
    words = shlex.split(command)
    program = shutil.which(words[0], path=environment["PATH"]) or fail(f"no {words[0]} on PATH")
    runtime = Path(environment["VIRTUAL_ENV"]) / "runtime"
    running = subprocess.Popen(
        [program, *words[1:]],
        cwd=ROOT,
        env=environment | {"BROWSER": "true", "JUPYTER_RUNTIME_DIR": str(runtime)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
    )
    try:
        waited = wait_for_first_screen(running)
        server = find_lab(runtime)
        shut_down(server)
        running.wait(30)
    finally:
        running.terminate()
        running.wait(30)
    print(f"first useful screen {waited:.1f} s after the install; JupyterLab answered and closed")
    if running.returncode:
        fail(f"{command} left with exit code {running.returncode}")
    if waited > SCREEN:
        fail(f"the first useful screen took {waited:.1f} s, more than {SCREEN:g}")


def wait_for_first_screen(running: "subprocess.Popen[str]") -> float:
    """Seconds from the end of the install to the line that says what to do next."""
    installed = time.monotonic()
    for line in running.stdout or ():
        print(line, end="", flush=True)
        if line.startswith(INSTALLED_SAYS):
            installed = time.monotonic()
        if line.startswith(SCREEN_SAYS):
            break
    else:
        fail("the first screen never came")
    return time.monotonic() - installed


def find_lab(runtime: Path) -> dict[str, str]:
    """Wait until the server that leaves its address in ``runtime`` serves a page."""
    last = time.monotonic() + 60.0
    while time.monotonic() < last:
        for file in runtime.glob("jpserver-*.json"):
            server = json.loads(file.read_text(encoding="utf-8"))
            if is_serving(f"{server['url']}lab?token={server['token']}"):
                return dict(server)
        time.sleep(0.5)
    return fail("JupyterLab never answered")


def shut_down(server: dict[str, str]) -> None:
    """Ask a Jupyter server to end, as its menu does."""
    address = f"{server['url']}api/shutdown"
    headers = {"Authorization": f"token {server['token']}"}
    with urlopen(Request(address, headers=headers, method="POST"), timeout=10):  # noqa: S310 - ours
        pass


def is_serving(address: str) -> bool:
    """Whether a page is served there."""
    try:
        with urlopen(address, timeout=5) as page:  # noqa: S310 - our own server's address
            return bool(page.status == OK)
    except (URLError, ConnectionError, TimeoutError):
        return False


def fail(line: str) -> NoReturn:
    """Leave with one line that says what broke."""
    print(f"\ngate: {line}", file=sys.stderr, flush=True)
    sys.exit(1)


if __name__ == "__main__":
    main()
