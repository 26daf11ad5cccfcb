"""The lessons as a learner meets them: JupyterLab in a real browser, offline, in both themes."""

import contextlib
import io
import json
import os
import secrets
import shutil
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest
from matplotlib.image import imread

ROOT = Path(__file__).resolve().parents[1]
LESSONS = sorted((ROOT / "lessons").glob("*.ipynb"))
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
SETTINGS = {
    "apputils-extension/notification": {"fetchNews": "false", "checkForUpdates": False},
    "notebook-extension/tracker": {"windowingMode": "none"},  # every cell is in the page
}
HOME = {"127.0.0.1", "localhost"}
LEAST_CONTRAST = 4.5  # of text against its ground: WCAG 2.2, level AA
PATIENCE = 60_000  # [ms] for anything to appear, on a busy machine
OFTEN = 100  # [ms] between two looks; a page that nobody sees draws no frames to wait for

pytestmark = pytest.mark.browser


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


@pytest.fixture
def lab(tmp_path_factory):
    """Fresh JupyterLab on a free local port, over a copy of the lessons: its address."""
    home = tmp_path_factory.mktemp("lab")
    for notebook in LESSONS:
        (home / "lessons").mkdir(exist_ok=True)
        shutil.copy(notebook, home / "lessons")
    for name, setting in SETTINGS.items():
        path = home / "settings" / "@jupyterlab" / f"{name}.jupyterlab-settings"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(setting), encoding="utf-8")
    token = secrets.token_hex(16)
    with (home / "lab.log").open("wb") as log:
        server = subprocess.Popen(
            _command(home, token), env=_environment(home), stdout=log, stderr=log
        )
    try:
        yield f"http://127.0.0.1:{_port(home, server)}/lab/tree/{{name}}?token={token}"
    finally:
        server.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            server.wait(timeout=20)
        server.kill()


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_a_lesson_runs_in_a_browser_without_the_network(lesson, lab, browser, tmp_path):
    hosts, complaints = set(), []
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.set_default_timeout(PATIENCE)
    page.on("request", lambda request: hosts.add(urlsplit(request.url).hostname))
    page.on("pageerror", lambda error: complaints.append(str(error)))

    _run_all(page, lab.format(name=lesson.name))

    assert _outputs(page, "error") == []
    assert _outputs(page, "stderr") == []
    _check_pictures(page)
    _check_knobs(page)
    for theme in ("JupyterLab Light", "JupyterLab Dark"):
        _use_theme(page, theme)
        assert _faintest(page) >= LEAST_CONTRAST, theme
        page.screenshot(path=tmp_path / f"{lesson.stem} {theme}.png")
    page.close()
    assert hosts - {None} <= HOME  # a data: address has no host
    assert complaints == []


def _run_all(page, address):
    """Open a notebook, choose Run > Run All Cells, and wait until the last cell is done."""
    page.goto(address)
    page.locator("#jp-main-statusbar").get_by_text("| Idle").wait_for()  # the kernel is there
    page.locator(".lm-MenuBar-itemLabel", has_text="Run").first.click()
    page.locator(".lm-Menu-itemLabel").get_by_text("Run All Cells", exact=True).click()
    page.wait_for_function(
        """() => {
            const prompts = [...document.querySelectorAll(
                '.jp-CodeCell .jp-InputPrompt')].map(prompt => prompt.textContent.trim());
            return prompts.length && prompts.every(text => /^\\[\\d+\\]:$/.test(text));
        }""",
        polling=OFTEN,
    )
    page.locator("#jp-main-statusbar").get_by_text("| Idle").wait_for()


def _outputs(page, kind):
    """The texts of all outputs of a kind: ``error``, ``stderr``."""
    where = f'[data-mime-type="application/vnd.jupyter.{kind}"]'
    return page.locator(where).all_inner_texts()


def _check_pictures(page):
    """Every picture has come through, says in words what it shows, and is not blank."""
    pictures = page.locator(".jp-Notebook img")
    assert pictures.count() > 0
    for picture in pictures.all():
        picture.scroll_into_view_if_needed()
        assert picture.get_attribute("alt")
        assert picture.evaluate("image => image.decode().then(() => image.naturalWidth)") > 0
        assert _colors(picture.screenshot()) > 50


def _check_knobs(page):
    """Widgets are shown, and turning one draws its picture again."""
    assert page.locator(".jp-Notebook .jupyter-widgets").count() > 0
    assert page.get_by_text("Error displaying widget").count() == 0
    for panel in page.locator(".jp-Notebook .widget-vbox").filter(has=page.locator("img")).all():
        before = panel.locator("img").last.get_attribute("src")
        menu, slider = panel.locator("select"), panel.locator(".noUi-handle")
        if menu.count():
            menu.first.select_option(index=1)
        else:
            slider.first.focus()
            slider.first.press("ArrowRight")
        page.wait_for_function(
            "([panel, before]) => [...panel.querySelectorAll('img')].at(-1)?.src !== before",
            arg=[panel.element_handle(), before],
            polling=OFTEN,
        )


def _use_theme(page, theme):
    page.locator(".lm-MenuBar-itemLabel", has_text="Settings").first.click()
    page.locator(".lm-Menu-itemLabel").get_by_text("Theme", exact=True).hover()
    page.locator(".lm-Menu-itemLabel").get_by_text(theme, exact=True).click()
    page.locator(f'body[data-jp-theme-name="{theme}"]').wait_for(state="attached")


def _faintest(page):
    """The smallest contrast of any text that our pictures and tables put into the page."""
    return page.evaluate(
        """() => {
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
                '.jp-OutputArea td, .jp-OutputArea th, .jp-OutputArea caption, ' +
                '.jp-OutputArea summary, .jp-OutputArea .widget-label, .jp-RenderedMarkdown p');
            return Math.min(...[...texts].map(node => {
                const [a, b] = [light(channels(getComputedStyle(node).color)), light(ground(node))];
                return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
            }));
        }"""
    )


def _colors(png):
    """How many colors a screenshot has: a blank one has one."""
    pixels = (imread(io.BytesIO(png))[:, :, :3] * 255).astype(np.uint32)
    return np.unique(pixels @ np.array([65536, 256, 1], dtype=np.uint32)).size


def _command(home, token):
    return [
        sys.executable,
        "-m",
        "jupyterlab",
        "--no-browser",
        "--allow-root",
        "--ip=127.0.0.1",
        "--port=0",
        f"--IdentityProvider.token={token}",
        f"--ServerApp.root_dir={home / 'lessons'}",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
        "--LabApp.extension_manager=readonly",
    ]


def _environment(home):
    """Everything Jupyter writes goes below ``home``; the project can be imported."""
    paths = [str(ROOT), os.environ.get("PYTHONPATH", "")]
    return os.environ | {
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        "JUPYTER_CONFIG_DIR": str(home / "config"),
        "JUPYTER_DATA_DIR": str(home / "data"),
        "JUPYTER_RUNTIME_DIR": str(home / "runtime"),
        "JUPYTERLAB_SETTINGS_DIR": str(home / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(home / "workspaces"),
        "IPYTHONDIR": str(home / "ipython"),
    }


def _port(home, server):
    """Where the server listens, once it does."""
    deadline = time.monotonic() + PATIENCE / 1000
    while time.monotonic() < deadline and server.poll() is None:
        for path in (home / "runtime").glob("jpserver-*.json"):
            with contextlib.suppress(json.JSONDecodeError):  # it is just being written
                return json.loads(path.read_text(encoding="utf-8"))["port"]
        time.sleep(0.1)
    pytest.fail(f"JupyterLab did not start:\n{(home / 'lab.log').read_text(errors='replace')}")
