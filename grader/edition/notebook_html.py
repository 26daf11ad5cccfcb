"""The cells of an executed notebook as HTML that needs no script."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from html import escape
from typing import Any

STATE = "application/vnd.jupyter.widget-state+json"
VIEW = "application/vnd.jupyter.widget-view+json"
NOTE = (
    "<p class='quiet'>In the notebook you can move and click this; here you see how it starts.</p>"
)


@dataclass(frozen=True)
class LessonPart:
    """One section of a lesson: a heading and the cells under it.

    Args:
        heading: its text; the first part's is the title.
        level: 1 for the title, 2 for a section.
        html: everything below, headings of lower rank included.
    """

    heading: str
    level: int
    html: str

    @property
    def anchor(self) -> str:
        """The anchor of the section in links."""
        return re.sub(r"[^a-z0-9]+", "-", self.heading.lower()).strip("-")


def split_notebook(notebook: Any) -> tuple[LessonPart, ...]:  # noqa: ANN401 - nbformat has no types
    """Split an executed notebook at its title and its sections."""
    found: list[tuple[str, int, list[str]]] = []
    for is_markdown, text in render_cells(notebook):
        if not is_markdown:
            found[-1][2].append(text)
            continue
        for level, heading, below in _split_cell(text):
            if level:
                found.append((heading, level, []))
            found[-1][2].append(_render_markdown(below))
    return tuple(LessonPart(heading, level, "\n".join(html)) for heading, level, html in found)


def render_cells(notebook: Any) -> Iterator[tuple[bool, str]]:  # noqa: ANN401 - nbformat has no types
    """The cells of a notebook that a page shows: whether it is markdown, and markdown or HTML.

    Left out are pictures that repeat the sliders above them, and cells that show nothing.
    """
    widgets = notebook.metadata.get("widgets", {}).get(STATE, {}).get("state", {})
    for cell, after in zip(notebook.cells, [*notebook.cells[1:], None], strict=True):
        if _repeats(cell) or (after is not None and _repeats(after)):
            continue  # plain code for whoever has no sliders, and the words before it
        if cell.cell_type == "markdown":
            yield True, cell.source
        elif html := _render_code(cell, widgets):
            yield False, html


def _repeats(cell: Any) -> bool:  # noqa: ANN401 - nbformat has no types
    """Whether a cell shows again what the sliders above it have drawn."""
    return bool(cell.metadata.get("jupyter", {}).get("outputs_hidden"))


def _split_cell(source: str) -> Iterator[tuple[int, str, str]]:
    """A markdown cell cut before each heading of rank 1 or 2: rank, heading, text below."""
    rows: list[str] = []
    level, heading, fenced = 0, "", False
    for row in source.splitlines():
        fenced ^= row.lstrip().startswith("```")
        found = None if fenced else re.match(r"(#{1,2}) (.+)", row)
        if found is None:
            rows.append(row)
            continue
        if level or any(rows):
            yield level, heading, "\n".join(rows)
        level, heading, rows = len(found[1]), found[2].strip(), []
    yield level, heading, "\n".join(rows)


def _render_markdown(text: str) -> str:
    from nbconvert.filters.markdown_mistune import (  # noqa: PLC0415 - only who builds pages
        markdown2html_mistune,
    )

    html: str = markdown2html_mistune(text).replace(" disabled/>", " disabled>")  # as HTML has it
    html = re.sub(r'<a class="anchor-link"[^>]*>.*?</a>', "", html)
    html = html.replace("<table>", "<div class='wide'><table>").replace(
        "</table>", "</table></div>"
    )
    html = re.sub(r'href="(\w+)\.ipynb"', r'href="\1.html"', html)  # another page of the edition
    # An edition has no exercises: what leads out of its folder is text, no link.
    return re.sub(r'<a href="\.\./[^"]*">(.*?)</a>', r"\1", html)


def _render_code(cell: Any, widgets: Mapping[str, Any]) -> str:  # noqa: ANN401 - nbformat has no types
    shown = "".join(_render_output(one, widgets) for one in cell.get("outputs", []))
    if cell.metadata.get("jupyter", {}).get("source_hidden"):
        return shown  # the code of a quick check holds the answer
    source = highlight_python(cell.source)
    return f"<details><summary>Code</summary>{source}</details>{shown}"


def highlight_python(source: str) -> str:
    """Python code with bold keywords: legible on light and on dark pages alike."""
    from pygments import highlight  # type: ignore[import-untyped]  # noqa: PLC0415 - as above
    from pygments.formatters import (  # type: ignore[import-untyped]  # noqa: PLC0415 - no types
        HtmlFormatter,
    )
    from pygments.lexers import (  # type: ignore[import-untyped]  # noqa: PLC0415 - no types
        PythonLexer,
    )

    return str(highlight(source, PythonLexer(), HtmlFormatter(cssclass="code")))


def _render_output(output: Any, widgets: Mapping[str, Any]) -> str:  # noqa: ANN401 - nbformat has no types
    if output.output_type == "stream":
        return f"<pre>{escape(output.text)}</pre>"
    data = output.get("data", {})
    if VIEW in data:
        return NOTE + _render_widget(data[VIEW]["model_id"], widgets)
    if "text/html" in data:
        return f"<div class='wide'>{data['text/html']}</div>"
    return f"<pre>{escape(data.get('text/plain', ''))}</pre>"


def _render_widget(model: str, widgets: Mapping[str, Any]) -> str:
    """A widget as it is first shown: its words, its choices, what it drew."""
    model = model.removeprefix("IPY_MODEL_")
    state = widgets.get(model, {}).get("state", {})
    inside = "".join(_render_widget(child, widgets) for child in state.get("children", ()))
    kind = state.get("_model_name", "")
    if kind == "HTMLModel":
        return f"<div class='wide'>{state.get('value', '')}</div>"
    if "_options_labels" in state:
        listed = "".join(f"<li>{escape(one)}</li>" for one in state["_options_labels"])
        return f"<p>{escape(state.get('description', ''))}</p><ul>{listed}</ul>"
    if "value" in state and state.get("description"):
        return f"<p>{escape(state['description'])}: {escape(str(state['value']))}</p>"
    return inside
