"""The edition in a real browser: it moves, fits a phone, and its slides fit the screen."""

import nbformat
import pytest

from grader.edition import build_pages

pytestmark = pytest.mark.browser

PHONE = {"width": 390, "height": 844}
PROJECTOR = {"width": 1366, "height": 768}
MARKDOWN, CODE = nbformat.v4.new_markdown_cell, nbformat.v4.new_code_cell


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_edition_moves_without_a_server_and_fits_a_phone(scheme, browser, tmp_path):
    code = (
        "import numpy as np\nfrom sim.plot.animation import *\nt = np.arange(0.0, 1.0, 0.02)\n"
        "animate_mechanism('arm', Scene(t, (Motion('arm', position=t),)), "
        "panels=(Panel('position', 'angle [rad]'),), alt='An arm rises.')"
    )
    wide = "# Lesson\n\n| " + " | ".join(["a long heading"] * 8) + " |\n|" + "---|" * 8
    cells = [nbformat.v4.new_markdown_cell(wide), nbformat.v4.new_code_cell(code)]
    notebook = tmp_path / "lessons" / "01_arm.ipynb"
    notebook.parent.mkdir()
    nbformat.write(nbformat.v4.new_notebook(cells=cells), notebook)
    build_pages([notebook], tmp_path / "out")
    asked = []
    page = browser.new_page(viewport=PHONE, color_scheme=scheme, reduced_motion="reduce")
    page.on("request", lambda request: asked.append(request.url))
    page.goto((tmp_path / "out" / "01_arm.html").as_uri())

    page.locator("figure[data-alive]").wait_for()
    assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    assert len(asked) == 1
    page.close()


def test_no_slide_is_taller_than_the_screen_and_keys_turn_them(browser, tmp_path):
    words = "\n\n".join(["This paragraph is a few words long, and says little. " * 6] * 12)
    rows = "\n".join(f"| {k} | b |" for k in range(40))
    text = f"# Lesson\n\nShort.\n\n## 1 Why\n\n{words}\n\n| a | b |\n|---|---|\n{rows}"
    notebook = tmp_path / "lessons" / "01_words.ipynb"
    notebook.parent.mkdir()
    cells = [MARKDOWN(text), CODE("from sim.plot import *\nplot_relative_change({'kS': 1.2})")]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), notebook)
    build_pages([notebook], tmp_path / "out")
    page = browser.new_page(viewport=PROJECTOR)
    complaints = []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto((tmp_path / "out" / "01_words-slides.html").as_uri())
    slides = page.locator(".slide")
    slides.nth(3).wait_for(state="attached")

    for number in range(slides.count()):
        slide = slides.nth(number)
        assert slide.is_visible()
        tall = slide.evaluate("slide => [slide.scrollHeight, slide.clientHeight]")
        assert tall[0] <= tall[1] == PROJECTOR["height"], slide.inner_text()[:60]
        page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowLeft")
    assert slides.nth(slides.count() - 2).is_visible()
    assert page.locator(".slide p").count() >= 13  # nothing was lost
    assert page.locator(".slide tr").count() > 40
    assert complaints == []
    page.close()
