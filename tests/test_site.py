"""The site: every page is there, every link leads somewhere, and nothing is asked of elsewhere."""

import os
import re
import subprocess
import sys
import threading
from functools import partial
from html.parser import HTMLParser
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import unquote, urlparse

import pytest
from chromium import AXE, LEAST_CONTRAST, least_contrast, list_violations, require_axe
from ci_scripts import load_script
from places import ROOT

pytestmark = pytest.mark.slow

LOADS = {  # what a browser fetches by itself
    "img": ("src", "srcset"), "source": ("src", "srcset"), "script": ("src",), "iframe": ("src",),
    "video": ("src", "poster"), "object": ("data",),
}  # fmt: skip
LOADING_LINKS = {"stylesheet", "icon", "shortcut icon", "preload", "manifest", "preconnect"}


class SitePage(HTMLParser):
    """The links, the anchors and what is loaded of a page."""

    def __init__(self, html):
        super().__init__()
        self.links, self.anchors, self.loaded, self.wordless = [], set(), [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        """Note what this tag points to."""
        given = dict(attrs)
        self.anchors |= {given[name] for name in ("id", "name") if given.get(name)}
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if tag == "img" and not given.get("alt"):
            self.wordless.append(given.get("src", "")[:60])
        self.loaded += [given[name] for name in LOADS.get(tag, ()) if given.get(name)]
        if tag == "link" and given.get("rel") in LOADING_LINKS:
            self.loaded.append(given["href"])


def build(folder, **variables):
    """Build the site without executing lessons; what the command printed, and its exit code."""
    return subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "-q", "-f", ".ci/mkdocs.yml",
         "-d", str(folder)],
        cwd=ROOT, env=os.environ | {"RUN_LESSONS": "false"} | variables,
        capture_output=True, encoding="utf-8", check=False,
    )  # fmt: skip


@pytest.fixture(scope="module")
def built_site(tmp_path_factory):
    """The built site: path -> page."""
    folder = tmp_path_factory.mktemp("site")
    done = build(folder)
    assert done.returncode == 0, done.stderr
    return folder, {
        path.relative_to(folder).as_posix(): SitePage(path.read_text("utf-8"))
        for path in folder.rglob("*.html")
    }


def lost_links(folder, pages):
    """Links within the site that lead to no file or to no anchor of it."""
    for name, page in pages.items():
        for link in page.links:
            parts = urlparse(link)
            if parts.scheme or name == "404.html":  # that page's links begin at the server's root
                continue
            path = (folder / name).parent / unquote(parts.path) if parts.path else folder / name
            target = path.resolve()
            if not target.is_file():
                yield f"{name}: {link}"
            elif parts.fragment and target.suffix == ".html":
                there = pages[target.relative_to(folder.resolve()).as_posix()]
                if unquote(parts.fragment) not in there.anchors:
                    yield f"{name}: {link}"


def test_every_lesson_and_every_exercise_has_a_page_that_the_navigation_leads_to(built_site):
    _, pages = built_site
    expected = {f"lessons/{path.stem}.html" for path in (ROOT / "lessons").glob("*.py")}
    expected |= {
        f"exercises/{path.parent.name}/index.html"
        for path in (ROOT / "exercises").glob("*/README.md")
    }

    assert expected <= set(pages)
    assert expected <= set(pages["index.html"].links)


def test_every_link_within_the_site_leads_to_a_page_and_to_its_anchor(built_site):
    assert list(lost_links(*built_site)) == []


class QuietFiles(SimpleHTTPRequestHandler):
    """Answers with files of a folder, and prints nothing."""

    def log_message(self, *_):
        """Print nothing."""


@pytest.fixture(scope="module")
def tab(built_site, browser):
    """A browser tab and a function that opens a page of the site in it, noting console errors."""
    folder, _ = built_site
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(QuietFiles, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    page = browser.new_page(color_scheme="light", reduced_motion="reduce")
    page.complaints = []
    page.on("pageerror", lambda one: page.complaints.append(f"{page.url}: {one}"))
    page.on(
        "console",
        lambda one: one.type == "error" and page.complaints.append(f"{page.url}: {one.text}"),
    )
    page.open = lambda name: page.goto(f"http://127.0.0.1:{server.server_port}/{name}")
    yield page
    page.close()
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def visits(built_site, tab):
    """Every page, opened once: its least contrast by theme, and what axe-core finds."""
    texts = '[role="main"] :is(a, p, li, h2), .bs-sidebar a, .navbar a:not(.disabled)'
    contrasts, violations = {}, {}
    for name in sorted(built_site[1]):
        tab.open(name)
        for theme in ("dark", "light"):
            tab.evaluate(f"setColorMode('{theme}')")
            contrasts[name, theme] = least_contrast(tab, texts)
        violations[name] = list_violations(tab) if AXE.is_file() else None
    return contrasts, violations


@pytest.mark.browser
def test_no_page_has_an_error_in_its_console_or_a_faint_link(visits, tab):
    assert tab.complaints == []
    assert {page: one for page, one in visits[0].items() if one < LEAST_CONTRAST} == {}


@pytest.mark.browser
def test_axe_finds_nothing_wrong_with_a_page_of_the_site(visits):
    require_axe()
    assert {name: found for name, found in visits[1].items() if found} == {}


@pytest.mark.browser
def test_a_search_finds_a_gain(tab):
    gain = "kG"
    with tab.expect_response("**/search_index.json"):
        tab.open("index.html")
    tab.locator("[data-bs-target='#mkdocs_search_modal']").click()
    found = tab.locator("#mkdocs-search-results article").first
    for _ in range(50):  # the index is read after the page
        tab.locator("#mkdocs-search-query").fill("")
        tab.locator("#mkdocs-search-query").press_sequentially(gain)
        tab.wait_for_timeout(200)
        if found.is_visible():
            break

    assert gain in tab.locator("#mkdocs-search-results").inner_text()


def test_check_finds_a_broken_link_and_a_broken_anchor(tmp_path):
    pages = {"a.html": SitePage('<a href="b.html#x">b</a> <a href="c.html">c</a>'),
             "b.html": SitePage("<p id=y>")}  # fmt: skip
    for name in pages:
        (tmp_path / name).touch()

    assert list(lost_links(tmp_path, pages)) == ["a.html: b.html#x", "a.html: c.html"]


def test_a_page_loads_nothing_from_elsewhere(built_site):
    folder, pages = built_site
    elsewhere = {
        f"{name}: {loaded}"
        for name, page in pages.items()
        for loaded in page.loaded
        if not loaded.startswith("data:") and urlparse(loaded).netloc
    }
    styles = [
        found
        for path in folder.rglob("*.css")
        for found in re.findall(r"url\(\s*['\"]?(?:https?:)?//[^)]+", path.read_text("utf-8"))
    ]

    assert elsewhere == set()
    assert styles == []


def test_files_that_a_page_loads_exist(built_site):
    folder, pages = built_site

    assert {
        f"{name}: {loaded}"
        for name, page in pages.items()
        for loaded in page.loaded
        if not loaded.startswith("data:")
        and name != "404.html"
        and not ((folder / name).parent / urlparse(loaded).path).is_file()
    } == set()


def test_every_picture_has_words(built_site):
    assert {name: page.wordless for name, page in built_site[1].items() if page.wordless} == {}


@pytest.mark.parametrize(
    "lesson", sorted((ROOT / "lessons").glob("*.ipynb")), ids=lambda path: path.stem
)
def test_a_lesson_says_how_to_run_it_and_offers_its_notebook(built_site, lesson):
    folder, pages = built_site
    links = pages[f"lessons/{lesson.stem}.html"].links

    assert "../guide.html#run-a-lesson" in links
    assert lesson.name in links
    assert (folder / "lessons" / lesson.name).read_bytes() == lesson.read_bytes()
    assert not [link for link in links if "colab" in link]  # no address of the project is known


def test_the_picture_of_a_grade_is_what_its_command_draws():
    kept = (ROOT / ".ci" / "pictures" / "grade.svg").read_text("utf-8")

    assert load_script("draw_pictures").draw_grade() == kept, "run  python .ci/draw_pictures.py"
    assert "http" not in re.sub(r"http://www.w3.org/2000/svg|https://www.textualize.io", "", kept)
