"""Draw the pictures of the README and of the site's first page: .ci/pictures/.

    python .ci/draw_pictures.py

open-light.png and open-dark.png show the page of `sysid open` with an effect that was found
(with Chromium). grade.svg is what `grade exercise4` prints about a mistake.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from io import StringIO
from pathlib import Path

from rich.console import Console
from rich.text import Text

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from sim.cli.open.server import PageServer  # noqa: E402 - the course in this folder
from sim.cli.open.session import Session  # noqa: E402 - the same
from solutions.exercise4.mistakes import MISTAKES  # noqa: E402 - the same

FOLDER = Path(__file__).parent / "pictures"
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
VIEW = {"width": 1200, "height": 1560}  # [px] of the page's picture
MADE = "simulate arm --hide drag --step 5 --seed 5 -o arm.wpilog"
MISTAKE = "a share of the battery, Java"
WIDTH = 84  # [characters] of the terminal


def main() -> int:
    """Draw; the exit code."""
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / "grade.svg").write_text(draw_grade(), encoding="utf-8", newline="\n")
    photograph_page()
    return 0


def run_command(name: str, *arguments: str, folder: str) -> str:
    """What a command prints on a terminal."""
    package = {"grade": "grader", "sysid": "sim"}[name]
    code = f"import sys; sys.path.insert(0, {str(ROOT)!r}); sys.stdout.isatty = lambda: True\n"
    code += f"from {package}.cli import main; main()"
    run = subprocess.run(
        [sys.executable, "-c", code, *arguments], cwd=folder, check=False,
        env=os.environ | {"COLUMNS": str(WIDTH), "FORCE_COLOR": "1", "TERM": "xterm-256color"},
        stdout=subprocess.PIPE, encoding="utf-8",
    )  # fmt: skip
    return run.stdout


def draw_grade() -> str:
    """What `grade exercise4` prints about a mistake, as SVG."""
    mistake = next(one for one in MISTAKES if one.name == MISTAKE)
    with tempfile.TemporaryDirectory() as name:
        for part in ("exercises", "lessons"):
            left = shutil.ignore_patterns("data", "__pycache__")
            shutil.copytree(ROOT / part, Path(name) / part, ignore=left)
        right = (ROOT / "solutions" / "exercise4" / mistake.file).read_text(encoding="utf-8")
        answer = Path(name, "exercises", "exercise4", mistake.file)
        answer.write_text(mistake.edit_text(right), encoding="utf-8")
        printed = run_command("grade", "exercise4", folder=name)
    console = Console(record=True, width=WIDTH, file=StringIO(), color_system="truecolor")
    console.print(Text.from_ansi(f"$ grade exercise4\n{printed.strip()}"))
    svg = console.export_svg(title="grade exercise4", unique_id="grade")
    return re.sub(r"@font-face \{.*?\}", "", svg, flags=re.DOTALL)  # nothing from elsewhere


def photograph_page() -> None:
    """The page of `sysid open` after a search found drag, light and dark, as PNG."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - grade.svg needs no browser

    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        run_command("sysid", *MADE.split(), folder=name)
        server = PageServer(Session(Path(name), [Path(name) / "arm.wpilog"]))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        window = playwright.chromium.launch(executable_path=browser, args=["--no-sandbox"])
        for scheme in ("light", "dark"):
            page = window.new_page(viewport=VIEW, color_scheme=scheme)
            page.goto(server.address)
            page.get_by_role("button", name="Look for what is missing").click()
            page.wait_for_selector("form.fixed", timeout=120_000)
            page.wait_for_timeout(1500)  # [ms] until the curves are drawn
            page.screenshot(path=FOLDER / f"open-{scheme}.png")
        server.shutdown()


if __name__ == "__main__":
    sys.exit(main())
