"""The page of a fit in a real browser: alone, legible in both themes, nothing beside the screen."""

import numpy as np
import pytest
from chromium import LEAST_CONTRAST, least_contrast

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.feedback import PRESETS
from sim.fit import fit
from sim.fit.feedback_trial import try_feedback_gains
from sim.report import Report, write_page

PHONE = {"width": 390, "height": 800}

pytestmark = pytest.mark.browser

TEXTS = "h1, h2, h3, p, li, b, a, td, th, caption, summary, pre"


def test_a_page_is_alone_and_legible_on_every_screen(browser, tmp_path):
    log = simulate(MECHANISMS["arm"], Routine(ramp=0.5, step=3.5), rng=np.random.default_rng(1))
    found, preset = fit(log).in_log_units(), PRESETS["rev-brushless"]
    path = tmp_path / "arm.html"
    write_page(Report("arm.wpilog", found, log, preset, try_feedback_gains(found, preset)), path)

    for theme in ("light", "dark"):
        asked, complaints = [], []
        page = browser.new_page(viewport=PHONE, color_scheme=theme)
        page.on("request", lambda request, asked=asked: asked.append(request.url[:5]))
        page.on("console", lambda message, all_=complaints: all_.append(message.text))
        page.goto(path.as_uri())

        assert least_contrast(page, TEXTS) >= LEAST_CONTRAST, theme
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        for picture in page.locator("img").all():
            assert picture.evaluate("image => image.decode().then(() => image.naturalWidth)") > 0
        code = page.get_by_label("Python code for WPILib 2027")
        assert not code.is_visible()
        page.get_by_text("Python, WPILib 2027").click()
        assert code.is_visible()  # chosen without a script
        assert "ArmFeedforward(kS, kG, kV, kA)" in code.inner_text()
        assert set(asked) <= {"file:", "data:"}
        assert complaints == []
        page.close()
