"""The layout file with which AdvantageScope shows what ``sysid fit --wpilog`` wrote.

AdvantageScope opens it with File > Import Layout…, and then the log. The keys are those of its own
exports since version 4: ``hubs``, ``satellites``, ``version``; it asks before it takes the file of
another version. Source: its ``src/main/electron/main.ts``, and the layout that AdvantageKit's
TalonFX swerve template brings.
"""

import hashlib
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from sim.report.page_file import write_page_file

SUFFIX = ".layout.json"  # in place of the log's .wpilog
VERSION = "26.0.0"
DOCUMENTATION, LINE_GRAPH = 0, 1  # types of a tab
COLORS = ("#2b66a2", "#e5b31b", "#af2437", "#80588e")  # AdvantageScope accepts no others
NO_CONVERSION = {"type": None, "factor": 1}


def choose_layout_path(log: Path) -> Path:
    """The path of the layout file that ``write_layout`` writes beside a log."""
    return log.with_suffix(SUFFIX)


def write_layout(log: Path, tops: Sequence[str]) -> None:
    """Write an AdvantageScope layout beside a log, with tabs for velocities and residuals.

    Args:
        log: path of the log that ``write_replay`` wrote.
        tops: the path above the entries of each part: ``/sysid/left``.

    Raises:
        BadRequest: the file cannot be written.
    """
    tabs = [_make_tab("", DOCUMENTATION, None)]
    for top in tops:
        name = top.rpartition("/")[2] if len(tops) > 1 else ""
        texts = (f"{top}/test", f"{top}/fault")
        velocity = _make_graph(
            (f"{top}/measured/velocity", f"{top}/simulated/velocity"), (f"{top}/voltage",), texts
        )
        residual = _make_graph(
            (f"{top}/residual/velocity", f"{top}/innovation/velocity"),
            (f"{top}/residual/position", f"{top}/innovation/position"),
            texts,
        )
        tabs += [
            _make_tab(f"{name} velocity".strip(), LINE_GRAPH, velocity),
            _make_tab(f"{name} residual".strip(), LINE_GRAPH, residual),
        ]
    state = {
        "sidebar": {"width": 300, "expanded": ["/sysid", *(tops if len(tops) > 1 else ())]},
        "tabs": {"selected": 1, "tabs": tabs},
    }
    hub = {"x": 100, "y": 100, "width": 1100, "height": 650, "state": state}
    content = {"hubs": [hub], "satellites": [], "version": VERSION}
    write_page_file(json.dumps(content, indent=2), choose_layout_path(log))


def _make_tab(title: str, kind: int, controller: dict[str, Any] | None) -> dict[str, Any]:
    return {
        "type": kind,
        "title": title,
        "controller": controller,
        "controllerUUID": hashlib.sha256(title.encode()).hexdigest()[:32],
        "renderer": "#/" if kind == DOCUMENTATION else None,
        "controlsHeight": 0 if kind == DOCUMENTATION else 200,
    }


def _make_graph(left: Sequence[str], right: Sequence[str], texts: Sequence[str]) -> dict[str, Any]:
    """The state of a line graph: numbers on its left and right axis, and texts as stripes."""
    colors = iter(COLORS)
    return {
        "leftSources": [_make_number_source(key, next(colors)) for key in left],
        "rightSources": [_make_number_source(key, next(colors)) for key in right],
        "discreteSources": [
            _make_source("stripes", key, "String", {"color": color})
            for key, color in zip(texts, COLORS, strict=False)
        ],
        "leftLockedRange": None,
        "rightLockedRange": None,
        "leftUnitConversion": NO_CONVERSION,
        "rightUnitConversion": NO_CONVERSION,
        "leftFilter": 0,
        "rightFilter": 0,
    }


def _make_number_source(key: str, color: str) -> dict[str, Any]:
    return _make_source("stepped", key, "Number", {"color": color, "size": "normal"})


def _make_source(kind: str, key: str, of: str, options: dict[str, str]) -> dict[str, Any]:
    return {"type": kind, "logKey": key, "logType": of, "visible": True, "options": options}
