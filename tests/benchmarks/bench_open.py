"""How long the page of ``sysid open`` takes, in a real Chromium.

    python tests/benchmarks/bench_open.py [MEGABYTES]

For an ordinary log and for a log of a whole match (125 MB unless said otherwise: four tests among
the records of four hundred other entries): seconds from the choice of the file to the first
picture, to the gains and to the faults, and pictures a second while a gain is dragged.
"""

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from bench_wpilog import START, mixed, record
from open_page import drive_log, served, write_log
from playwright.sync_api import sync_playwright
from test_open_in_browser import BROWSERS, DRAG, FLAGS, opened
from wpilog_file import records

from sim.io.formats.wpilog.control import Start, make_start_payload, parse_control_record

OTHERS = 432  # entries of a mixed log
REPETITIONS = 3
SAMPLE = 200_000  # records, of which the number that fills a file is estimated
SEEN = """async (began) => {
    const seen = {};
    const now = () => (performance.now() - began) / 1000;
    while (!(seen.gains && seen.faults)) {
        if (!seen.picture && sysid.chart.runs.length && sysid.chart.pictures) seen.picture = now();
        if (!seen.gains && document.querySelector('.gain')) seen.gains = now();
        if (!seen.faults && document.querySelector('#faults :is(.well, .fault)')) {
            seen.faults = now();
        }
        await new Promise(requestAnimationFrame);
    }
    return seen;
}"""


def match_log(path: Path, megabytes: float) -> Path:
    """The four tests of a drivetrain in a log of a whole match."""
    rng = np.random.default_rng(1)
    each = len(mixed(SAMPLE, rng)) / SAMPLE
    drive = write_log(drive_log(), path.with_name("drive.wpilog")).read_bytes()
    parts = [mixed(int(1e6 * megabytes / each), rng)]
    for number, moment, payload in records(drive):
        said = parse_control_record(payload) if number == 0 else None
        if isinstance(said, Start):
            moved = Start(said.id + OTHERS, said.name, said.type, said.metadata)
            parts.append(record(0, START + moment, make_start_payload(moved)))
        elif number:
            parts.append(record(number + OTHERS, START + moment, payload))
    path.write_bytes(b"".join(parts))
    return path


def measure(browser: Any, file: Path, folder: Path) -> dict[str, float]:
    """Seconds from the choice of a file on the open page until each thing is seen."""
    folder.mkdir()
    with served(folder) as server:
        server.session.warm_up()
        with opened(browser, server.address) as page:
            began = page.evaluate("performance.now()")
            page.set_input_files("#file", file)
            seen = dict(page.evaluate(SEEN, began))
            seen["pictures a second"] = page.evaluate(DRAG, {"id": "gain-kA", "seconds": 2.0})
    return seen


def main() -> None:
    """Print a line for each log."""
    megabytes = float(sys.argv[1]) if sys.argv[1:] else 125.0
    found = next(filter(None, map(shutil.which, BROWSERS)))
    with tempfile.TemporaryDirectory() as name, sync_playwright() as driver:
        folder = Path(name)
        files = [
            write_log(drive_log(), folder / "ordinary.wpilog"),
            match_log(folder / "match.wpilog", megabytes),
        ]
        browser = driver.chromium.launch(executable_path=found, args=FLAGS, headless=True)
        for number, file in enumerate(file for file in files for _ in range(REPETITIONS)):
            seen = measure(browser, file, folder / str(number))
            words = ", ".join(f"{what} {value:.2f}" for what, value in seen.items())
            print(f"{file.name} {file.stat().st_size / 1e6:.1f} MB: {words}", flush=True)
        browser.close()


if __name__ == "__main__":
    main()
