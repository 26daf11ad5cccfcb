"""The page of a fit in a real browser: alone, legible in both themes, nothing beside the screen."""

import shutil

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.feedback import PRESETS
from sim.fit import fit
from sim.fit.feedback_trial import try_feedback_gains
from sim.report import Report, write_page

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ["--no-sandbox", "--disable-gpu"]  # a container runs as root, where no sandbox can start
LEAST_CONTRAST = 4.5  # of text against its ground: WCAG 2.2, level AA
PHONE = {"width": 390, "height": 800}

pytestmark = pytest.mark.browser

FAINTEST = """() => {
    const channels = color => color.match(/[\\d.]+/g).map(Number);
    const light = ([r, g, b]) => [r, g, b].map(c => c / 255)
        .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const ground = node => {
        for (; node; node = node.parentElement) {
            const color = channels(getComputedStyle(node).backgroundColor);
            if (color.length < 4 || color[3] === 1) return color;
        }
        return [255, 255, 255];
    };
    const texts = document.querySelectorAll(
        'h1, h2, h3, p, li, b, a, td, th, caption, summary, pre');
    return Math.min(...[...texts].map(node => {
        const [a, b] = [light(channels(getComputedStyle(node).color)), light(ground(node))];
        return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    }));
}"""


@pytest.fixture(scope="module")
def browser():
    """A Chromium without a window."""
    playwright = pytest.importorskip(
        "playwright.sync_api", reason="Playwright is not installed: pip install playwright"
    )
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.skip(f"no browser found: install one of {', '.join(BROWSERS)}")
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=found, args=FLAGS, headless=True)
        yield chromium
        chromium.close()


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

        assert page.evaluate(FAINTEST) >= LEAST_CONTRAST, theme
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
