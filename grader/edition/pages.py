"""Pages of executed lessons: one each, slides, an index, and a handout."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from grader.classroom.atomic_files import write_private_file
from grader.edition.notebook_execution import execute_notebook
from grader.edition.notebook_html import LessonPart, split_notebook
from sim.core.errors import BadRequest
from sim.plot.animation import make_script_source, read_script
from sim.report.page_file import load_templates

FOLDER = Path(__file__).parent
SLIDES = (FOLDER / "slides.js").read_text(encoding="utf-8")
SYSTEM_CHECK = "System check"


@dataclass(frozen=True)
class Lesson:
    """An executed lesson.

    Args:
        name: of its notebook: ``04_wire_sysidroutine``.
        parts: its title and its sections.
    """

    name: str
    parts: tuple[LessonPart, ...]

    @property
    def title(self) -> str:
        """The lesson's first heading."""
        return self.parts[0].heading

    @property
    def page_file(self) -> str:
        """The file name of the lesson's page."""
        return f"{self.name}.html"

    @property
    def slides_file(self) -> str:
        """The file name of the lesson's slides."""
        return f"{self.name}-slides.html"


def build_pages(
    notebooks: Sequence[Path], folder: Path, *, say: Callable[[str], None] = lambda _: None
) -> Path:
    """Run lessons and write their pages.

    Args:
        notebooks: in order.
        folder: where the pages go.
        say: called with each lesson's name when it is run.

    Returns:
        The index.

    Raises:
        BadRequest: there are none, one fails, or a page cannot be written.
    """
    if not notebooks:
        raise BadRequest("there are no lessons", advice="Run this in the course folder.")
    lessons = []
    for path in notebooks:
        say(path.stem)
        lessons.append(Lesson(path.stem, split_notebook(execute_notebook(path))))
    for place, lesson in enumerate(lessons):
        before = lessons[place - 1].page_file if place else ""
        after = lessons[place + 1].page_file if place + 1 < len(lessons) else ""
        for slides in (False, True):
            text = _write_page(lesson, before=before, after=after, slides=slides)
            write_private_file(folder / (lesson.slides_file if slides else lesson.page_file), text)
    write_private_file(folder / "handout.html", _write_handout(lessons))
    text = _fill("index.html.jinja", lessons=lessons)
    return write_private_file(folder / "index.html", text)


def _write_page(lesson: Lesson, *, before: str, after: str, slides: bool) -> str:
    return _fill(
        "lesson.html.jinja",
        title=lesson.title,
        parts=lesson.parts,
        before=before,
        after=after,
        slides=slides,
        scripts=" ".join(make_script_source(text) for text in (read_script(), SLIDES)),
        slides_script=SLIDES,
        other=lesson.page_file if slides else lesson.slides_file,
    )


def _write_handout(lessons: Sequence[Lesson]) -> str:
    checks = [
        {"title": lesson.title, "html": part.html}
        for lesson in lessons
        for part in lesson.parts
        if part.heading.endswith(SYSTEM_CHECK)
    ]
    return _fill("handout.html.jinja", checks=checks)


def _fill(name: str, **what: object) -> str:
    return load_templates(FOLDER).get_template(name).render(what)
