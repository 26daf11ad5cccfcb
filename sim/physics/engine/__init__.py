"""The simulation engine: one compiled kernel for simulation, fit and reconcile.

It is composed from the effects of the catalogue when first used: about 20 seconds once, from the
cache on disk within a tenth of a second after that. Without Numba (extra ``fast``) the same text
runs uncompiled: the same digits, about a hundred times slower.
"""

import importlib.util
import math
import sys
from dataclasses import dataclass, field, fields
from functools import cache
from threading import Lock
from typing import TYPE_CHECKING

import numpy as np

from sim.core.log import Array
from sim.physics.effects import EFFECTS
from sim.physics.engine.compose import compose_engine, is_compiled
from sim.physics.engine.model_arrays import (
    COARSEST,
    EXACT,
    ORDER,
    compute_search_step_limits,
    compute_step_limits,
    find_finest_step,
    is_pure_delay,
    make_effect_arrays,
    make_model_constants,
    sum_backlash,
)
from sim.physics.engine.run_batch import RunBatch
from sim.physics.engine.stepping import (
    APPLIED,
    BUS,
    CURRENT,
    EXPECTED,
    LOAD_POSITION,
    POSITION,
    SEEN,
    VELOCITY,
    allocate_output,
)
from sim.physics.engine.two_body_modes import WAYS
from sim.physics.model import Model

if TYPE_CHECKING:
    from types import ModuleType

    from sim.physics.engine.kernel import Kernel

__all__ = [
    "COARSEST",
    "EXACT",
    "EXPECTED",
    "NO_CORRECTION",
    "NO_WIRES",
    "ORDER",
    "RunBatch",
    "State",
    "Track",
    "engine_can_compile",
    "engine_is_cached",
    "filter_runs",
    "find_finest_step",
    "load_engine",
    "make_effect_arrays",
    "make_model_constants",
    "simulate_run",
]  # fmt: skip

ONE_AT_A_TIME = Lock()
NO_WIRES: Array = np.zeros(9)
UNSEEN: Array = np.zeros((0, 2))
NO_CORRECTION: Array = np.zeros((2, 2))


@dataclass(eq=False)
class State:
    """The state of a mechanism, which carries over from one run to the next.

    Args:
        body: (5,) position and velocity of the motor, then of the load, and the end of a cut.
        memory: (effects,) what effects remember.
        clock: [s] since the log began.
    """

    body: Array = field(default_factory=lambda: np.zeros(5))
    memory: Array = field(default_factory=lambda: np.zeros(len(EFFECTS)))
    clock: float = 0.0

    @classmethod
    def cold_at(cls, position: float, velocity: float = 0.0) -> "State":
        """The state of a cold mechanism.

        Args:
            position: [m or rad].
            velocity: [m/s or rad/s].
        """
        return cls(np.array([position, velocity, position, velocity, 0.0]))


@dataclass(frozen=True, eq=False)
class Track:
    """A motion, sample by sample, before the sensor's own noise.

    Args:
        position: (n,) [m or rad] at the motor, which is what a sensor there reads.
        velocity: (n,) the same, [m/s or rad/s].
        load_position: (n,) [m or rad]; the same as ``position`` where there is one body.
        applied: (n,) [V] at the motor, before hidden paths.
        bus: (n,) [V] of the battery; 0 where there are no wires.
        current: (n,) [A] of one motor; 0 where there are no wires.
        seen: (n,) [m/s or rad/s] the velocity that the sensor reports.
        expected: (n,) [m or rad] the position, before a measurement corrected it.
    """

    position: Array
    velocity: Array
    load_position: Array
    applied: Array
    bus: Array
    current: Array
    seen: Array
    expected: Array

    @classmethod
    def from_array(cls, out: Array) -> "Track":
        """The motion that the engine wrote, (n, 8)."""
        return cls(
            out[:, POSITION], out[:, VELOCITY], out[:, LOAD_POSITION], out[:, APPLIED],
            out[:, BUS], out[:, CURRENT], out[:, SEEN], out[:, EXPECTED],
        )  # fmt: skip

    @property
    def sensor_readings(self) -> Array:
        """(n, 2) position and velocity as the sensors report them."""
        return np.column_stack((self.position, self.seen))

    def take_every(self, step: int) -> "Track":
        """A copy with every ``step``-th sample, from the first."""
        return Track(*(getattr(self, one.name)[::step] for one in fields(self)))

    def truncate(self, end: int) -> "Track":
        """A copy with the first ``end`` samples."""
        return Track(*(getattr(self, one.name)[:end] for one in fields(self)))


def simulate_run(
    model: Model,
    *,
    time: Array,
    voltage: Array,
    state: State,
    wires: Array = NO_WIRES,
    step: float | None = None,
    plain: bool = False,
    slide: Array | None = None,
) -> Track:
    """Simulate a model under a voltage.

    Args:
        model: what moves.
        time: (n,) [s], increasing.
        voltage: (n,) [V], each held until the next.
        state: where it begins; afterward, where it ended.
        wires: (9,) battery and limits, see ``power_path.py``; none is an ideal source.
        step: [s] the longest; None chooses.
        plain: in uncompiled Python, for comparison.
        slide: (n,) [V] by which the voltage slides evenly to the next; None holds it.

    Examples:
        >>> time = np.linspace(0.0, 5.0, 251)
        >>> model = Model("simple", {"kS": 0.2, "kV": 2.0, "kA": 0.5})
        >>> track = simulate_run(model, time=time, voltage=np.full(251, 6.2), state=State())
        >>> float(track.velocity[-1].round(3))  # (6.2 V - kS)/kV [m/s]
        3.0
    """
    on, parameters = make_effect_arrays(model)
    out = allocate_output(time.size)
    simple = not wires.any() and model.type != "arm" and all(map(is_pure_delay, model.parts))
    longest = EXACT if simple else compute_step_limits(model)
    if step:
        longest = np.array([step, math.inf, step, math.inf])
    kernel = _plain_engine() if plain else _compiled_engine()
    kernel.move(
        np.array([0.0, time.size]), _as_contiguous(time), _as_contiguous(voltage),
        np.zeros(time.size) if slide is None else _as_contiguous(slide), state.body[None],
        np.array([-math.inf]), np.array([math.inf]), np.zeros(1), np.zeros(1), np.zeros(1),
        make_model_constants(model), wires, on, parameters, state.memory, np.zeros(WAYS),
        np.array([state.clock]), longest, simple, UNSEEN, np.zeros((0, 4)), np.empty((0, 2)), out,
    )  # fmt: skip
    state.clock += float(time[-1] - time[0])
    return Track.from_array(out)


def _as_contiguous(array: Array) -> Array:
    """The same numbers, in one piece."""
    return np.ascontiguousarray(array, dtype=np.float64)


def filter_runs(
    model: Model,
    batch: RunBatch,
    *,
    kalman_gain: Array,
    position_offset: Array,
    backlash_phase: Array,
    friction_offset: Array,
    lag_offset: Array,
    errors: Array | None = None,
) -> Array:
    """Predict all runs of a batch with a model and its Kalman gain, in one call of the engine.

    Steps are as coarse as a search can bear (``SEARCHED``): a tenth of a percent does not decide
    between two effects.

    Args:
        model: what moves.
        batch: the runs.
        kalman_gain: (2, 2) by how much measurements correct, or (n, 4) the same for each sample;
            ``NO_CORRECTION`` leaves it alone.
        position_offset: (runs,) [m or rad] by which each begins, and has its stops, beside where it
            says.
        backlash_phase: (runs,) [1] where in its free play the motor is, from -1 to 1; nan where a
            weight decides.
        friction_offset: (runs,) [V] dry friction of each beyond kS.
        lag_offset: (runs,) [s] by which each is late beyond the model's delay.
        errors: (n, 2) where innovations are written, measured minus expected, if wanted.

    Returns:
        (n, 8) of all runs, one after another, as ``Track.from_array`` takes it; the last two
        columns, from ``EXPECTED`` on, are what was expected before a measurement corrected it.
    """
    on, parameters = make_effect_arrays(model)
    simple = model.type != "arm" and all(map(is_pure_delay, model.parts))
    longest = EXACT if simple else compute_search_step_limits(model)
    begin = batch.position + position_offset
    load = begin
    if play := sum_backlash(model):
        load = begin - 0.5 * play * _backlash_position(model, begin, backlash_phase)
    bodies = np.zeros((begin.size, 5))
    bodies[:, 0], bodies[:, 2] = begin, load
    bodies[:, 1] = bodies[:, 3] = batch.velocity
    aside = position_offset + (load - begin)
    out = allocate_output(batch.time.size)
    measured = batch.measured if errors is not None or kalman_gain.any() else UNSEEN
    gains = _as_contiguous(kalman_gain.reshape(-1, 4)[: len(measured)])
    errors = np.empty(measured.shape) if errors is None else errors
    _compiled_engine().move(
        batch.edges, batch.time, batch.voltage, batch.voltage_slide, bodies, batch.low + aside,
        batch.high + aside, _as_contiguous(friction_offset), _as_contiguous(lag_offset),
        batch.memory_groups, make_model_constants(model), NO_WIRES, on, parameters,
        np.zeros(len(EFFECTS)), np.zeros(WAYS), batch.clocks, longest, simple,
        measured, gains, errors, out,
    )  # fmt: skip
    return out


def _backlash_position(model: Model, position: Array, meshed: Array) -> Array:
    """(runs,) where in its free play each motor is: a weight hangs on its motor's teeth."""
    load = np.full(position.size, model.gains.get("kG", 0.0))
    if model.type == "arm":
        load *= np.cos(position + model.gains.get("offset_rad", 0.0))
    return np.where(np.isnan(meshed), np.sign(load), meshed)


def engine_can_compile() -> bool:
    """Whether Numba is installed; without it the engine runs uncompiled."""
    return all(importlib.util.find_spec(name) for name in ("llvmlite", "numba"))


def engine_is_cached() -> bool:
    """Whether a compiled engine is in the cache; if not, its first use takes 20 seconds.

    Where it cannot be compiled there is nothing to wait for, and the answer is True.
    """
    return not engine_can_compile() or is_compiled(EFFECTS)


def load_engine() -> None:
    """Compile the engine, or load it."""
    gains = {"kS": 0.0, "kV": 1.0, "kA": 1.0}
    simulate_run(Model("simple", gains), time=np.zeros(1), voltage=np.zeros(1), state=State())


def _compiled_engine() -> "Kernel | ModuleType":
    """The compiled engine, made once whoever asks first."""
    with ONE_AT_A_TIME:
        return _build_engine()


@cache
def _build_engine() -> "Kernel | ModuleType":
    """The compiled engine, or the plain one where Numba is missing.

    A person at a terminal is told why the first time takes a while.
    """
    if not engine_can_compile():
        return _plain_engine()
    try:
        if sys.stderr.isatty() and not engine_is_cached():
            sys.stderr.write("Compiling the simulation, once; this takes about twenty seconds…\n")
        return compose_engine(EFFECTS)
    except ImportError:  # Numba refuses a NumPy that is newer than itself
        return _plain_engine()


@cache
def _plain_engine() -> "Kernel | ModuleType":
    return compose_engine(EFFECTS, compiled=False)
