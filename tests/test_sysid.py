"""The command sysid, as a person or another program runs it."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from sysid_process import run_sysid

pytestmark = pytest.mark.slow


def one_line(text):
    """The text, once it is sure that it is a single line and no traceback."""
    assert text.count("\n") == 1, text
    assert "Traceback" not in text
    return text.strip()


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    folder = tmp_path_factory.mktemp("logs")
    made = run_sysid("simulate", "drivetrain", "--seed", 1, "-o", "drive.csv", folder=folder)
    assert made.returncode == 0, made.stderr
    return folder / "drive.csv"


@pytest.mark.parametrize("suffix", [".csv", ".wpilog"])
def test_fit_reads_the_files_of_simulate(tmp_path, suffix):
    made = run_sysid(
        "simulate", "shooter", "--seed", 4, "-o", f"log{suffix}", "--truth", "truth.json",
        folder=tmp_path,
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    assert "Next: sysid fit" in made.stdout
    asked = ["--units", "rotations"] if suffix == ".csv" else []

    found = run_sysid("fit", f"log{suffix}", *asked, "--json", folder=tmp_path)

    assert found.returncode == 0, found.stderr
    gains = json.loads(found.stdout)["gains"]
    truth = json.loads((tmp_path / "truth.json").read_text(encoding="utf-8"))
    assert truth["units"] == "rotations"
    assert gains["kV"] == pytest.approx(truth["gains"]["kV"], rel=0.01)
    assert gains["kA"] == pytest.approx(truth["gains"]["kA"], rel=0.05)


def test_the_table_shows_gains_with_errors_and_units(drive):
    shown = run_sysid("fit", drive, folder=drive.parent)

    assert shown.returncode == 0
    assert "simple mechanism in meters, method output-error" in shown.stdout
    (kv,) = [line for line in shown.stdout.splitlines() if line.startswith("kV")]
    assert kv.split()[-1] == "V·s/m"
    assert "simulated velocity R²" in shown.stdout
    assert "velocity kP" in shown.stdout
    assert "\x1b" not in shown.stdout  # no colors into a pipe


def test_a_log_in_pieces_is_fitted_together(drive):
    header, *rows = drive.read_text(encoding="utf-8").splitlines(keepends=True)
    for kind in ("quasistatic", "dynamic"):
        part = [row for row in rows if row.startswith(kind)]
        (drive.parent / f"{kind}.csv").write_text(header + "".join(part), encoding="utf-8")

    whole = run_sysid("fit", drive, "--json", folder=drive.parent)
    pieces = run_sysid("fit", "quasistatic.csv", "dynamic.csv", "--json", folder=drive.parent)

    assert json.loads(pieces.stdout)["gains"] == json.loads(whole.stdout)["gains"]


def test_gains_that_cannot_be_right_give_exit_code_1(drive):
    header, *rows = drive.read_text(encoding="utf-8").splitlines()
    flipped = []
    for row in rows:
        test, time, voltage, position, velocity = row.split(",")
        flipped.append(f"{test},{time},{voltage},{-float(position)},{-float(velocity)}")
    (drive.parent / "flipped.csv").write_text("\n".join([header, *flipped]), encoding="utf-8")

    shown = run_sysid("fit", "flipped.csv", folder=drive.parent)

    assert shown.returncode == 1
    assert "wrong: kV and kA are negative" in shown.stdout


@pytest.mark.parametrize(
    ("suffix", "content"),
    [
        (".csv", b""),
        ("", b"\x00\xff" * 500),
        (".json", b"test,time_s\n"),
        (".csv", "Straße;1,5\n".encode("latin-1")),
        (".json", b"{"),
        (".wpilog", b"WPILOG"),
    ],
    ids=["empty", "binary", "header only", "not UTF-8", "a bracket", "a magic word"],
)
def test_a_file_of_nonsense_gets_one_line_whatever_its_name(tmp_path, suffix, content):
    (tmp_path / f"odd{suffix}").write_bytes(content)

    refused = run_sysid("fit", f"odd{suffix}", folder=tmp_path)

    assert refused.returncode == 2
    assert one_line(refused.stderr).startswith(f"sysid: odd{suffix}")


@pytest.mark.parametrize(
    ("name", "heavy"), [("simulate", "matplotlib"), ("fit", "matplotlib"), ("", "numpy")]
)
def test_help_imports_no_heavy_library(name, heavy):
    code = (
        "import sys; from sim.cli import sysid\n"
        f"sysid.main({[*name.split(), '--help']!r}, standalone_mode=False)\n"
        f"assert {heavy!r} not in sys.modules, '{heavy} was imported for a help text'"
    )

    shown = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=False,
        cwd=Path(__file__).parents[1],
    )  # fmt: skip

    assert shown.returncode == 0, shown.stderr
    assert "Usage:" in shown.stdout


def test_a_fit_is_held_against_the_motor_that_drives_it(drive):
    right = ["--driven-by", "krakenX60", "--count", 4, "--ratio", 6.75, "--load", 60]
    there = run_sysid("fit", drive, *right, "--radius", 0.0508, folder=drive.parent)
    wrong = run_sysid("fit", drive, *right, "--radius", 0.1016, folder=drive.parent)

    assert there.returncode == 0, there.stdout
    assert "In theory, 4 × krakenX60 have kV 2.54 V·s/m (12 V divided" in there.stdout
    assert "from theory" not in there.stdout
    assert wrong.returncode == 1
    assert "kV" in wrong.stdout.partition("wrong: ")[2]
