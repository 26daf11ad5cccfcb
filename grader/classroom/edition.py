"""The lessons as pages and slides to read without installing anything: executed, whole.

nbclient runs a lesson's notebook, and nbconvert writes it as HTML.
"""

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

from grader.classroom.atomic_files import write_private_file
from sim.core.errors import BadRequest

LONGEST_CELL = 120  # [s] after which a cell counts as hung
VIEW = "application/vnd.jupyter.widget-view+json"
SLIDERS = "(In the notebook, there are sliders and menus here. They draw this picture again.)"
SYSTEM_CHECK = re.compile(r"^## [^\n]*System check\n(.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)
PAGE, SLIDES, BODY = "lab/index.html.j2", "reveal/index.html.j2", "lab/base.html.j2"
BLOCKS = Path(__file__).with_name("edition.html.jinja")


def execute_notebook(path: Path) -> Any:  # noqa: ANN401 - nbformat has no types
    """Execute a notebook in a fresh copy of its course.

    Args:
        path: of the notebook, in the folder ``lessons`` of a course.

    Returns:
        The notebook with its outputs and the state of its widgets.

    Raises:
        BadRequest: it cannot be read, or one of its cells fails.
    """
    import nbformat  # noqa: PLC0415 - only who builds pages needs it
    from nbclient import NotebookClient  # noqa: PLC0415 - the same
    from nbclient.exceptions import (  # noqa: PLC0415 - the same
        CellExecutionError,
        CellTimeoutError,
        DeadKernelError,
    )

    copied = (path.parents[1] / name for name in ("lessons", "exercises", "solutions"))
    left = shutil.ignore_patterns("data", "__pycache__", ".*")
    try:
        notebook = nbformat.read(path, 4)
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as home:
            for folder in filter(Path.is_dir, copied):
                shutil.copytree(folder, Path(home) / folder.name, ignore=left)
            where = {"metadata": {"path": str(Path(home) / path.parent.name)}}
            client = NotebookClient(notebook, timeout=LONGEST_CELL, resources=where)
            # without the kernel's own remarks
            client.execute(env={**os.environ, "IPYTHONDIR": home}, stderr=subprocess.DEVNULL)
    except (CellExecutionError, CellTimeoutError, DeadKernelError, ValueError) as error:
        raise BadRequest(
            f"cannot be run: {str(error).strip().splitlines()[-1]}",
            where=str(path),
            advice="Run the lesson in JupyterLab to see which cell fails.",
        ) from None
    return notebook


def convert_notebook(notebook: Any, template: str = PAGE) -> str:  # noqa: ANN401 - nbformat has no types
    """An executed notebook as HTML.

    A question is shown as text. The code of a folded cell is left out: it may hold the answer.
    A section begins a slide, and what it says and shows goes on slides below: each text with the
    cell after it, and each further cell that shows something, so no answer is beside its question.

    Args:
        notebook: as `execute_notebook` returns it.
        template: ``PAGE``, ``SLIDES``, or ``BODY`` for the cells alone.
    """
    from nbconvert import HTMLExporter, SlidesExporter  # noqa: PLC0415 - only who builds pages

    notebook = deepcopy(notebook)
    notebook.metadata.pop("widgets", None)
    types = ["", *(cell.cell_type for cell in notebook.cells)]
    for before, cell in zip(types, notebook.cells, strict=False):
        hidden = cell.metadata.get("jupyter", {}).get("source_hidden", False)
        if cell.cell_type == "markdown":
            kind = "slide" if re.match("##? ", cell.source) else "subslide"
        else:
            kind = "-" if before == "markdown" else "subslide" if cell.outputs else "skip"
        cell.metadata |= {"transient": {"remove_source": hidden}, "slideshow": {"slide_type": kind}}
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            if data.pop(VIEW, None) and "text/html" in data:
                data["text/html"] = f"<p>{SLIDERS}</p>{data['text/html']}"
    exporter = SlidesExporter(reveal_theme="white") if template == SLIDES else HTMLExporter()
    blocks = BLOCKS.read_text(encoding="utf-8")
    exporter.raw_template = f"{{% extends '{template}' %}}{blocks}"
    exporter.exclude_input_prompt = exporter.exclude_output_prompt = True
    exporter.exclude_anchor_links = True
    return make_accessible(str(exporter.from_notebook_node(notebook)[0]))


def make_accessible(html: str) -> str:
    """HTML whose boxes to tick have a name, and whose wide parts scroll from the keyboard.

    It names no theme of JupyterLab's, so that animations follow the reader's color scheme, too.
    """
    html = html.replace(' data-jp-theme-light="true" data-jp-theme-name="JupyterLab Light"', "")
    html = re.sub(r'<input(?=[^>]*type="checkbox")', '<input aria-label="Done"', html)
    html = re.sub(r'<(pre|div class="wide")(?=[ >])', r'<\1 tabindex="0"', html)
    return re.sub(r"<th[^>]*></th>", "<td></td>", html)


def build_pages(notebooks: Sequence[Path], folder: Path, say: Callable[[str], None]) -> None:
    """Execute lessons, and write their pages and slides, an index, and the handout.

    Args:
        notebooks: in order.
        folder: where the pages go.
        say: called with each lesson's name when it is run.

    Raises:
        BadRequest: there are none, one fails, or a page cannot be written.
    """
    from nbformat.v4 import new_markdown_cell, new_notebook  # noqa: PLC0415 - only who builds pages

    if not notebooks:
        raise BadRequest("there are no lessons", advice="Run this in the course folder.")
    index, checks, pages = "# The SysId course\n", "# Before you enable a test\n", {}
    for path in notebooks:
        say(path.stem)
        notebook = execute_notebook(path)
        texts = [cell for cell in notebook.cells if cell.cell_type == "markdown"]
        for cell in texts:  # a link leads to another page, or is no link: there are no exercises
            cell.source = re.sub(r"\]\((\w+)\.ipynb\b", r"](\1.html", cell.source)
            cell.source = re.sub(r"\[([^\]]*)\]\(\.\./[^)]*\)", r"\1", cell.source)
        whole = "\n\n".join(cell.source for cell in texts)
        title = whole.partition("\n")[0].removeprefix("# ")
        notebook.metadata["title"] = title
        index += f"- [{title}]({path.stem}.html) ([slides]({path.stem}-slides.html))\n"
        checks += "".join(f"\n## {title}\n{found}" for found in SYSTEM_CHECK.findall(whole))
        pages[f"{path.stem}-slides.html"] = convert_notebook(notebook, SLIDES)
        texts[0].source = "[All lessons](index.html)\n\n" + texts[0].source
        pages[f"{path.stem}.html"] = convert_notebook(notebook)
    index += "\n[The system checks of all lessons, to print](handout.html)"
    for name, text in {"handout.html": checks, "index.html": index}.items():
        pages[name] = convert_notebook(new_notebook(cells=[new_markdown_cell(text)]))
    for name, page in pages.items():
        write_private_file(folder / name, page)
