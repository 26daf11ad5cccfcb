"""Draw the pictures of the README and of the site's first page: .ci/pictures/.

    python .ci/draw_pictures.py          drag.svg, which moves, and drag-still.svg, its end
    python .ci/draw_pictures.py --page   also open-*.png, the page of `sysid open`, with Chromium

The moving picture is plain SVG of a log of the bench. It follows the reader's light or dark
colors, and stands still where the reader asked for less motion; pages offer the still one to them,
too, since a browser may not tell a picture about this wish.
"""

import shutil
import sys
import threading
from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from sim.bench.mechanisms import MECHANISMS  # noqa: E402 - the course in this folder
from sim.bench.routine import Routine  # noqa: E402 - the same
from sim.bench.simulate import simulate  # noqa: E402 - the same
from sim.core.log import Array, Log  # noqa: E402 - the same
from sim.fit import fit  # noqa: E402 - the same
from sim.physics.model import Model  # noqa: E402 - the same
from sim.physics.replay import replay_log  # noqa: E402 - the same

FOLDER = Path(__file__).parent / "pictures"
GUESS = {"kS": 0.6, "kV": 3.4, "kA": 0.15}  # a guess as it is made without a log
TURNS = ("kV", "kS", "kA")  # the order in which the gains are dragged to their fitted values
UNITS = {"kS": "V", "kV": "V·s/m", "kA": "V·s²/m"}
MOST = {"kS": 1.0, "kV": 4.0, "kA": 1.0}  # at the right end of a slider
STEPS = 12  # pictures of a gain's way
PERIOD, MOVING = 9.0, 0.7  # [s] of one round; share of it in which something moves
TESTS = {"quasistatic-forward": 7.0, "dynamic-forward": 2.0}  # [s] shown of each
TITLES = ("slow ramp: quasistatic-forward", "sudden step: dynamic-forward")
WIDE, HIGH, TOP, LEFT, APART = 316, 190, 44, 46, 380  # of a panel and its place [px]
SHOWN = 3.4  # [m/s] at the top of a panel
POINTS = 70  # of a curve
TRACK, TRACKS_AT, SLIDERS = 150, 296, 240  # [px] of a slider, how far down, how far apart
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
VIEW = {"width": 1200, "height": 820}  # [px] of the page's picture
STYLE = """
svg { --ink: #222; --quiet: #666; --line: #ccc; --paper: #fff; --seen: #0072b2; --said: #d55e00; }
@media (prefers-color-scheme: dark) {
  svg { --ink: #eee; --quiet: #aaa; --line: #555; --paper: #14181d; }
  svg { --seen: #56b4e9; --said: #ff9d57; }
}
text { font: 13px system-ui, sans-serif; fill: var(--ink); }
.quiet { fill: var(--quiet); font-size: 11px; }
.strong { font-weight: 700; }
path { fill: none; stroke-linejoin: round; }
.seen { stroke: var(--seen); stroke-width: 5; opacity: 0.55; }
.said { stroke: var(--said); stroke-width: 2; }
.axis, .track { stroke: var(--line); }
.track { stroke-width: 4; stroke-linecap: round; }
.knob { fill: var(--said); }
.step { visibility: hidden; }
"""


def main(arguments: Sequence[str]) -> int:
    """Draw; the exit code."""
    FOLDER.mkdir(exist_ok=True)
    for name, moves in (("drag.svg", True), ("drag-still.svg", False)):
        (FOLDER / name).write_text(draw_drag(moves=moves), encoding="utf-8", newline="\n")
        print(FOLDER / name)
    if "--page" in arguments:
        photograph_page()
    return 0


def draw_drag(*, moves: bool = True) -> str:
    """Gains dragged from a guess to the fit, over the measured curves, as SVG.

    Args:
        moves: whether all of the way is in it, or only its end.
    """
    log = simulate(MECHANISMS["swerve"], Routine(), rng=np.random.default_rng(1))
    shown = Log(tuple(log.list_runs_of_test(test)[0] for test in TESTS), units=log.units)
    fitted = {name: float(value) for name, value in fit(log).gains.items()}
    steps = list_steps(fitted)[0 if moves else -1 :]
    frames = [draw_step(gains, shown, moved=moved) for gains, moved in steps]
    words = (
        "Two panels of velocity over time with the measured curve of a swerve drive, a slow ramp "
        "and a sudden step. Below them are sliders. One gain after the other is dragged from a "
        f"guess to its fitted value (kS {fitted['kS']:.2f} V, kV {fitted['kV']:.2f} V·s/m, "
        f"kA {fitted['kA']:.2f} V·s²/m), and the simulated curve moves until it lies on the "
        "measured one."
    )
    head = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 350" role="img" '
        'aria-labelledby="title words">'
    )
    return "\n".join(
        (
            head,
            '<title id="title">Gains dragged until the simulation fits the log</title>',
            f'<desc id="words">{escape(words)}</desc>',
            f"<style>{STYLE}{time_steps(len(frames))}</style>",
            '<rect width="760" height="350" rx="8" style="fill: var(--paper)"/>',
            *draw_ground(shown),
            *(f'<g class="step s{number}">{frame}</g>' for number, frame in enumerate(frames)),
            "</svg>\n",
        )
    )


def list_steps(fitted: dict[str, float]) -> list[tuple[dict[str, float], str]]:
    """The gains of each picture, and which of them moves: from the guess to the fit."""
    gains, found = dict(GUESS), [(dict(GUESS), "")]
    for name in TURNS:
        for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
            eased = float(share * share * (3.0 - 2.0 * share))  # slow at both ends, as a hand is
            gains[name] = GUESS[name] + eased * (fitted[name] - GUESS[name])
            found.append((dict(gains), name))
    found.append((dict(gains), ""))
    return found


def time_steps(count: int) -> str:
    """The CSS that shows one picture after the other; the last where motion is unwelcome."""
    if count == 1:
        return ".s0 { visibility: visible; }"
    each = 100.0 * MOVING / (count - 1)
    shown, hidden = "{ visibility: visible; }", "{ visibility: hidden; }"
    rules = [
        f"@keyframes show {{ 0% {shown} {each:.3f}% {hidden} }}",
        f"@keyframes stay {{ 0% {hidden} {100.0 * MOVING:.3f}% {shown} }}",
    ]
    for number in range(count - 1):
        delay = PERIOD * (each * number / 100.0 - 1.0)
        rules.append(
            f".s{number} {{ animation: show {PERIOD:g}s step-end {delay:.3f}s infinite; }}"
        )
    rules.append(f".s{count - 1} {{ animation: stay {PERIOD:g}s step-end infinite; }}")
    rules.append(
        "@media (prefers-reduced-motion: reduce) { .step { animation: none; } "
        f".s{count - 1} {{ visibility: visible; }} }}"
    )
    return "\n".join(rules)


def draw_ground(shown: Log) -> list[str]:
    """What does not move: axes, measured curves, tracks of the sliders."""
    drawn = [
        '<path class="seen" d="M46 22h22"/><text x="74" y="26">measured</text>',
        '<path class="said" d="M150 22h22"/><text x="178" y="26">simulated</text>',
    ]
    for place, (run, title) in enumerate(zip(shown.runs, TITLES, strict=True)):
        left, seconds = LEFT + place * APART, TESTS[run.test]
        drawn.append(f'<path class="axis" d="M{left} {TOP}v{HIGH}h{WIDE}"/>')
        drawn.append(f'<text class="quiet" x="{left + 6}" y="{TOP + 10}">{title}</text>')
        for speed in (1, 2, 3):
            y = TOP + HIGH - HIGH * speed / SHOWN
            drawn.append(f'<text class="quiet" x="{left - 14}" y="{y + 4:.0f}">{speed}</text>')
        drawn.append(f'<text class="quiet" x="{left - 38}" y="{TOP - 6}">m/s</text>')
        drawn.append(
            f'<text class="quiet" x="{left + WIDE - 22}" y="{TOP + HIGH + 15}">{seconds:g} s</text>'
        )
        drawn.append(f'<path class="seen" d="{draw_curve(run.time, run.velocity, place)}"/>')
    drawn += [
        f'<path class="track" d="M{LEFT + place * SLIDERS} {TRACKS_AT + 16}h{TRACK}"/>'
        for place in range(len(TURNS))
    ]
    return drawn


def draw_step(gains: dict[str, float], shown: Log, *, moved: str) -> str:
    """One picture: the simulated curves, the knobs, and how far off the simulation is."""
    tracks = replay_log(Model("simple", gains), shown)
    drawn, missed = [], []
    for place, (run, track) in enumerate(zip(shown.runs, tracks, strict=True)):
        drawn.append(f'<path class="said" d="{draw_curve(run.time, track.velocity, place)}"/>')
        inside = run.time - run.time[0] <= TESTS[run.test]
        missed.append((track.velocity - run.velocity)[inside])
    for place, name in enumerate(UNITS):
        x = LEFT + place * SLIDERS
        knob = x + TRACK * gains[name] / MOST[name]
        strong = ' class="strong"' if name == moved else ""
        drawn.append(
            f'<circle class="knob" cx="{knob:.1f}" cy="{TRACKS_AT + 16}" '
            f'r="{10 if name == moved else 8}"/>'
            f'<text{strong} x="{x}" y="{TRACKS_AT}">{name} {gains[name]:.2f} {UNITS[name]}</text>'
        )
    off = float(np.sqrt(np.mean(np.concatenate(missed) ** 2)))
    drawn.append(
        f'<text class="strong" x="{LEFT + APART + 178}" y="26">off by {off:.2f} m/s</text>'
    )
    return "".join(drawn)


def draw_curve(time: Array, velocity: Array, place: int) -> str:
    """The path of a curve in a panel.

    Args:
        time: (n,) [s].
        velocity: (n,) [m/s].
        place: of the panel, from the left.
    """
    seconds = tuple(TESTS.values())[place]
    at = np.linspace(0.0, seconds, POINTS)
    values = np.interp(at, time - time[0], velocity)
    x = LEFT + place * APART + WIDE * at / seconds
    y = TOP + HIGH - HIGH * np.clip(values, 0.0, SHOWN) / SHOWN
    return "M" + "L".join(f"{a:.0f} {b:.1f}" for a, b in zip(x, y, strict=True))


def photograph_page() -> None:
    """The page of `sysid open` with an ordinary log, light and dark, as PNG."""
    import tempfile  # noqa: PLC0415 - only where a browser is asked for

    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - the same

    from sim.cli.open.server import PageServer  # noqa: PLC0415 - the same
    from sim.cli.open.session import Session  # noqa: PLC0415 - the same
    from sim.io import write  # noqa: PLC0415 - the same

    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        log = simulate(MECHANISMS["swerve"], Routine(), rng=np.random.default_rng(1))
        write(log, Path(name) / "swerve.wpilog")
        server = PageServer(Session(Path(name), [Path(name) / "swerve.wpilog"]))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        window = playwright.chromium.launch(executable_path=browser, args=["--no-sandbox"])
        for scheme in ("light", "dark"):
            page = window.new_page(viewport=VIEW, color_scheme=scheme)
            page.goto(server.address)
            page.wait_for_selector(".gain")
            page.wait_for_timeout(1500)  # [ms] until the curves are drawn
            page.screenshot(path=FOLDER / f"open-{scheme}.png")
            print(FOLDER / f"open-{scheme}.png")
        server.shutdown()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
