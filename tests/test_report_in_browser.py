"""The page of a fit as one file, in a real browser: alone, legible and alive."""

import pytest
from chromium import LEAST_CONTRAST, least_contrast
from open_page import drive_log, served, slipped_log, write_log
from test_open_in_browser import SET, TEXTS

from sim.cli import sysid
from sim.cli.open.saved_page import render_saved_page
from sim.cli.open.session import OpenLog, Reading
from sim.support.command_line import run_command

PHONE, DESKTOP = {"width": 390, "height": 800}, {"width": 1366, "height": 768}

pytestmark = pytest.mark.browser

HOSTILE = "<b>&amp;<script>alert(1)<"


@pytest.fixture
def saved(browser, tmp_path):
    """Open the page that `sysid fit --html` writes; what it asks for and complains of is noted."""
    pages = []

    def make(log, *options, viewport=DESKTOP, theme="light"):
        file, html = write_log(log, tmp_path / "log.csv"), tmp_path / "log.html"
        arguments = ["fit", str(file), "--html", str(html), *options]
        run_command(sysid, name="sysid", arguments=arguments)
        page = browser.new_page(viewport=viewport, color_scheme=theme)
        pages.append(page)
        page.asked, page.complaints = [], []
        page.on("request", lambda request: page.asked.append(request.url[:5]))
        page.on("console", lambda message: page.complaints.append(message.text))
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.goto(html.as_uri())
        page.locator("#gain-kV").wait_for()
        return page

    yield make
    for page in pages:
        page.close()


@pytest.mark.parametrize(
    ("viewport", "theme"), [(DESKTOP, "light"), (PHONE, "dark")], ids=["desktop", "phone"]
)
def test_saved_page_loads_nothing_and_is_legible_on_every_screen(saved, viewport, theme):
    page = saved(slipped_log(), viewport=viewport, theme=theme)

    page.locator("#fault-lines .link", has_text="encoder slip (sure)").wait_for()
    assert least_contrast(page, TEXTS) >= LEAST_CONTRAST
    assert page.evaluate("document.documentElement.scrollWidth") <= viewport["width"]
    assert set(page.asked) == {"file:"}
    assert page.complaints == []


def test_saved_page_reacts_like_the_page_of_the_server(saved):
    page = saved(drive_log(), "--own-kp", "300", "--loop", "position")

    page.locator("#paste").click()
    page.get_by_label("Language").select_option("python")
    page.locator("#code-text", has_text="SimpleMotorFeedforwardMeters").wait_for()
    page.get_by_label("Season").select_option("2027")
    page.locator("#code-text", has_text="import").wait_for()
    page.get_by_role("button", name="Close", exact=True).click()
    assert "your own gains" in page.locator("#doubts").inner_text()
    page.locator("#gain-kV").evaluate(SET, 3.2)
    page.get_by_text("× that of the fit").wait_for()
    page.locator("#paste").click()
    page.locator("#code-text", has_text="a saved page cannot").wait_for()
    assert not page.get_by_text("Add log").is_visible()
    assert page.complaints == []


def test_saved_page_shows_what_was_on_the_screen(browser, tmp_path):
    html, page, later = tmp_path / "saved.html", browser.new_page(), browser.new_page()
    with served(tmp_path, write_log(slipped_log(), tmp_path / "log.csv")) as server:
        page.goto(f"http://{server.hosts[0]}/{server.word}/")
        page.locator("#fault-lines button.leave").first.click()
        page.locator("#word", has_text="Usable").wait_for()
        page.locator("#gain-kV").evaluate(SET, 2.9)
        page.locator("#word", has_text="Moved by hand").wait_for()
        with page.expect_download() as given:
            page.locator("#report").click()
        given.value.save_as(html)
        shown = {place: page.locator(place).inner_text() for place in ("#meter", "#doubts")}
    later.goto(html.as_uri())
    later.locator("#word", has_text="Moved by hand").wait_for()
    left_out = later.locator("#fault-lines").inner_text()
    kept = {place: later.locator(place).inner_text() for place in shown}
    page.close()
    later.close()

    assert kept == shown
    assert left_out.startswith("Left out: quasistatic-forward")


def test_file_name_is_never_run_as_code(browser, tmp_path):
    one = OpenLog(1, HOSTILE, write_log(drive_log(), tmp_path / "log.csv"))
    html = tmp_path / "log.html"
    html.write_text(render_saved_page(one, Reading()), encoding="utf-8")
    page = browser.new_page()
    complaints = []
    page.on("dialog", lambda dialog: complaints.append(dialog.message))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(html.as_uri())
    page.locator("#gain-kV").wait_for()

    assert page.locator("h1#title").inner_text() == HOSTILE
    assert complaints == []
    page.close()
