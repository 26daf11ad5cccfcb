"""Mutation testing of the graders, on a terminal.

    python tests/mutation/report.py [PART]

Prints how many mutants there are, how many lose points with advice, how many are legal variants of
``legal.toml``, and every survivor. ``PART`` is a part of an exercise's, a file's or an operator's
name. All of robot code takes a quarter of an hour: each mutant is run on the simulated robot.
"""

import fnmatch
import importlib
import re
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
if __name__ == "__main__":
    sys.path.insert(0, str(HERE.parent))

from mutation.answers import ROOT, Verdict, judge  # noqa: E402 - the path is set above
from mutation.mutant import Mutant  # noqa: E402 - the same


@dataclass(frozen=True)
class Legal:
    """A kind of mutant that is a right answer in another way.

    Args:
        exercise, file, operator: shell patterns.
        line: a regular expression that is in the changed line.
        reason: why it is right, or why no grader can tell.
        was: a regular expression that is in that line of the authored answer.
    """

    exercise: str
    file: str
    operator: str
    line: str
    reason: str
    was: str = ""

    def covers(self, mutant: Mutant) -> bool:
        """Whether a mutant is of this kind."""
        pairs = (
            (mutant.exercise, self.exercise),
            (mutant.file, self.file),
            (mutant.operator, self.operator),
        )
        if not all(fnmatch.fnmatch(name, form) for name, form in pairs):
            return False
        authored = ROOT / "solutions" / mutant.exercise / mutant.file
        return all(
            re.search(pattern, _line(text, mutant.line)) is not None
            for pattern, text in (
                (self.line, mutant.text),
                (self.was, authored.read_text(encoding="utf-8") if self.was else ""),
            )
        )


def _line(text: str, number: int) -> str:
    """A line of a text, counted from 1; empty beyond its end."""
    lines = text.splitlines()
    return lines[number - 1] if number <= len(lines) else ""


@dataclass
class Report:
    """What became of all mutants.

    Args:
        killed: how many lose points with advice, by operator.
        legal: how many are right in another way, by operator.
        survivors: those that are neither, with why.
        stale: entries of the list of legal variants that cover nothing.
    """

    killed: Counter[str] = field(default_factory=Counter)
    legal: Counter[str] = field(default_factory=Counter)
    survivors: list[tuple[Mutant, Verdict]] = field(default_factory=list)
    stale: list[Legal] = field(default_factory=list)

    @property
    def total(self) -> int:
        """How many mutants there are."""
        return self.killed.total() + self.legal.total() + len(self.survivors)


def legal_variants() -> list[Legal]:
    """The lists of legal variants: of robot code, and of answers in TOML."""
    tables = [tomllib.loads(path.read_text(encoding="utf-8")) for path in HERE.glob("legal*.toml")]
    return [Legal(**row) for table in tables for row in table["legal"]]


def all_mutants() -> Iterator[Mutant]:
    """The mutants of every module of this folder that makes some."""
    for path in sorted(HERE.glob("*.py")):
        module = importlib.import_module(f"mutation.{path.stem}") if path.stem != "report" else None
        make = getattr(module, "mutants", None)
        if make is not None:
            yield from make()


def survey(mutants: Iterable[Mutant]) -> Report:
    """Grade mutants."""
    report, listed = Report(), legal_variants()
    used: set[int] = set()
    for mutant in mutants:
        with tempfile.TemporaryDirectory() as place:
            verdict = judge(mutant, Path(place))
        covering = [at for at, one in enumerate(listed) if one.covers(mutant)]
        if verdict.killed:
            report.killed[mutant.operator] += 1
        elif covering:
            used.update(covering)
            report.legal[mutant.operator] += 1
        else:
            report.survivors.append((mutant, verdict))
    report.stale = [one for at, one in enumerate(listed) if at not in used]
    return report


def lines(report: Report) -> Iterator[str]:
    """The report in words."""
    yield (
        f"{report.total} mutants: {report.killed.total()} killed, {report.legal.total()} legal, "
        f"{len(report.survivors)} survivors"
    )
    left = Counter(mutant.operator for mutant, _ in report.survivors)
    for operator in sorted({*report.killed, *report.legal, *left}):
        counts = (report.killed[operator], report.legal[operator], left[operator])
        yield f"  {operator:24} {counts[0]:5} killed {counts[1]:4} legal {counts[2]:4} survivors"
    for mutant, verdict in report.survivors:
        text = mutant.text.splitlines()[mutant.line - 1 : mutant.line]
        where = f"{mutant.exercise} {mutant.file}:{mutant.line} {mutant.operator}"
        yield f"SURVIVOR {where}: {''.join(text).strip()} ({verdict.said})"
    for one in report.stale:
        yield f"STALE {one.exercise} {one.file} {one.operator} {one.line}: covers no survivor"


def main(arguments: list[str]) -> int:
    """Print the report; 1 if there is a survivor or a stale entry."""
    part = next((one for one in arguments if not one.startswith("-")), "")
    wanted = (one for one in all_mutants() if part in f"{one.exercise} {one.file} {one.operator}")
    report = survey(wanted)
    if part:
        report.stale = []
    for line in lines(report):
        print(line)
    return 1 if report.survivors or report.stale else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
