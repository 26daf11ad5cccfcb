"""The simulation engine: one compiled kernel for simulation, fit and reconcile.

It is composed from the effects of the catalogue when first used. Compiling it takes about 20
seconds once, loading it from the cache a tenth of a second. Without Numba (extra ``fast``) the same
source runs uncompiled: the same digits, about a hundred times slower.
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
from sim.physics.engine.stepping import EXPECTED, allocate_output
from sim.physics.engine.two_body_modes import TABLES_SIZE
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

BUILD_LOCK = Lock()
NO_WIRES: Array = np.zeros(9)
NO_MEASUREMENTS: Array = np.zeros((0, 2))
NO_CORRECTION: Array = np.zeros((2, 2))


@dataclass(eq=False)
class State:
    """The state of a mechanism, which carries over from one run to the next.

    Args:
        body: (5,) position [m or rad] and velocity of the motor, then of the load, and the time [s]
            at which a brownout ends.
        memory: (effects,) memory of the effects, like the heat of a motor.
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
    """A simulated motion, sample by sample, without sensor noise: the columns of the output.

    Args:
        position: (n,) [m or rad] at the motor, which is what a sensor there reads.
        velocity: (n,) [m/s or rad/s] at the motor.
        load_position: (n,) [m or rad] at the load; equal to ``position`` with one body.
        applied: (n,) [V] at the motor, before the effects on the voltage.
        bus: (n,) [V] of the battery; 0 without a battery.
        current: (n,) [A] of one motor; 0 without a battery.
        expected: (n,) [m or rad] the predicted position, before the Kalman correction.
        seen: (n,) [m/s or rad/s] the velocity that the sensor reports.
    """

    position: Array
    velocity: Array
    load_position: Array
    applied: Array
    bus: Array
    current: Array
    expected: Array
    seen: Array

    @property
    def sensor_readings(self) -> Array:
        """(n, 2) position and velocity as the sensors report them."""
        return np.column_stack((self.position, self.seen))

    def select(self, samples: slice) -> "Track":
        """The motion at some of the samples."""
        return Track(*(getattr(self, one.name)[samples] for one in fields(self)))


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
        model: the model.
        time: (n,) [s], increasing.
        voltage: (n,) [V], each held until the next.
        state: the state at the start; it is changed to that at the end.
        wires: (9,) battery and limits, see ``power_path.py``; zeros are an ideal voltage source.
        step: [s] longest integration step; None chooses.
        plain: whether to use the uncompiled engine, for comparison.
        slide: (n,) [V] linear change of the voltage until the next sample; None holds it.

    Examples:
        >>> time = np.linspace(0.0, 5.0, 251)
        >>> model = Model("simple", {"kS": 0.2, "kV": 2.0, "kA": 0.5})
        >>> track = simulate_run(model, time=time, voltage=np.full(251, 6.2), state=State())
        >>> float(track.velocity[-1].round(3))  # (6.2 V - kS)/kV [m/s]
        3.0
    """
    on, parameters = make_effect_arrays(model)
    out = allocate_output(time.size)
    base_only = not wires.any() and model.type != "arm" and all(map(is_pure_delay, model.parts))
    limits = EXACT if base_only else compute_step_limits(model)
    if step:
        limits = np.array([step, math.inf, step, math.inf])
    kernel = _load_plain_engine() if plain else _load_compiled_engine()
    kernel.move(
        np.array([0.0, time.size]), _as_contiguous(time), _as_contiguous(voltage),
        np.zeros(time.size) if slide is None else _as_contiguous(slide), state.body[None],
        np.array([-math.inf]), np.array([math.inf]), np.zeros(1), np.zeros(1), np.zeros(1),
        make_model_constants(model), wires, on, parameters, state.memory, np.zeros(TABLES_SIZE),
        np.array([state.clock]), limits, base_only, NO_MEASUREMENTS, np.zeros((0, 4)),
        np.empty((0, 2)), out,
    )  # fmt: skip
    state.clock += float(time[-1] - time[0])
    return Track(*out.T)


def _as_contiguous(array: Array) -> Array:
    """The array as contiguous doubles, copied only if needed."""
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
    """Run the Kalman filter of a model over all runs of a batch, in one call of the engine.

    Steps are coarser than in ``simulate_run`` (``SEARCHED``): an error of 0.1 % does not decide
    between two effects.

    Args:
        model: the model.
        batch: the runs.
        kalman_gain: (2, 2) Kalman gain, or (n, 4) one for each sample, row by row;
            ``NO_CORRECTION`` simulates open loop.
        position_offset: (runs,) [m or rad] added to the start position and to the stops.
        backlash_phase: (runs,) [1] where in its backlash the motor starts, from -1 to 1; nan where
            the load's weight decides.
        friction_offset: (runs,) [V] dry friction of each run beyond kS.
        lag_offset: (runs,) [s] delay of each run beyond the model's.
        errors: (n, 2) array for the innovations, measured minus predicted, or None.

    Returns:
        (n, 8) all runs, one after another, with the columns of ``Track``; the last two columns,
        from ``EXPECTED`` on, are the predictions before the Kalman correction.
    """
    on, parameters = make_effect_arrays(model)
    base_only = model.type != "arm" and all(map(is_pure_delay, model.parts))
    limits = EXACT if base_only else compute_search_step_limits(model)
    begin = batch.position + position_offset
    load = begin
    if play := sum_backlash(model):
        load = begin - 0.5 * play * _choose_backlash_position(model, begin, backlash_phase)
    bodies = np.zeros((begin.size, 5))
    bodies[:, 0], bodies[:, 2] = begin, load
    bodies[:, 1] = bodies[:, 3] = batch.velocity
    shift = position_offset + (load - begin)
    out = allocate_output(batch.time.size)
    measured = batch.measured if errors is not None or kalman_gain.any() else NO_MEASUREMENTS
    gains = _as_contiguous(kalman_gain.reshape(-1, 4)[: len(measured)])
    errors = np.empty(measured.shape) if errors is None else errors
    _load_compiled_engine().move(
        batch.edges, batch.time, batch.voltage, batch.voltage_slide, bodies, batch.low + shift,
        batch.high + shift, _as_contiguous(friction_offset), _as_contiguous(lag_offset),
        batch.memory_groups, make_model_constants(model), NO_WIRES, on, parameters,
        np.zeros(len(EFFECTS)), np.zeros(TABLES_SIZE), batch.clocks, limits, base_only,
        measured, gains, errors, out,
    )  # fmt: skip
    return out


def _choose_backlash_position(model: Model, position: Array, phase: Array) -> Array:
    """(runs,) [1] backlash phases; where ``phase`` is nan, the load's weight decides."""
    load = np.full(position.size, model.gains.get("kG", 0.0))
    if model.type == "arm":
        load *= np.cos(position + model.gains.get("offset_rad", 0.0))
    return np.where(np.isnan(phase), np.sign(load), phase)


def engine_can_compile() -> bool:
    """Whether Numba is installed; without it the engine runs uncompiled."""
    return all(importlib.util.find_spec(name) for name in ("llvmlite", "numba"))


def engine_is_cached() -> bool:
    """Whether a compiled engine is in the cache; if not, its first use takes 20 seconds.

    True as well if the engine cannot be compiled: then there is nothing to wait for.
    """
    return not engine_can_compile() or is_compiled(EFFECTS)


def load_engine() -> None:
    """Load the engine from the cache, or compile it, so that the first simulation is fast."""
    gains = {"kS": 0.0, "kV": 1.0, "kA": 1.0}
    simulate_run(Model("simple", gains), time=np.zeros(1), voltage=np.zeros(1), state=State())


def _load_compiled_engine() -> "Kernel | ModuleType":
    """The compiled engine, built once even if several threads need it."""
    with BUILD_LOCK:
        return _build_engine()


@cache
def _build_engine() -> "Kernel | ModuleType":
    """The compiled engine, or the uncompiled one if Numba is missing.

    A message on the terminal or in the notebook says why the first use takes long.
    """
    if not engine_can_compile():
        return _load_plain_engine()
    try:
        stream = sys.stdout if "ipykernel" in sys.modules else sys.stderr  # red in a notebook
        if (stream is sys.stdout or stream.isatty()) and not engine_is_cached():
            stream.write("Compiling the simulation, once; this takes about twenty seconds…\n")
            stream.flush()
        return compose_engine(EFFECTS)
    except ImportError:  # Numba refuses a NumPy that is newer than itself
        return _load_plain_engine()


@cache
def _load_plain_engine() -> "Kernel | ModuleType":
    return compose_engine(EFFECTS, compiled=False)
