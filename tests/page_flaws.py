"""What is wrong with a page that is to work alone, for everybody, and know what it says."""

import re
from html.parser import HTMLParser

ALONE = ("data:", "#")  # what a page may point to without asking the network
POINTERS = ("src", "href", "srcset", "data", "action", "poster")
VOID = {"img", "meta", "br", "link", "input", "hr"}
NOT_A_NUMBER = re.compile(r"(?<![\w-])[-−+]?(nan|inf|infinity|none)(?![\w-])", re.IGNORECASE)


class _Page(HTMLParser):
    def __init__(self, html):
        super().__init__()
        self.tags, self.open, self.text, self.flaws = [], [], [], []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.flaws.append(f"</{tag}> closes nothing")

    def handle_data(self, data):
        if not {"style", "code"} & set(self.open):
            self.text.append(data)

    def all(self, *names):
        return [(tag, attrs) for tag, attrs in self.tags if tag in names]


def page_flaws(html):
    """Every flaw, a few words each; empty for a sound page."""
    page = _Page(html)
    return [
        *page.flaws,
        *(f"<{tag}> stays open" for tag in page.open),
        *_network(page, html),
        *_reading(page),
        *_finding(page),
        *(f"says {found[0]!r}" for text in page.text for found in NOT_A_NUMBER.finditer(text)),
    ]


def _network(page, html):
    for tag, attrs in page.tags:
        for name in POINTERS:
            target = attrs.get(name)
            if target is not None and not target.startswith(ALONE):
                yield f"<{tag}> points to {target[:40]}"
        yield from (f"<{tag}> runs {name}" for name in attrs if name.startswith("on"))
    yield from (f"<{tag}>" for tag, _ in page.all("script", "iframe", "object", "link", "base"))
    if re.search(r"@import|url\(\s*['\"]?(?!data:|#)", html):
        yield "a style from elsewhere"


def _reading(page):
    if not all(attrs.get("lang") for _, attrs in page.all("html")) or not page.all("html"):
        yield "no language"
    if not page.all("title"):
        yield "no title"
    for _, attrs in page.all("img"):
        if len(attrs.get("alt") or "") < 20:
            yield "a picture without words"
    for _, attrs in page.all("th"):
        if not attrs.get("scope"):
            yield "a header of nothing"


def _finding(page):
    level = 0
    for tag, _ in page.all("h1", "h2", "h3", "h4"):
        if int(tag[1]) > level + 1:
            yield f"<{tag}> after <h{level}>"
        level = int(tag[1])
    ids = [attrs["id"] for _, attrs in page.tags if "id" in attrs]
    yield from (f"two things called {name}" for name in {one for one in ids if ids.count(one) > 1})
    for _, attrs in page.all("a"):
        if attrs.get("href", "#")[1:] not in ids:
            yield f"a link to nothing: {attrs.get('href')}"
