"""WPILOG logs: which runs, motors and mechanisms are found in them.

The logs come from the little robot in ``wpilog_file``.
"""

from pathlib import Path

import numpy as np
import pytest
from wpilog_file import FOUR, LOOP, Logger, Motor, codes, motion, routine, saved, voltage

import sim
from sim.core.errors import BadRequest
from sim.core.log import Array

TURN = 2 * np.pi
JAVA = ("Volt", "Rotation", "Rotation per Second")


def expected(test: str, loops: range, *, si: float = TURN) -> tuple[Array, Array, Array]:
    """Voltage, position and velocity of the little robot, worked out anew."""
    seen = np.array([motion(test, loop) for loop in loops])
    return np.array([voltage(test, loop) for loop in loops]), seen[:, 0] * si, seen[:, 1] * si


def test_log_of_a_routine_is_read_as_its_four_runs(tmp_path: Path) -> None:
    path = saved(tmp_path)

    log = sim.read(path)

    assert (log.units, log.mechanism, log.type, log.source) == (
        "rotations",
        "Arm",
        "arm",
        str(path),
    )
    assert log.doubts == ()
    assert [run.test for run in log.runs] == list(FOUR)
    assert log.runs[0].time[0] == 1.0
    for run in log.runs:
        u, x, v = expected(run.test, range(39))  # the last loop has the time of "none"
        assert np.array_equal(run.voltage, u)
        assert np.array_equal(run.position, x)
        assert np.array_equal(run.velocity, v)
        assert np.allclose(np.diff(run.time), 0.02, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("mechanism", "units", "type_"),
    [
        ("Arm", JAVA, "arm"),
        ("left-Elevator", JAVA, "elevator"),
        ("ElevatorSubsystem", JAVA, "elevator"),
        ("ARM_1", JAVA, "arm"),
        ("frontArm", JAVA, "arm"),
        ("alarm", JAVA, ""),
        ("Charm", JAVA, ""),
        ("elevator-arm", JAVA, ""),
        ("drive", JAVA, ""),
        ("Arm", ("Volt", "Meter", "Meter per Second"), ""),  # what moves in meters is no arm
        ("Elevator", ("Volt", "Meter", "Meter per Second"), "elevator"),
    ],
)
def test_a_mechanism_may_say_its_type_by_its_name(
    tmp_path: Path, mechanism: str, units: tuple[str, str, str], type_: str
) -> None:
    path = saved(tmp_path, Motor("main", units=units), mechanism=mechanism)

    assert sim.read(path).type == type_
    assert sim.read(path, type="simple").type == "simple"


def test_the_first_loop_is_left_out_where_the_state_is_stamped_later(tmp_path: Path) -> None:
    """On a robot every value has its own time; SysId draws lines to the times of the voltage."""
    log = sim.read(saved(tmp_path, Motor("main", late=(0, 30, 60)), state_late=100))

    run = log.list_runs_of_test("quasistatic-forward")[0]
    u, x, v = expected("quasistatic-forward", range(1, 40))
    assert log.doubts == ()
    assert np.array_equal(run.voltage, u)
    assert run.time[0] == pytest.approx(1.02)
    steps_x, steps_v = np.diff(x), np.diff(v)
    back_x = np.concatenate((steps_x[:1], steps_x)) * 30 / LOOP
    back_v = np.concatenate((steps_v[:1], steps_v)) * 60 / LOOP
    np.testing.assert_allclose(run.position, x - back_x, rtol=1e-12)
    np.testing.assert_allclose(run.velocity, v - back_v, rtol=1e-12)


def states(tmp_path: Path, *said: str) -> Path:
    """A log in which each word holds for ten loops."""
    logger = Logger()
    for name in ("voltage", "position", "velocity"):
        logger.start(f"{name}-m-Arm")
    logger.start("sysid-test-state-Arm", "string")
    for index in range(10 * len(said)):
        for name in ("voltage", "position", "velocity"):
            logger.put(f"{name}-m-Arm", index * LOOP, float(index))
        logger.put("sysid-test-state-Arm", index * LOOP, said[index // 10])
    return logger.save(tmp_path / "log.wpilog")


@pytest.mark.parametrize(
    ("said", "runs", "doubts"),
    [
        # a state that repeats is one run
        ("dynamic-forward/dynamic-forward/none", {"dynamic-forward": 20}, []),
        (
            "Dynamic-Forward/ QUASISTATIC-REVERSE /None",
            {"dynamic-forward": 10, "quasistatic-reverse": 10},
            [],
        ),
        # tests beyond the four, and an empty state between them
        (
            "chirp-forward//triangle-reverse/none",
            {"chirp-forward": 10, "triangle-reverse": 10},
            [],
        ),
        (
            "dynamic-forward/dynamic-sideways/quasistatic/none",
            {"dynamic-forward": 10},
            ["unknown-test"],
        ),
        ("none/dynamic-forward", {"dynamic-forward": 10}, ["unfinished-run"]),
    ],
)
def test_test_states_split_a_log_into_runs(
    tmp_path: Path, said: str, runs: dict[str, int], doubts: list[str]
) -> None:
    log = sim.read(states(tmp_path, *said.split("/")), units="meters")

    assert {run.test: len(run) for run in log.runs} == runs
    assert codes(log) == doubts


@pytest.mark.parametrize("signal", ["state", "voltage"])
def test_two_copies_under_paths_must_be_distinguished_by_an_option(
    tmp_path: Path, signal: str
) -> None:
    logger = Logger()
    plain = signal == "voltage"
    routine(
        logger, Motor("main", leave_out=("voltage",) if plain else ()), path="" if plain else "a/"
    )
    for path in ("b/", "c/") if plain else ("b/",):
        leave_out = ("position", "velocity") if plain else ()
        routine(logger, Motor("main", leave_out=leave_out), path=path, tests=())
        logger.put(f"{path}voltage-main-Arm", 5, 1.0)
        logger.put(f"{path}sysid-test-state-Arm", 5, "none" if plain else "dynamic-forward")

    with pytest.raises(BadRequest, match=f"--{signal} ENTRY"):
        sim.read(logger.save(tmp_path / "log.wpilog"))


@pytest.mark.parametrize(
    ("mechanism", "sign"), [pytest.param("drive-train", 1.0), pytest.param("train", -1.0)]
)
def test_dashes_in_names_are_split_by_the_mechanism(
    tmp_path: Path, mechanism: str, sign: float
) -> None:
    """``voltage-front-left-drive-train`` belongs to drive-train alone, though it ends in -train."""
    logger = Logger()
    routine(logger, Motor("front-left"), mechanism="drive-train")
    routine(logger, Motor("x", sign=-1), mechanism="train", begin=10**9)

    log = sim.read(
        logger.save(tmp_path / "log.wpilog"), entries={"state": f"sysid-test-state-{mechanism}"}
    )

    assert log.mechanism == mechanism
    assert log.doubts == ()
    assert log.list_runs_of_test("dynamic-forward")[0].voltage[0] == 7.0 * sign


def test_file_with_two_mechanisms_asks_for_one(tmp_path: Path) -> None:
    logger = Logger()
    routine(logger, Motor("a"), mechanism="Arm")
    routine(logger, Motor("b"), mechanism="Wrist", begin=10**9)
    path = logger.save(tmp_path / "log.wpilog")

    with pytest.raises(BadRequest) as refused:
        sim.read(path)
    assert refused.value.advice
    assert sim.read(path, motor="b").mechanism == "Wrist"
    assert sim.read(path, entries={"state": "sysid-test-state-Arm"}).mechanism == "Arm"


LEFT, RIGHT = Motor("drive-left"), Motor("drive-right", sign=0.5)


@pytest.mark.parametrize("name", ["drive-right", "RIGHT", "right", "-right"])
def test_a_motor_is_chosen_by_its_name_or_its_end(tmp_path: Path, name: str) -> None:
    log = sim.read(saved(tmp_path, LEFT, RIGHT), motor=name)

    assert log.list_runs_of_test("dynamic-forward")[0].voltage[0] == 3.5
    assert log.doubts == ()


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("middle", id="no such motor"),
        pytest.param("t", id="an end that two have"),
    ],
)
def test_an_ambiguous_motor_name_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(BadRequest) as refused:
        sim.read(saved(tmp_path, LEFT, RIGHT), motor=name)
    assert refused.value.advice


def test_motors_against_each_other_are_not_averaged(tmp_path: Path) -> None:
    path = saved(tmp_path, LEFT, Motor("drive-right", sign=-1))

    with pytest.raises(BadRequest) as refused:
        sim.read(path)
    assert refused.value.advice
    assert sim.read(path, motor="right").list_runs_of_test("dynamic-forward")[0].voltage[0] == -7.0


def test_motor_that_lacks_a_signal_is_left_out_with_a_warning(tmp_path: Path) -> None:
    log = sim.read(saved(tmp_path, LEFT, Motor("follower", leave_out=("velocity",))))

    assert codes(log) == ["incomplete-motor"]
    assert log.list_runs_of_test("dynamic-forward")[0].voltage[0] == 7.0
