"""Every page for everybody: axe-core finds nothing, consoles have no error, phones have room."""

import nbformat
import numpy as np
import pytest
from chromium import list_violations
from open_page import drive_log, served, slipped_log, write_log
from test_class_exports import student
from test_open_in_browser import DESKTOP, PHONE, drop, opened, write_strange

from grader.classroom.edition import build_pages
from grader.classroom.result_pages import write_pages
from grader.classroom.results import ClassResults
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli.open.saved_page import save_page
from sim.cli.open.session import OpenLog, Reading
from sim.reconcile import reconcile

pytestmark = [pytest.mark.slow, pytest.mark.browser]


CODE = (
    "import numpy as np\nfrom sim.plot.animation import *\nt = np.arange(0.0, 1.0, 0.02)\n"
    "animate_mechanism('arm', Scene(t, (Motion('arm', position=t),)), "
    "panels=(Panel('position', 'angle [rad]'),), alt='An arm rises.')"
)
WIDE = "# Lesson\n\n| " + " | ".join(["a long heading"] * 8) + " |\n|" + "---|" * 8


def test_pages_need_no_network_and_offline_slides_become_a_long_page(browser, tmp_path):
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


@pytest.mark.parametrize(("viewport", "theme"), [(DESKTOP, "light"), (PHONE, "dark")])
def test_page_of_sysid_open_is_accessible_in_each_view(browser, tmp_path, viewport, theme):
    (tmp_path / "session").mkdir()
    with served(tmp_path / "session") as server:
        server.session.warm_up()
        with opened(browser, server.address, viewport, theme) as page:
            found = {"empty": list_violations(page)}
            drop(page, write_log(slipped_log(), tmp_path / "slipped.csv"))
            page.locator("#gain-kV").wait_for()
            page.locator("li.fault h3").wait_for()
            found["log"] = list_violations(page)
            page.locator("#views [value=signals]").click()
            found["signals"] = list_violations(page)
            page.locator("#paste").click()
            page.locator("#code-text", has_text="kV").wait_for()
            found["code"] = list_violations(page)
            page.get_by_role("button", name="Close", exact=True).click()
            page.locator("#feedback").click()
            page.locator("#loop-gains dd", has_text="kP").first.wait_for()
            found["feedback"] = list_violations(page)
            page.get_by_role("button", name="Close", exact=True).click()
            assert page.complaints == []
            drop(page, write_strange(tmp_path))
            page.get_by_text("Which entries are the signals?").wait_for()
            found["wizard"] = list_violations(page)

    assert {name: wrong for name, wrong in found.items() if wrong} == {}


def write_files(folder):
    """Saved pages, one with a story; the pages of a class, and of the edition with its slides."""
    one = OpenLog(1, "log.csv", write_log(drive_log(), folder / "log.csv"))
    save_page(one, Reading(), folder / "s.html")
    arm = MECHANISMS["arm"].hide("drag", 1.0)
    log = simulate(arm, Routine(step=5.0), rng=np.random.default_rng(5))
    one = OpenLog(1, "arm.csv", folder, finished={"": log})
    save_page(one, Reading(), folder / "story.html", reconcile(log, type="arm"))
    people = (student("Ada", [1.0, 2.0]), student("Bo", [0.0, 2.0]))
    write_pages(ClassResults("Robotics 1", people, ("exercise1",)), folder)
    cells = [nbformat.v4.new_markdown_cell(WIDE), nbformat.v4.new_code_cell(CODE)]
    notebook = folder / "lessons" / "01_arm.ipynb"
    notebook.parent.mkdir()
    nbformat.write(nbformat.v4.new_notebook(cells=cells), notebook)
    build_pages([notebook], folder / "edition", print)
    return sorted(folder.rglob("*.html"))


def is_error(message):
    """Whether a console shows an error that is not of the network: formulas come from a server."""
    return message.type == "error" and "net::ERR_" not in message.text


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_every_saved_page_is_accessible(browser, tmp_path, theme):
    wrong, complaints = {}, []
    for file in write_files(tmp_path):
        page = browser.new_page(viewport=DESKTOP, color_scheme=theme)
        page.on("pageerror", lambda one: complaints.append(str(one)))
        page.on("console", lambda one: complaints.append(one.text) if is_error(one) else None)
        page.goto(file.as_uri())
        if file.name in {"s.html", "story.html"}:
            page.locator("#gain-kV").wait_for()
        if file.name == "story.html":
            page.locator("#story .gains-table", has_text="with drag").wait_for()
        if found := list_violations(page):
            wrong[file.name] = found
        page.close()

    assert wrong == {}
    assert complaints == []


def test_check_finds_a_picture_without_alt_text(browser):
    page = browser.new_page()
    page.set_content("<html lang=en><title>a</title><main><h1>a</h1><img src=x></main>")

    assert [rule for rule, _ in list_violations(page)] == ["image-alt"]
    page.close()
