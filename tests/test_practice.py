"""Practice: five steps on one mechanism, with a robot of one's own or without."""

import math
from dataclasses import replace

import numpy as np
import pytest
from places import ROOT

from grader.exercise.course_check import prepare_solved
from grader.exercise.exercise import Exercise, load_module
from grader.exercise.mistake import make_wrong_answer, scale_numbers
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.io import read, write

pytestmark = pytest.mark.usefixtures("robot_code_once")

OWN = Exercise("practice", ROOT / "exercises" / "practice")


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """The solution of a learner without a robot: file name -> text."""
    return prepare_solved(OWN, "ann", tmp_path_factory.mktemp("course")).right


def grade_answer(folder, texts, *, student="ann", **answers):
    """The results of an answer, by check."""
    for name, text in texts.items():
        if name == "answers.toml":
            for key, value in answers.items():
                text = make_wrong_answer(key, value)(text)  # noqa: PLW2901 - each answer in its turn
        (folder / name).write_text(text, encoding="utf-8")
    found = OWN.grade(folder / "answers.toml", student=student)
    return {check.id: check for check in found.checks}


def test_the_kp_of_a_position_loop_is_named(solved, tmp_path):
    fitted = OWN.module.measure_bench(OWN.module.draw("ann")).fit
    wrong = f"{fitted.feedback()['position'].kp:.5g}"

    found = grade_answer(tmp_path, solved, kP=wrong)["gains-kp"]

    assert found.status == "failed"
    assert "the kP of a position loop" in found.hint


def test_gains_per_rotation_of_wheel_or_motor_are_named(solved, tmp_path):
    measured = OWN.module.measure_bench(OWN.module.draw("ann"))
    turn = math.pi * measured.parts.diameter
    for what, factor in (("wheel", turn), ("motor", turn / measured.parts.ratio)):
        gains = {name: f"{measured.fit.gains[name] * factor:.5g}" for name in ("kV", "kA")}
        found = grade_answer(tmp_path, solved, **gains)

        for check in ("gains-kv", "gains-ka"):
            assert found[check].hint.startswith(f"is this per rotation of the {what}")


def robot(folder, *, noise=0.0):
    """A drivetrain of one's own: its log in a folder, and what its owner writes about it."""
    built = replace(MECHANISMS["drivetrain"], drag=0.05)
    log = simulate(built, Routine(0.5, 3.5, 8.0), rng=np.random.default_rng(5))
    rng = np.random.default_rng(6)
    runs = tuple(
        replace(run, velocity=run.velocity + noise * rng.standard_normal(len(run)))
        for run in log.runs
    )
    write(replace(log, runs=runs), folder / "mine.wpilog")
    found = fit(read(folder / "mine.wpilog"), method="sysid").in_units("meters")
    paper = 12 / (6000 / 60 / 6.75 * np.pi * 0.1016)  # a Kraken X60 turns at 6000 rpm
    above = 100 * (found.gains["kV"] / paper - 1)
    answers = {
        "log": '"mine.wpilog"',
        "motor": '"Kraken X60"',
        "ratio": "6.75",
        "wheel_diameter": '"101.6 mm"',
        **{name: f"{value:.5g}" for name, value in found.gains.items()},
        "kP": f"{found.feedback()['velocity'].kp:.5g}",
        "simulated_velocity_r2": f"{found.simulated_velocity_r2:.4f}",
        "kV_theory": f"{paper:.4g}",
        "difference": f"{above:.4g}",
        "verdict": '"ok"' if above <= 8 else '"watch"' if above <= 20 else '"inspect"',
    }
    return answers, found


def constants(found):
    """The code with these gains, as the solution writes it."""
    gains = {**found.gains, "kP": found.feedback()["velocity"].kp}
    return load_module(OWN.solution / "solve.py").fill_in_code(OWN.folder, gains, "m")


def lacking(results):
    return {name: (one.status, one.seen) for name, one in results.items() if one.status != "passed"}


@pytest.mark.parametrize("language", ["java", "Python"])
def test_without_a_robot_everything_can_be_earned_in_either_language(tmp_path, solved, language):
    results = grade_answer(tmp_path, solved, language=f'"{language}"')

    assert lacking(results) == {}


def test_with_a_robot_everything_can_be_earned(tmp_path, solved):
    answers, found = robot(tmp_path)
    results = grade_answer(tmp_path, {**solved, **constants(found)}, **answers)

    assert lacking(results) == {}


def test_team_logger_is_accepted_when_its_log_is_present(tmp_path, solved):
    answers, found = robot(tmp_path)
    texts = {**solved, **constants(found)}
    config = "Seconds.of(10))"
    assert config in texts["ExampleSubsystem.java"]
    text = texts["ExampleSubsystem.java"].replace("this::record", "null")
    own = 'Seconds.of(10), state -> SignalLogger.writeString("state", state.toString()))'
    text = text.replace(config, own)
    bring = "import com.ctre.phoenix6.SignalLogger;\nimport com.ctre.phoenix6.hardware.TalonFX;"
    texts["ExampleSubsystem.java"] = text.replace(bring.splitlines()[1], bring)
    with_log = grade_answer(tmp_path, texts, **answers)
    without = grade_answer(tmp_path, texts)

    assert {with_log[f"routine-{name}"].status for name in ("log", "units")} == {"passed"}
    assert "your own logger records" in with_log["routine-log"].hint
    assert without["routine-log"].status == "failed"


def test_poor_fit_requires_a_suspected_cause(tmp_path, solved):
    answers, found = robot(tmp_path, noise=0.6)
    texts = {**solved, **constants(found)}
    silent = grade_answer(tmp_path, texts, **answers)["hypothesis"]
    vague = grade_answer(tmp_path, texts, **answers, hypothesis='"wheel-slip"')["hypothesis"]
    strange = grade_answer(tmp_path, texts, **answers, hypothesis='"bad luck"')["hypothesis"]
    said = '"The wheels: chalk on the floor shows where they slip."'
    whole = grade_answer(tmp_path, texts, **answers, hypothesis='"wheel-slip"', first_check=said)

    assert found.simulated_velocity_r2 < 0.9
    assert "Choose one of" in silent.hint
    assert "Write a sentence: what would you check" in vague.hint
    assert "not one of the choices" in strange.seen
    assert whole["hypothesis"].status == "passed"


@pytest.mark.parametrize(
    ("changed", "check", "says"),
    [
        ({"log": '"other.wpilog"'}, "gains-kv", "there is no other.wpilog"),
        ({"log": '"../../../etc/passwd"'}, "gains-kv", "there is no passwd next to"),
        ({"log": '"answers.toml"'}, "gains-kv", "answers.toml"),
        ({"motor": '"a big one"'}, "theory-kv-theory", "an unknown motor"),
        ({"ratio": "0"}, "theory-kv-theory", "not larger than zero"),
        ({"language": '"C++"'}, "routine-ramp", "language"),
        ({"language": '""'}, "constants-named", "language"),
    ],
)
def test_a_missing_answer_gets_a_hint_and_no_crash(tmp_path, solved, changed, check, says):
    answers, found = robot(tmp_path)
    results = grade_answer(tmp_path, {**solved, **constants(found)}, **{**answers, **changed})
    first = next(one for one in results.values() if one.id.startswith(check.partition("-")[0]))

    assert {one.status for one in results.values()} <= {"passed", "failed", "not-reached"}
    assert says in f"{results[check].seen} {first.seen}"


def test_files_may_have_names_of_their_own(tmp_path, solved):
    texts = {**solved, "Arm.java": solved["ExampleSubsystem.java"]}
    texts["ExampleSubsystem.java"] = "public class Empty {}\n"
    texts["answers.toml"] += 'subsystem = "Arm.java"\n'
    own = grade_answer(tmp_path, texts)

    assert own["routine-step"].status == "passed"


@pytest.mark.parametrize(
    ("gain", "factor", "status"), [("kV", 2.0, "failed"), ("kA", 1.1, "passed")]
)
def test_a_gain_that_is_written_down_differently_costs_no_points_for_right_constants(
    tmp_path, solved, gain, factor, status
):
    texts = {**solved, "answers.toml": scale_numbers(factor, gain)(solved["answers.toml"])}
    results = grade_answer(tmp_path, texts)

    assert results[f"gains-{gain.lower()}"].status == status
    assert results[f"constants-{gain.lower()}"].status == "passed"


def test_the_files_to_fill_in_and_the_log_are_one_mechanism(tmp_path, solved):
    drawn = OWN.module.draw("zoë")
    names = {"motor_count": 2, "units": "meters"}
    for name, file in (("java", "ExampleSubsystem.java"), ("python", "example_subsystem.py")):
        (tmp_path / file).write_text(solved[file], encoding="utf-8")
        (facts,) = OWN.module.FOURTH.read(tmp_path / file, student="zoë")
        container = next(one for one in OWN.module.LANGUAGES[name] if "ontainer" in one)
        text = (OWN.folder / container).read_text(encoding="utf-8")

        assert len(facts.motors) == names["motor_count"]
        assert f"new {facts.name}(" in text or f"{facts.name}()" in text
        assert "class ExampleSubsystem" not in text
    assert {name: getattr(drawn.mechanism, name) for name in names} == names
    constant = OWN.module.METERS_PER_ROTATION
    assert 2 * np.pi * drawn.mechanism.radius / drawn.mechanism.ratio == pytest.approx(constant)


def test_two_mechanisms_in_one_answer_do_not_earn_everything(tmp_path, solved):
    """The container of exercise 5 brings a subsystem of its own, and a shooter has no meters."""
    shooter = replace(MECHANISMS["shooter"], drag=0.05)
    log = simulate(shooter, Routine(0.5, 3.5, 8.0), rng=np.random.default_rng(5))
    write(log, tmp_path / "mine.wpilog")
    fifth = (ROOT / "solutions" / "exercise5" / "RobotContainer.java").read_text(encoding="utf-8")
    texts = {**solved, "RobotContainer.java": fifth}
    twice = grade_answer(tmp_path, texts)["one-mechanism"]
    turning = grade_answer(tmp_path, solved, log='"mine.wpilog"')["one-mechanism"]

    assert (twice.points, turning.points) == (0, 1)
    assert (
        twice.seen
        == "ExampleSubsystem.java has a SysIdRoutine, and RobotContainer.java has another one"
    )
    assert turning.seen == "your code records meters, and your log has turns"
