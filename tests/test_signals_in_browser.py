"""The log viewer of the course in a real browser: signals, spans to mark, no answers given."""

import re
import tomllib

import numpy as np
import pytest
from open_page import ask, ask_json, drive_log, served, slipped_log, write_log
from test_open_in_browser import DESKTOP, PHONE, opened, wait_until

from sim.cli.open.view import PageView, SpanText

pytestmark = [pytest.mark.slow, pytest.mark.browser]

FAULTS = SpanText(
    before='{log} = "', span="WHAT, {test}, {begin} to {end}, WHAT-TO-DO", between=" + ", after='"'
)
PARTS = SpanText(span='{key} = "{begin} to {end}"')
GIVES_ANSWERS = ("faults", "fit", "directions", "reconcile", "code", "report.html")


@pytest.fixture
def viewer(browser, tmp_path):
    """Opens a log with its signals alone; spans are written as exercise 7 asks for them."""
    tabs = []

    def show_log(log, *, name="log04.wpilog", span_text=FAULTS, viewport=DESKTOP, theme="light"):
        file = write_log(log, tmp_path / name)
        folder = tmp_path / f"session {len(tabs)}"
        folder.mkdir()
        server = served(folder, file, view=PageView(raw=True, span_text=span_text))
        tab = opened(browser, server.__enter__().address, viewport, theme)
        tabs.append((tab, server))
        wait_until(tab.page, "sysid.chart.pictures > 0 && sysid.chart.runs.length === 4")
        return tab.page

    yield show_log
    for tab, server in tabs:
        tab.__exit__()
        server.__exit__(None, None, None)


def place_of(page, run, seconds, *, panel="velocity"):
    """Where a time of a run is on the screen."""
    x, y = page.evaluate(
        f"""(() => {{
            const {{chart}} = sysid, run = chart.runs[{run}];
            const box = chart.moving.getBoundingClientRect();
            const panel = chart.panels['{panel}'];
            return [box.x + chart.xOf(chart.timeline.placeOf({run}, run.time[0] + {seconds})),
                    box.y + 0.5 * (panel.top + panel.bottom)];
        }})()"""
    )
    return x, y


def drag(page, run, begin, end):
    """Drag over a part of a run."""
    page.mouse.move(*place_of(page, run, begin))
    page.mouse.down()
    page.mouse.move(*place_of(page, run, 0.5 * (begin + end)), steps=3)
    page.mouse.move(*place_of(page, run, end), steps=3)
    page.mouse.up()


def test_a_dragged_span_becomes_the_line_of_the_answers(viewer):
    log = drive_log()
    page = viewer(log)
    page.get_by_role("button", name="Show run 2, dynamic-forward").click()
    drag(page, 2, 0.5, 1.3)
    said = tomllib.loads(page.locator("#span-text").inner_text())["log04"]
    begin, end = map(
        float, re.fullmatch(r"WHAT, dynamic-forward, (.+) to (.+), WHAT-TO-DO", said).groups()
    )

    assert (begin, end) == (pytest.approx(0.5, abs=0.03), pytest.approx(1.3, abs=0.03))
    drag(page, 2, end, 1.6)  # an edge is taken hold of, and moved
    said = page.locator("#span-text").inner_text()
    assert float(re.search(r"to ([\d.]+)", said)[1]) == pytest.approx(1.6, abs=0.03)
    assert f"{begin:.2f} to" in said
    page.get_by_role("button", name="All", exact=True).click()
    drag(page, 0, 1.0, 2.0)
    assert page.locator("#span-text").inner_text().count(" + ") == 1
    page.get_by_role("button", name="Clear").click()
    assert not page.locator("#span-text").is_visible()
    assert page.complaints == []


def test_a_span_is_marked_from_the_keyboard(viewer):
    page = viewer(drive_log(), span_text=PARTS)
    page.locator("#moving").focus()
    page.keyboard.press("PageDown")
    for key in ("Shift+ArrowRight", "s", "Shift+ArrowRight", "Shift+ArrowRight", "e"):
        page.keyboard.press(key)

    assert page.evaluate("[...sysid.chart.spans]") == [[0, [10, 30]]]
    page.keyboard.press("Delete")
    assert page.evaluate("sysid.chart.spans.size") == 0


def test_one_cursor_shows_all_values_at_a_time(viewer):
    log = drive_log()
    page = viewer(log)
    page.get_by_role("button", name="Show run 2, dynamic-forward").click()
    page.mouse.move(*place_of(page, 2, 1.0, panel="position"))
    rows = page.locator("#readout > div").all_inner_texts()
    values = {name.partition(",")[0]: value for name, value in (one.split("\n") for one in rows)}
    run = log.runs[2]
    sample = int(np.argmin(np.abs(run.time - run.time[0] - float(values["time in the test"][:-2]))))

    assert float(values["time in the test"][:-2]) == pytest.approx(1.0, abs=0.02)
    assert float(values["velocity"].split()[0]) == pytest.approx(run.velocity[sample], abs=1e-3)
    assert float(values["position"].split()[0]) == pytest.approx(run.position[sample], abs=1e-3)
    slope = (run.position[sample + 1] - run.position[sample - 1]) / (
        run.time[sample + 1] - run.time[sample - 1]
    )
    assert float(values["slope of position"].split()[0]) == pytest.approx(slope, abs=1e-3)
    assert float(values["time step"].split()[0]) == pytest.approx(
        1e3 * (run.time[sample] - run.time[sample - 1]), abs=0.06
    )


def test_the_viewer_of_signals_shows_no_verdict_on_a_damaged_log(viewer):
    page = viewer(slipped_log())
    page.wait_for_timeout(1500)

    assert page.evaluate("sysid.chart.faults.length") == 0
    for hidden in ("#faults", "#verdict", "#sliders", "#story", "#meter", "#views"):
        assert not page.locator(hidden).is_visible()
    assert not {url.rpartition("/")[2].partition("?")[0] for url in page.asked} & {*GIVES_ANSWERS}
    assert "slip" not in page.locator("body").inner_text().lower()
    assert all(url.startswith("http://127.0.0.1:") for url in page.asked)


def test_server_refuses_requests_that_would_reveal_the_answers(tmp_path):
    file = write_log(slipped_log(), tmp_path / "log04.wpilog")
    (tmp_path / "session").mkdir()
    with served(tmp_path / "session", file, view=PageView(raw=True)) as server:
        answers = {what: ask_json(server, f"logs/1/{what}") for what in GIVES_ANSWERS}
        samples = ask(server, "logs/1/samples")[0]

    assert {status for status, _ in answers.values()} == {200}
    assert {said["refusal"]["what"] for _, said in answers.values()} == {
        "this page shows the data alone"
    }
    assert samples == 200


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_phone_shows_the_whole_view_of_signals(viewer, theme):
    page = viewer(drive_log(), viewport=PHONE, theme=theme)
    page.evaluate("sysid.chart.setSpan(2, [5, 60])")

    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    assert page.locator("#span-text").is_visible()
