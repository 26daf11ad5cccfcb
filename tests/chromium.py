"""A Chromium without a window, and how legible a page is in it."""

import contextlib
import shutil

import pytest
from places import ROOT

AXE = ROOT / "build" / "node" / "lib" / "node_modules" / "axe-core" / "axe.min.js"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = [
    "--no-sandbox",  # a container runs as root, where the sandbox cannot start
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
LEAST_CONTRAST = 4.5  # of text against its ground: WCAG 2.2, level AA
FAINTEST = """(selector) => {
    const canvas = new OffscreenCanvas(1, 1).getContext('2d', {willReadFrequently: true});
    const paint = (...colors) => {
        canvas.clearRect(0, 0, 1, 1);
        for (const color of colors) {
            canvas.fillStyle = color;
            canvas.fillRect(0, 0, 1, 1);
        }
        return [...canvas.getImageData(0, 0, 1, 1).data];
    };
    const light = (...colors) => paint(...colors).slice(0, 3).map(c => c / 255)
        .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const ground = node => {
        for (; node; node = node.parentElement) {
            const color = getComputedStyle(node).backgroundColor;
            if (paint(color)[3] === 255) return color;
        }
        return 'white';
    };
    const seen = [...document.querySelectorAll(selector)].filter(node => node.checkVisibility());
    return Math.min(...seen.map(node => {
        const under = ground(node);
        const [a, b] = [light(under, getComputedStyle(node).color), light(under)];
        return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    }));
}"""

SETTLED = """() => new Promise(done => {  // when no color changes any more
    setTimeout(done, 400);
    const finish = () => Promise.all(document.getAnimations().map(one => one.finished));
    setTimeout(() => finish().then(done, done), 20);
})"""


@contextlib.contextmanager
def launched():
    """The browser; without one the test is skipped."""
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


def least_contrast(page, selector):
    """The smallest contrast of the texts that a CSS selector finds."""
    return page.evaluate(FAINTEST, selector)


def require_axe():
    """Skip the test without axe-core, which .ci/prepare_machine.py installs."""
    if not AXE.is_file():
        pytest.skip("axe-core is not installed: python .ci/prepare_machine.py")


def list_violations(page):
    """What axe-core finds wrong with a page for people with disabilities: rule and places.

    Without axe-core the test is skipped.
    """
    require_axe()
    if not page.evaluate("typeof axe !== 'undefined'"):
        page.evaluate(AXE.read_text("utf-8") + "; 0")
    page.evaluate(SETTLED)
    found = page.evaluate("axe.run().then(({violations}) => violations)")
    return [(one["id"], [node["html"][:90] for node in one["nodes"][:3]]) for one in found]
