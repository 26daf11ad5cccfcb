"""The contract of an effect, over everything the catalogue holds."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.core.log import KINDS, Log, Run
from sim.physics.effects import EFFECTS, find_effect, list_look_alikes
from sim.physics.engine import State, find_finest_step, simulate_run
from sim.physics.model import Model, Part
from sim.physics.voltage_residual import compute_voltage_residual

PAIRS = [
    (name, kind)
    for name in EFFECTS
    for kind in MECHANISMS
    if not EFFECTS[name].reason_against(MECHANISMS[kind].scale)
]
TIME = np.arange(0.0, 2.0, 0.02)


def some(seed=0):
    return np.random.default_rng(seed)


def hidden(name, kind, size=1.0):
    """The model of a mechanism with one effect, without friction's help from stops."""
    return replace(MECHANISMS[kind].hide(name, size).model, travel=None)


def middle(kind):
    """[m or rad] a place in the middle of a mechanism's travel."""
    stops = MECHANISMS[kind].stops
    return 0.5 * sum(stops) if stops else 0.0


def wave(seed, size=4.0):
    """(n,) [V] steps of half a second, as nobody would plan them."""
    levels = some(seed).uniform(-size, size, 1 + TIME.size // 25)
    return np.repeat(levels, 25)[: TIME.size]


@pytest.mark.parametrize("name", EFFECTS)
def test_an_effect_is_written_as_the_contract_asks(name):
    found = EFFECTS[name]

    assert found.find_contract_breaches() == []
    assert found.name == name
    for said in (found.summary, found.formula, found.fingerprint, found.inspect):
        assert len(said) > 3, said
    assert not found.summary.endswith(".")
    assert found.fingerprint.endswith(".")
    assert found.inspect.endswith(".")
    assert list_look_alikes(name), "name a look-alike, and the test that tells them apart"
    for other, test in found.apart.items():
        assert other in EFFECTS, f"{name} is told apart from {other!r}, which is not an effect"
        assert name not in EFFECTS[other].apart, f"{other}'s file says it: once is enough"
        assert test.endswith("."), test
    for parameter in found.parameters:
        assert parameter.name.isidentifier()
        assert parameter.least <= parameter.neutral <= max(parameter.most, parameter.neutral)


@pytest.mark.parametrize(("name", "kind"), PAIRS)
def test_everyday_size_of_an_effect_is_within_bounds_and_visible(name, kind):
    model = hidden(name, kind)
    plain = replace(model, parts=())
    part = model.parts[0]
    assert Part(part.effect, part.parameters) == part  # within its bounds, or it would be refused
    noise = MECHANISMS[kind].sensor.velocity_noise
    silent = replace(MECHANISMS[kind].sensor, velocity_noise=0.0)
    bare = replace(MECHANISMS[kind], sensor=silent)
    routine = Routine(ramp=0.5, step=6.0, kinds=KINDS)  # every kind of test, so that heat shows too

    logs = [simulate(one, routine, rng=some()) for one in (bare.hide(name), bare)]

    apart = max(
        float(np.abs(a.velocity[: len(b)] - b.velocity[: len(a)]).max())
        for a, b in zip(*(log.runs for log in logs), strict=True)
    )
    assert plain.gains == model.gains
    assert apart > noise


@pytest.mark.parametrize("name", [n for n in EFFECTS if EFFECTS[n].kind != "two-body"])
def test_effect_at_its_neutral_values_changes_nothing(name):
    kind = next(kind for one, kind in PAIRS if one == name)
    base = replace(MECHANISMS[kind].model, travel=None)
    values = dict(EFFECTS[name].neutral)
    start = middle(kind)

    there = simulate_run(base, time=TIME, voltage=wave(1), state=State.cold_at(start))
    with_it = simulate_run(
        base + Part(name, values), time=TIME, voltage=wave(1), state=State.cold_at(start),
        step=find_finest_step(base),
    )  # fmt: skip
    alone = simulate_run(
        base, time=TIME, voltage=wave(1), state=State.cold_at(start), step=find_finest_step(base)
    )

    assert with_it.seen == pytest.approx(alone.seen, abs=1e-9)
    assert with_it.position == pytest.approx(there.position, abs=2e-3 * np.ptp(there.position))


@pytest.mark.parametrize("name", [name for name in EFFECTS if EFFECTS[name].same_in_motion])
@pytest.mark.parametrize("step", [6.0, -6.0])
def test_effects_that_are_the_same_in_motion_move_alike(name, step):
    base = replace(MECHANISMS["drivetrain"].model, travel=None)

    def speeds(effect):
        part = Part(effect, dict.fromkeys(EFFECTS[effect].names, 0.1))
        volts = np.full(TIME.size, step)
        return simulate_run(base + part, time=TIME, voltage=volts, state=State()).velocity

    plain = simulate_run(base, time=TIME, voltage=np.full(TIME.size, step), state=State()).velocity
    assert speeds(name) == pytest.approx(speeds(EFFECTS[name].same_in_motion), rel=1e-9)
    assert np.abs(speeds(name) - plain).max() > 0.01 * np.abs(plain).max()


@pytest.mark.parametrize(("name", "kind"), PAIRS)
@pytest.mark.parametrize("size", [0.3, 1.0, 2.0])
def test_halving_the_step_changes_a_trajectory_by_less_than_a_thousandth(name, kind, size):
    model = hidden(name, kind, size)
    volts = wave(3)
    start = middle(kind)

    coarse = simulate_run(model, time=TIME, voltage=volts, state=State.cold_at(start))
    fine = simulate_run(
        model,
        time=TIME,
        voltage=volts,
        state=State.cold_at(start),
        step=0.5 * find_finest_step(model),
    )

    assert np.abs(coarse.position - fine.position).max() < 1e-3 * np.ptp(fine.position)
    assert np.abs(coarse.velocity - fine.velocity).max() < 1e-3 * np.ptp(fine.velocity)


SYMMETRIC = [  # gravity does not mirror
    pair for pair in PAIRS if EFFECTS[pair[0]].symmetric and MECHANISMS[pair[1]].type == "simple"
]


@pytest.mark.parametrize(("name", "kind"), SYMMETRIC)
@given(seed=st.integers(0, 10_000))
@settings(max_examples=5)
def test_mirrored_volts_give_mirrored_motion(name, kind, seed):
    model = hidden(name, kind)
    volts = wave(seed)

    there = simulate_run(model, time=TIME, voltage=volts, state=State())
    back = simulate_run(model, time=TIME, voltage=-volts, state=State())

    told = "other volts, other motion: an effect with a direction of its own says symmetric=False"
    assert (there.position == -back.position).all(), told
    assert (there.seen == -back.seen).all(), told


def energy(model, track):
    """(n,) [V·unit] of motion and of everything that can give it back."""
    part = model.parts[0]
    share = part.parameters.get("share", 1.0) if EFFECTS[part.effect].kind == "two-body" else 1.0
    load = np.gradient(track.load_position, TIME, edge_order=2)
    inertia = model.gains["kA"]
    moving = 0.5 * inertia * track.velocity**2
    if share < 1.0:
        moving = 0.5 * inertia * share * track.velocity**2
        _ = load  # the load's own motion is counted by the test of two bodies
    stored = np.zeros_like(track.position)
    if (stores := EFFECTS[part.effect].stored_energy) is not None:
        stored = np.array([stores(float(x), **part.parameters) for x in track.position])
    kg = model.gains.get("kG", 0.0)
    if model.type == "elevator":
        stored = stored + kg * track.position
    elif model.type == "arm":
        stored = stored + kg * np.sin(track.position)
    return moving + stored


@pytest.mark.parametrize(("name", "kind"), [p for p in PAIRS if EFFECTS[p[0]].kind != "two-body"])
@given(seed=st.integers(0, 10_000))
@settings(max_examples=5)
def test_energy_is_never_created(name, kind, seed):
    # Without voltage, the back-EMF of a shorted motor and friction only take; with it, no more is
    # stored than the battery gave: the volts times the way, sample by sample.
    model = hidden(name, kind, float(some(seed).uniform(0.3, 2.0)))
    volts = wave(seed)
    state = State.cold_at(middle(kind))
    fine = 0.1 * find_finest_step(model)

    driven = simulate_run(model, time=TIME, voltage=volts, state=state, step=fine)
    spent = np.abs(volts[:-1]) * np.abs(np.diff(driven.position))
    slack = 1e-6 + 1e-3 * float(np.abs(energy(model, driven)).max())
    gained = np.diff(energy(model, driven))
    speeds = np.maximum(np.abs(driven.velocity[1:]), np.abs(driven.velocity[:-1]))
    turned = np.sign(driven.velocity[1:]) != np.sign(driven.velocity[:-1])
    late = EFFECTS[name].hooks.keys() & {"command_delay"}
    given_most = spent + np.where(turned, np.abs(volts[:-1]) * speeds * 0.02, 0.0)
    if late:  # what arrives now was asked for before
        given_most = np.abs(volts).max() * speeds * 0.02 + slack
    told = "energy comes from nowhere: a force that gives back what it took needs stored_energy"
    assert (gained <= given_most + slack).all(), told

    coasting = simulate_run(model, time=TIME, voltage=np.zeros_like(TIME), state=state, step=fine)
    lost = np.diff(energy(model, coasting))
    first = 3 if late else 0  # the last command is still on its way
    assert (lost[first:] <= slack).all(), told


@pytest.mark.parametrize("name", ["backlash", "compliance"])
@given(seed=st.integers(0, 10_000))
@settings(max_examples=5)
def test_two_bodies_without_voltage_only_slow_down(name, seed):
    model = hidden(name, "drivetrain", float(some(seed).uniform(0.3, 2.0)))
    part = model.parts[0].parameters
    ka = model.gains["kA"]
    soft = part.get("softness", 0.0)
    state = State()
    simulate_run(model, time=TIME, voltage=wave(seed), state=state)
    before = math.inf
    for _ in range(150):
        x, v, y, w, _ = state.body
        bent = 0.5 * (x - y) ** 2 / soft if soft else 0.0
        if not soft:  # teeth of a stiff contact
            into = max(abs(x - y) - 0.5 * part["slack"], 0.0)
            reduced = part["share"] * (1.0 - part["share"]) * ka
            bent = 0.5 * reduced * (2.0 * math.pi * 40.0) ** 2 * into**2
        own = 0.5 * ka * (part["share"] * v * v + (1.0 - part["share"]) * w * w) + bent
        assert own <= before * (1.0 + 1e-3) + 1e-9
        before = own
        simulate_run(
            model, time=np.array([0.0, 0.005]), voltage=np.zeros(2), state=state,
            step=0.2 * find_finest_step(model),
        )  # fmt: skip


NEAR = {  # parameter that the best start should have nearly right, and how nearly (a factor)
    "drag": ("drag", 1.6), "constant-load": ("load", 1.3), "spring": ("rate", 1.5),
    "gravity-cosine": ("level", 1.4), "asymmetric-back-emf": ("lean", 1.3),
    "asymmetric-friction": ("lean", 1.3), "cogging": ("turns", 1.1),
    "velocity-scale": ("scale", 1.02),
    "velocity-filter": ("window", 1.6), "voltage-limit": ("limit", 1.25), "deadband": ("band", 1.3),
    "delay": ("lag", 2.0), "current-limit": ("limit", 1.6), "stribeck": ("extra", 2.5),
    "battery-sag": ("share", 3.0), "wheel-slip": ("grip", 1.25),
}  # fmt: skip


@pytest.mark.parametrize("name", NEAR)
def test_the_best_start_is_near_the_truth(name):
    kind = "turret" if name == "gravity-cosine" else "drivetrain"
    mechanism = MECHANISMS[kind].hide(name)
    truth = mechanism.hidden[0].parameters
    log = simulate(mechanism, Routine(ramp=0.5, step=3.5), rng=some(5))
    wanted, factor = NEAR[name]

    starts = list(
        EFFECTS[name].start_values(
            compute_voltage_residual(log, MECHANISMS[kind].gains, type=mechanism.type)
        )
    )

    off = min(abs(math.log(abs(start[wanted] / truth[wanted]))) for start in starts)
    assert math.exp(off) < factor, (truth, starts)


def test_starts_survive_a_log_in_which_nothing_moves():
    still = np.zeros(60)
    time = np.arange(60) * 0.02
    tests = ("quasistatic-forward", "dynamic-forward")
    log = Log(tuple(Run(test, time, still, still, still) for test in tests))
    seen = compute_voltage_residual(log, {"kS": 0.1, "kV": 2.0, "kA": 0.2}, type="simple")
    for name, found in EFFECTS.items():
        for start in found.start_values(seen):
            Part(name, start)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (dict(kind="magic"), "kind is 'magic'; choose one of: term"),
        (dict(hooks={}), "hooks is empty"),
        (dict(hooks={"forces": lambda v: v}), "'forces', which is not one of: force"),
        (
            dict(hooks={"force": lambda speed: speed}),
            "force asks for 'speed'; it may ask for: x, v",
        ),
        (dict(hooks={"transform_voltage": lambda u: u}), "order is 0"),
    ],
    ids=["kind", "nothing", "hook", "argument", "order"],
)
def test_an_effect_written_wrongly_is_named_with_what_is_wrong(change, said):
    assert any(said in line for line in replace(EFFECTS["drag"], **change).find_contract_breaches())


@pytest.mark.parametrize(
    "make",
    [
        lambda: find_effect("magic"),
        lambda: Part("drag", {}),
        lambda: Part("drag", {"drag": -1.0}),
        lambda: Model("simple", {}) + Part("drag", {"drag": 1.0}) + Part("drag", {"drag": 1.0}),
        lambda: MECHANISMS["shooter"].hide("spring"),
        lambda: MECHANISMS["drivetrain"].hide("drag", 9.0),
        lambda: MECHANISMS["drivetrain"].hide("drag", math.nan),
        lambda: MECHANISMS["drivetrain"].hide("drag").hide("drag"),
    ],
    ids=["unknown", "missing", "sign", "twice", "cannot", "size", "nan", "hidden twice"],
)  # fmt: skip
def test_unphysical_parameter_is_refused(make):
    with pytest.raises(BadRequest) as refused:
        make()

    assert refused.value.advice


def asked(act, **known):
    """Call an effect's function with what it asks for."""
    names = act.__code__.co_varnames[: act.__code__.co_argcount]
    return act(**{name: known[name] for name in names})


@pytest.mark.parametrize(("name", "kind"), [p for p in PAIRS if "force" in EFFECTS[p[0]].hooks])
def test_an_effect_never_accelerates_a_mechanism_without_voltage(name, kind):
    # beyond what it stores and gives back, kV·v and the term together never feed the motion
    found, scale = EFFECTS[name], MECHANISMS[kind].scale
    values = hidden(name, kind, 2.0).parts[0].parameters
    for v in (scale.speed * np.geomspace(1e-4, 2.0, 30)).tolist():
        for x, way in ((0.0, v), (0.3 * scale.reach, -v)):
            slope = 0.0
            if found.stored_energy is not None:
                step = 1e-6 * scale.reach
                slope = (
                    found.stored_energy(x + step, **values)
                    - found.stored_energy(x - step, **values)
                ) / (2.0 * step)
            force = asked(found.hooks["force"], x=x, v=way, **values)
            tiny = 1e-6 * abs(force)
            told = f"without voltage it speeds up at {x:g}, {way:g}: turn the sign of force around"
            told += ", or say stored_energy if it gives back what it took"
            assert (scale.kv * way + force - slope) * way >= -tiny * abs(way), told
