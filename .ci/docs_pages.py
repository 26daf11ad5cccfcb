"""A hook of MkDocs: the pages that stand beside the code are pages of the documentation, too."""

import re
from pathlib import Path
from urllib.parse import urlparse

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[1]
PAGES = ("sim/ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md")
DECISIONS = "sim/decisions/*.md"
LINK = re.compile(r"\[([^\]]+)\]\(([^)#\s]+)\)")


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Add the pages that stand elsewhere in the project under their own paths."""
    for name in (*PAGES, *(path.relative_to(ROOT).as_posix() for path in ROOT.glob(DECISIONS))):
        files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
    return files


def on_page_markdown(markdown: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:  # noqa: ARG001 - the hook's own signature
    """Leave the text of a link to a file of the project that is no page here."""
    folder = (ROOT / page.file.src_uri).parent

    def keep(link: re.Match[str]) -> str:
        text, target = link.groups()
        if urlparse(target).scheme:
            return link.group()
        path = (folder / target).resolve()
        if not path.exists() or not path.is_relative_to(ROOT):
            return link.group()
        page_of = files.get_file_from_path(path.relative_to(ROOT).as_posix())
        return link.group() if page_of else text

    return LINK.sub(keep, markdown)
