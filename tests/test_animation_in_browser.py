"""Animations in a real browser: they move, answer at once, and simulate as the engine does."""

import io
from dataclasses import replace

import numpy as np
import pytest
from chromium import LEAST_CONTRAST, least_contrast
from lab import (
    LESSONS,
    OFTEN,
    PATIENCE,
    SCREEN,
    run_all,
    serving,
)
from matplotlib.image import imread

from sim.core.errors import BadRequest
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model
from sim.plot.animation import (
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Scene,
    Score,
    TestPlan,
    animate_mechanism,
)
from sim.plot.animation.charts import Chart, Curve, animate_charts
from sim.plot.picture import COLORS_ON_DARK

pytestmark = [pytest.mark.slow, pytest.mark.browser]

LEAST_PICTURES = 20.0  # [1/s] while a knob is dragged
PHONE = {"width": 390, "height": 844}
TIME = np.arange(0.0, 3.0, 0.02)
TARGET = np.interp(TIME, [0.0, 0.5, 1.0, 2.0, 2.5], [0.0, 0.0, 2.5, 2.5, -1.0])
GAINS = {"kS": 0.15, "kV": 2.5, "kA": 0.2}
KNOBS = (
    Knob("kS", "kS [V]", low=0.0, high=1.0, step=0.01, value=0.3),
    Knob("kV", "kV [V·s/m]", low=1.0, high=4.0, step=0.01, value=2.0),
    Knob("kA", "kA [V·s²/m]", low=0.0, high=0.6, step=0.01, value=0.1),
)
KNOB_GAINS = {name: Gain(name) for name in GAINS}
MOTIONS = {
    "program": Motion("robot", gains=GAINS, program=KNOB_GAINS),
    "model": Motion("robot", gains=KNOB_GAINS | {"kA": 0.3}, voltage=4.0 * np.sin(3 * TIME)),
    "elevator": Motion(
        "robot", gains=GAINS | {"kG": 1.2}, type="elevator", voltage=Gain("kV", 2.0), start=0.4
    ),
    "arm": Motion("robot", gains=GAINS | {"kG": 0.6}, type="arm", voltage=Gain("kS"), start=0.7),
    "test": Motion(
        "robot", gains=GAINS, plan=TestPlan(ramp=Gain("kV"), step=0.2, mark=0.8, reaction=0.3)
    ),
}
DRAG = """async ({figure, seconds}) => {
    const slider = figure.querySelector('.motion-knobs input');
    const [began, before] = [performance.now(), figure.animation.pictures];
    while (performance.now() - began < 1000 * seconds) {
        slider.value = 0.5 + 0.4 * Math.sin((performance.now() - began) / 90);
        slider.dispatchEvent(new Event('input', {bubbles: true}));
        await new Promise(requestAnimationFrame);
    }
    return (figure.animation.pictures - before) / ((performance.now() - began) / 1000);
}"""


def race(motion=MOTIONS["program"], **more):
    """A race against a target, as in lesson 0."""
    asked = Motion("target", velocity=TARGET, asked=True)
    given = {"score": Score("robot"), "wall": 6.0} | more
    return animate_mechanism(
        "drivetrain",
        Scene(TIME, (asked, motion), target=TARGET),
        panels=(Panel("velocity", "velocity [m/s]"), Panel("voltage", "voltage [V]")),
        knobs=KNOBS,
        alt="A robot beside a dashed target.",
        **given,
    )


def ask_charts(style, slope):
    """A line with a number at its end, and bars in rows; no line falls."""
    if slope < 0.0:
        raise BadRequest("a line that falls", advice="Choose a slope above 0.")
    line = Curve("the line", TIME, slope * TIME, style, 0, [""] * (TIME.size - 1) + [f"{slope:g}"])
    bar = Curve("", [0.0, slope], [0.0, 0.0], "bar", 2, ["", f"{slope:g} V"])
    return [Chart("t [s]", "y [V]", (line,)), Chart("bars [V]", "", (bar,), ("kS", "kV"))]


def charts():
    """Two charts that a menu and a slider change."""
    return animate_charts(
        ask_charts,
        choices=(Choice("style", ("line", "dots", "dashed", "area")),),
        knobs=(Knob("slope", "slope", low=-0.1, high=1.0, step=0.1, value=0.5),),
    )


@pytest.fixture
def shown(browser, tmp_path):
    """Shows an animation in a page; the first figure of it."""
    pages = []

    def open_page(animation, *, viewport=SCREEN, motion="reduce", scheme="light"):
        path = tmp_path / "page.html"
        path.write_text(f'<!DOCTYPE html><meta charset="utf-8">{animation.html}', encoding="utf-8")
        page = browser.new_page(viewport=viewport, reduced_motion=motion, color_scheme=scheme)
        page.set_default_timeout(PATIENCE)
        page.complaints, page.asked = [], []
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.on("request", lambda request: page.asked.append(request.url))
        page.goto(path.as_uri())
        page.locator("figure[data-alive] .motion-knobs, .motion-clock").first.wait_for()
        pages.append(page)
        return page, page.locator("figure.motion").first

    yield open_page
    for page in pages:
        assert page.complaints == []
        assert {url.partition(":")[0] for url in page.asked} == {"file"}
        page.close()


def wanted_volts():
    """The voltage of each motion, as the knobs first stand."""
    speed, push = (TARGET[:-1] + TARGET[1:]) / 2, np.diff(TARGET) / np.diff(TIME)
    ramp = 0.2 + 2.0 * TIME
    free = simulate_run(
        Model("simple", GAINS), time=TIME, voltage=ramp, state=State.cold_at(0.0)
    ).position
    off = TIME[int(np.argmax(free > 0.8))] + 0.3
    return {
        "program": np.append(0.3 * np.sign(speed) + 2.0 * speed + 0.1 * push, 0.0),
        "model": 4.0 * np.sin(3 * TIME),
        "elevator": np.full(TIME.size, 4.0),
        "arm": np.full(TIME.size, 0.3),
        "test": np.where(off > TIME, ramp, 0.0),
    }


@pytest.mark.parametrize("name", MOTIONS)
def test_the_page_simulates_as_the_engine_does(name, shown):
    motion, volts = MOTIONS[name], wanted_volts()[name]
    kind = motion.type if motion.type != "simple" else "drivetrain"
    scene = Scene(TIME, (motion,), target=TARGET)
    panels = (Panel("velocity", "v"),)
    _, figure = shown(animate_mechanism(kind, scene, panels=panels, knobs=KNOBS, alt="It moves."))
    found = figure.evaluate("figure => figure.animation.scene.motions[0]")

    track = simulate_run(
        Model(motion.type, found["gains"]), time=TIME, voltage=volts,
        state=State.cold_at(motion.start),
    )  # fmt: skip
    wanted = {"voltage": volts, "velocity": track.velocity, "position": track.position}
    for signal, values in wanted.items():
        assert np.abs(np.array(found[signal]) - values).max() < 1e-3 * np.abs(values).max(), signal


def test_axes_show_all_scenes_and_keep_limits_that_were_given(shown):
    late = Motion("robot", velocity=TARGET, position=TIME - 0.25)
    asked = Motion("target", velocity=TARGET, position=TIME, asked=True)
    scenes = {
        ("slow",): Scene(TIME, (asked, late)),
        ("fast",): Scene(TIME, (Motion("robot", velocity=3.0 * TARGET),)),
    }
    panels = (
        Panel("velocity", "[m/s]"), Panel("position", "[cm]", low=-7.0, scale=100.0),
        Panel("error", "[m]"),
    )  # fmt: skip
    choices = (Choice("drive", ("slow", "fast")),)
    _, figure = shown(
        animate_mechanism("drivetrain", scenes, panels=panels, choices=choices, alt="It moves.")
    )
    speed, place, error = figure.evaluate("figure => figure.animation.data.panels")
    stage = figure.evaluate("figure => figure.animation.data.stage")

    assert 7.5 < speed["high"] < 8.5
    assert place["low"] == -7.0
    assert 100 * TIME[-1] < place["high"]
    assert stage["high"] == pytest.approx(place["high"] / 100.0, rel=0.01)
    assert stage["low"] < 0.0
    assert error["low"] == pytest.approx(-0.27)


def test_a_knob_changes_the_motion_the_score_and_the_picture(shown):
    _, figure = shown(race())
    before = figure.locator("polyline").nth(1).get_attribute("points")
    score = figure.locator(".motion-score").inner_text()
    figure.get_by_label("kV [V·s/m]").press("ArrowRight")

    assert figure.evaluate("figure => figure.animation.knobs.kV") == pytest.approx(2.01)
    assert figure.locator("polyline").nth(1).get_attribute("points") != before
    assert figure.locator(".motion-score").inner_text() != score
    assert "best" in figure.locator(".motion-score").inner_text()


@pytest.mark.parametrize("kind", ["race", "charts"])
def test_knobs_answer_at_twenty_pictures_a_second(kind, shown, capsys):
    _, figure = shown(race() if kind == "race" else charts())
    rate = figure.evaluate(f"figure => ({DRAG})({{figure, seconds: 1.5}})")
    with capsys.disabled():
        print(f"\n{rate:.0f} pictures a second")  # noqa: T201 - a figure for whoever runs it
    assert rate >= LEAST_PICTURES


def test_a_menu_and_a_slider_change_charts_and_a_refusal_is_read(shown):
    page, figure = shown(charts(), viewport=PHONE)
    drawing = figure.locator("svg[role=img]").first
    before = drawing.inner_html()
    assert "the line, 0.5" in drawing.get_attribute("aria-label")
    figure.get_by_label("slope").press("ArrowRight")
    assert "the line, 0.6" in drawing.get_attribute("aria-label")
    figure.get_by_label("style").select_option("dots")
    assert drawing.inner_html() != before
    assert figure.locator("svg[role=img]").last.get_by_text("kV", exact=True).is_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    figure.get_by_label("slope").press("Home")
    assert figure.get_by_text("Choose a slope above 0.").is_visible()


def test_the_cursor_moves_robot_and_plots_together(shown):
    page, figure = shown(race())
    car = figure.locator("svg").first.locator("g").first
    line = figure.locator(".motion-panels svg[role=img] line[stroke-width='1.5']").first
    before = car.get_attribute("transform"), line.get_attribute("x1")
    panel = figure.locator(".motion-panels svg[role=img]").first
    box = panel.bounding_box()
    page.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + 0.5 * box["height"])

    assert car.get_attribute("transform") != before[0]
    assert line.get_attribute("x1") != before[1]
    assert 2.0 < figure.evaluate("figure => figure.animation.now") < 2.8


def test_the_keyboard_plays_pauses_and_moves_the_cursor(shown):
    page, figure = shown(race())
    cursor = figure.get_by_label("time", exact=True)
    cursor.focus()
    page.keyboard.press("ArrowRight")
    assert cursor.evaluate("cursor => Number(cursor.value)") == pytest.approx(0.0298, abs=1e-6)
    assert "robot at" in cursor.get_attribute("aria-valuetext")
    page.keyboard.press("Space")
    assert figure.evaluate("figure => figure.animation.playing")
    page.wait_for_function(
        "figure => figure.animation.now > 0.2", arg=figure.element_handle(), polling=OFTEN
    )
    page.keyboard.press("Space")
    assert not figure.evaluate("figure => figure.animation.playing")


@pytest.mark.parametrize(("motion", "plays"), [("no-preference", True), ("reduce", False)])
def test_animation_plays_by_itself_unless_less_motion_is_asked_for(motion, plays, shown):
    page, figure = shown(race(), motion=motion)
    page.wait_for_timeout(600)
    assert figure.evaluate("figure => figure.animation.now > 0") is plays


@pytest.mark.parametrize("kind", ["drivetrain", "elevator", "arm", "flywheel", "swerve"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_each_mechanism_is_drawn_moves_and_fits_a_phone(kind, scheme, shown):
    motion = Motion("robot", velocity=0.5 + 0 * TIME, heading=TIME)
    scene = Scene(TIME, (motion, replace(motion, name="model", ghost=True)))
    page, figure = shown(
        animate_mechanism(kind, scene, panels=(Panel("velocity", "v"),), alt="It moves."),
        viewport=PHONE,
        scheme=scheme,
    )
    pictures = []
    for share in (0.0, 0.6):
        figure.evaluate(f"figure => figure.animation.show({share} * figure.animation.duration)")
        pictures.append(imread(io.BytesIO(figure.locator("svg").first.screenshot())))
    assert not np.array_equal(*pictures)
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    for svg in figure.locator("svg[role=img]").all():
        assert len(svg.get_attribute("aria-label")) > 3


@pytest.mark.parametrize(
    "darken",
    [
        "document.body.dataset.jpThemeLight = 'false'",  # JupyterLab's dark theme
        "document.documentElement.style.colorScheme = 'dark'",
    ],
)
def test_colors_of_an_animation_stand_out_from_a_dark_page(darken, shown):
    page, figure = shown(race())
    page.evaluate(f"() => {{ {darken}; }}")
    fills = (
        "figure => [...figure.querySelectorAll('svg *')].map(node => getComputedStyle(node).fill)"
    )
    blue = tuple(int(COLORS_ON_DARK[0][at : at + 2], 16) for at in (1, 3, 5))
    assert f"rgb{blue}" in figure.evaluate(fills)
    for at in range(len(COLORS_ON_DARK)):
        style = f"color: var(--motion-color-{at}); background: #121212"
        figure.evaluate(
            "(figure, style) => figure.insertAdjacentHTML('beforeend',"
            " `<b class='sample' style='${style}'>robot</b>`)",
            style,
        )
    assert least_contrast(page, ".sample") >= LEAST_CONTRAST


def test_lesson_0_moves_in_jupyterlab_and_keeps_its_keys_from_the_notebook(browser, tmp_path):
    (lesson,) = (path for path in LESSONS if path.stem.startswith("00"))
    with serving(tmp_path) as address:
        page = browser.new_page(viewport=SCREEN)
        page.set_default_timeout(PATIENCE)
        run_all(page, address.format(name=lesson.name))
        figures = page.locator("figure.motion")
        assert figures.count() == page.locator("figure[data-alive]").count() > 2
        figure = figures.first
        figure.scroll_into_view_if_needed()
        page.wait_for_function(
            "figure => figure.animation.now > 0.2", arg=figure.element_handle(), polling=OFTEN
        )
        active = (
            "[...document.querySelectorAll('.jp-Cell')]"
            ".findIndex(cell => cell.matches('.jp-mod-active'))"
        )
        figure.get_by_label("time", exact=True).focus()  # which makes its cell the active one
        before = page.evaluate(active)
        page.keyboard.press("ArrowDown")
        page.keyboard.press("ArrowDown")
        assert page.evaluate(active) == before
        assert not figure.evaluate("figure => figure.animation.playing")
        page.close()
