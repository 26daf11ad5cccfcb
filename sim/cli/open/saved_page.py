"""The page of ``sysid open`` as one file: it needs no server."""

import base64
import json
import re
from collections.abc import Mapping
from dataclasses import asdict
from itertools import combinations, product
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode

from sim.cli.open import page_data
from sim.cli.open.reconcile_job import describe_story, refit_story
from sim.cli.open.session import OpenLog, Reading
from sim.cli.open.view import PageView
from sim.core.errors import Refusal
from sim.reconcile.story import Story
from sim.report.page_file import choose_page_path, write_page_file
from sim.report.robot_code_snippet import SEASONS, TARGETS

if TYPE_CHECKING:
    from sim.reconcile.model_variant import ModelVariant

PAGE = Path(__file__).with_name("page")
SIM = Path(__file__).parents[2]
# Modules of others that the page uses, too
SHARED = (SIM / "physics" / "engine" / "simulate.js", SIM / "plot" / "animation" / "ticks.js")
OF_LOG = ("summary", "faults", "directions")  # requests that name no model
MOST_SWITCHED = 3  # effects of which each combination is fitted; of more, only all together
POLICY = """<meta http-equiv="Content-Security-Policy" content="default-src 'none';
script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; img-src data:">"""
SCRIPTS = """<script type="application/json" id="saved">{}</script>
<script type="importmap">{{"imports": {}}}</script>
<script"""


def save_page(one: OpenLog, reading: Reading, target: Path, story: Story | None = None) -> None:
    """Write the page of one log; if that fails, an existing file stays as it was.

    Args:
        one: the log.
        reading: how to read the log, and what to leave out.
        target: path of the page.
        story: a result of reconcile to show with it.

    Raises:
        Refusal: the log cannot be read, the name does not end in .html, or it cannot be written.
    """
    write_page_file(render_saved_page(one, reading, story), choose_page_path(target))


def render_saved_page(
    one: OpenLog,
    reading: Reading,
    story: Story | None = None,
    chosen: Mapping[str, str] | None = None,
) -> str:
    """The page of one log as HTML.

    Args:
        one: the log.
        reading: how to read the log, and what to leave out.
        story: a result of reconcile to show with it.
        chosen: effects to tick, and gains that were moved; None ticks those of the story.

    Raises:
        Refusal: the log cannot be read.
    """
    text = (PAGE / "index.html").read_text(encoding="utf-8")
    style = re.sub(
        r'url\("(\w+\.svg)"\)',
        lambda found: f'url("{_make_address(PAGE / found[1])}")',
        (PAGE / "style.css").read_text(encoding="utf-8"),
    )
    choices = {"logs": {one.number: _describe_choices(one, reading, story, chosen)}}
    data = _collect_answers(one, reading, story) | {"choices": choices}
    answers = json.dumps(data, allow_nan=False)
    modules = {path.name: _make_address(path) for path in (*PAGE.glob("*.js"), *SHARED)}
    return (
        text.replace("<head>", f"<head>{POLICY}")
        .replace("mark.svg", _make_address(PAGE / "mark.svg"))
        .replace('<link rel="stylesheet" href="style.css">', f"<style>{style}</style>")
        .replace("<script", SCRIPTS.format(answers.replace("<", "\\u003c"), json.dumps(modules)), 1)
        .replace(' src="main.js">', '>import "main.js";')
    )


def _describe_choices(
    one: OpenLog, reading: Reading, story: Story | None, chosen: Mapping[str, str] | None
) -> dict[str, Any]:
    """What the user has chosen on the page, as the page keeps it."""
    named = (chosen or {}).get("effects", "").split(",")
    effects = None if chosen is None else list(filter(None, named))
    spans = {  # two sides of a drivetrain have the same tests
        (run.test, float(time[0]), float(time[-1])): None
        for part in reading.left_out
        for run in one.combine_runs(reading).runs
        if (time := run.time[part.find(run)]).size
    }
    return {
        "leftOut": [{"test": test, "start": start, "end": end} for test, start, end in spans],
        "moved": page_data.read_moved_gains(chosen or {}),
        **({} if story is None else {"settings": {}, "effects": effects}),
    }


def _make_address(path: Path) -> str:
    """A file of the page as a data address; a module's imports name modules, not files."""
    text = re.sub(r'from "\./(\w+\.js)"', r'from "\1"', path.read_text(encoding="utf-8"))
    kind = "text/javascript" if path.suffix == ".js" else "image/svg+xml"
    return f"data:{kind};base64,{base64.b64encode(text.encode()).decode()}"


def _collect_answers(one: OpenLog, reading: Reading, story: Story | None) -> dict[str, Any]:
    """The address of each request that the page can make -> its answer."""
    of_log, log = f"logs/{one.number}", one.combine_runs(reading)
    answers = {
        "view": asdict(PageView()),
        "live": {"follows": False},
        "logs": [{"id": one.number, "name": one.name}],
        f"{of_log}/samples": base64.b64encode(page_data.pack_samples(log)).decode(),
    }
    models: dict[str, ModelVariant | None] = {"": None}
    if story is not None:
        told = describe_story(story, {doubt.text for doubt in log.doubts})
        answers[f"{of_log}/reconcile"] = {"words": "", "share": 1.0, "story": told}
        added = told["effects"]
        counts = range(1, len(added) + 1) if len(added) <= MOST_SWITCHED else [len(added)]
        for some in (some for count in counts for some in combinations(added, count)):
            models[",".join(some)] = refit_story(story, some)
    languages = [
        {"language": language, "season": str(season)}
        for language, season in product(TARGETS, SEASONS)
    ]
    requests: list[tuple[str, dict[str, str]]] = [(what, {}) for what in OF_LOG]
    for effects in models:
        model = {"effects": effects} if effects else {}
        requests += [("fit", model), *(("code", model | chosen) for chosen in languages)]
    for what, query in requests:
        address = "?".join(filter(None, (f"{of_log}/{what}", urlencode(query))))
        variant = models[query.get("effects", "")]
        answers[address] = _answer(one, reading, what, query, variant)
    return answers


def _answer(one: OpenLog, *request: Any) -> Any:  # noqa: ANN401 - passed on, and JSON
    """The answer, or the refusal as the page shows it."""
    try:
        return page_data.answer_request(one, *request)
    except Refusal as refusal:
        return {"refusal": page_data.describe_refusal(refusal, str(one.path.parent))}
