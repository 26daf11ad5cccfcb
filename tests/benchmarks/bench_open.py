"""How long the page of ``sysid open`` takes, in a real Chromium.

    python tests/benchmarks/bench_open.py [MEGABYTES]

For an ordinary log and for a log of a whole match (125 MB unless said otherwise: four tests among
the records of 300 other entries): seconds from the choice of the file to the first
picture, to the gains and to the faults, and pictures a second while a gain is dragged.
"""

import sys
import tempfile
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from bench_command import match_log
from chromium import launched
from open_page import drive_log, served, write_log
from test_open_in_browser import DRAG, opened

REPETITIONS = 3
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
    with tempfile.TemporaryDirectory() as name, launched() as browser:
        folder = Path(name)
        ordinary = write_log(drive_log(), folder / "ordinary.wpilog")
        match = match_log(folder / "match.wpilog", ordinary.read_bytes(), size=1e6 * megabytes)
        for number, file in enumerate(
            file for file in (ordinary, match) for _ in range(REPETITIONS)
        ):
            seen = measure(browser, file, folder / str(number))
            words = ", ".join(f"{what} {value:.2f}" for what, value in seen.items())
            print(f"{file.name} {file.stat().st_size / 1e6:.1f} MB: {words}", flush=True)


if __name__ == "__main__":
    main()
