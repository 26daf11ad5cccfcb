"""Draw the picture that each lesson begins with: .ci/pictures/NAME.png, NAME as the lesson's file.

    python .ci/draw_lessons.py

Every curve is simulated. `.ci/derive_notebooks.py` puts the pictures into the notebooks. They are
PNG on white, because JupyterLab shows no SVG that a notebook holds, and a page may be dark.
"""

import io
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

import sim  # noqa: E402 - the course in this folder
from sim.bench.mechanism import Mechanism  # noqa: E402 - the same
from sim.bench.simulate import move_gains_only, simulate  # noqa: E402 - the same
from sim.core.log import Array, Log  # noqa: E402 - the same
from sim.inspect.contaminate import contaminate  # noqa: E402 - the same
from sim.physics.engine import State, simulate_run  # noqa: E402 - the same
from sim.physics.model import Model  # noqa: E402 - the same
from sim.physics.replay import replay_log  # noqa: E402 - the same
from sim.plot.animation.charts import (  # noqa: E402 - the same
    Chart,
    Curve,
    chart_curves,
    chart_line_errors,
)
from sim.plot.picture import COLORS, INK, add_legend, make_panels  # noqa: E402 - the same
from sim.teaching.runway import Floor, drive_test  # noqa: E402 - the same

SECONDS, SPEED, VOLTS = "time [s]", "speed [m/s]", "voltage [V]"
RAMP = "quasistatic-forward"
ROUTINE = sim.Routine(ramp=2.0, step=3.5, timeout=3.0)
DRIVETRAIN, ELEVATOR = sim.MECHANISMS["drivetrain"], sim.MECHANISMS["elevator"]
TRUTH = DRIVETRAIN.gains
GUESS = {"kS": 0.1, "kV": 2.0, "kA": 0.1}
TIME = np.arange(0.0, 2.5, 0.02)
WANTED = np.interp(TIME, [0.2, 0.7, 1.7, 2.2], [0.0, 2.0, 2.0, 0.0])  # [m/s]
FRAMES, PERIOD = 23, 100  # growing pictures, and milliseconds that each is shown
STYLES = {"line": "-", "bar": "-", "dashed": "--", "dots": "o"}


def record(mechanism: Mechanism) -> Log:
    """The log of a routine."""
    return simulate(mechanism, ROUTINE, rng=np.random.default_rng(1))


def split_voltage(gains: Mapping[str, float]) -> dict[str, Array]:
    """The terms of the voltage for the wanted speed."""
    return {
        "kS·sgn(v)": gains["kS"] * np.sign(WANTED),
        "kV·v": gains["kV"] * WANTED,
        "kA·a": gains["kA"] * np.gradient(WANTED, TIME),
    }


def chart_drives(programs: Mapping[str, Mapping[str, float]]) -> Chart:
    """The wanted speed, and the speeds that programs with other gains reach."""
    lines = {"wanted": WANTED}
    for name, gains in programs.items():
        volts = sum(split_voltage(gains).values())
        lines[name] = move_gains_only(TRUTH, time=TIME, voltage=volts)[1]
    return chart_curves(TIME, lines, xlabel=SECONDS, ylabel=SPEED)


def simulate_lift(volts: float) -> Array:
    """The height of the elevator under a constant voltage."""
    held, start = np.full(20, volts), State.cold_at(0.6)
    return simulate_run(ELEVATOR.model, time=TIME[:20], voltage=held, state=start).position


def chart_tests(log: Log, directions: str, *shown: str) -> Chart:
    """The named signals of a log's tests, interrupted between them."""
    runs = [run for run in log.runs if run.direction in directions]
    signals = [np.array([run.time, run.voltage, run.velocity]) for run in runs]
    time, volts, speed = np.hstack([np.insert(one, one.shape[1], np.nan, 1) for one in signals])
    lines = {VOLTS: volts, SPEED: speed}
    return chart_curves(time, {one: lines[one] for one in shown}, xlabel=SECONDS, ylabel="")


def chart_lessons() -> Iterator[Chart]:
    """The chart of each lesson, in order."""
    log = record(DRIVETRAIN)
    run = log.runs[0]

    # 0: guessed gains
    yield chart_drives({"with guessed gains": GUESS})

    # 1: the terms of a voltage
    terms = split_voltage(TRUTH)
    lines = terms | {"V, their sum": sum(terms.values())}
    yield chart_curves(TIME, lines, xlabel=SECONDS, ylabel=VOLTS)

    # 2: an elevator that somebody lets go
    lines = {f"{volts} V": simulate_lift(volts) for volts in (4, 2, 0)}
    yield chart_curves(TIME[:20], lines, xlabel=SECONDS, ylabel="height [m]")

    # 3 and 4: two kinds of tests, each in two directions
    yield chart_tests(log, "forward", VOLTS)
    yield chart_tests(log, "forward, reverse", VOLTS, SPEED)

    # 5: a ramp on a floor
    free, curves = replace(DRIVETRAIN, travel=None), [Curve("wall", [12.0] * 2, [0.0, 4.0], "bar")]
    for color, (name, tape) in enumerate({"no tape": None, "stopped at the tape": 4.0}.items()):
        went = drive_test(free, sim.Routine(), test=RAMP, floor=Floor(wall=12.0, tape=tape))
        curves.append(Curve(name, went.position, went.velocity, "line", color))
    yield Chart("distance from the start [m]", SPEED, curves)

    # 6: an encoder that slips
    slipped = contaminate(log, "encoder-slip", test=RAMP, rng=np.random.default_rng(2)).log
    lines = {"good log": run.velocity, "damaged log": slipped.runs[0].velocity}
    yield chart_curves(run.time, lines, xlabel=SECONDS, ylabel=SPEED)

    # 7: noisy samples and their line
    sensor = replace(DRIVETRAIN.sensor, velocity_noise=0.15)
    noisy = record(replace(DRIVETRAIN, sensor=sensor)).runs[0]
    x, y = noisy.velocity[10::8], noisy.voltage[10::8]
    slope, offset = np.polyfit(x, y, 1)
    yield chart_line_errors(x, y, intercept=offset, slope=slope, xlabel=SPEED, ylabel=VOLTS)

    # 8: gains in the wrong places
    swapped = TRUTH | {"kV": TRUTH["kA"], "kA": TRUTH["kV"]}
    yield chart_drives({"right order": TRUTH, "kV and kA swapped": swapped})

    # 9: a log, and simulations without and with drag
    robot = DRIVETRAIN.hide("drag")
    log = record(robot)
    run = log.runs[0]
    curves = [Curve("log", run.time[::5], run.velocity[::5], "dots", 0)]
    models = {"gains alone": Model("simple", robot.gains), "gains and drag": robot.model}
    for color, (name, model) in enumerate(models.items(), 1):
        curves.append(Curve(name, run.time, replay_log(model, log)[0].velocity, "line", color))
    yield Chart(SECONDS, SPEED, curves)

    # 10: a swerve drive that goes straight, and one that turns on the spot
    frame, curves = 0.3 * np.array([1 + 1j, 1 - 1j, -1 - 1j, -1 + 1j]), []  # x + j·y
    for place, ways in ((0.0, [0.4] * 4), (2.0, 1j * frame)):
        for corner, way in zip(place + frame, ways, strict=True):
            path, wheel = corner + way * np.array([[0.0, 1.0], [-0.2, 0.2]])
            curves.append(Curve("", path.real, path.imag, "line", 1))
            curves.append(Curve("", wheel.real, wheel.imag, "bar", 0))
    where = "x [m]: four wheels go straight, and turn on the spot"
    yield Chart(where, "y [m]", curves, x=(-2.0, 4.0), y=(-0.7, 0.7))


def draw(chart: Chart, *, share: float = 1.0) -> Image.Image:
    """A chart with the first part of each curve."""
    figure, ((axes,),) = make_panels(1, 1, width=8.6, height=2.8)
    for curve in chart.curves:
        pen = {"color": INK if curve.color is None else COLORS[curve.color], "label": curve.name}
        if curve.style == "area":
            axes.fill(curve.x, curve.y, alpha=0.3, **pen)
        else:
            wide = 6.0 if curve.style == "bar" else 1.5
            (line,) = axes.plot(curve.x, curve.y, STYLES[curve.style], linewidth=wide, **pen)
            if share < 1.0:
                axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())
                shown = 1 + int(share * (len(curve.x) - 1))
                line.set_data(curve.x[:shown], curve.y[:shown])
                axes.plot(curve.x[shown - 1], curve.y[shown - 1], "o", color=pen["color"])
    axes.set(xlabel=chart.xlabel, ylabel=chart.ylabel, xlim=chart.x, ylim=chart.y)
    add_legend(figure, [axes], columns=4)
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=110)
    return Image.open(drawn).convert("RGB")


def draw_lessons() -> Iterator[bytes]:
    """The picture of each lesson as PNG; in that of the first, the curves grow twice, for 4.8 s."""
    for lesson, chart in enumerate(chart_lessons()):
        whole, file = draw(chart).quantize(128), io.BytesIO()
        shares = np.linspace(0.0, 1.0, FRAMES, endpoint=False) if lesson == 0 else ()
        parts = [draw(chart, share=share) for share in shares]
        grown = [part.quantize(palette=whole, dither=Image.Dither.NONE) for part in parts]
        motion = {"save_all": True, "append_images": [*grown, whole], "default_image": True,
                  "duration": PERIOD, "loop": 2} if grown else {}  # fmt: skip
        whole.save(file, format="png", optimize=True, **motion)
        yield file.getvalue()


if __name__ == "__main__":
    for lesson, drawn in zip(sorted((ROOT / "lessons").glob("*.py")), draw_lessons(), strict=True):
        (ROOT / ".ci" / "pictures" / f"{lesson.stem}.png").write_bytes(drawn)
