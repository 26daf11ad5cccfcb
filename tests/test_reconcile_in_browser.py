"""The page of a story in a real browser: alone, legible in both themes, on every screen."""

import pytest
from chromium import LEAST_CONTRAST, least_contrast
from story_made import STORIES
from test_report_in_browser import TEXTS

from sim.reconcile.story_text import write_headline
from sim.report.story import write_story

pytestmark = pytest.mark.browser
SCREENS = {"phone": {"width": 400, "height": 800}, "desk": {"width": 1100, "height": 900}}


@pytest.mark.parametrize("name", ["ambiguous", "unexplained"])
def test_a_story_is_alone_and_legible_on_every_screen(browser, tmp_path, name):
    path = tmp_path / "story.html"
    write_story(STORIES[name], path, title="drive.csv")

    for theme in ("light", "dark"):
        for screen, size in SCREENS.items():
            asked, complaints = [], []
            page = browser.new_page(viewport=size, color_scheme=theme)
            page.on("request", lambda request, asked=asked: asked.append(request.url[:5]))
            page.on("console", lambda message, all_=complaints: all_.append(message.text))
            page.goto(path.as_uri())

            assert least_contrast(page, TEXTS) >= LEAST_CONTRAST, (theme, screen)
            assert page.evaluate("document.documentElement.scrollWidth") <= size["width"]
            assert page.get_by_text(write_headline(STORIES[name])).is_visible()
            assert page.locator("#overlays img").last.is_visible()  # open without a click
            for picture in page.locator("img").all():
                width = picture.evaluate("image => image.decode().then(() => image.naturalWidth)")
                assert width > 0
            assert set(asked) <= {"file:", "data:"}
            assert complaints == []
            page.close()
