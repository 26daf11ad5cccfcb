"""The page of a story as one file, in a real browser: legible, and each effect can be switched."""

import numpy as np
import pytest
from chromium import LEAST_CONTRAST, least_contrast
from open_page import write_log
from test_open_in_browser import TEXTS, kv_shown

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.support.command_line import run_command

pytestmark = [pytest.mark.slow, pytest.mark.browser]
SCREENS = {"phone": {"width": 400, "height": 800}, "desk": {"width": 1100, "height": 900}}


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """The page of an arm with drag."""
    folder = tmp_path_factory.mktemp("arm")
    arm = MECHANISMS["arm"].hide("drag", 1.0)
    log = simulate(arm, Routine(step=5.0), rng=np.random.default_rng(5))
    path = folder / "arm.html"
    file = write_log(log, folder / "arm.wpilog")
    run_command(sysid, name="sysid", arguments=["reconcile", str(file), "--html", str(path)])
    return path


@pytest.mark.parametrize(("screen", "theme"), [("desk", "light"), ("phone", "dark")])
def test_saved_story_loads_nothing_and_is_legible_on_every_screen(browser, told, screen, theme):
    page = browser.new_page(viewport=SCREENS[screen], color_scheme=theme)
    asked, complaints = [], []
    page.on("request", lambda request: asked.append(request.url[:5]))
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(told.as_uri())
    page.locator("#story .headline", has_text="The model is missing drag").wait_for()
    page.locator("form.fixed").wait_for()
    page.wait_for_timeout(300)  # until colors have changed

    assert least_contrast(page, TEXTS) >= LEAST_CONTRAST
    assert page.evaluate("document.documentElement.scrollWidth") <= SCREENS[screen]["width"]
    assert set(asked) == {"file:"}
    with_drag = kv_shown(page)
    page.locator("#models").get_by_label("drag").uncheck()
    page.locator("form.fixed").wait_for(state="detached")
    truth = MECHANISMS["arm"].gains["kV"]
    assert abs(with_drag - truth) < 0.02 * truth < abs(kv_shown(page) - truth)
    assert complaints == []
    page.close()
