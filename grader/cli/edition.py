"""``grade edition``."""

from pathlib import Path

import click

from grader.classroom.edition import build_pages
from grader.cli.course_here import PATH
from grader.course.progress import find_course
from grader.feedback.terminal import print_error, print_lines, style_line
from sim.support.command_line import DONE


@click.command()
@click.option("-o", "--output", type=PATH, required=True, help="Folder of the pages.")
@click.option(
    "--lesson", "only", multiple=True, metavar="NN", help="Only this lesson; may be repeated."
)
def edition(output: Path, only: tuple[str, ...]) -> int:
    """Run all lessons, and write each as a page and as slides.

    The pages can be read without installing anything and without a network; slides need a network.
    """
    notebooks = sorted((find_course(Path.cwd()) / "lessons").glob("*.ipynb"))
    asked = tuple(one.zfill(2) for one in only)
    chosen = [path for path in notebooks if not asked or path.name.startswith(asked)]
    build_pages(chosen, output, lambda name: print_error(f"running {name}"))
    index = output / "index.html"
    said = f"{index}: {len(chosen)} lessons, their slides, and handout.html to print"
    print_lines([style_line(said)])
    return DONE
