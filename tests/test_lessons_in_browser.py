"""The lessons as a learner meets them: JupyterLab in a real browser, offline, in both themes."""

import io
import os
import re
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from urllib.parse import urlsplit

import numpy as np
import pytest
from chromium import LEAST_CONTRAST, least_contrast
from lab import (
    LESSONS,
    OFTEN,
    PATIENCE,
    SCREEN,
    choose_run_all,
    make_environment,
    outputs,
    run_all,
    serving,
    wait_until_idle,
)
from matplotlib.image import imread
from places import ROOT

from grader.exercise.exercise import list_exercises
from sim.physics.effects import EFFECTS

TEXTS = (
    ".jp-OutputArea td, .jp-OutputArea th, .jp-OutputArea caption, .jp-OutputArea summary, "
    ".jp-OutputArea .widget-label, .jp-RenderedMarkdown p"
)
ADDRESS = re.compile(r"http://127\S+token=\w+")
LAPTOP = {"width": 1366, "height": 768}
HOME = {"127.0.0.1", "localhost"}
DRAWN = "drawings => drawings.map(drawing => drawing.innerHTML).join()"
LOADED = "picture => picture.complete && picture.naturalWidth > 0 && performance.now()"  # [ms]
TURN = """figure => {
    const knob = figure.querySelector('.motion-knobs :is(input, select)');
    if (knob.tagName === 'SELECT') knob.selectedIndex = knob.selectedIndex ? 0 : 1;
    else knob.value = knob.value === knob.max ? knob.min : knob.max;
    knob.dispatchEvent(new Event(knob.tagName === 'SELECT' ? 'change' : 'input'));
}"""
ENDS = """figure => figure.querySelectorAll('.motion-knobs input').forEach(knob => {
    for (const end of [knob.min, knob.max]) {
        knob.value = end;
        knob.dispatchEvent(new Event('input'));
    }
})"""

pytestmark = [pytest.mark.slow, pytest.mark.browser]


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """Where a JupyterLab serves a copy of the lessons, each in an empty workspace."""
    with serving(tmp_path_factory.mktemp("lab")) as where:
        yield where


@pytest.fixture
def page(browser):
    """A page that asks nobody elsewhere and complains of nothing."""
    hosts, complaints = set(), []
    opened = browser.new_page(viewport=SCREEN)
    opened.set_default_timeout(3 * PATIENCE)  # a first kernel compiles the engine
    opened.on("request", lambda request: hosts.add(urlsplit(request.url).hostname))
    opened.on("pageerror", lambda error: complaints.append(str(error)))
    yield opened
    opened.close()
    assert hosts - {None} <= HOME  # a data: address has no host
    assert complaints == []


def check_lesson(page, folder):
    """A lesson that ran to its end is whole, can be turned and can be read in both themes."""
    assert outputs(page, "error") == []
    assert outputs(page, "stderr") == []
    _check_pictures(page)
    _check_knobs(page)
    for theme in ("JupyterLab Light", "JupyterLab Dark"):
        _use_theme(page, theme)
        assert _faintest(page) >= LEAST_CONTRAST, theme
        page.screenshot(path=folder / f"{theme}.png")


# Every lesson is executed in test_lessons.py, 0 and 9 below; a browser takes 20 s for each.
@pytest.mark.parametrize("lesson", LESSONS[4::2], ids=lambda path: path.stem)
def test_a_lesson_runs_in_a_browser_without_the_network(lesson, address, page, tmp_path):
    run_all(page, address.format(name=lesson.name))

    check_lesson(page, tmp_path)


@pytest.fixture
def printed(tmp_path):
    """The address that ``grade start`` prints, in a course with all lessons and no exercise."""
    for name in ("exercises", "lessons", "solutions"):
        (tmp_path / name).mkdir()
    for lesson in LESSONS:
        for path in (lesson, lesson.with_suffix(".py")):
            shutil.copy(path, tmp_path / "lessons")
    process = subprocess.Popen(
        [sys.executable, "-m", "grader", "start"],
        cwd=tmp_path,
        env=make_environment(tmp_path) | {"BROWSER": str(tmp_path / "none")},  # it opens no window
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
    )
    try:
        yield next(filter(None, map(ADDRESS.search, process.stdout)))[0]
    finally:
        process.terminate()
        process.communicate(timeout=20)


def test_a_newcomer_soon_sees_something_move(printed, browser):
    page = browser.new_page(viewport=SCREEN)
    page.set_default_timeout(PATIENCE)
    begun = time.monotonic()
    page.goto(printed)
    picture = page.locator(".jp-RenderedMarkdown img").first
    picture.wait_for()
    loaded = page.wait_for_function(LOADED, arg=picture.element_handle()).json_value()
    before = picture.screenshot()  # a picture that moves does so from its first moment
    while picture.screenshot() == before:
        assert time.monotonic() - begun < PATIENCE / 1000, "the first picture stands still"
    wait_until_idle(page)
    there = time.monotonic()
    choose_run_all(page)
    scene = page.locator(".jp-OutputArea svg[role=img]").first
    scene.scroll_into_view_if_needed()
    page.wait_for_function(
        "([scene, before]) => scene.innerHTML !== before",
        arg=[scene.element_handle(), scene.inner_html()],
        polling=OFTEN,
    )
    moving = time.monotonic()
    print(  # noqa: T201 - figures to read; a busy machine may take longer
        f"lesson 0: picture moves after {loaded / 1000:.1f} s, open after {there - begun:.1f} s, "
        f"simulation moves {moving - there:.1f} s later"
    )

    assert page.url.endswith(f"/lab/tree/lessons/{LESSONS[0].name}")
    listed = page.locator(".jp-DirListing-itemText").all_inner_texts()
    assert listed == [lesson.name for lesson in LESSONS]
    assert page.get_by_text("Jupyter news").count() == 0
    page.close()


@pytest.mark.parametrize("lesson", LESSONS[::5], ids=lambda path: path.stem)
def test_the_first_screen_of_a_lesson_holds_its_picture(lesson, address, page):
    page.set_viewport_size(LAPTOP)
    page.goto(address.format(name=lesson.name))
    picture = page.locator(".jp-RenderedMarkdown img").first
    picture.wait_for()
    page.wait_for_function(
        "picture => picture.naturalWidth > 0", arg=picture.element_handle(), polling=OFTEN
    )
    box = picture.bounding_box()

    assert box["y"] > 0
    assert box["y"] + box["height"] < LAPTOP["height"]
    assert box["x"] + box["width"] < LAPTOP["width"]
    assert _colors(picture.screenshot()) > 50


def test_a_prediction_a_quick_check_and_a_box_answer_a_click(address, page, tmp_path):
    run_all(page, address.format(name=LESSONS[0].name))
    check_lesson(page, tmp_path)

    def click(asked, answer):
        question = page.locator(".jp-OutputArea .widget-vbox").filter(has_text=asked)
        question.get_by_text(answer, exact=True).click()
        question.get_by_text(re.compile(r"^(?:No|Not yet|Right)\. ")).wait_for()
        return question.locator("p b").inner_text()

    prediction = "Who gets the smaller typical error?"
    assert click(prediction, "I do, clearly").startswith("No. The answer is: the three lines.")
    assert click("Which gain changed when", "kS").startswith("Not yet. Most friction")
    box = page.locator(".jp-RenderedMarkdown input[type=checkbox]").first
    box.check()
    assert box.is_checked()
    assert page.evaluate(
        "Object.keys(localStorage).some(key => key.startsWith('system check: '))"
    )  # it is kept


def test_a_student_finds_what_lesson_9_hides_by_clicks(address, page, tmp_path):
    """As the page says: the largest share, an effect for it, fit, look again, stop."""
    run_all(page, address.format(name="09_reality_gap.ipynb"))
    check_lesson(page, tmp_path)
    widget = page.locator(".jp-Notebook .widget-vbox").filter(
        has=page.get_by_role("button", name="Add and fit")
    )
    said = widget.locator("p b").last

    def press(button, reply):
        widget.get_by_role("button", name=button).click()
        widget.get_by_text(reply).first.wait_for()

    def add(effect):
        widget.locator("select").select_option(effect)
        press("Add and fit", f"{effect}, the gap of the validation log is")
        return float(re.search(r"validation log is ([\d.]+)", said.inner_text())[1])

    def shares():
        words = widget.locator("figure.picture img").last.get_attribute("alt")
        listed = re.search(r"squared residual: (.*?)\.", words)[1]
        return dict(one.removesuffix(" %").rsplit(" ", 1) for one in listed.split(", ")), words

    first, _ = shares()
    assert max(first, key=lambda name: int(first[name])) == "time since the voltage jumped"
    late = add("delay")
    press("Take back", "With gains alone, the gap")
    filtered = add("velocity-filter")
    second, _ = shares()
    assert max(second, key=lambda name: int(second[name])) == "speed"
    done = add("stribeck")
    assert "At least 90 % of this is noise." in shares()[1]
    widget.locator("select").select_option("velocity-filter")  # needed; added again, it comes last
    press("Take back", "With stribeck, the gap")
    assert add("velocity-filter") == done
    widget.screenshot(path=tmp_path / "found.png")
    press("Stop, open the held-out log", "The held-out log is open.")
    opened = widget.inner_text()

    assert done < filtered < late
    assert 'effects = ["velocity-filter", "stribeck"]' in opened
    before, after = (
        float(re.search(rf"{name} = ([\d.]+)", opened)[1]) for name in ("gap_before", "gap_after")
    )
    assert after < 1.1 < before
    window = re.search(r"velocity-filter.window \[s\]\s+([\d.]+)\s+([\d.]+)", opened)
    assert float(window[1]) == pytest.approx(float(window[2]), rel=0.05)  # yours, and the truth
    assert widget.get_by_role("button", name="Add and fit").is_disabled()
    page.screenshot(path=tmp_path / "opened.png")


@pytest.mark.parametrize("number", range(int(os.environ.get("SYSID_STUDENTS", "0"))))
def test_what_lesson_9_asks_gives_a_student_full_marks(number, page, tmp_path):
    """On the student's own log: each effect of the largest share's line, the best one stays."""
    student, home = f"student {number}", tmp_path / "home"
    (every,) = (one for one in list_exercises(ROOT) if one.name == "exercise12")
    mine = replace(every, folder=home / "exercises" / every.name)
    shutil.copytree(every.folder, mine.folder, ignore=shutil.ignore_patterns("data", "__pycache__"))
    mine.prepare(student, say=lambda _: None)
    with serving(home) as address:
        run_all(page, address.format(name="09_reality_gap.ipynb"))
        listed = (" ".join(one.split()) for one in page.locator("li").all_inner_texts())
        found = [re.fullmatch(r"([\w ]+): ([\w-]+(?:, [\w-]+)*)[;.]", one) for one in listed]
        lines = {one[1]: one[2].split(", ") for one in found if one}
        widget = page.locator(".jp-Notebook .widget-vbox").filter(
            has=page.get_by_role("button", name="Add and fit")
        )
        answer = StudentByPage(widget.last, lines).find_effects()
    (mine.folder / "answers.toml").write_text(answer, encoding="utf-8")
    graded = mine.grade(mine.folder / "answers.toml", student=student)

    assert [check for check in graded.checks if check.status != "passed"] == []
    assert graded.score == graded.max_score


class StudentByPage:
    """A student who does with the search of lesson 9 what the page asks, and nothing else."""

    def __init__(self, widget, lines):
        self.widget, self.lines, self.model = widget, lines, []
        self.said = widget.locator("p b")

    def press(self, button, effect):
        """Press a button for an effect: the gap and the verdict that are then shown."""
        menu = self.widget.locator("select")
        if menu.input_value() != effect:
            menu.select_option(effect)
            self.widget.get_by_text(EFFECTS[effect].summary).wait_for()
        before = self.said.all_inner_texts()
        self.widget.get_by_role("button", name=button).click()
        deadline = time.monotonic() + PATIENCE / 1000
        while (said := self.said.all_inner_texts()) == before or "Fitting…" in "".join(said):
            assert time.monotonic() < deadline, f"{button} {effect}: no answer"
            time.sleep(OFTEN / 1000)
        shown = r"log is ([\d.]+).*That is ((?:no )?better than)"
        return re.search(shown, self.said.last.inner_text())

    def try_effects(self, names):
        """The effect with the smallest gap of those that make it smaller; empty if none does."""
        gaps = {}
        for name in (name for name in names if name not in self.model):
            gap, verdict = self.press("Add and fit", name).groups()
            if name in self.said.last.inner_text():  # it was not refused
                self.press("Take back", name)
                gaps |= {name: float(gap)} if verdict == "better than" else {}
        return min(gaps, key=gaps.get, default="")

    def list_lines(self):
        """The effects of each plot, that of the largest share first; all if no plot shows most."""
        words = self.widget.locator("figure.picture img").last.get_attribute("alt")
        listed = re.search(r"squared residual: (.*?)\.", words)[1].split(", ")
        shares = dict(one.removesuffix(" %").rsplit(" ", 1) for one in listed)
        hidden = re.search(r"(\d+) % of the gap beyond noise shows in no plot", words)
        if hidden and int(hidden[1]) > 50:
            return [[name for line in self.lines.values() for name in line]]
        return [self.lines[name] for name in sorted(shares, key=lambda one: -int(shares[one]))]

    def find_effects(self):
        """Add effects until none helps, check each, and open the held-out log: its lines."""
        while best := next(filter(None, map(self.try_effects, self.list_lines())), ""):
            self.model.append(best)
            if float(self.press("Add and fit", best)[1]) < 1.1:
                break
        for name in self.model[:] if len(self.model) > 1 else []:
            self.press("Take back", name)
            if self.press("Add and fit", name)[2] == "no better than":
                self.press("Take back", name)
                self.model.remove(name)
        self.press("Stop, open the held-out log", self.model[0])
        return self.widget.locator("pre").inner_text()


def _check_pictures(page):
    """Every picture has come through, says in words what it shows, and is not blank."""
    pictures = page.locator(".jp-Notebook img")
    assert pictures.count() + page.locator(".jp-Notebook figure.motion").count() > 0
    for picture in pictures.all():
        picture.scroll_into_view_if_needed()
        assert picture.get_attribute("alt")
        assert picture.evaluate("image => image.decode().then(() => image.naturalWidth)") > 0
        assert _colors(picture.screenshot()) > 50


def _check_knobs(page):
    """Widgets are shown, and the first menu or slider of each figure changes what it shows."""
    assert page.locator(".jp-Notebook .jupyter-widgets").count() > 0
    assert page.get_by_text("Error displaying widget").count() == 0
    for figure in page.locator("figure.motion").filter(has=page.locator(".motion-knobs")).all():
        before = figure.locator("svg[role=img]").evaluate_all(DRAWN)
        figure.evaluate(TURN)
        assert figure.locator("svg[role=img]").evaluate_all(DRAWN) != before
        figure.evaluate(ENDS)  # an error there is a complaint of the page


def _use_theme(page, theme):
    page.locator(".lm-MenuBar-itemLabel", has_text="Settings").first.click()
    page.locator(".lm-Menu-itemLabel").get_by_text("Theme", exact=True).hover()
    page.locator(".lm-Menu-itemLabel").get_by_text(theme, exact=True).click()
    page.locator(f'body[data-jp-theme-name="{theme}"]').wait_for(state="attached")


def _faintest(page):
    """The smallest contrast of any text that our pictures and tables put into the page."""
    return least_contrast(page, TEXTS)


def _colors(png):
    """How many colors a screenshot has: a blank one has one."""
    pixels = (imread(io.BytesIO(png))[:, :, :3] * 255).astype(np.uint32)
    return np.unique(pixels @ np.array([65536, 256, 1], dtype=np.uint32)).size
