"""The page of ``sysid open`` as one file: it needs no server."""

import base64
import json
import re
from dataclasses import asdict
from itertools import product
from pathlib import Path
from typing import Any

from sim.cli.fit.paste import CONTROLLERS, LANGUAGES, SEASONS
from sim.cli.open import page_data
from sim.cli.open.session import OpenLog, Reading
from sim.cli.open.view import PageView
from sim.core.errors import Refusal

PAGE = Path(__file__).with_name("page")
ENGINE = Path(__file__).parents[2] / "physics" / "engine" / "simulate.js"  # the page uses it, too
POLICY = """<meta http-equiv="Content-Security-Policy" content="default-src 'none';
script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; img-src data:">"""
SCRIPTS = """<script type="application/json" id="saved">{}</script>
<script type="importmap">{{"imports": {}}}</script>
<script"""


def render_saved_page(one: OpenLog, reading: Reading) -> str:
    """The page of one log as HTML.

    Raises:
        Refusal: the log cannot be read or fitted.
    """
    text = (PAGE / "index.html").read_text(encoding="utf-8")
    style = re.sub(
        r'url\("(\w+\.svg)"\)',
        lambda found: f'url("{_make_address(PAGE / found[1])}")',
        (PAGE / "style.css").read_text(encoding="utf-8"),
    )
    answers = json.dumps(_collect_answers(one, reading), allow_nan=False)
    modules = {path.name: _make_address(path) for path in (*PAGE.glob("*.js"), ENGINE)}
    return (
        text.replace("<head>", f"<head>{POLICY}")
        .replace("mark.svg", _make_address(PAGE / "mark.svg"))
        .replace('<link rel="stylesheet" href="style.css">', f"<style>{style}</style>")
        .replace("<script", SCRIPTS.format(answers.replace("<", "\\u003c"), json.dumps(modules)), 1)
        .replace(' src="main.js">', '>import "main.js";')
    )


def _make_address(path: Path) -> str:
    """A file of the page as a data address; a module's imports name modules, not files."""
    text = re.sub(r'from "\./(\w+\.js)"', r'from "\1"', path.read_text(encoding="utf-8"))
    kind = "text/javascript" if path.suffix == ".js" else "image/svg+xml"
    return f"data:{kind};base64,{base64.b64encode(text.encode()).decode()}"


def _collect_answers(one: OpenLog, reading: Reading) -> dict[str, Any]:
    """The address of each request that the page can make -> its answer."""
    of_log = f"logs/{one.number}"
    answers = {
        "view": asdict(PageView()),
        "live": {"follows": False},
        "logs": [{"id": one.number, "name": one.name}],
        f"{of_log}/summary": page_data.describe_log(one, reading),
        f"{of_log}/samples": base64.b64encode(
            page_data.pack_samples(one.combine_runs(reading))
        ).decode(),
        f"{of_log}/faults": page_data.describe_faults(one.inspect(reading), one),
        f"{of_log}/fit": page_data.describe_fit(one, reading),
        f"{of_log}/directions": page_data.describe_directions(one, reading),
    }
    for language, season in product((*LANGUAGES, *CONTROLLERS), SEASONS):
        query = {"language": language, "season": season}
        try:
            answer: dict[str, Any] = page_data.write_code(one, reading, query)
        except Refusal as refusal:
            answer = {"refusal": page_data.describe_refusal(refusal, str(one.path))}
        answers[f"{of_log}/code?language={language}&season={season}"] = answer
    return answers
