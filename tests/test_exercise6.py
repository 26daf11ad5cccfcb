"""Exercise 6: plans that keep the rules, held against the bench, and a morning before the tests."""

import math
import re
import sys
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from answer_grades import grade_answer
from places import ROOT

from grader.answers.answer_key import load_answer_key
from grader.cli import run_command
from grader.exercise.exercise import Exercise
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.units import find_unit
from sim.fit import fit
from sim.physics.battery import Battery
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model

OWN = Exercise("exercise6", ROOT / "exercises" / "exercise6")
KEY = load_answer_key(OWN.module.__name__)
DRAWN = sys.modules[OWN.module.draw.__module__]
RULES = sys.modules[OWN.module.find_broken_rules.__module__]
PLAN = sys.modules[OWN.module.Plan.__module__]
CLASS = [f"student {number}" for number in range(50)]
KINDS = ("drivetrain", "elevator", "turret", "shooter")
STEPS = ["wire-routine", "run-tests", "inspect-and-fit", "place-gains"]
UNITS = {"m": "meters", "rot": "rotations"}


def written(kind, plan):
    """A plan as the lines of an answer."""
    mark = "timeout" if math.isinf(plan.release) else f"{plan.release:.4g}"
    values = {"ramp": plan.ramp, "step": plan.step, "timeout": plan.timeout}
    return {f"{kind}_{name}": f"{value:.4g}" for name, value in values.items()} | {
        f"{kind}_release": mark
    }


def right(student):
    """Everything as it should be."""
    answers = {}
    for kind, machine in OWN.module.draw(student).machines.items():
        answers |= written(kind, DRAWN.make_sound_plan(machine))
    morning = KEY.draw_morning(student)
    answers |= {f"check_{item}": word for item, word in morning.decisions.items()}
    return answers | {
        "steps": STEPS,
        "log_2026": "/u/logs" if morning.stick else "/home/lvuser/logs",
        "log_2027": "/home/systemcore/logs",
        **morning.effects,
        "schedule": "last-two-weeks-of-build-season",
    }


def grid(machine):
    """Some hundred plans, sensible and not."""
    for ramp, step, timeout, share in product(
        np.geomspace(0.2, 2.0, 9), np.geomspace(0.7, 7.0, 7), (4.0, 5.0, 10.0), (0.4, 0.6, 0.8)
    ):
        mark = math.inf if machine.travel is None else share * machine.travel
        yield PLAN.Plan(float(ramp), float(step), timeout, mark)


def test_every_mechanism_has_several_plans_and_far_more_that_break_a_rule():
    for student in CLASS[:4]:
        for machine in OWN.module.draw(student).machines.values():
            kept = [not RULES.find_broken_rules(machine, plan) for plan in grid(machine)]

            assert 4 <= sum(kept) < 0.4 * len(kept)


def test_any_plan_that_keeps_the_rules_passes(copy):
    variant = OWN.module.draw("ann")
    for kind, machine in variant.machines.items():
        kept = [plan for plan in grid(machine) if not RULES.find_broken_rules(machine, plan)]
        for plan in kept[:: max(1, len(kept) // 6)]:
            assert grade_answer(copy, **written(kind, plan))[kind].points == 1.5


def test_a_60_kg_drivetrain_goes_nine_meters_in_ten_seconds_at_half_a_volt_a_second():
    """Four Kraken X60 at 6.75:1 and 60 kg: 9.3 m, and at 1 V/s it is at 4.1 V after 10 feet."""
    machine = PLAN.Machine(
        "drivetrain", "m", 0.15, 2.524, 0.191, 0.0, 20.0, 366.0, 120.0, 0.01, 1.1, 0.3
    )
    ten = PLAN.quasistatic(machine, PLAN.Plan(0.5, 2.0, 10.0, math.inf))
    feet = PLAN.quasistatic(machine, PLAN.Plan(1.0, 2.0, 10.0, math.inf))

    assert ten.compute_position(ten.driven_time) == pytest.approx(9.3, abs=0.15)
    assert feet.still + feet.find_time(feet.compute_position, 3.048) == pytest.approx(4.1, abs=0.1)
    assert machine.slip_voltage == pytest.approx(2.2, abs=0.02)


@pytest.mark.parametrize("kind", KINDS)
def test_closed_form_predicts_the_travel_of_the_bench(kind):
    """The bench's own routine begins to drive two loops late; its sensor rounds."""
    variant = OWN.module.draw("ann")
    machine, built = variant.machines[kind], variant.built[kind]
    per = find_unit(UNITS[machine.symbol]).si
    plan = replace(DRAWN.make_sound_plan(machine), release=math.inf)
    sensor = replace(built.sensor, velocity_noise=0.0, jitter=0.0)
    strong = Battery(14.0, 0.0)
    quiet = replace(built, sensor=sensor, battery=strong, stator=1e4, supply=1e4)
    if machine.kg:
        quiet = replace(quiet, lowest=0.0, travel=100.0)  # it begins at the bottom
    routine = Routine(ramp=plan.ramp, step=plan.step, timeout=plan.timeout)
    log = simulate(quiet, routine, rng=np.random.default_rng(1))

    for test, name in ((PLAN.quasistatic, "quasistatic"), (PLAN.dynamic, "dynamic")):
        (ran,) = log.list_runs_of_test(f"{name}-forward")
        begins = ran.time[0] - (0.04 if name == "quasistatic" else 0.0)
        moving = ran.time - begins - test(machine, plan).still
        places = [test(machine, plan).compute_position(max(float(t), 0.0)) for t in moving]
        seen = (ran.position - ran.position[0]) / per

        assert np.max(np.abs(seen - places)) < 0.02 * max(places)


@pytest.mark.parametrize("kind", KINDS)
def test_mechanism_stops_where_the_plan_says(kind):
    """The mark, a late thumb, and 0 V in brake mode: how far it got."""
    for student in CLASS[:5]:
        machine = OWN.module.draw(student).machines[kind]
        plan = DRAWN.make_sound_plan(machine)
        gains = {"kS": machine.ks, "kV": machine.kv, "kA": machine.ka}
        gains |= {"kG": machine.kg} if machine.kg else {}
        stops = (0.0, 100.0) if machine.kg else None  # it begins at the bottom
        model = Model("elevator" if machine.kg else "simple", gains, (), stops)
        for test in (PLAN.quasistatic(machine, plan), PLAN.dynamic(machine, plan)):
            off = test.still + test.driven_time
            time = np.arange(0.0, off + 12.0 * machine.tau + 0.2, 0.002)
            drive = plan.ramp * (time + 0.001) if test.ramp else np.full(time.size, plan.step)
            track = simulate_run(
                model, time=time, voltage=np.where(time < off, drive, 0.0), state=State()
            )

            assert np.max(track.position) == pytest.approx(test.stop_position, rel=0.01)
            assert np.max(track.velocity) == pytest.approx(test.end_speed, rel=0.01)


@pytest.mark.parametrize("kind", KINDS)
def test_a_log_made_by_a_plan_that_keeps_the_rules_determines_the_gains(kind):
    """With the bench's own noise and SysId's recipe: kV within 3, kA 20, kG 4 %."""
    for number, student in enumerate(CLASS[:4]):
        variant = OWN.module.draw(student)
        machine, built = variant.machines[kind], variant.built[kind]
        if machine.travel is not None:
            built = replace(built, travel=machine.travel * find_unit(UNITS[machine.symbol]).si)
        built = replace(built, lowest=0.0) if machine.kg else built
        plan = DRAWN.make_sound_plan(machine)
        routine = Routine(ramp=plan.ramp, step=plan.step, timeout=plan.timeout)
        log = simulate(built, routine, rng=np.random.default_rng(number))
        found = fit(log, type=built.type, method="sysid").gains

        for gain, near in {"kV": 0.03, "kA": 0.20, "kG": 0.04}.items():
            assert found.get(gain, 0.0) == pytest.approx(built.gains.get(gain, 0.0), rel=near)


def test_acceleration_scatters_on_the_bench_as_the_rule_says():
    """Velocity samples 20 ms apart, the one after less the one before."""
    machine = OWN.module.draw("ann").machines["shooter"]
    noisy = machine.noise * np.random.default_rng(2).standard_normal(20000)

    assert np.std(np.gradient(noisy, 0.02)[1:-1]) == pytest.approx(
        machine.acceleration_noise, rel=0.03
    )


@pytest.mark.parametrize("student", ["ann", "ben", "zoë"])
def test_texts_for_the_learner_contain_no_plan_and_no_right_word(copy, student, capsys):
    """The smallest and the largest step, the ramp of a sound plan; a word outside of its list."""
    variant = OWN.module.draw(student)
    said = []
    words = {"log_2026": "/home/lvuser/deploy", "log_2027": "/u/logs", "schedule": "kickoff-week"}
    for ramp, step, timeout in ((0.11, 11.5, 9.9), (3.9, 0.15, 1.1), (99.0, 99.0, 99.0)):
        plan = PLAN.Plan(ramp, step, timeout, math.inf)
        lines = {name: one for kind in KINDS for name, one in written(kind, plan).items()}
        results = grade_answer(copy, student=student, **lines, **words, steps=STEPS[::-1])
        said += [one.hint for one in results.values()]
        run_command(["6", "--student", student, "--json"])
    printed = capsys.readouterr().out
    told = " ".join(said)

    assert all(one in printed for one in ("V/s", "you have", "at least 25 %", "does not move it"))
    for machine in variant.machines.values():
        ramp = DRAWN.make_sound_plan(machine).ramp
        for value, per in ((ramp, "V/s"), *((step, "V") for step in DRAWN.find_steps(machine))):
            near = [float(one) for one in re.findall(rf"(\d+\.\d+) {per}(?!/s)\b", told)]

            assert [one for one in near if abs(one - value) < 0.02 * value] == []
    for word in (KEY.draw_morning(student).roborio, "/home/systemcore/logs", "last-two-weeks"):
        assert not any(word in one for one in said if "Choose one of" not in one)


@pytest.mark.parametrize(("off", "kept"), [(0.002, True), (-0.002, True), (0.02, False)])
def test_plan_rounded_up_to_a_bound_is_accepted(off, kept):
    """The current, the grip, the end of the travel: a fifth of a percent beyond is rounding."""
    machine = replace(OWN.module.draw("ann").machines["drivetrain"], limit=1e4)
    plan = replace(DRAWN.make_sound_plan(machine), step=0.9 * machine.slip_voltage * (1.0 + off))
    rests = max(one(machine, plan).stop_position for one in (PLAN.quasistatic, PLAN.dynamic))
    short = replace(machine, travel=rests / (1.0 + off))
    drawn = replace(machine, grip=9.0, limit=plan.step / 12.0 * machine.stall / (1.0 + off))

    for here in (machine, replace(short, grip=9.0), drawn):
        assert (RULES.find_broken_rules(here, plan) == ()) == kept


def test_a_plan_that_breaks_one_rule_earns_half(copy):
    machine = OWN.module.draw("ann").machines["shooter"]
    plan = DRAWN.make_sound_plan(machine)
    one = grade_answer(copy, **written("shooter", replace(plan, step=12.0)))["shooter"]
    two = grade_answer(copy, **written("shooter", replace(plan, step=12.0, timeout=30.0)))[
        "shooter"
    ]

    assert (one.points, two.points) == (0.75, 0)


@pytest.mark.parametrize(
    ("name", "check", "given", "status"),
    [
        ("log_2027", "log-2027", "/home/systemcore/logs/", "passed"),
        ("log_2027", "log-2027", "home/systemcore/logs", "passed"),
        ("log_2027", "log-2027", "/home/SystemCore/Logs", "passed"),
        ("log_2027", "log-2027", "/var/log", "failed"),
        ("schedule", "schedule", "last two weeks of build season", "passed"),
        ("schedule", "schedule", "Last two weeks", "passed"),
        ("schedule", "schedule", "whenever", "failed"),
        (
            "steps",
            "steps",
            ["Wire routine", "RUN TESTS", "inspect_and_fit", "place gains"],
            "passed",
        ),
        ("steps", "steps", "wire-routine, run-tests, inspect-and-fit, place-gains", "passed"),
        ("steps", "steps", "wire-routine", "failed"),
        ("steps", "steps", [*STEPS, "place-gains"], "failed"),
    ],
)
def test_a_word_may_be_written_in_many_ways(copy, name, check, given, status):
    assert grade_answer(copy, **{name: given})[check].status == status


@pytest.mark.parametrize(("go", "no_go"), [("GO", "NO GO"), ("go!", "nogo"), ("yes", "no")])
def test_a_decision_may_be_written_in_many_ways(copy, go, no_go):
    decisions = KEY.draw_morning("ann").decisions
    words = {f"check_{item}": go if word == "go" else no_go for item, word in decisions.items()}

    assert grade_answer(copy, **words)["checklist"].status == "passed"


@pytest.mark.parametrize("word", ["go", "no-go"])
def test_the_same_decision_about_everything_earns_little(copy, word):
    same = {f"check_{item}": word for item in KEY.draw_morning("ann").seen}
    limits = {"limit_a": "bypassed", "limit_b": "bypassed"}
    results = [grade_answer(copy, student=one, **same, **limits) for one in CLASS]

    assert np.mean([one["checklist"].points for one in results]) < 0.2
    assert {one["limits"].points for one in results} == {0}


def test_each_wrong_word_cancels_a_right_one(copy):
    answers = right("ann") | {"check_log": "perhaps", "limit_a": "perhaps"}
    results = grade_answer(copy, **answers)

    assert results["checklist"].points == pytest.approx(4 / 6)  # five right, one wrong
    assert results["limits"].points == 0  # one right, one wrong


def test_a_mark_beyond_the_end_of_the_run_is_wrong(copy):
    """Meters written as millimeters: the timeout would end the test, but such a mark is no plan."""
    answers = right("ann")
    for kind, machine in OWN.module.draw("ann").machines.items():
        if machine.travel is None:
            continue
        found = grade_answer(copy, **{**answers, f"{kind}_release": 60.0 * machine.travel})

        assert any("your mark is at" in check.hint for check in found.values()), kind
