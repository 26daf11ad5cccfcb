"""Derive the lessons' notebooks from their text: lessons/*.py -> lessons/*.ipynb.

    python .ci/derive_notebooks.py            all of them
    python .ci/derive_notebooks.py --check    only say which are out of date; exit code 1 if any is

The text is what people edit. A notebook holds no outputs, and deriving it again changes nothing.
It holds the picture of its lesson from .ci/pictures/, so that it shows it wherever it is opened.
Each begins with a folded cell that installs the course where a notebook is opened alone.
"""

import base64
import hashlib
import re
import sys
from collections import Counter
from pathlib import Path

import jupytext
import nbformat

LESSONS = Path(__file__).resolve().parents[1] / "lessons"
PICTURES = Path(__file__).with_name("pictures")
PICTURE = "picture.png"  # as the text names it: ![words](attachment:picture.png)
LONGEST_IN_SIGHT = 12  # [lines] of a cell
# What a cell does whose code nobody needs to read: import, ask, show a widget, animate, list.
PLUMBING = re.compile(
    r"^(?:import|from) "
    r"|\b(?:ask_question|animate_\w+|ExerciseQuestions|Table|tabulate_\w+)\(",
    re.MULTILINE,
)
INSTALL = """\
# Installs the course where it is missing, for example on Colab.
from importlib.util import find_spec

if find_spec("grader") is None:
    address = input("Address of the course's repository, https://github.com/…: ")
    %pip install --quiet "sysid-course[course] @ git+{address}"
"""
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def derive(text: Path) -> nbformat.NotebookNode:
    """The notebook of a lesson's text, without outputs.

    Folded are the cell that installs the course, long cells, and cells that only import, ask, show
    a widget or a table, or draw an animation.
    """
    notebook = jupytext.read(text, fmt="py:percent")
    notebook.cells.insert(0, nbformat.v4.new_code_cell(INSTALL.strip()))
    notebook.metadata = nbformat.from_dict(
        {"kernelspec": KERNEL, "language_info": {"name": "python"}}
    )
    notebook.nbformat, notebook.nbformat_minor = 4, 5
    seen: Counter[str] = Counter()
    for cell in notebook.cells:
        name = hashlib.sha256(cell.source.encode("utf-8")).hexdigest()[:12]
        seen[name] += 1
        cell.id = name if seen[name] == 1 else f"{name}-{seen[name]}"
        cell.metadata = nbformat.from_dict({})
        lines = [line for line in cell.source.splitlines() if line.strip()]
        folded = (
            cell is notebook.cells[0]
            or len(lines) > LONGEST_IN_SIGHT
            or PLUMBING.search(cell.source)
        )
        if cell.cell_type == "code" and folded:
            cell.metadata = nbformat.from_dict({"jupyter": {"source_hidden": True}})
        if f"(attachment:{PICTURE})" in cell.source:
            drawn = base64.b64encode((PICTURES / f"{text.stem}.png").read_bytes()).decode("ascii")
            cell.attachments = nbformat.from_dict({PICTURE: {"image/png": drawn}})
    nbformat.validate(notebook)
    return notebook


def is_stale(text: Path) -> bool:
    """Whether the notebook beside a lesson's text is missing or says something else."""
    path = text.with_suffix(".ipynb")
    return not path.exists() or path.read_text(encoding="utf-8") != _write_text(derive(text))


def main(arguments: list[str]) -> int:
    """Derive, or check."""
    late = [text for text in sorted(LESSONS.glob("*.py")) if is_stale(text)]
    for text in late:
        if "--check" in arguments:
            print(f"{text.name} was edited: run  python .ci/derive_notebooks.py")
        else:
            text.with_suffix(".ipynb").write_text(
                _write_text(derive(text)), encoding="utf-8", newline="\n"
            )
            print(f"derived {text.with_suffix('.ipynb').name}")
    return 1 if late and "--check" in arguments else 0


def _write_text(notebook: nbformat.NotebookNode) -> str:
    return str(nbformat.writes(notebook)) + "\n"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
