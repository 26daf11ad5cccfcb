"""The lessons as pages and slides: executed, whole, with every question, asking no network."""

import re

import nbformat
import pytest

from grader.classroom.edition import SLIDES, build_pages, convert_notebook
from grader.cli import run_command
from sim.core.errors import BadRequest

MARKDOWN, CODE = nbformat.v4.new_markdown_cell, nbformat.v4.new_code_cell
FOLDED = {"jupyter": {"source_hidden": True}}
CELLS = (
    CODE("# Installs the course.", metadata=FOLDED),
    MARKDOWN("# Lesson 1: Measure\n\n[next](02_more.ipynb), [task](../exercises/x/README.md)"),
    MARKDOWN("## 1 Why: it is short\n\n```python\n# ## no heading\n```"),
    CODE("from sim.plot import Table\nprint('1 < 2')\nTable(('gain',), ((0.25,),))"),
    MARKDOWN("**Predict:**"),
    CODE(
        "from grader.notebook.lesson_questions import ChoiceQuestion, NumberQuestion\n"
        "display(ChoiceQuestion('Which way?', ['up & left', 'down'], right='down'),"
        "NumberQuestion('How far?', 7.5, 'm'))",
        metadata=FOLDED,
    ),
    CODE(
        "from sim.plot.animation import Knob\n"
        "from sim.plot.animation.charts import animate_charts, compare_values\n"
        "animate_charts(lambda ramp: compare_values({'kS': ramp}, truth=1.0, xlabel='kS'), "
        "knobs=[Knob('ramp', 'ramp', 0.0, 4.0, 1.0, 3.0)])"
    ),
    MARKDOWN("## 2 System check\n\n- [ ] the robot has room\n\n### Details\n\nmore"),
    MARKDOWN("## 3 Practice\n\nnothing to tick"),
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


def loaded_from_elsewhere(html):
    """What makes a page load something from the network by itself."""
    tag = r"<(?!a\b)\w+\s[^>]*\b(?:src|href)=\"https?:[^>]*>"
    return re.findall(rf"{tag}|\bimport\b[^;]*['\"]https?:[^;]*;|url\(\s*['\"]?https?:[^)]*", html)


def test_a_lesson_becomes_a_page_slides_and_a_part_of_the_handout(lesson, tmp_path):
    first = lesson("01_measure", *CELLS)
    second = lesson("02_more", MARKDOWN("# Lesson 2: More\n\n## System check\n\nagain"))
    build_pages([first, second], tmp_path / "out", print)
    pages = {path.name: path.read_text("utf-8") for path in (tmp_path / "out").iterdir()}

    assert set(pages) == {
        "index.html", "handout.html", "01_measure.html", "01_measure-slides.html", "02_more.html",
        "02_more-slides.html",
    }  # fmt: skip
    page, slides = pages["01_measure.html"], pages["01_measure-slides.html"]
    for text in (page, slides):
        assert re.findall(r"<h2>(.*?)</h2>", text) == [
            "1 Why: it is short", "2 System check", "3 Practice",
        ]  # fmt: skip
        for shown in (
            "# ## no heading",
            "1 &lt; 2",
            "up &amp; left",
            "How far?",
            "With ramp = 3.0",
        ):
            assert shown in text
        assert "right=" not in text
        assert "Installs" not in text
        assert '<a href="02_more.html">next</a>, task' in text
    assert "<title>Lesson 1: Measure</title>" in page
    handout = pages["handout.html"]
    assert re.findall(r"<h2>(.*?)</h2>", handout) == ["Lesson 1: Measure", "Lesson 2: More"]
    assert "the robot has room" in handout
    assert "nothing to tick" not in handout
    for name in re.findall(r'href="([\w-]+\.html)"', "".join(pages.values())):
        assert name in pages
    for name, text in pages.items():
        found = loaded_from_elsewhere(text)
        assert all("/reveal.js@" in one for one in found), name
        assert bool(found) == name.endswith("-slides.html")


def test_check_finds_each_way_to_load_from_elsewhere():
    for html in (
        '<script src="https://a.b/c.js"></script>',
        '<link rel="stylesheet" href="https://a.b/c.css">',
        "<style>@font-face { src: url(https://a.b/c.woff) }</style>",
        "<script>import m from 'https://a.b/c.js';</script>",
    ):
        assert loaded_from_elsewhere(html)
    assert not loaded_from_elsewhere('<a href="https://a.b">a link</a>')


def test_the_answer_is_not_on_the_slide_of_its_question():
    def shown(text):
        return [nbformat.v4.new_output("stream", text=text)]

    cells = [
        MARKDOWN("# Lesson"),
        MARKDOWN("## 1 Why\n\n**Predict:**"),
        CODE("ask()", outputs=shown("which one"), metadata=FOLDED),
        CODE("tell()", outputs=shown("that one")),
    ]
    slides = convert_notebook(nbformat.v4.new_notebook(cells=cells), SLIDES).split("<section")

    (asked,) = (slide for slide in slides if "which one" in slide)
    assert "Predict:" in asked
    assert "that one" not in asked
    assert any("that one" in slide for slide in slides)


def test_page_shows_no_personal_data(lesson, tmp_path):
    own = tmp_path / "exercises" / "exercise12" / "data" / "ann"
    own.mkdir(parents=True)
    (own / "log.wpilog").write_bytes(b"mine")
    (own.parents[1] / "answers.toml").write_text("", encoding="utf-8")
    code = "from pathlib import Path\nprint(sorted(p.name for p in Path('..').rglob('*.*')))"
    path = lesson("01_look", MARKDOWN("# Lesson 1: Look"), CODE(code))
    build_pages([path], tmp_path / "out", print)

    page = (tmp_path / "out" / "01_look.html").read_text("utf-8")

    assert "answers.toml" in page
    assert "log.wpilog" not in page


def test_a_lesson_that_fails_gets_one_line_and_no_page(lesson, tmp_path, monkeypatch, capsys):
    path = lesson("01_broken", MARKDOWN("# Lesson 1"), CODE("1 / 0"))
    (tmp_path / "exercises").mkdir()
    monkeypatch.chdir(tmp_path)

    for says in ("ZeroDivisionError", "JSON"):
        assert run_command(["edition", "-o", "out"]) == 2
        said = capsys.readouterr().err
        assert "01_broken.ipynb: cannot be run: " in said
        assert says in said
        assert not (tmp_path / "out").exists()
        path.write_text("<<<<<<< mine", encoding="utf-8")


def test_no_lessons_are_refused(tmp_path):
    with pytest.raises(BadRequest, match="no lessons"):
        build_pages([], tmp_path, print)
