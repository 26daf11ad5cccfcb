"""The command sysid, as a person or another program runs it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow


def sysid(*arguments, folder):
    """Run the command as a process of its own."""
    return subprocess.run(
        [sys.executable, "-c", "from sim.cli import main; main()", *map(str, arguments)],
        cwd=folder,
        capture_output=True,
        encoding="utf-8",
        check=False,
        timeout=120,
    )


def one_line(text):
    """The text, once it is sure that it is a single line and no traceback."""
    assert text.count("\n") == 1, text
    assert "Traceback" not in text
    return text.strip()


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    folder = tmp_path_factory.mktemp("logs")
    made = sysid("simulate", "drivetrain", "--seed", 1, "-o", "drive.csv", folder=folder)
    assert made.returncode == 0, made.stderr
    return folder / "drive.csv"


@pytest.mark.parametrize("suffix", [".csv", ".wpilog"])
def test_what_simulate_writes_fit_reads(tmp_path, suffix):
    made = sysid(
        "simulate", "shooter", "--seed", 4, "-o", f"log{suffix}", "--truth", "truth.json",
        folder=tmp_path,
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    assert "Next: sysid fit" in made.stdout
    asked = ["--units", "rotations"] if suffix == ".csv" else []

    found = sysid("fit", f"log{suffix}", *asked, "--json", folder=tmp_path)

    assert found.returncode == 0, found.stderr
    gains = json.loads(found.stdout)["gains"]
    truth = json.loads((tmp_path / "truth.json").read_text(encoding="utf-8"))
    assert truth["units"] == "rotations"
    assert gains["kV"] == pytest.approx(truth["gains"]["kV"], rel=0.01)
    assert gains["kA"] == pytest.approx(truth["gains"]["kA"], rel=0.05)


def test_the_same_seed_gives_the_same_file(tmp_path):
    for name in ("a.csv", "b.csv"):
        sysid("simulate", "drivetrain", "--seed", 9, "-o", name, folder=tmp_path)

    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_the_table_shows_gains_with_errors_and_units(drive):
    shown = sysid("fit", drive, folder=drive.parent)

    assert shown.returncode == 0
    assert "simple mechanism in meters, method output-error" in shown.stdout
    (kv,) = [line for line in shown.stdout.splitlines() if line.startswith("kV")]
    assert kv.split()[-1] == "V·s/m"
    assert "simulated velocity R²" in shown.stdout
    assert "velocity kP" in shown.stdout
    assert "\x1b" not in shown.stdout  # no colors into a pipe


def test_a_preset_changes_the_feedback_gains_only(drive):
    plain, talon = (
        json.loads(sysid("fit", drive, "--json", *asked, folder=drive.parent).stdout)
        for asked in ([], ["--preset", "ctre-phoenix5"])
    )

    assert plain["gains"] == talon["gains"]
    assert plain["feedback"] != talon["feedback"]


def test_a_log_in_pieces_is_fitted_together(drive):
    header, *rows = drive.read_text(encoding="utf-8").splitlines(keepends=True)
    for kind in ("quasistatic", "dynamic"):
        part = [row for row in rows if row.startswith(kind)]
        (drive.parent / f"{kind}.csv").write_text(header + "".join(part), encoding="utf-8")

    whole = sysid("fit", drive, "--json", folder=drive.parent)
    pieces = sysid("fit", "quasistatic.csv", "dynamic.csv", "--json", folder=drive.parent)

    assert json.loads(pieces.stdout)["gains"] == json.loads(whole.stdout)["gains"]


def test_gains_that_cannot_be_right_give_exit_code_1(drive):
    header, *rows = drive.read_text(encoding="utf-8").splitlines()
    flipped = []
    for row in rows:
        test, time, voltage, position, velocity = row.split(",")
        flipped.append(f"{test},{time},{voltage},{-float(position)},{-float(velocity)}")
    (drive.parent / "flipped.csv").write_text("\n".join([header, *flipped]), encoding="utf-8")

    shown = sysid("fit", "flipped.csv", folder=drive.parent)

    assert shown.returncode == 1
    assert "wrong: kV and kA are negative" in shown.stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["fit", "nowhere.csv"], "sysid: nowhere.csv:"),
        (["fit"], "Missing argument 'FILES...'. See 'sysid fit --help'."),
        (["fit", "drive.csv", "--type", "crane"], "'crane' is not one of 'simple', 'elevator'"),
        (["fit", "drive.csv", "--median", "99", "--method", "sysid"], "a median window of 99"),
        (["fit", "drive.csv", "--median", "5"], "The median filter belongs to SysId's method"),
        (["fit", "drive.csv", "--type", "arm", "--units", "meters"], "must be an angle"),
        (["fit", "."], "sysid: .:"),
        (["simulate", "trebuchet", "-o", "x.csv"], "Choose one of: arm, cascade-elevator,"),
        (["simulate", "shooter", "-o", "x.xyz"], ".csv"),
        (["simulate", "shooter", "-o", "no/such/folder/x.csv"], "sysid: "),
        (["simulate", "shooter", "-o", "x.csv", "--ramp", "0"], "a ramp of 0 V/s"),
        (["simulate", "shooter", "-o", "x.csv", "--ramp", "nan"], "a ramp of nan V/s"),
        (["simulate", "shooter", "-o", "x.csv", "--seed", "-1"], "a seed is zero or more"),
        (["simulate", "shooter", "-o", "x.csv", "--truth", "no/truth.json"], "no"),
        (["frobnicate"], "No such command 'frobnicate'. See 'sysid --help'"),
        (["fitt"], "No such command 'fitt'. Did you mean 'sysid fit'? See 'sysid --help'"),
    ],
    ids=lambda value: " ".join(value)[:40] if isinstance(value, list) else "",
)
def test_what_cannot_be_done_is_one_line_and_exit_code_2(drive, arguments, said):
    refused = sysid(*arguments, folder=drive.parent)

    assert refused.returncode == 2
    assert refused.stdout == ""
    assert said in one_line(refused.stderr)
    assert not list(drive.parent.glob("x.*"))  # nothing written, nothing half-written


@pytest.mark.parametrize(
    "content",
    [b"", b"\x00\xff" * 500, b"test,time_s\n", "Straße;1,5\n".encode("latin-1"), b"{", b"WPILOG"],
    ids=["empty", "binary", "header only", "not UTF-8", "a bracket", "a magic word"],
)
@pytest.mark.parametrize("suffix", [".csv", ".wpilog", ".json", ""])
def test_a_file_of_nonsense_is_one_line_whatever_its_name(tmp_path, content, suffix):
    (tmp_path / f"odd{suffix}").write_bytes(content)

    refused = sysid("fit", f"odd{suffix}", folder=tmp_path)

    assert refused.returncode == 2
    assert one_line(refused.stderr).startswith(f"sysid: odd{suffix}")


def test_mechanisms_are_listed_for_people_and_for_programs(tmp_path):
    people = sysid("mechanisms", folder=tmp_path).stdout
    programs = json.loads(sysid("mechanisms", "--json", folder=tmp_path).stdout)

    assert [row["name"] for row in programs] == [line.split()[0] for line in people.splitlines()]
    assert "drivetrain" in people


@pytest.mark.parametrize("name", ["simulate", "fit", "mechanisms", ""])
def test_help_is_there_and_loads_no_numerics(name):
    code = (
        "import sys; from sim.cli import sysid\n"
        f"sysid.main({[*name.split(), '--help']!r}, standalone_mode=False)\n"
        "assert 'numpy' not in sys.modules, 'numpy was imported for a help text'"
    )

    shown = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=False,
        cwd=Path(__file__).parents[1],
    )  # fmt: skip

    assert shown.returncode == 0, shown.stderr
    assert "Usage:" in shown.stdout


REAL = [
    ("frc4646-2022-drivetrain.json", ["--motor", "left"]),
    ("frc4646-2022-drivetrain.json", ["--motor", "right"]),
    ("frc4646-2022-drivetrain.json", []),
    ("frc501-2020-drivetrain.json", ["--motor", "left"]),
    ("frc501-2020-drivetrain.json", ["--motor", "right"]),
    ("frc501-2020-drivetrain.json", []),
    ("sciborgs-2023-elbow-arm.json", []),
    ("sciborgs-2023-elevator.json", []),
    ("sciborgs-2023-wrist-arm.json", []),
]


@pytest.mark.shared
@pytest.mark.parametrize(("name", "asked"), REAL, ids=lambda value: "-".join(value) or "all"
                         if isinstance(value, list) else value)  # fmt: skip
def test_a_real_robots_log_gives_gains_with_errors(shared, tmp_path, name, asked):
    file = shared / "data" / "real" / name
    if not file.exists():
        pytest.skip(f"{name} is not there")

    found = sysid("fit", file, *asked, "--json", folder=tmp_path)

    assert found.returncode in {0, 1}, found.stderr
    data = json.loads(found.stdout)
    assert {"kS", "kV", "kA"} <= set(data["gains"])
    assert data["gains"]["kV"] > 0
    assert all(error > 0 for error in data["errors"].values())


@pytest.mark.shared
def test_a_real_log_without_voltage_is_refused_by_the_entry_it_lacks(shared, tmp_path):
    file = shared / "data" / "real" / "sciborgs-2024-pivot-no-voltage.wpilog"
    if not file.exists():
        pytest.skip("the log is not there")

    refused = sysid("fit", file, folder=tmp_path)

    assert refused.returncode == 2
    said = one_line(refused.stderr)
    assert "voltage-" in said
    assert "--voltage ENTRY" in said


@pytest.mark.shared
def test_the_parity_script_finds_no_figure_off(shared, tmp_path):
    """What others run against us: SysId's figures through the command, to 1e-9."""
    if not (shared / "checks" / "sysid_parity.py").exists():
        pytest.skip("the script is not there")
    scripts = Path(sys.executable).parent
    if not list(scripts.glob("sysid*")):
        pytest.skip("the command sysid is not installed in this environment")
    run = subprocess.run(
        [sys.executable, str(shared / "checks" / "sysid_parity.py")],
        cwd=tmp_path,
        capture_output=True,
        encoding="utf-8",
        check=False,
        env=os.environ | {"PATH": f"{scripts}{os.pathsep}{os.environ['PATH']}"},
    )

    assert run.returncode == 0, run.stdout
    assert "0 figures off" in run.stdout


@pytest.mark.parametrize("language", ["java", "python"])
def test_a_fit_can_be_pasted_into_robot_code(drive, language):
    pasted = sysid("fit", drive, "--paste", language, folder=drive.parent)

    assert pasted.returncode == 0, pasted.stderr
    assert "SimpleMotorFeedforward" in pasted.stdout
    assert "2.52" in pasted.stdout


def test_a_fit_is_held_against_the_motor_that_drives_it(drive):
    right = ["--driven-by", "krakenX60", "--count", 4, "--ratio", 6.75, "--load", 60]
    there = sysid("fit", drive, *right, "--radius", 0.0508, folder=drive.parent)
    wrong = sysid("fit", drive, *right, "--radius", 0.1016, folder=drive.parent)

    assert there.returncode == 0, there.stdout
    assert "In theory, 4 × krakenX60 have kV 2.54 V·s/m (12 V divided" in there.stdout
    assert "from theory" not in there.stdout
    assert wrong.returncode == 1
    assert "kV" in wrong.stdout.partition("wrong: ")[2]


def test_a_motor_without_its_ratio_is_asked_for_it(drive):
    refused = sysid("fit", drive, "--driven-by", "neo", folder=drive.parent)

    assert refused.returncode == 2
    assert "--ratio" in one_line(refused.stderr)
