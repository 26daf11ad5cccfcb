"""The lessons as pages: run, whole, readable without installing anything."""

import html
import re

import nbformat
import pytest
from page_flaws import page_flaws

from grader.cli import run_command
from grader.edition import build_pages
from grader.edition.notebook_html import highlight_python, split_notebook
from sim.core.errors import BadRequest
from sim.plot.animation import make_script_source, read_script

MARKDOWN, CODE = nbformat.v4.new_markdown_cell, nbformat.v4.new_code_cell
CELLS = (
    MARKDOWN("# Lesson 1: Measure\n\n*Ten minutes.*"),
    MARKDOWN("## 1 Why: it is short\n\n```python\n# ## no heading\n```\n\n**V = kS**"),
    CODE("from sim.plot import Table\nprint('1 < 2')\nTable(('gain',), ((0.25,),))"),
    CODE(
        "import ipywidgets\nfrom sim.teaching.prediction import Prediction\n"
        "display(Prediction('Which way?', 'up & left', 'down'))\n"
        "ipywidgets.VBox([ipywidgets.IntSlider(3, description='ramp'), "
        "ipywidgets.HTML('<b>as drawn</b>')])"
    ),
    MARKDOWN("## System check\n\n- [ ] the robot has room\n\n### Details\n\nmore"),
)


@pytest.fixture
def lesson(tmp_path):
    """Writes a lesson's notebook into a course of its own."""

    def write(name, *cells):
        path = tmp_path / "lessons" / f"{name}.ipynb"
        path.parent.mkdir(exist_ok=True)
        nbformat.write(nbformat.v4.new_notebook(cells=list(cells)), path)
        return path

    return write


def test_a_lesson_becomes_a_page_slides_and_a_part_of_the_handout(lesson, tmp_path):
    first = lesson("01_measure", *CELLS)
    second = lesson("02_more", MARKDOWN("# Lesson 2: More\n\n## System check\n\nagain"))
    index = build_pages([first, second], tmp_path / "out")
    pages = {path.name: path.read_text("utf-8") for path in (tmp_path / "out").iterdir()}

    assert index.name == "index.html"
    assert set(pages) == {
        "index.html", "handout.html", "01_measure.html", "01_measure-slides.html", "02_more.html",
        "02_more-slides.html",
    }  # fmt: skip
    page = pages["01_measure.html"]
    assert [
        found
        for text in pages.values()
        for found in page_flaws(text)
        if not re.search(r"\d\d_\w+(-slides)?\.html|handout\.html|index\.html|<script>", found)
    ] == []
    assert re.findall(r"<h2>(.*?)</h2>", page) == ["1 Why: it is short", "System check"]
    assert "# ## no heading" in page
    assert "1 &lt; 2" in page
    assert "<b>as drawn</b>" in page
    assert "ramp: 3" in page
    assert "up &amp; left" in page
    assert "In the notebook you can move and click this" in page
    assert 'href="02_more.html">Next' in page
    handout = pages["handout.html"]
    assert handout.count("<section>") == 2
    assert "the robot has room" in handout
    for name in re.findall(r'href="([\w-]+\.html)"', "".join(pages.values())):
        assert name in pages


def test_only_the_scripts_of_the_edition_itself_may_run(lesson, tmp_path):
    text = "# Lesson\n\n<script>alert(1)</script>"
    build_pages([lesson("01_a", MARKDOWN(text))], tmp_path / "out")
    page = (tmp_path / "out" / "01_a-slides.html").read_text("utf-8")
    policy = html.unescape(re.search(r'Policy" content="([^"]*)"', page)[1])
    (own,) = re.findall(r'<script type="module">(.*?)</script>', page, flags=re.DOTALL)

    assert make_script_source(own) in policy
    assert make_script_source(read_script()) in policy
    assert "unsafe" not in policy.partition("script-src")[2]
    for name in ("handout.html", "index.html"):
        assert "script-src" not in (tmp_path / "out" / name).read_text("utf-8")


def test_a_page_shows_nobodys_own_data(lesson, tmp_path):
    own = tmp_path / "exercises" / "exercise12" / "data" / "ann"
    own.mkdir(parents=True)
    (own / "log.wpilog").write_bytes(b"mine")
    (own.parents[1] / "answers.toml").write_text("", encoding="utf-8")
    code = "from pathlib import Path\nprint(sorted(p.name for p in Path('..').rglob('*.*')))"
    build_pages([lesson("01_look", MARKDOWN("# Lesson 1: Look"), CODE(code))], tmp_path / "out")

    page = (tmp_path / "out" / "01_look.html").read_text("utf-8")

    assert "answers.toml" in page
    assert "log.wpilog" not in page


def test_a_lesson_that_fails_is_one_line_and_leaves_no_page(lesson, tmp_path, monkeypatch, capsys):
    lesson("01_broken", MARKDOWN("# Lesson 1"), CODE("1 / 0"))
    (tmp_path / "exercises").mkdir()
    monkeypatch.chdir(tmp_path)

    assert run_command(["edition", "-o", "out"]) == 2
    assert "a cell of 01_broken.ipynb fails: ZeroDivisionError" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_no_lessons_are_refused(tmp_path):
    with pytest.raises(BadRequest, match="no lessons"):
        build_pages([], tmp_path)


def test_a_link_leads_to_another_page_or_nowhere_out_of_the_edition():
    text = (
        "# Lesson\n\n[next](02_more.ipynb), [task](../exercises/exercise1/README.md), "
        "[docs](https://docs.wpilib.org)"
    )
    (part,) = split_notebook(nbformat.v4.new_notebook(cells=[MARKDOWN(text)]))

    links = '<a href="02_more.html">next</a>, task, <a href="https://docs.wpilib.org">'
    assert links in part.html


def test_code_is_escaped():
    assert "&lt;b&gt;" in highlight_python("x = '<b>'")


def test_the_code_of_a_quick_check_and_a_repeated_picture_are_left_out():
    from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output  # noqa: PLC0415 - only here

    shown = [new_output("stream", text="seen")]
    asks, again = {"jupyter": {"source_hidden": True}}, {"jupyter": {"outputs_hidden": True}}
    notebook = new_notebook(
        cells=[
            new_markdown_cell("# Lesson"),
            new_code_cell('QuickCheck(right="kA")', metadata=asks, outputs=shown),
            new_markdown_cell("No sliders? Change the numbers here:"),
            new_code_cell("attempt(0.6)", metadata=again, outputs=shown),
        ]
    )

    (part,) = split_notebook(notebook)

    assert part.html.count("seen") == 1
    assert "kA" not in part.html
    assert "No sliders" not in part.html
