"""The page of `sysid open` in a real browser: drop logs, move gains, nothing asked of elsewhere."""

import base64
import re
import time
from dataclasses import replace

import numpy as np
import pytest
from chromium import LEAST_CONTRAST, least_contrast
from open_page import drive_log, served, slipped_log, write_log, write_old_json

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli.open.session import LiveView
from sim.core.units import TURN
from sim.fit import fit
from sim.fit.replay import replay_fit
from sim.inspect.contaminate import contaminate
from sim.io import read
from sim.io.formats.wpilog.signals import SignalGroup, write_signals

DESKTOP, PHONE = {"width": 1280, "height": 900}, {"width": 390, "height": 844}
PATIENCE = 30_000  # [ms]
DROP = """(files) => {
    const given = new DataTransfer();
    for (const {name, content} of files) {
        const bytes = Uint8Array.from(atob(content), one => one.charCodeAt(0));
        given.items.add(new File([bytes], name));
    }
    window.dispatchEvent(new DragEvent('drop', {dataTransfer: given, bubbles: true}));
}"""
DRAG = """async ({id, seconds}) => {
    const slider = document.getElementById(id);
    const [low, high] = [Number(slider.min), Number(slider.max)];
    const [began, before] = [performance.now(), sysid.chart.pictures];
    while (performance.now() - began < 1000 * seconds) {
        const share = 0.5 + 0.4 * Math.sin((performance.now() - began) / 90);
        slider.value = low + share * (high - low);
        slider.dispatchEvent(new Event('input', {bubbles: true}));
        await new Promise(requestAnimationFrame);
    }
    return (sysid.chart.pictures - before) / seconds;
}"""
SET = """(slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event('input', {bubbles: true}));
}"""
IN_VIEW = """(place => {
    const box = document.querySelector(place).getBoundingClientRect();
    return box.top >= 0 && box.bottom <= innerHeight;
})"""
WATCH_TEXTS = """() => {
    window.texts = [];
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (words, ...place) {
        window.texts.push(words);
        write.call(this, words, ...place);
    };
    const {runs} = sysid.chart;
    const faults = runs.map(({time}, run) => ({
        run, number: `${run + 1}`, fault: 'wheel-slip', color: 'fault',
        start: time[0], end: time[0] + 0.1,
    }));
    sysid.chart.mark({faults});
}"""
CURVE = "[...sysid.logs.values()][0].simulated.map(one => one && [...one.velocity])"

TEXTS = (
    "#work :is(h1, h2, h3, p, dt, dd, label, li), kbd, .tab button.name, "
    "#work .button:not([hidden]):not(:disabled), .chip"
)
pytestmark = [pytest.mark.slow, pytest.mark.browser]


@pytest.fixture
def server(tmp_path):
    """A page without logs."""
    (tmp_path / "session").mkdir()
    with served(tmp_path / "session") as running:
        running.session.warm_up()
        yield running


@pytest.fixture
def page(browser, server):
    """The page on a desktop; what it asks for and complains of is noted."""
    with opened(browser, server.address) as one:
        yield one


class opened:  # noqa: N801 - used as a function
    """A tab with the page."""

    def __init__(self, browser, address, viewport=DESKTOP, theme="light"):
        self.page = browser.new_page(viewport=viewport, color_scheme=theme)
        self.page.set_default_timeout(PATIENCE)
        self.page.asked, self.page.complaints = [], []
        self.page.on("request", lambda one: self.page.asked.append(one.url))
        self.page.on("pageerror", lambda one: self.page.complaints.append(str(one)))
        self.page.on(
            "console",
            lambda one: self.page.complaints.append(one.text) if one.type == "error" else None,
        )
        self.page.goto(address)

    def __enter__(self):
        return self.page

    def __exit__(self, *_):
        self.page.close()


def drop(page, *files):
    """Drop files on the page, as a hand does."""
    page.evaluate(DROP, [as_dropped(file.name, file.read_bytes()) for file in files])


def as_dropped(name, content):
    return {"name": name, "content": base64.b64encode(content).decode()}


def wait_until(page, expression):
    """Wait until something is so; the page's policy forbids what Playwright has for it."""
    last = time.monotonic() + PATIENCE / 1000
    while not page.evaluate(expression):
        assert time.monotonic() < last, expression
        page.wait_for_timeout(50)


def error_shown(page):
    """The simulation error on the page, in the log's unit per second."""
    return float(re.search(r"[\d.]+", page.locator("#meter .quiet").inner_text())[0])


def write_each(folder):
    """The same log in every format."""
    log = drive_log()
    return [
        write_log(log, folder / "drive.wpilog"),
        write_log(log, folder / "drive.wpilogxz"),
        write_log(log, folder / "drive.csv"),
        write_old_json(log, folder / "drive.json"),
    ]


def test_each_format_is_shown_and_fitted_alike(page, tmp_path):
    for file in write_each(tmp_path):
        drop(page, file)
        page.locator(".tab.now .name", has_text=file.name).or_(
            page.locator(".tab .name", has_text=file.name)
        ).click()
        page.locator("h1#title", has_text=file.name).wait_for()
        page.locator("#gain-kV").wait_for()

        assert float(page.get_by_label("kV as a number").input_value()) == pytest.approx(
            2.5238, rel=2e-3
        )
        assert page.locator(".chip").count() == 5
        page.locator("#faults .well").wait_for()
    assert page.locator(".tab").count() == 4
    assert page.complaints == []


def test_watched_log_is_shown_live(page, server, tmp_path):
    log = drive_log()
    path = write_log(log, tmp_path / "robot.wpilog")
    assert not page.locator("#live").is_visible()
    counts = dict.fromkeys([run.test for run in log.runs], 0)
    server.session.live = LiveView("waiting for a log", counts)
    page.reload()
    page.locator("#live-status", has_text="waiting for a log").wait_for()
    assert page.locator("#live-tests li.done").count() == 0
    seen = []
    for count in (3, 4):
        server.session.renew("robot", path, {"": replace(log, runs=log.runs[:count])})
        counts |= {run.test: 1 for run in log.runs[:count]}
        server.session.live = LiveView("following robot.wpilog", counts, f"{4 - count} missing.")
        page.locator("#live-next", has_text=f"{4 - count} missing.").wait_for()
        wait_until(page, f"document.querySelectorAll('#runs .chip').length === {count + 1}")
        wait_until(page, "[...sysid.logs.values()][0].fit !== null")
        page.locator("#gain-kV").wait_for()
        seen.append(page.evaluate("[...sysid.logs.values()][0].gains"))

    assert page.locator("#live-tests li.done").count() == 4
    assert page.locator(".tab").count() == 1
    assert seen[0] != seen[1]
    assert {re.sub(r"^(http://[^/]+).*", r"\1", url) for url in page.asked} == {
        f"http://{server.hosts[0]}"
    }
    assert page.complaints == []


def test_verdict_gap_faults_and_warnings_are_seen_without_scrolling(browser, server, tmp_path):
    with opened(browser, server.address, {"width": 1366, "height": 768}) as page:
        drop(page, write_log(slipped_log(), tmp_path / "slipped.csv"))
        page.locator("#fault-lines .link", has_text="encoder slip (sure)").wait_for()
        page.locator("#meter .gap", has_text="× sensor noise").wait_for()
        wait_until(page, "!document.querySelector('#loading').classList.contains('busy')")

        assert page.locator("#word").inner_text() == "Check first"
        assert re.search(r"[\d.]+\s% of top speed", page.locator("#meter .gap").inner_text())
        assert page.locator("#verdict").inner_text().startswith("kS usable")
        for line in page.locator("#verdict-card :is(h2, .gap, #verdict, li)").all():
            assert line.bounding_box()["y"] + line.bounding_box()["height"] < 768
        warnings = page.locator("#doubts summary").all()
        assert all(line.bounding_box()["height"] < 30 for line in warnings)  # one line each
        warnings[0].click()
        assert page.locator("#doubts details[open] p").count() == 1
        said = page.locator("#doubts li").all_inner_texts()
        assert len(said) == len(set(said))
        assert "--" not in page.locator("body").inner_text()


def test_verdict_and_curves_are_on_the_first_screen_of_a_phone(browser, server, tmp_path):
    with opened(browser, server.address, PHONE) as page:
        drop(page, write_log(slipped_log(), tmp_path / "a log with a rather long name indeed.csv"))
        page.locator("#meter .gap", has_text="× sensor noise").wait_for()

        assert page.locator("#word").inner_text() != "Fitting…"
        for place in ("#word", "#meter .gap", "#plot"):
            assert page.evaluate(f"{IN_VIEW}('{place}')"), place
        assert page.evaluate("scrollY") == 0


def test_every_fault_has_its_name_or_number_in_the_chart_of_a_phone(browser, server, tmp_path):
    with opened(browser, server.address, PHONE) as page:
        drop(page, write_log(drive_log(), tmp_path / "drive.csv"))
        page.locator("#gain-kV").wait_for()
        page.evaluate(WATCH_TEXTS)
        wait_until(page, "window.texts.length > 0")
        texts = page.evaluate("window.texts")

    assert {one[:1] for one in texts if "wheel slip" in one or one in "1234"} == set("1234")
    assert sum("wheel slip" in one for one in texts) >= 1


def test_what_is_left_out_is_neither_drawn_nor_counted(page, tmp_path):
    drop(page, write_log(slipped_log(), tmp_path / "slipped.csv"))
    page.locator("#gain-kV").wait_for()
    before = page.locator("#meter .gap").inner_text()
    page.get_by_role("button", name="Look for what is missing").click()
    page.get_by_role("button", name="Stop").wait_for()
    page.locator("#faults").get_by_role("button", name="Leave out").click()
    page.get_by_text("its search is gone").wait_for()
    page.get_by_text("Left out: quasistatic-forward").wait_for()
    wait_until(page, "[...sysid.logs.values()][0].fit?.doubts.length === 0")
    holes = "[...sysid.logs.values()][0].simulated.map(one => one.velocity.filter(isNaN).length)"

    assert page.evaluate(holes)[0] > 5
    assert page.evaluate(holes)[1:] == [0, 0, 0]
    assert page.locator("#meter .gap").inner_text() != before
    page.locator("#moving").focus()
    page.keyboard.press("Home")
    assert "NaN" not in page.locator("#readout").inner_text()


def test_a_fault_of_nearly_a_whole_run_cannot_be_left_out(page, tmp_path):
    rng = np.random.default_rng(4)
    dropped = contaminate(
        drive_log(4), "voltage-dropout", severity=1.0, test="quasistatic-forward", at=0.5, rng=rng
    )
    drop(page, write_log(dropped.log, tmp_path / "dropped.csv"))
    fault = page.locator("li.fault", has_text="voltage dropout").first
    fault.get_by_role("button", name="Show").wait_for()

    assert fault.get_by_role("button", name="Leave out").count() == 0


def test_faults_are_listed_and_marked_and_shown_on_demand(page, tmp_path):
    drop(page, write_log(slipped_log(), tmp_path / "slipped.csv"))
    page.locator("li.fault h3", has_text="encoder slip").wait_for()
    page.locator("#gain-kV").wait_for()
    page.locator("#faults").get_by_role("button", name="Leave out").click()
    page.get_by_text("Left out: quasistatic-forward, 5.56 to 5.92 s").wait_for()
    wait_until(page, "[...sysid.logs.values()][0].fit?.doubts.length === 0")
    page.get_by_role("button", name="Take in again").click()
    wait_until(page, "[...sysid.logs.values()][0].fit?.doubts.length > 0")
    page.get_by_role("button", name="Show", exact=True).click()
    view = page.evaluate("sysid.chart.view")

    assert page.evaluate("sysid.chart.faults.length") == 1
    assert view[1] - view[0] < 3.0
    assert page.locator("#readout .run dd").inner_text() == "quasistatic-forward"


def test_a_dragged_gain_moves_the_curve_and_the_error_in_time(page, tmp_path):
    drop(page, write_log(drive_log(), tmp_path / "drive.wpilog"))
    page.locator("#gain-kV").wait_for()
    before, curve = error_shown(page), page.evaluate(CURVE)
    page.locator("#gain-kV").evaluate(SET, 3.2)
    page.get_by_text("× that of the fit").wait_for()
    moved = page.evaluate(CURVE)
    pictures = page.evaluate(DRAG, {"id": "gain-kA", "seconds": 2.0})

    assert error_shown(page) > 10 * before
    assert abs(moved[0][-1] / curve[0][-1]) == pytest.approx(2.5238 / 3.2, rel=0.01)
    assert pictures > 0
    print(f"{pictures:.0f} pictures a second while a gain is dragged")  # noqa: T201 - for people
    page.get_by_role("button", name="Reset to the fit").click()
    page.get_by_text("× that of the fit").wait_for(state="hidden")
    assert error_shown(page) == before


@pytest.mark.parametrize("mechanism", ["drivetrain", "elevator", "arm"])
def test_the_page_simulates_as_the_engine_does(page, tmp_path, mechanism):
    file = write_log(drive_log(3, mechanism), tmp_path / f"{mechanism}.wpilog")
    log = read(file)
    drop(page, file)
    page.locator("#gain-kV").wait_for()
    curves = page.evaluate(CURVE)
    if page.evaluate("[...sysid.logs.values()][0].fit.parts.length"):
        pytest.skip("this fit has small effects beside its gains, which the page leaves out")
    found = fit(log)

    for replay, curve in zip(replay_fit(found, log), curves, strict=True):
        gap = np.abs(np.array(curve) - replay.velocity)
        assert gap.max() < 2e-3 * log.runs[0].top_speed


def test_the_robot_code_has_the_gains_that_were_moved(page, tmp_path):
    drop(page, write_log(drive_log(), tmp_path / "drive.wpilog"))
    page.get_by_label("kV as a number").fill("2.75")
    page.locator("#paste").click()
    page.locator("#code-text", has_text="kV = 2.75").wait_for()
    assert page.locator("#word").inner_text() == "Moved by hand"
    page.get_by_label("Language").select_option("phoenix6")
    page.locator("#radius").fill("0.05")
    page.locator("#code-text", has_text="Slot0Configs").wait_for()
    page.locator("#radius").press("Enter")
    assert page.locator("#code-text").is_visible()
    page.get_by_label("Language").select_option("python")
    page.locator("#code-text", has_text="import").wait_for()

    assert (
        "±" not in page.locator("#code-text").inner_text().partition("2.75")[2].partition("\n")[0]
    )


def test_the_feedback_gains_follow_controller_and_weights(page, tmp_path):
    page.get_by_role("button", name="theory and feedback gains").click()
    page.get_by_label("kV and kA of").select_option("neo")
    page.locator("#loop-form [name=units]").select_option("radians")
    page.get_by_label("mass, kg, or inertia").fill("0.01")
    page.locator("#loop-gains dd", has_text="kP").first.wait_for()
    page.locator("#loops").get_by_role("button", name="Close").click()
    drop(page, write_log(drive_log(), tmp_path / "drive.wpilog"))
    page.locator("#gain-kV").wait_for()
    page.get_by_role("button", name="Feedback gains").click()
    page.locator("#loop-gains dd", has_text="V/(m/s)").first.wait_for()
    ours = page.locator("#loop-gains").inner_text()
    page.get_by_label("Controller").select_option("rev-brushless")
    page.locator("#loop-gains dd", has_text="duty cycle/(m/min)").first.wait_for()

    assert page.locator("#loop-gains").inner_text() != ours
    kv = float(page.locator("#loop-form [name=kV]").input_value())
    page.locator("#loop-form [name=units]").select_option("rotations")
    page.locator("#loop-gains dd", has_text="needs the wheel").wait_for()
    page.locator("#loop-form [name=radius]").fill("0.05")
    page.locator("#loop-gains dd", has_text="duty cycle/(rot/min)").first.wait_for()
    turned = float(page.locator("#loop-form [name=kV]").input_value())
    assert turned == pytest.approx(kv * 0.05 * TURN, rel=1e-3)
    allowed = float(page.locator("#loop-form [name=position_error]").input_value())
    assert allowed == pytest.approx(0.1 / (0.05 * TURN), rel=1e-3)
    assert page.complaints == []


def test_another_signal_of_the_log_is_plotted(page, tmp_path):
    drop(page, write_strange(tmp_path))
    choose_signals(page, voltage="/a/1", position="/a/2", velocity="/a/3", state="/b")
    page.locator("#gain-kV").wait_for()
    page.locator("#views").get_by_text("Signals").click()
    page.get_by_label("Name of another signal").fill("/a/2")
    page.get_by_label("Name of another signal").press("Enter")
    wait_until(page, "sysid.chart.panels.entry !== undefined")
    equal = "[...sysid.logs.values()][0].runs.every((run) => run.entry.length === run.time.length)"

    assert page.evaluate(equal)
    page.get_by_label("Name of another signal").fill("")
    page.get_by_label("Name of another signal").press("Enter")
    wait_until(page, "sysid.chart.panels.entry === undefined")
    assert page.complaints == []


def test_the_chart_is_moved_by_wheel_hand_and_keyboard(page, tmp_path):
    drop(page, write_log(drive_log(), tmp_path / "drive.wpilog"))
    page.locator("#gain-kV").wait_for()
    chart = page.locator("#moving")
    box = chart.bounding_box()
    middle = (box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])

    def width():
        view = page.evaluate("sysid.chart.view")
        return view[1] - view[0]

    whole = width()
    page.mouse.move(*middle)
    page.mouse.wheel(0, -600)
    wait_until(page, f"sysid.chart.view[1] - sysid.chart.view[0] < {0.6 * whole}")
    assert page.locator("#readout .measured dt").inner_text().endswith("m/s")
    before = page.evaluate("sysid.chart.view[0]")
    page.mouse.down()
    page.mouse.move(middle[0] - 80, middle[1], steps=4)
    page.mouse.up()
    assert page.evaluate("sysid.chart.view[0]") > before
    chart.focus()
    page.keyboard.press("0")
    assert width() == pytest.approx(whole)
    page.keyboard.press("PageDown")
    assert width() < 0.5 * whole
    before = page.locator("#readout dd").nth(1).inner_text()
    page.keyboard.press("Shift+ArrowRight")
    assert page.locator("#readout dd").nth(1).inner_text() != before
    page.keyboard.press("+")
    assert page.complaints == []


def test_logs_named_on_the_command_line_are_open(browser, tmp_path):
    good = write_log(drive_log(), tmp_path / "good.csv")
    with (
        served(tmp_path / "session", good, tmp_path / "absent.csv") as server,
        opened(browser, server.address) as page,
    ):
        page.locator("#gain-kV").wait_for()
        page.locator(".refusal", has_text="there is no such file").wait_for()
        assert good.is_file()
        page.get_by_label("Close good.csv").click()
        page.get_by_text("Drop a log.").wait_for()
        assert good.is_file()  # only dropped files are removed


@pytest.mark.parametrize(
    ("viewport", "theme"), [(DESKTOP, "light"), (PHONE, "dark")], ids=["desktop", "phone"]
)
def test_page_fits_the_screen_in_either_theme(browser, server, tmp_path, viewport, theme):
    with opened(browser, server.address, viewport, theme) as page:
        wide = "document.documentElement.scrollWidth"
        assert page.evaluate(wide) <= viewport["width"]
        drop(page, write_log(slipped_log(), tmp_path / "a log with a rather long name indeed.csv"))
        page.locator("#gain-kV").wait_for()
        page.locator("li.fault h3").wait_for()
        assert page.evaluate(wide) <= viewport["width"]
        assert least_contrast(page, TEXTS) >= LEAST_CONTRAST
        paper = page.evaluate("getComputedStyle(document.body).backgroundColor")
        assert (sum(map(int, re.findall(r"\d+", paper))) < 150) == (theme == "dark")
        other = {"light": "dark", "dark": "light"}[theme]
        page.get_by_label("Color theme").select_option(other)
        paper = page.evaluate("getComputedStyle(document.body).backgroundColor")
        assert (sum(map(int, re.findall(r"\d+", paper))) < 150) == (other == "dark")
        ink = page.evaluate("sysid.chart.colors.ink")
        assert (sum(map(int, re.findall(r"\d+", ink))) > 450) == (other == "dark")


def kv_shown(page):
    """The value of kV on the page."""
    return float(page.get_by_label("kV as a number").input_value())


def test_an_effect_that_was_found_is_switched_on_and_off(page, tmp_path):
    arm = MECHANISMS["arm"].hide("drag", 1.0)
    for name, seed, step in (("arm", 5, 5.0), ("other", 6, 4.0)):
        log = simulate(arm, Routine(step=step), rng=np.random.default_rng(seed))
        drop(page, write_log(log, tmp_path / f"{name}.wpilog"))
        page.locator(".tab .name", has_text=name).wait_for()
    page.locator(".tab .name", has_text="arm").click()
    page.locator("h1#title", has_text="arm").wait_for()
    page.locator("#gain-kG").wait_for()
    wrong, far = kv_shown(page), error_shown(page)
    page.get_by_label("Show the gap on").select_option(label="other.wpilog")
    page.get_by_role("button", name="Look for what is missing").click()
    box = page.locator("#models").get_by_label("drag")
    box.wait_for()
    wait_until(page, "document.querySelector('#sliders').inert")

    truth = MECHANISMS["arm"].gains["kV"]
    assert abs(kv_shown(page) - truth) < 0.02 * truth < abs(wrong - truth)
    assert error_shown(page) < 0.5 * far
    assert page.evaluate("sysid.chart.without.length") == 4
    assert "held-out" in page.locator("#story").inner_text()
    page.locator("#paste").click()
    page.locator("#code-text", has_text=f"kV = {kv_shown(page):.2f}").wait_for()
    assert "// Effect in the model: drag" in page.locator("#code-text").inner_text()
    page.get_by_label("Language").select_option("phoenix6")
    page.locator("#code-text", has_text="Slot0Configs").wait_for()
    page.get_by_role("button", name="Close", exact=True).click()
    saved = page.evaluate("fetch(document.querySelector('#report').href).then(one => one.text())")
    assert "The model is missing drag" in saved
    page.set_viewport_size({"width": 1366, "height": 768})
    page.get_by_role("button", name="Tick effects above the curves").click()
    wait_until(page, f"{IN_VIEW}('#models') && {IN_VIEW}('#moving')")
    box.uncheck()
    wait_until(page, "!document.querySelector('#sliders').inert")
    assert kv_shown(page) == wrong
    assert page.complaints == []


def choose_signals(page, **chosen):
    """Choose an entry for each role in the wizard, and open the log."""
    page.get_by_text("Which entries are the signals?").wait_for()
    for role, name in chosen.items():
        page.locator(f"#roles [value={role}]").click()
        page.get_by_label("Filter the entries").fill(name)
        page.locator("#candidates").get_by_role("radio", name=name).check()
    page.get_by_role("button", name="Open the log").click()


def write_strange(folder):
    """A log whose entries have names without a meaning; /a/4 never changes."""
    groups = [
        SignalGroup(
            run.time,
            {"/a/1": run.voltage, "/a/2": run.position, "/a/3": run.velocity, "/a/4": 0 * run.time},
            {"/b": [(run.time[0], run.test), (run.time[-1] + 0.02, "none")]},
        )
        for run in drive_log().runs
    ]
    write_signals(groups, folder / "strange.wpilog", units={"/a/3": "meters per second"})
    return folder / "strange.wpilog"


def test_signals_of_unknown_names_are_chosen_with_a_picture_of_each(page, tmp_path):
    drop(page, write_log(drive_log(), tmp_path / "first.csv"))
    page.locator("#gain-kV").wait_for()
    drop(page, write_strange(tmp_path))  # a second log is shown at once
    page.locator(".tab.now .badge", has_text="choose signals").wait_for()
    assert page.locator(".candidate svg path").count() == 3  # what never changes is no signal
    page.locator("#roles [value=velocity]").click()
    assert "likely" in page.locator(".candidate").nth(1).inner_text()  # our own guess is first
    assert page.get_by_role("button", name="Open the log").is_disabled()  # no voltage is known
    choose_signals(page, voltage="/a/1", position="/a/2", velocity="/a/3", state="/b")
    page.locator("#gain-kV").wait_for()

    assert kv_shown(page) == pytest.approx(2.52, rel=0.01)
    page.get_by_role("button", name="Choose other signals").click()
    page.get_by_role("button", name="Back to the log").click()
    page.locator("h1#title", has_text="strange.wpilog").wait_for()
    page.get_by_role("button", name="Choose other signals").click()
    choose_signals(page, voltage="/a/3")  # a wrong choice leads back to the wizard, or to a log
    page.locator("#rechoose, #choose-why").first.wait_for()
    assert page.locator(".tab").count() == 2
    assert page.complaints == []


def test_columns_of_a_table_are_chosen(page, tmp_path):
    rows = write_log(drive_log(), tmp_path / "drive.csv").read_text("utf-8").splitlines()
    text = "\n".join(["Versuch,Zeit,Spannung,Weg,Tempo", *rows[1:]])
    (tmp_path / "tabelle.csv").write_text(text, encoding="utf-8")
    drop(page, tmp_path / "tabelle.csv")
    missing = page.locator("#missing", has_text="Voltage at the motor; Position; Time, in seconds.")
    missing.wait_for()
    columns = {"voltage": "Spannung", "position": "Weg", "velocity": "Tempo", "state": "Versuch"}
    choose_signals(page, **columns, time="Zeit")
    page.locator("#gain-kV").wait_for()

    assert kv_shown(page) == pytest.approx(2.52, rel=0.01)


def test_a_reload_keeps_what_was_chosen(page, tmp_path):
    drop(page, write_strange(tmp_path))
    choose_signals(page, voltage="/a/1", position="/a/2", velocity="/a/3", state="/b")
    page.locator("#gain-kV").wait_for()
    drop(page, write_log(slipped_log(), tmp_path / "slipped.csv"))
    page.locator(".tab.now .name", has_text="slipped.csv").wait_for()
    page.locator("#faults").get_by_role("button", name="Leave out").click()
    page.get_by_text("Left out: quasistatic-forward").wait_for()
    wait_until(page, "[...sysid.logs.values()][1].fit !== null")
    page.get_by_label("kV as a number").fill("2.75")
    page.reload()
    page.get_by_text("Left out: quasistatic-forward").wait_for()
    wait_until(page, "document.querySelector('.gain.moved') !== null")

    assert kv_shown(page) == 2.75
    assert page.locator(".tab.now .name").inner_text() == "slipped.csv"
    page.locator(".tab .name", has_text="strange").click()
    page.locator("#gain-kV").wait_for()
    assert kv_shown(page) == pytest.approx(2.52, rel=0.01)


def test_the_heights_of_the_chart_follow_the_zoom(page, tmp_path):
    drop(page, write_log(drive_log(), tmp_path / "drive.wpilog"))
    page.locator("#gain-kV").wait_for()
    heights = "(([low, high]) => high - low)(sysid.chart.ranges.velocity)"
    whole = page.evaluate(heights)
    page.evaluate("sysid.chart.setView(1, 1.5)")

    assert page.evaluate(heights) < 0.3 * whole
    assert page.evaluate("sysid.chart.ranges.voltage[1]") < 2.0
    page.locator("#moving").dblclick()
    assert page.evaluate(heights) == pytest.approx(whole)
