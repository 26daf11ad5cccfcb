"""A hook of MkDocs: what stands beside the code is part of the site, too.

Pages and exercises are rendered as GitHub shows them, and lessons as `grade edition` writes their
executed notebooks. A lesson whose outputs the tests kept in build/lessons/ is not run again.
"""

import logging
import re
import sys
from html import escape, unescape
from pathlib import Path
from urllib.parse import unquote, urlparse

import nbformat
from markdown_it import MarkdownIt
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from mkdocs.structure.toc import get_toc
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name
from pygments.util import ClassNotFound

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from grader.classroom.edition import BODY, convert_notebook, execute_notebook, make_accessible  # noqa: E402 - this folder's
from grader.student_data.fingerprint import fingerprint_folders  # noqa: E402 - the same
from sim.core.errors import BadRequest  # noqa: E402 - the same
from sim.support.atomic_file import write_atomically  # noqa: E402 - the same

PAGES = (
    "sim/ARCHITECTURE.md",
    "sim/decisions/*.md",
    "tests/benchmarks/COMPARISON.md",
    "tests/benchmarks/*.svg",
    "exercises/*/README.md",
    "INSTRUCTORS.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
)
PICTURES = ".ci/pictures/*"
DOCS = ROOT / "sim" / "docs"
MKDOCS_OWN = ("index.md", "reference.md")  # rendered by MkDocs: they hold what only it understands
KEPT = ROOT / "build" / "lessons"
SOURCE = re.compile(r' src="(?!data:)(?P<target>[^"]*)"')
ANCHOR = re.compile(
    r'<a (?P<before>[^>]*)href="(?P<target>[^"]*)"(?P<after>[^>]*)>(?P<text>.*?)</a>', re.DOTALL
)
HEADING = re.compile(r"<h([1-6])>(.*?)</h\1>", re.DOTALL)
H1 = re.compile(r"<h1>(.+?)</h1>")
PICTURE = re.compile(r'<img (alt="[^"]*") src="data:image/png;base64,')
ABLE = re.compile(r"At the end you can</strong></p>\s*<ul>\s*<li>(.+?)[;.]?</li>", re.DOTALL)
MADE_FROM = "made_from"  # in a kept notebook's metadata: the digest of what its outputs depend on
LESSONS_HERE = "<!-- lessons -->"  # in the first page: where their cards stand
log = logging.getLogger("mkdocs.hooks.docs_pages")  # a warning here fails a strict build


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Put each lesson and each exercise into the navigation, in the order of their numbers."""
    patterns = {
        "lessons/*": [f"lessons/{path.stem}.md" for path in list_lessons()],
        "exercises/*": [
            path.relative_to(ROOT).as_posix()
            for path in sorted((ROOT / "exercises").glob("*/README.md"), key=_find_number)
        ],
    }
    for section in config.nav or ():
        for name, pages in section.items():
            if isinstance(pages, str) and pages in patterns:
                section[name] = patterns[pages]
    return config


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Add the pages and pictures that stand elsewhere under their own paths, and the lessons."""
    for pattern in PAGES:
        for path in ROOT.glob(pattern):
            name = path.relative_to(ROOT).as_posix()
            files.append(File.generated(config, name, abs_src_path=str(path)))
    for path in ROOT.glob(PICTURES):  # a server of pages may leave out folders with a dot
        files.append(File.generated(config, f"pictures/{path.name}", abs_src_path=str(path)))
    for path in list_lessons():
        html = convert_notebook(get_notebook(path, run=config.extra["run_lessons"]), BODY)
        text = f"# {H1.search(html)[1]}\n{html}"
        files.append(File.generated(config, f"lessons/{path.stem}.md", content=text))
        files.append(File.generated(config, f"lessons/{path.name}", abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:  # noqa: ARG001 - the hook's own signature
    """Leave MkDocs only the title of a page that it does not render itself."""
    if _is_ours(page):
        title = re.search(r"^# (.+)$", markdown, re.MULTILINE)
        page.meta["source"] = markdown
        return f"# {title[1]}\n" if title else ""
    return markdown.replace(LESSONS_HERE, "".join(make_card(one, files) for one in list_lessons()))


def on_page_content(html: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Render such a page, check its links, and make its table of contents."""
    if not _is_ours(page):
        return html
    source = page.meta.pop("source")
    if page.file.src_uri.startswith("lessons/"):  # which is HTML below its title
        html = source.partition("\n")[2]
        rendered = html.replace("</h1>", f"</h1>{say_how_to_run(page, config)}", 1)
    else:
        rendered = make_accessible(render_markdown(source))
    rendered, tokens = name_headings(rendered)
    page.toc = get_toc(tokens)
    page.present_anchor_ids = set(re.findall(r'\bid="([^"]+)"', rendered))
    return resolve_links(rendered, page=page, config=config, files=files)


def on_post_page(output: str, *, page: Page | None, config: MkDocsConfig) -> str:  # noqa: ARG001 - the hook's own signature
    """Say that the bar of links is the site's navigation, which the theme does not."""
    return output.replace(
        '<div class="navbar ', '<div role="navigation" aria-label="Site" class="navbar '
    )


def on_post_template(output_content: str, *, template_name: str, config: MkDocsConfig) -> str:  # noqa: ARG001 - the same
    """Say the same on the page that is shown for an address that does not exist."""
    return on_post_page(output_content, page=None, config=config)


def list_lessons() -> list[Path]:
    """The notebooks, in order."""
    return sorted((ROOT / "lessons").glob("*.ipynb"))


def get_notebook(path: Path, *, run: bool) -> nbformat.NotebookNode:
    """A lesson's notebook with its outputs.

    Args:
        path: of the notebook.
        run: whether to execute it where no outputs of it are kept; else it has none.

    Raises:
        PluginError: a cell fails.
    """
    kept = KEPT / path.name
    if kept.is_file():
        notebook = nbformat.read(kept, 4)
        if notebook.metadata.get(MADE_FROM) == fingerprint_folders(path.parent):
            return notebook
    if not run:
        return nbformat.read(path, 4)
    log.info("running %s", path.stem)
    try:
        notebook = execute_notebook(path)
    except BadRequest as error:
        raise PluginError(str(error)) from None
    keep_notebook(notebook, path)
    return notebook


def keep_notebook(notebook: nbformat.NotebookNode, path: Path) -> None:
    """Store an executed notebook for `get_notebook`, until its lesson or the code changes."""
    notebook.metadata[MADE_FROM] = fingerprint_folders(path.parent)
    KEPT.mkdir(parents=True, exist_ok=True)
    write_atomically(KEPT / path.name, nbformat.writes(notebook))


def make_card(path: Path, files: Files) -> str:
    """The first page's entry of a lesson: its picture, its title, what one can do afterwards."""
    html = files.get_file_from_path(f"lessons/{path.stem}.md").content_string
    able, picture = ABLE.search(html), PICTURE.search(html)
    shown = f'<img {picture[1]} src="pictures/{path.stem}.png">' if picture else ""
    words = f"<p>You can {able[1]}.</p>" if able else ""
    return (
        f'<a class="card" href="lessons/{path.stem}.html">{shown}'
        f"<strong>{H1.search(html)[1]}</strong>{words}</a>\n"
    )


def render_markdown(text: str) -> str:
    """GitHub's Markdown as HTML, code highlighted, with boxes of a list to tick."""
    parser = MarkdownIt("commonmark", {"highlight": _highlight}).enable(["table", "strikethrough"])
    html = str(parser.render(text))
    html = re.sub(r"(<li>(?:\s*<p>)?)\[ \] ", r'\1<input type="checkbox"> ', html)
    html = re.sub(r'<pre><code class="language-\w+">(<pre.*?</pre>)\s*</code></pre>', r"\1", html)
    return html.replace("<table>", '<div class="wide"><table>').replace(
        "</table>", "</table></div>"
    )


def resolve_links(html: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Point links to pages of the site; a link to another file of the project becomes text.

    Args:
        html: of the page.
        page: whose links are relative to the folder of its source.
        config: names the repository, where other files can be read, if there is one.
        files: of the site.

    A link that leads nowhere is a warning, which fails a strict build.
    """
    own = (DOCS / page.file.src_uri).is_file()
    folder = DOCS if own else (ROOT / page.file.src_uri).parent

    def find(target: str) -> str | None:
        """Where a link leads on the site; None for a file that has no page."""
        parts = urlparse(unescape(target))
        if parts.scheme or not parts.path:
            return target
        path = (folder / unquote(parts.path)).resolve()
        name = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else parts.path
        page_name = re.sub(r"^(lessons/\w+)\.ipynb$", r"\1.md", name.removeprefix("sim/docs/"))
        file = files.get_file_from_path(page_name)
        if file is not None:
            return file.url_relative_to(page.file) + (f"#{parts.fragment}" * bool(parts.fragment))
        if not path.exists() or not path.is_relative_to(ROOT):
            log.warning("%s: a link leads nowhere: %s", page.file.src_uri, target)
        repository = config.extra["repository"]
        return f"{repository}/blob/main/{name}" if repository else None

    def rewrite_link(link: re.Match[str]) -> str:
        if "download" in link["after"]:
            return link.group()
        found = find(link["target"])
        if found is None:
            return link["text"]
        return f'<a {link["before"]}href="{found}"{link["after"]}>{link["text"]}</a>'

    def replace_source(source: re.Match[str]) -> str:
        return f' src="{find(source["target"])}"'

    return SOURCE.sub(replace_source, ANCHOR.sub(rewrite_link, html))


def say_how_to_run(page: Page, config: MkDocsConfig) -> str:
    """How to open a lesson as a notebook."""
    name = f"{Path(page.file.src_uri).stem}.ipynb"
    repository = str(config.extra["repository"])
    colab = ""
    if repository.startswith("https://github.com/"):
        where = repository.replace("https://github.com", "https://colab.research.google.com/github")
        colab = f' · <a class="run" href="{where}/blob/main/lessons/{name}">Open in Colab</a>'
    return (
        f'<p class="run-it"><a class="run" href="../sim/docs/guide.md#run-a-lesson">Run it</a>'
        f'{colab} · <a href="{name}" download>Download the notebook</a></p>'
    )


def _highlight(code: str, language: str, _: str) -> str:
    try:
        lexer = get_lexer_by_name(language or "text")
    except ClassNotFound:
        return ""
    spans = highlight(code, lexer, HtmlFormatter(nowrap=True))
    return f'<pre class="highlight"><code>{spans}</code></pre>'


def name_headings(html: str) -> tuple[str, list[dict[str, object]]]:
    """HTML whose headings have names as on GitHub, and the table of contents they make."""
    tokens: list[dict[str, object]] = []
    taken: set[str] = set()

    def name(heading: re.Match[str]) -> str:
        words = unescape(re.sub(r"<[^>]+>", "", heading[2]))
        base = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
        base = re.sub(r"^(?=\d)", "part-", base)  # scripts want no digit first
        own, count = base, 0
        while own in taken:
            count += 1
            own = f"{base}-{count}"
        taken.add(own)
        token = {"level": int(heading[1]), "id": own, "name": escape(words), "children": []}
        siblings = tokens
        while siblings and siblings[-1]["level"] < token["level"]:
            siblings = siblings[-1]["children"]
        siblings.append(token)
        return f'<h{heading[1]} id="{own}">{heading[2]}</h{heading[1]}>'

    return HEADING.sub(name, html), tokens


def _is_ours(page: Page) -> bool:
    """Whether this file renders a page, and not MkDocs."""
    return page.file.src_uri not in MKDOCS_OWN


def _find_number(path: Path) -> tuple[int, str]:
    """The order of exercises: by number, and those without one behind."""
    found = re.search(r"\d+", path.parent.name)
    return (int(found[0]) if found else 1000, path.parent.name)
