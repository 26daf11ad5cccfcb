"""SysId's recipe and ours beside each other: a page of tables and one figure, made anew.

    python tests/benchmarks/comparison.py [--logs 20] [--out FOLDER] [--real FOLDER]

Writes COMPARISON.md and comparison.svg beside this file, and the words of the figure into the
README where nothing else is asked for: velocity noise, sampling, light
mechanisms, hidden lag, everyday dirt, missing tests, and logs of real robots where there are any.
Takes some minutes; the same logs give the same page.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from bench_real import folder
from comparison_figure import picture
from comparison_measured import measured
from comparison_page import page

HERE = Path(__file__).resolve().parent
README = HERE.parents[1] / "README.md"
BEGIN, END = "<!-- comparison.py writes this -->\n", "<!-- until here -->\n"
LOGS = 20
PAGE, PICTURE = "COMPARISON.md", "comparison.svg"


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure, and write both files."""
    parser = argparse.ArgumentParser(description="SysId's recipe and ours beside each other.")
    parser.add_argument("--logs", type=int, default=LOGS, help="for each row")
    parser.add_argument("--first", type=int, help="only so many rows of each section")
    parser.add_argument("--out", type=Path, default=HERE, help="folder to write to")
    parser.add_argument("--real", type=Path, default=folder(), help="folder with real robots' logs")
    given = parser.parse_args(arguments)
    figures = measured(logs=given.logs, real=given.real, first=given.first)
    drawn = picture(figures)
    drawn.save(given.out / PICTURE)
    write(given.out / PAGE, page(figures, alt=drawn.alt))
    if given.out == HERE:
        shown = f"![{drawn.alt}](tests/benchmarks/{PICTURE})"
        write(README, put(README.read_text(encoding="utf-8"), [shown]))
    print(f"\n{given.out / PAGE} and {PICTURE}", file=sys.stderr)


def put(text: str, lines: Sequence[str]) -> str:
    """A text with other lines between its two marks."""
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        sys.exit(f"{README} has lost its marks: put {BEGIN.strip()} and {END.strip()} back")
    return before + begin + "\n".join(lines) + "\n" + end + after


def write(path: Path, text: str) -> None:
    """Write a file that is the same on every system."""
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write(text)


if __name__ == "__main__":
    main()
