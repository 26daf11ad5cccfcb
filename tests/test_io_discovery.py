"""Logs of other loggers: signals are found by the names, units and motion of their entries.

Every log is a bench mechanism's, written under the names that another tool uses. Mechanisms and
devices have other names than in any log that the reader was written for.
"""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from wpilog_file import Logger

import sim
import sim.io
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.core.errors import MissingSignal, Refusal
from sim.core.units import UNITS
from sim.fit import fit
from sim.support.command_line import run_command

ROUTINE = Routine(ramp=0.5, step=4.0)
ADVANTAGESCOPE = '{"exporter":"AdvantageScope"}'
PHOENIX = (
    ("Phoenix6/TalonFX-21/MotorVoltage", "The applied (output) motor voltage.\nUnits: V"),
    ("Phoenix6/TalonFX-21/Position", "Position of the device in rotations.\nUnits: rotations"),
    ("Phoenix6/TalonFX-21/Velocity", "Velocity of the device.\nUnits: rotations per second"),
)
URCL = tuple(
    (f"NT:/URCL/SparkMax-5/{name}", ADVANTAGESCOPE)
    for name in ("AppliedOutputVoltage", "MotorPositionRotations", "MotorVelocityRPM")
)
AKIT = tuple(
    (f"/Shooter/Upper/{name}", ADVANTAGESCOPE)
    for name in ("FlywheelAppliedVolts", "FlywheelPositionRad", "FlywheelVelocityRadPerSec")
)
TAU = 2.0 * np.pi


@cache
def recorded(mechanism="shooter"):
    return simulate(MECHANISMS[mechanism], ROUTINE, rng=np.random.default_rng(3))


@cache
def fit_recorded(mechanism="shooter"):
    """The fit of a log as it was recorded."""
    return fit(recorded(mechanism))


def samples(log, columns, *, factors=(1.0, 1.0, 1.0), state="", more=()):
    """Name, time [µs] and value of every sample, in the order in which a robot logs them.

    Args:
        log: in SI.
        columns: name and metadata of voltage, position and velocity.
        factors: what SI numbers are multiplied by.
        state: name of the entry that names tests; empty for none.
        more: name and function of a run that gives its values, for entries beside them.
    """
    for run in log.runs:
        signals = (run.voltage, run.position, run.velocity)
        rows = [
            (name, column * factor)
            for (name, _), column, factor in zip(columns, signals, factors, strict=True)
        ]
        rows += [(name, of(run)) for name, of in more]
        times = (1e6 * run.time).astype(int).tolist()
        for n, time in enumerate(times):
            if state:
                yield state, time, run.test
            for name, values in rows:
                yield name, time, float(values[n])
        if state:
            yield state, times[-1] + 20_000, "none"
        yield columns[0][0], times[-1] + 20_000, 0.0


def write(path, log, columns, *, changes=False, **told):
    """A WPILOG file with the runs of a log; ``changes`` logs changes only."""
    logger = Logger(changes_only=changes)
    said = dict(columns)
    for name, time, value in samples(log, columns, **told):
        if name not in logger.ids:
            logger.start(name, "string" if isinstance(value, str) else "double", said.get(name, ""))
        logger.put(name, time, value)
    return logger.save(path)


def same_gains(path, log, **asked):
    """The gains of a file are those of the log that it was written from."""
    read = sim.read(path, **asked)
    unit = "radians" if UNITS[log.units].angular else "meters"
    found, truth = fit(read, type=log.type).in_units(unit), fit_recorded(log.mechanism)
    for gain, value in truth.in_units(unit).gains.items():
        assert found.gains[gain] == pytest.approx(value, rel=0.02, abs=0.01), gain
    return read


def rotations(log):
    """Factors from SI to rotations and rotations per second."""
    assert UNITS[log.units].angular
    return (1.0, 1.0 / TAU, 1.0 / TAU)


def test_phoenix_signals_with_a_state_of_the_teams_own_name(tmp_path):
    log = recorded()
    path = write(tmp_path / "a.wpilog", log, PHOENIX, factors=rotations(log),
                 state="Flywheel-SysId-State")  # fmt: skip

    read = same_gains(path, log)

    assert read.mechanism == "Flywheel"
    assert read.units == "rotations"
    (said,) = [doubt.message for doubt in read.doubts if doubt.code == "signals-found"]
    for name, _ in PHOENIX:
        assert name in said


def test_a_share_of_the_bus_voltage_is_a_voltage(tmp_path):
    log = recorded()
    columns = (("NT:/URCL/SparkFlex-9/AppliedOutput", ADVANTAGESCOPE), *[
        (name.replace("SparkMax-5", "SparkFlex-9"), said) for name, said in URCL[1:]
    ])  # fmt: skip
    path = write(
        tmp_path / "a.wpilog", log, columns, factors=(1.0 / 11.5, 1.0 / TAU, 60.0 / TAU),
        state="sysid-test-state-Shooter",
        more=(("NT:/URCL/SparkFlex-9/BusVoltage", lambda run: np.full(len(run), 11.5)),),
    )  # fmt: skip

    same_gains(path, log)


@pytest.mark.parametrize(
    "name", ["sysid-{way}-{kind}", "2025-03-01 {kind} {way}", "Sysid{Kind}{Way}_retry"]
)
def test_advantagekit_with_one_file_for_each_test(tmp_path, name):
    log = recorded()
    read = None
    for run in log.runs:
        kind, _, way = run.test.partition("-")
        stem = name.format(kind=kind, way=way, Kind=kind.capitalize(), Way=way.capitalize())
        path = write(
            tmp_path / f"{stem}.wpilog", replace(log, runs=(run,)), AKIT,
            more=(("/Shooter/Upper/FlywheelCurrentAmps", lambda run: np.ones(len(run))),),
        )  # fmt: skip
        one = sim.read(path)
        assert [found.test for found in one.runs] == [run.test]
        read = one if read is None else read.join(one)

    found, truth = fit(read), fit_recorded()
    for gain, value in truth.gains.items():
        assert found.in_units("radians").gains[gain] == pytest.approx(value, rel=0.03, abs=0.01)


def test_motors_that_move_together_are_combined_and_can_be_chosen(tmp_path):
    log = recorded()
    lower = tuple((name.replace("Upper", "Lower"), said) for name, said in AKIT)
    path = write(
        tmp_path / "a.wpilog", log, AKIT, state="SysIdState",
        more=tuple(
            (name, lambda run, signal=signal: getattr(run, signal))
            for (name, _), signal in zip(lower, ("voltage", "position", "velocity"), strict=True)
        ),
    )  # fmt: skip

    both, one = same_gains(path, log), same_gains(path, log, motor="Lower/Flywheel")

    assert "several-motors" in [doubt.code for doubt in both.doubts]
    assert "several-motors" not in [doubt.code for doubt in one.doubts]


def test_records_before_their_entry_starts_are_left_out_and_counted(tmp_path):
    log = recorded()
    path = write(tmp_path / "a.wpilog", log, PHOENIX, factors=rotations(log),
                 state="sysid-test-state-Shooter")  # fmt: skip
    content = path.read_bytes()
    orphans = b"".join(
        bytes([0x30]) + bytes([number, 8]) + (5).to_bytes(4, "little") + b"\0" * 8
        for number in (1, 2, 3)
    )
    path.write_bytes(content[:12] + orphans + content[12:])

    read = same_gains(path, log)

    (said,) = [doubt.message for doubt in read.doubts if doubt.code == "orphan-records"]
    assert "3 records" in said
    assert not {"damaged", "truncated"} & {doubt.code for doubt in read.doubts}


@pytest.mark.parametrize(
    "text",
    [
        "Timestamp,Name,Value\n",
        "Timestamp,Name,Value\nsoon,a,1\n",
        "Timestamp,Name,Value\n1.0,a\n",
        "Timestamp,a,b\n1.0,2.0,\n",
    ],
)
def test_an_export_that_cannot_be_read_says_where(tmp_path, text):
    path = tmp_path / "log.csv"
    path.write_text(text, encoding="utf-8")

    with pytest.raises(Refusal) as refused:
        sim.read(path)
    assert refused.value.advice


def test_the_command_lists_entries_and_what_they_seem_to_be(tmp_path, capsys):
    log = recorded()
    path = write(tmp_path / "a.wpilog", log, PHOENIX, factors=rotations(log), state="My-State",
                 more=(("Phoenix6/TalonFX-21/DeviceTemp", lambda run: run.time),))  # fmt: skip

    assert run_command(sysid, name="sysid", arguments=["entries", str(path), "--json"]) == 0

    rows = {row["name"]: row for row in json.loads(capsys.readouterr().out)}
    signals = {name: row["signal"] for name, row in rows.items()}
    assert signals == {
        PHOENIX[0][0]: "voltage", PHOENIX[1][0]: "position", PHOENIX[2][0]: "velocity",
        "My-State": "state", "Phoenix6/TalonFX-21/DeviceTemp": "",
    }  # fmt: skip
    assert rows[PHOENIX[2][0]]["unit"] == "rotations per second"
    assert run_command(sysid, name="sysid", arguments=["entries", str(path)]) == 0
    assert capsys.readouterr().out.startswith("5 entries:\nstate ")


def test_two_motors_may_share_one_position(tmp_path):
    log = recorded("elevator")
    columns = [(f"/Lift/{name}", "") for name in
               ("LeftAppliedVolts", "PositionMeters", "VelocityMetersPerSec")]  # fmt: skip
    path = write(tmp_path / "a.wpilog", log, columns, state="LiftState",
                 more=(("/Lift/RightAppliedVolts", lambda run: run.voltage),))  # fmt: skip

    assert list(sim.io.read_motors(path)) == ["/Lift/left", "/Lift/right"]
    same_gains(path, log)


def one_after_another(path, *, states):
    """Two mechanisms in one file, the second 100 s after the first."""
    logger = Logger()
    for number, (mechanism, state) in enumerate(zip(("shooter", "intake"), states, strict=True)):
        log = recorded(mechanism)
        columns = [(name.replace("21", str(number)), said) for name, said in PHOENIX]
        for name, time, value in samples(log, columns, factors=rotations(log), state=state):
            if name not in logger.ids:
                kind = "string" if isinstance(value, str) else "double"
                logger.start(name, kind, dict(columns).get(name, ""))
            logger.put(name, time + number * 100_000_000, value)
    return logger.save(path)


@pytest.mark.parametrize(
    "states",
    [
        ("Roof-State", "Mouth-State"),
        ("Mode", "Mode"),
    ],
)
def test_several_mechanisms_are_a_numbered_list_to_pick_from(tmp_path, capsys, states):
    path = one_after_another(tmp_path / "a.wpilog", states=states)

    def ran(*more):
        arguments = ["fit", "--json", str(path), *more]
        return run_command(sysid, name="sysid", arguments=arguments), capsys.readouterr()

    code, said = ran()
    assert code == 2
    assert "such as --pick 1" in said.err
    for number, mechanism in enumerate(("shooter", "intake"), start=1):
        code, said = ran("--pick", str(number))
        gains = json.loads(said.out)["gains"]
        truth = fit_recorded(mechanism).in_units("rotations").gains
        assert gains["kV"] == pytest.approx(truth["kV"], rel=0.02)
        assert gains["kA"] == pytest.approx(truth["kA"], rel=0.05)
    assert ran("--pick", "3")[0] == 2


def test_arrays_are_refused_by_name_and_say_which_export(tmp_path):
    logger = Logger()
    for name, _ in AKIT:
        logger.start(name, "double[]", ADVANTAGESCOPE)
    path = logger.save(tmp_path / "dynamic-forward.wpilog")

    with pytest.raises(MissingSignal, match=r"Arrays cannot be used: '/Shooter") as refused:
        sim.read(path)

    assert "Tuner X or AdvantageScope" in str(refused.value)


@pytest.mark.parametrize(
    ("spoiled", "asked", "refused"),
    [
        (lambda run: run.position, [], ""),
        (lambda run: 0.25 * run.velocity, [], "--velocity-scale 4"),
        (lambda run: 0.25 * run.velocity, ["--velocity-scale", "4"], ""),
        (lambda run: 0.25 * run.velocity, ["--ignore-velocity"], ""),
        (None, ["--ignore-velocity"], ""),
    ],
)
def test_wrong_or_missing_velocity_is_replaced_or_refused(
    tmp_path, capsys, spoiled, asked, refused
):
    log = recorded()
    columns = AKIT[:2] if spoiled is None else AKIT
    logger = Logger()
    for run in log.runs:
        signals = [run.voltage, run.position, *([spoiled(run)] if spoiled else [])]
        for n, time in enumerate((1e6 * run.time).astype(int).tolist()):
            for name, value in [
                ("Mode", run.test),
                *zip([c[0] for c in columns], signals, strict=True),
            ]:
                if name not in logger.ids:
                    logger.start(name, "string" if name == "Mode" else "double")
                logger.put(name, time, value if name == "Mode" else float(value[n]))
        logger.put("Mode", time + 20_000, "none")
    path = logger.save(tmp_path / "a.wpilog")

    code = run_command(sysid, name="sysid", arguments=["fit", "--json", str(path), *asked])

    said = capsys.readouterr()
    if refused:
        assert code == 2
        assert refused in said.err
        return
    found = json.loads(said.out)
    codes = {one["code"] for one in found["warnings"]}
    assert ("velocity-is-position" in codes) == (not asked)
    truth = fit_recorded().gains
    assert found["gains"]["kV"] == pytest.approx(truth["kV"], rel=0.02)
    assert found["gains"]["kA"] == pytest.approx(truth["kA"], rel=0.12)
