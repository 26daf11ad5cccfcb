"""The stepping engine: against closed forms, against itself uncompiled, and as it is composed."""

import ast
import inspect
import math
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import make_power_path_array
from sim.core.errors import BadRequest
from sim.physics.effects import EFFECTS
from sim.physics.effects.drag import EFFECT as DRAG
from sim.physics.engine import (
    EXACT,
    NO_CORRECTION,
    NO_WIRES,
    RunBatch,
    State,
    compose,
    filter_runs,
    kernel,
    make_effect_arrays,
    make_model_constants,
    simulate_run,
)
from sim.physics.engine.compose import MODULES, compose_engine, is_compiled
from sim.physics.engine.kernel import NO_USE, find_kernel_file
from sim.physics.engine.machine_code import ObjectCode, link_code
from sim.physics.engine.power_path import CUT
from sim.physics.engine.two_body_modes import TABLES_SIZE
from sim.physics.model import Model, Part
from sim.support.work.cache import CACHE, find_cache_folder

pytestmark = pytest.mark.slow

GAINS = {"kS": 0.2, "kV": 2.0, "kA": 0.3}
PLAIN = Model("simple", GAINS)
TIME = np.arange(0.0, 1.0, 0.02)


def steady(volts):
    return np.full(TIME.size, float(volts))


@pytest.mark.parametrize("name", EFFECTS)
def test_the_compiled_engine_does_what_the_plain_text_says(name):
    kind = next(k for k in MECHANISMS if not EFFECTS[name].reason_against(MECHANISMS[k].scale))
    model = MECHANISMS[kind].hide(name).model
    volts = np.where(TIME < 0.4, 3.0, -2.0)
    wires = make_power_path_array(MECHANISMS[kind])

    fast, slow = (
        simulate_run(model, time=TIME, voltage=volts, state=State(), wires=wires, plain=plain)
        for plain in (False, True)
    )

    assert fast.position == pytest.approx(slow.position, abs=1e-9)
    assert fast.seen == pytest.approx(slow.seen, abs=1e-7)
    assert fast.applied == pytest.approx(slow.applied, abs=1e-9)


def test_an_arm_that_is_let_go_swings_through_and_settles_below():
    arm = Model("arm", {"kS": 0.0, "kV": 0.05, "kA": 0.1, "kG": 1.0, "offset_rad": 0.0})
    time = np.arange(0.0, 60.0, 0.02)

    track = simulate_run(arm, time=time, voltage=np.zeros(time.size), state=State.cold_at(0.3))

    assert track.position[-1] == pytest.approx(-math.pi / 2.0, abs=1e-3)
    assert track.position.min() < -math.pi / 2.0 - 0.5


def test_an_elevator_on_its_stop_lifts_when_the_ramp_exceeds_weight_and_friction():
    lift = Model("elevator", {"kS": 0.2, "kV": 4.0, "kA": 0.2, "kG": 1.0}, travel=(0.0, 1.0))
    time = np.arange(0.0, 4.0, 0.02)

    track = simulate_run(lift, time=time, voltage=0.5 * time, state=State())

    assert not track.velocity[time < 2.38].any()  # (kG + kS)/0.5 V/s = 2.4 s
    assert track.velocity[time > 2.5].all()
    held = simulate_run(lift, time=time, voltage=np.full(time.size, 8.0), state=State())
    assert held.position.max() == 1.0
    assert held.velocity[-1] == 0.0


def test_a_current_limit_makes_the_rise_a_straight_line():
    # |u - kV·v| ≤ 1: a = (1 - 0.2)/0.3 until u - kV·v falls below the limit, at v = (3 - 1)/2
    limited = PLAIN + Part("current-limit", {"limit": 1.0})

    track = simulate_run(limited, time=TIME, voltage=steady(3.0), state=State())

    rising = track.velocity < 0.98
    assert track.velocity[rising] == pytest.approx(0.8 / 0.3 * TIME[rising], rel=1e-4, abs=1e-12)


def test_voltage_ramp_moves_like_many_small_steps():
    fine = np.linspace(0.0, 0.2, 2001)
    coarse = fine[::200]
    volts = 3.0 + 10.0 * coarse

    track = simulate_run(
        PLAIN, time=coarse, voltage=volts, slide=np.append(np.diff(volts), 0.0), state=State()
    )

    middle = 3.0 + 10.0 * (fine + 0.5 * (fine[1] - fine[0]))
    exact = simulate_run(PLAIN, time=fine, voltage=middle, state=State())
    held = simulate_run(PLAIN, time=coarse, voltage=volts, state=State())
    missed = np.max(np.abs(track.position - exact.position[::200]))
    assert missed < 0.005 * np.max(np.abs(held.position - exact.position[::200]))


def test_a_delay_shifts_the_motion_and_nothing_else():
    late = simulate_run(
        PLAIN + Part("delay", {"lag": 0.06}), time=TIME, voltage=steady(3.0), state=State()
    )
    prompt = simulate_run(PLAIN, time=TIME, voltage=steady(3.0), state=State())

    assert late.velocity[3:] == pytest.approx(prompt.velocity[:-3], abs=1e-12)
    assert not late.velocity[:4].any()


def test_inertia_that_joins_shares_its_momentum():
    joined = PLAIN + Part(
        "inertia-change", {"extra": 0.3, "onset": 0.5, "until": 1e6, "shared": 1.0}
    )
    state = State.cold_at(0.0, 1.0)
    free = replace(joined, gains={"kS": 0.0, "kV": 1e-9, "kA": 0.3})

    track = simulate_run(free, time=TIME, voltage=steady(0.0), state=state)

    assert track.velocity[TIME < 0.49] == pytest.approx(1.0, abs=1e-6)
    assert track.velocity[TIME > 0.51] == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize("until", [0.537, 1e6])
def test_event_between_two_samples_happens_at_its_own_time(until):
    values = {"extra": 0.3, "onset": 0.413, "until": until, "shared": 1.0}
    model, finer = PLAIN + Part("inertia-change", values), np.union1d(TIME, [0.413, 0.537])

    track, every = (
        simulate_run(model, time=time, voltage=np.full(time.size, 6.0), state=State())
        for time in (TIME, finer)
    )

    there = np.isin(finer, TIME)
    assert track.velocity == pytest.approx(every.velocity[there], abs=1e-9)
    assert track.position == pytest.approx(every.position[there], abs=1e-9)


def test_a_search_is_fine_where_friction_fades_while_the_speed_changes_fast():
    # The speed passes zero so fast that friction at low speed is gone within two long steps.
    model = Model("simple", {"kS": 0.23, "kV": 2.66, "kA": 0.16})
    model += Part("stribeck", {"extra": 0.21, "slow": 0.1})
    volts, still = np.where(TIME < 0.5, 2.5, -2.5), np.zeros(1)
    batch = RunBatch(
        edges=np.array([0.0, TIME.size]), time=TIME, voltage=volts,
        voltage_slide=np.zeros(TIME.size), measured=np.full((TIME.size, 2), np.nan),
        position=still, velocity=still, low=still - math.inf, high=still + math.inf,
        clocks=still, memory_groups=still,
    )  # fmt: skip

    found = filter_runs(
        model, batch, kalman_gain=NO_CORRECTION, position_offset=still, backlash_phase=still,
        friction_offset=still, lag_offset=still,
    )  # fmt: skip
    exact = simulate_run(model, time=TIME, voltage=volts, state=State(), step=2e-5)

    assert np.abs(found[:, 0] - exact.position).max() < 1e-5  # [m] noise of a good encoder


def new_effect(**change):
    return {**EFFECTS, "new-one": replace(DRAG, name="new-one", **change)}


def test_a_new_effect_is_composed_into_the_engine_and_called():
    module = compose_engine(new_effect(), compiled=False)

    on = np.zeros(len(EFFECTS) + 1 + len(module.__dict__))
    assert module.force(on, np.ones(99), 0.0, 2.0) == 0.0
    on[:] = 0.0
    on[len(EFFECTS)] = 1.0
    on[len(EFFECTS) + 1 :] = 1.0
    assert module.force(on, np.full(99, 0.5), 0.0, 2.0) == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (dict(hooks={"force": lambda speed: speed}), "effect new-one: force asks for 'speed'"),
        (dict(hooks={}), "effect new-one: hooks is empty"),
    ],
    ids=["argument", "nothing"],
)
def test_an_effect_written_wrongly_stops_the_engine_with_a_sentence(change, said):
    with pytest.raises(BadRequest) as refused:
        compose_engine(new_effect(**change))

    assert said in str(refused.value)
    assert "sim/physics/effects/drag.py" in str(refused.value)


def test_the_modules_that_become_one_text_define_each_name_once():
    defined = [name for module in MODULES for name in top_level_names(inspect.getsource(module))]

    assert sorted(defined) == sorted(set(defined))


def top_level_names(text):
    for statement in ast.parse(text).body:
        if isinstance(statement, ast.FunctionDef):
            yield statement.name
        elif isinstance(statement, ast.Assign):
            for node in ast.walk(statement):
                if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                    yield node.id


FEW = {"drag": EFFECTS["drag"]}  # a small engine is compiled in half the time
SIMULATION_SCRIPT = """
import numpy as np
from sim.physics.effects import EFFECTS
for name in {*EFFECTS} - {"drag"}:
    del EFFECTS[name]
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model
track = simulate_run(Model("simple", {"kS": 0.2, "kV": 2.0, "kA": 0.3}), time=np.arange(0, 1, 0.02),
                     voltage=np.full(50, 3.0), state=State())
print(round(float(track.velocity[-1]), 6))
"""


ENDS = str(round(1.4 * (1.0 - math.exp(-0.98 / 0.15)), 6))  # (3 - 0.2)/2, and kA/kV = 0.15 s


def started(environment, program=SIMULATION_SCRIPT):
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, encoding="utf-8",
        check=False, timeout=300,
    )  # fmt: skip
    return done.returncode, done.stdout.strip(), done.stderr


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """A cache in which one process left what it compiled, in place of a damaged engine."""
    kept = tmp_path_factory.mktemp("cache")
    text = "\n".join(compose._write_engine(FEW, compiled=True))
    find_kernel_file(kept, compose._hash_engine(FEW, text)).write_bytes(b"not an engine")
    assert started({**os.environ, CACHE: str(kept)}) == (0, ENDS, "")
    return kept


def test_compiled_code_is_cached_in_the_folder_of_the_environment_variable(
    cache, tmp_path, monkeypatch
):
    monkeypatch.setenv(CACHE, str(tmp_path))
    assert not is_compiled(FEW)

    monkeypatch.setenv(CACHE, str(cache))
    assert find_cache_folder() == cache
    assert is_compiled(FEW)
    (kept,) = cache.iterdir()  # no file beside the damaged one, which is an engine again
    assert ObjectCode.from_bytes(kept.read_bytes())
    written = kept.stat().st_mtime_ns
    assert started(os.environ.copy()) == (0, ENDS, "")
    assert kept.stat().st_mtime_ns == written


def test_cached_machine_code_is_loaded_without_numba(cache):
    asked = f"{SIMULATION_SCRIPT}\nimport sys\nprint('numba' in sys.modules)"

    done = started({**os.environ, CACHE: str(cache)}, asked)

    assert done == (0, f"{ENDS}\nFalse", "")


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: whole[:-100],
        lambda whole: whole[:3000] + bytes(100) + whole[3100:],
        lambda whole: b"{}\n" + whole.split(b"\n", 1)[1],
        lambda _: b"not an engine",
        lambda whole: whole.replace(b"log1p", b"nolog", 1),
    ],
    ids=["cut short", "bytes lost", "no head", "something else", "asks what is not there"],
)
def test_a_damaged_engine_is_never_loaded(cache, damage):
    (kept,) = cache.glob("*.kernel")

    code = ObjectCode.from_bytes(damage(kept.read_bytes()))

    assert code is None or link_code(code) is None
    assert link_code(ObjectCode.from_bytes(kept.read_bytes()))


def test_engine_without_object_files_uses_the_cache_of_numba(cache, tmp_path):
    (kept,) = cache.glob("*.kernel")
    (tmp_path / kept.name).write_bytes(NO_USE)

    for _ in range(2):
        assert started({**os.environ, CACHE: str(tmp_path)}) == (0, ENDS, "")

    assert (tmp_path / kept.name).read_bytes() == NO_USE
    assert [*tmp_path.glob(f"__pycache__/{kept.stem}*.nbc")]


@pytest.mark.parametrize(
    "change",
    [
        {"time": TIME[::2]},
        {"commanded": TIME.astype(np.float32)},
        {"out": np.zeros((8, TIME.size)).T},
        {"measured": np.zeros((3, 2))},
        {"bodies": np.zeros((2, 5))},
        {"low": np.zeros(2)},
        {"edges": np.array([0.0, TIME.size + 1.0])},
        {"edges": np.array([0.0, 9.0, TIME.size])},
    ],
    ids=[
        "another length",
        "singles",
        "not in one piece",
        "measured elsewhere",
        "a body too many",
        "a stop too many",
        "beyond the last sample",
        "a run too many",
    ],
)
def test_an_array_that_the_engine_would_read_wrongly_is_refused(change):
    on, parameters = make_effect_arrays(PLAIN)
    given = {
        "edges": np.array([0.0, TIME.size]), "time": TIME, "commanded": steady(3.0),
        "slides": steady(0.0), "bodies": np.zeros((1, 5)), "low": np.full(1, -math.inf),
        "high": np.full(1, math.inf), "frictions": np.zeros(1), "run_lags": np.zeros(1),
        "memory_groups": np.zeros(1), "c": make_model_constants(PLAIN), "w": NO_WIRES, "on": on,
        "p": parameters, "memory": np.zeros(len(EFFECTS)), "tables": np.zeros(TABLES_SIZE),
        "start_times": np.zeros(1), "steps": EXACT, "base_only": True,
        "measured": np.zeros((0, 2)), "kalman_gains": np.zeros((0, 4)), "errors": np.zeros((0, 2)),
        "out": np.zeros((TIME.size, 8)),
    }  # fmt: skip
    engine = compose_engine(EFFECTS)
    engine.move(**given)

    with pytest.raises(TypeError):
        engine.move(**{**given, **change})


def test_engine_runs_when_the_home_folder_is_read_only(cache, tmp_path, monkeypatch):
    (kept,) = cache.glob("*.kernel")
    code = ObjectCode.from_bytes(kept.read_bytes())
    address, owner = link_code(code)
    made = SimpleNamespace(address=address, owner=owner)  # to compile it anew takes 20 s
    monkeypatch.setattr(kernel, "_compile_text", lambda _: made)
    monkeypatch.setattr(kernel, "extract_code", lambda _: code)
    blocked = tmp_path / "file"
    blocked.write_text("not a folder", encoding="utf-8")

    loaded = kernel.load_kernel("", blocked / "cache" / kept.name)

    assert isinstance(loaded, kernel.Kernel)


def test_with_drag_the_final_speed_is_where_friction_back_emf_and_drag_take_all_volts():
    # 4 = 0.2 + 2 v + 0.5 v² has v = (-2 + √(4 + 7.6))/1
    track = simulate_run(
        PLAIN + Part("drag", {"drag": 0.5}),
        time=np.arange(0.0, 5.0, 0.02), voltage=np.full(250, 4.0), state=State(),
    )  # fmt: skip

    assert track.velocity[-1] == pytest.approx(-2.0 + math.sqrt(11.6), rel=1e-6)


def test_a_hidden_delay_is_not_in_the_voltage_that_is_recorded():
    late = simulate_run(
        PLAIN + Part("delay", {"lag": 0.06}), time=TIME, voltage=3.0 * TIME, state=State()
    )

    assert (late.applied == 3.0 * TIME).all()


def test_a_filter_reports_the_mean_velocity_of_its_window():
    track = simulate_run(
        PLAIN + Part("velocity-filter", {"window": 0.1}),
        time=TIME, voltage=steady(3.0), state=State(),
    )  # fmt: skip

    assert track.seen[5:] == pytest.approx((track.position[5:] - track.position[:-5]) / 0.1)


def test_a_brownout_takes_the_motors_off_for_a_loop():
    built = replace(MECHANISMS["drivetrain"], stator=400.0, supply=400.0)
    time = np.arange(0.0, 0.5, 0.005)

    track = simulate_run(
        built.model, time=time, voltage=np.full(time.size, 11.0), state=State(),
        wires=make_power_path_array(built),
    )  # fmt: skip

    off = track.applied == 0.0
    assert off.any()
    assert not off[-1]  # at speed it draws less, and the battery recovers
    starts = np.flatnonzero(np.diff(off.astype(int)) == 1)
    ends = np.flatnonzero(np.diff(off.astype(int)) == -1)
    lasted = (ends[-1] - starts[-1]) * 0.005 if starts.size else CUT
    assert lasted == pytest.approx(CUT, abs=0.006)


def test_threads_that_ask_at_once_get_one_engine():
    with ThreadPoolExecutor(4) as pool:
        tracks = list(
            pool.map(
                lambda _: simulate_run(PLAIN, time=TIME, voltage=steady(3.0), state=State()),
                range(8),
            )
        )

    assert all((track.velocity == tracks[0].velocity).all() for track in tracks)
