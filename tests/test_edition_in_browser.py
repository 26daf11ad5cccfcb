"""The edition in a real browser: it moves and fits a phone without a network or a server."""

import nbformat
import pytest

from grader.edition import build_pages

pytestmark = [pytest.mark.slow, pytest.mark.browser]

PHONE = {"width": 390, "height": 844}
CODE = (
    "import numpy as np\nfrom sim.plot.animation import *\nt = np.arange(0.0, 1.0, 0.02)\n"
    "animate_mechanism('arm', Scene(t, (Motion('arm', position=t),)), "
    "panels=(Panel('position', 'angle [rad]'),), alt='An arm rises.')"
)
WIDE = "# Lesson\n\n| " + " | ".join(["a long heading"] * 8) + " |\n|" + "---|" * 8


def test_pages_need_no_network_and_slides_without_one_are_a_long_page(browser, tmp_path):
    cells = [nbformat.v4.new_markdown_cell(WIDE), nbformat.v4.new_code_cell(CODE)]
    notebook = tmp_path / "lessons" / "01_arm.ipynb"
    notebook.parent.mkdir()
    nbformat.write(nbformat.v4.new_notebook(cells=cells), notebook)
    build_pages([notebook], tmp_path / "out", print)

    for name, asks in (("01_arm.html", False), ("01_arm-slides.html", True)):
        asked, complaints = [], []
        page = browser.new_page(viewport=PHONE, reduced_motion="reduce")
        page.context.set_offline(True)
        page.on("request", lambda request, asked=asked: asked.append(request.url))
        page.on("pageerror", lambda error, said=complaints: said.append(str(error)))
        page.goto((tmp_path / "out" / name).as_uri())

        page.locator("figure[data-alive]").wait_for()
        assert page.get_by_role("heading", name="Lesson").is_visible()
        assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
        assert complaints == []
        assert all("/reveal.js@" in one for one in asked[1:])
        assert (len(asked) > 1) == asks
        page.close()
