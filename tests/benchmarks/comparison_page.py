"""The comparison as a page of Markdown; every figure in it is handed in."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from statistics import median

import numpy as np
from comparison_dirt import DIRT, GAINS
from comparison_fits import (
    BUILT,
    FARTHEST,
    FARTHEST_VOLTS,
    NEAR,
    NEAR_VOLTS,
    OURS,
    OUTCOMES,
    RECIPE,
    STATED,
    SUBSETS,
    Found,
)
from comparison_measured import Measured, ratios, totals
from comparison_plan import GAINS as TEXTBOOK
from comparison_plan import LAG, LIGHT, NOISE, SECTIONS, TICK, Row, Section

COMMAND = "python tests/benchmarks/comparison.py"
SHORT = "In short"
REAL = "Logs of real robots"
DIRTY = "Six mechanisms with everyday dirt"
SUBSET = "Missing tests"
ABSENT = (
    "This page was made where the logs of real robots were not to be had, so their rows are left "
    "out. Say where they are with the environment variable SYSID_SHARED, and make it again."
)
WAYS = {RECIPE: "SysId's recipe", OURS: "ours"}
TOLD = {"velocity noise ": NOISE, "light mechanism: ": LIGHT, "velocity ": LAG}
"""How a row of a section is called in the table of the most important ones."""
ABOUT = (
    "Made by `{command}`, figures, picture and all: {logs} logs for each row, seeds 0 to {last}. "
    "The recipe is `sysid fit --method sysid`, which gives what WPILib SysId 2026.2.2 gives; ours "
    "is `sysid fit`. Nothing is told to either but the log and the type of the mechanism."
)
READING = (
    "Of simulated logs, here and below: the error in the middle one of a row's logs, and in "
    "brackets the least and the most; so many times is what was found over the truth. The "
    "textbook's mechanism has kS {kS} V, kV {kV} V·s/m and, where nothing else is said, kA {kA} "
    "V·s²/m; it is what both methods assume, with white noise on the velocity and an encoder of "
    "{tick} mm. The logs with dirt and those of real robots are what neither assumes."
)
MANY = 3.0  # [1] times the truth from which a factor says more than a percentage


def page(figures: Measured, *, alt: str) -> str:
    """The whole page.

    Args:
        figures: what was measured.
        alt: what the figure shows, in words.
    """
    parts = [
        "# SysId's recipe and ours, side by side",
        ABOUT.format(command=COMMAND, logs=figures.logs, last=figures.logs - 1),
        f"![{alt}](comparison.svg)",
        f"## {SHORT}",
        "\n".join(short(figures)),
        READING.format(tick=1e3 * TICK, **TEXTBOOK),
        *(part for section in SECTIONS for part in simulated(section, figures)),
        *dirty(figures),
        *subsets(figures),
        *real(figures),
    ]
    return "\n\n".join(parts) + "\n"


def short(figures: Measured) -> list[str]:
    """The lines of the first table: what matters most."""
    rows = [
        (f"kA, {label}{row.name}", *(off(figures.rows[row][way], row, "kA") for way in WAYS))
        for label, section in TOLD.items()
        if (row := told(section, figures))
    ]
    kinds, noises = (len({key[i] for key in figures.dirty}) for i in (0, 1))
    rows.append(
        (
            f"kA, {kinds} mechanisms with everyday dirt at {noises} noises, the middle one",
            *(_percent(median(cell[way]["kA"] for cell in figures.dirty.values())) for way in WAYS),
        )
    )
    every = f"{len(SUBSETS)} subsets of the four tests, {len(BUILT)} mechanisms"
    rows.append((every, *(_said(totals(figures, way)) for way in WAYS)))
    if (some := ratios(figures)).size:
        better = int(np.count_nonzero(some <= 1.0))
        rows.append(
            (
                "velocity of a run held out, real logs, the recipe's as 1",
                "1",
                f"{np.median(some):.2f} in the middle, no larger in {better} of {some.size} runs",
            )
        )
    return table(["error of", *WAYS.values()], rows)


def simulated(section: Section, figures: Measured) -> Iterator[str]:
    """A section of the textbook's mechanism."""
    yield f"## {section.title}"
    yield section.about
    late = any(row.late for row in section.rows)
    heads = [section.first]
    heads += [f"{gain}, {way}" for gain in ("kA", "kS", "kV") for way in WAYS.values()]
    heads.append("lag: true, found by ours" if late else "the recipe's own R²")
    lines = []
    for row in section.rows:
        if row not in figures.rows:
            continue
        both = figures.rows[row]
        cells = [off(both[way], row, gain) for gain in ("kA", "kS", "kV") for way in WAYS]
        found = both[OURS].late
        lag = f"{1e3 * row.late:.0f} ms, {_middle(1e3 * found):.0f} ms"
        r2 = f"{_middle(both[RECIPE].r2):.2f}"
        lines.append((row.name, *cells, lag if late else r2))
    yield "\n".join(table(heads, lines))


def off(found: Found, row: Row, gain: str) -> str:
    """By how much a method's gain is off: the median, and its range for kA."""
    values, truth = found.gains[gain], row.truth[gain]
    if not values.size:
        return "refused"
    said = f", {found.refused} refused" if found.refused else ""
    if gain == "kS":
        return f"{_signed(_middle(values) - truth, 3)} V{said}"
    shares = values / truth
    if gain == "kV":
        return share(_middle(shares)) + said
    least, most = share(shares.min()), share(shares.max())
    unit = most.partition(" ")[2]
    return f"{share(_middle(shares))} ({least.removesuffix(f' {unit}')} to {most}){said}"


def dirty(figures: Measured) -> Iterator[str]:
    """Mechanisms of the bench."""
    yield f"## {DIRTY}"
    yield (
        "Drawn anew for each log, at 20 ms, with what nobody has to name: a little "
        f"{', '.join(DIRT)}; the noise is so many times the mechanism's own. Median size of the "
        "error. Where it is ours that is larger, the row says so."
    )
    heads = ["mechanism, noise", *(f"{g}, {way}" for g in reversed(GAINS) for way in WAYS.values())]
    lines = []
    for (name, noise), cell in figures.dirty.items():
        cells = [
            f"{cell[way][g]:.3f} V" if g == "kS" else _percent(cell[way][g])
            for g in reversed(GAINS)
            for way in WAYS
        ]
        worse = [g for g in reversed(GAINS) if cell[OURS][g] > cell[RECIPE][g]]
        aside = f" (ours larger: {', '.join(worse)})" if worse else ""
        lines.append((f"{name}, × {noise:g}{aside}", *(_plain(text) for text in cells)))
    yield "\n".join(table(heads, lines))


def subsets(figures: Measured) -> Iterator[str]:
    """All subsets of the four tests."""
    yield f"## {SUBSET}"
    yield (
        f"All {len(SUBSETS)} subsets of the four tests, {figures.few} logs each. Right: every gain "
        f"within {NEAR:.0%} (kS and kG within {NEAR_VOLTS} V) or {STATED:g} of its stated standard "
        f"errors, and never farther off than {FARTHEST:.0%} ({FARTHEST_VOLTS} V). Refused: an "
        "error that names what is missing. SysId asks for all four tests; so does its recipe."
    )
    lines = []
    shown = [tests for tests in SUBSETS if (tests, BUILT[0], OURS) in figures.subsets]
    for tests in shown:
        recipe = {
            outcome: sum(figures.subsets[tests, name, RECIPE][outcome] for name in BUILT)
            for outcome in OUTCOMES
        }
        mine = [_said(figures.subsets[tests, name, OURS]) for name in BUILT]
        lines.append((", ".join(tests) or "none", _said(recipe), *mine))
    yield "\n".join(table(["tests", "recipe, all three", *(f"ours, {n}" for n in BUILT)], lines))


def real(figures: Measured) -> Iterator[str]:
    """Logs of real robots: predict the run that was left out."""
    yield f"## {REAL}"
    if not figures.real:
        yield ABSENT
        return
    yield (
        "Three runs are fitted, the fourth is predicted from its voltage alone, and the root mean "
        "square of the error of its velocity is shown: the recipe's, then ours. The logs are "
        "public, of three teams; they are not part of this project. (The recipe is prepared with "
        "all four runs, as SysId refuses three, and regressed on the rows of three.)"
    )
    tests = list(dict.fromkeys(one.test for one in figures.real))
    lines = []
    for log, group in groupby(figures.real, key=lambda one: one.log):
        of = {one.test: one for one in group}
        unit = f"{next(iter(of.values())).unit}/s"
        lines.append((f"{log} [{unit}]", *(_real(of.get(test)) for test in tests)))
    yield "\n".join(table(["log", *tests], lines))


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """The lines of a table in Markdown."""
    lines = [heads, ["---"] * len(heads), *rows]
    return [f"| {' | '.join(cells)} |".replace("|  |", "| |") for cells in lines]


def share(value: float) -> str:
    """A share of the truth as a difference: +12 %, −0.3 %, or 14 times."""
    if abs(value) >= MANY:
        return f"{_plain(f'{value:.3g}')} times"
    away = 100.0 * (value - 1.0)
    return f"{_signed(away, 0 if abs(away) >= 9.95 else 1)} %"


def _percent(value: float) -> str:
    return f"{100.0 * value:.{0 if value >= 1.0 else 2}{'f' if value >= 1.0 else 'g'}} %"


def _signed(value: float, digits: int) -> str:
    text = f"{value:+.{digits}f}"
    return _plain(text if float(text) else text[1:])


def _plain(text: str) -> str:
    """With a true minus sign."""
    return text.replace("-", "−")


def _middle(values: np.ndarray) -> float:
    return float(np.median(values)) if values.size else float("nan")


def _said(counts: dict[str, int]) -> str:
    return ", ".join(f"{times} {outcome}" for outcome, times in counts.items() if times)


def _real(one: object) -> str:
    return f"{one.recipe:.3g}, {one.ours:.3g}" if one else "–"


def told(section: Section, figures: Measured) -> Row:
    """The row by which a section is told in short; the last there is, if that was left out."""
    rows = [row for row in section.rows if row in figures.rows]
    return next((row for row in rows if row.name == section.told), rows[-1])
