"""Compose the engine: the effects' functions and the integrator, compiled as one unit.

The source of one module is generated: functions that call the hooks of all effects in use (in place
of ``hooks.py``), then the text of ``MODULES``, whose names must therefore all differ. The compiled
module is cached in a folder of the user under a hash of that text and of the effects, so that a
changed or a new effect gives a new engine.
"""

import hashlib
import inspect
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sim.core.errors import BadRequest
from sim.physics.effect import Effect
from sim.physics.engine import (
    ieee_math,
    one_body,
    power_path,
    slipping_wheels,
    stepping,
    two_bodies,
    two_body_modes,
)
from sim.physics.engine.two_body_modes import TABLES_SIZE
from sim.support.work.cache import find_cache_folder

if TYPE_CHECKING:
    from sim.physics.engine.kernel import Kernel

MODULES = (power_path, two_body_modes, one_body, two_bodies, slipping_wheels, stepping)
CONSTANTS, WIRES = 8, 9  # lengths of ``c``, the base model, and ``w``, battery and limits

HOOKS: Mapping[str, tuple[str, str, str]] = {
    # hook: arguments of the composed function, its initial value, how an effect's value is added
    "command_delay": ("on, p", "0.0", "{0} + {1}"),
    "transform_voltage": ("on, p, memory, u, v, kv", "u", "{1}"),
    "force": ("on, p, x, v", "0.0", "{0} + {1}"),
    "coulomb_friction": ("on, p, v, way", "0.0", "{0} + {1}"),
    "added_inertia": ("on, p, clock", "0.0", "{0} + {1}"),
    "impact": ("on, p", "0.0", "max({0}, {1})"),
    "next_change": ("on, p, clock", "math.inf", "min({0}, {1})"),
    "backlash_gap": ("on, p", "0.0", "{0} + {1}"),
    "joint_compliance": ("on, p", "0.0", "{0} + {1}"),
    "joint_damping": ("on, p", "0.0", "max({0}, {1})"),
    "motor_friction_share": ("on, p", "0.0", "max({0}, {1})"),
    "motor_inertia_share": ("on, p", "0.0", "max({0}, {1})"),
    "grip_limit": ("on, p", "math.inf", "min({0}, {1})"),
    "transform_velocity": ("on, p, now, time, position, velocity", "velocity[now]", "{1}"),
}
DELAY_HOOKS = frozenset({"command_delay", "transform_velocity"})
"""Hooks that leave a model linear, so that its motion is still computed exactly."""
HEAD = re.compile(r'"""[\s\S]*?"""\n(\n|import .*\n|from .* import (\([^)]*\)|.*)\n)*')
"""A module's first lines: its docstring and its imports."""
SHAPES = {  # of the array arguments of `step_runs`, except `memory`
    "edges": "(count + 1,)",
    "time": "(n,)",
    "commanded": "(n,)",
    "slides": "(n,)",
    "bodies": "(count, 5)",
    "low": "(count,)",
    "high": "(count,)",
    "frictions": "(count,)",
    "run_lags": "(count,)",
    "memory_groups": "(count,)",
    "start_times": "(count,)",
    "tables": f"({TABLES_SIZE},)",
    "steps": "(4,)",
    "measured": "(rows, 2)",
    "kalman_gains": "(gains, 4)",
    "errors": "(rows, 2)",
    "out": "(n, 8)",
}
CHAINED = {
    "transform_voltage": "u",
    "transform_velocity": "seen",
}  # hooks that chain: each effect transforms the value that the one before returned


def make_parameter_slices(effects: Mapping[str, Effect]) -> dict[str, slice]:
    """Slice of each effect's parameters in the engine's parameter array."""
    found, at = {}, 0
    for name, effect in effects.items():
        found[name] = slice(at, at + len(effect.parameters))
        at += len(effect.parameters)
    return found


def compose_engine(
    effects: Mapping[str, Effect], *, compiled: bool = True
) -> "Kernel | ModuleType":
    """The engine for these effects: a kernel or module with the function ``move``.

    Args:
        effects: the catalogue.
        compiled: False gives plain Python, about a hundred times slower, for comparison.

    Raises:
        BadRequest: an effect breaks the contract; the message names it and the mistake.
        ImportError: ``compiled`` is set, and Numba or llvmlite (extra ``fast``) is missing.
    """
    for name, effect in effects.items():
        if wrong := effect.find_contract_breaches():
            raise BadRequest(
                wrong[0],
                where=f"effect {name}",
                advice="Compare with sim/physics/effects/drag.py, and with HOOK_ARGUMENTS in "
                "sim/physics/effect.py.",
            )
    text = "\n".join(_write_engine(effects, compiled=compiled))
    if compiled:
        from sim.physics.engine.kernel import find_kernel_file, load_kernel  # noqa: PLC0415 - needs llvmlite

        return load_kernel(text, find_kernel_file(find_cache_folder(), _hash_engine(effects, text)))
    module = ModuleType("plain_engine")
    exec(compile(text, "plain_engine", "exec"), module.__dict__)  # noqa: S102 - our own text
    module.__dict__["move"] = np.errstate(all="ignore")(
        module.move
    )  # compiled code does not warn, either
    return module


def use_ieee_math(act: Callable[..., float]) -> Callable[..., float]:
    """An effect's function with ``ieee_math`` as its ``math``, for the uncompiled engine."""
    code, globals_ = act.__code__, act.__globals__
    return FunctionType(code, {**globals_, "math": ieee_math}, act.__name__, act.__defaults__)


def is_compiled(effects: Mapping[str, Effect]) -> bool:
    """Whether the compiled engine for these effects is in the cache.

    Raises:
        ImportError: llvmlite (extra ``fast``) is missing.
    """
    from sim.physics.engine.kernel import find_kernel_file  # noqa: PLC0415 - needs llvmlite

    text = "\n".join(_write_engine(effects, compiled=True))
    return find_kernel_file(find_cache_folder(), _hash_engine(effects, text)).is_file()


def _hash_engine(effects: Mapping[str, Effect], text: str) -> str:
    """SHA-256 of the engine's text and of the modules that define the effects' functions."""
    sources = [
        inspect.getsource(sys.modules[act.__module__])
        for effect in effects.values()
        for act in effect.hooks.values()
    ]
    return hashlib.sha256("\n".join([text, *sources]).encode()).hexdigest()


def _write_engine(effects: Mapping[str, Effect], *, compiled: bool) -> Iterator[str]:
    """The lines of the engine's module."""
    yield '"""Composed by compose.py."""'
    yield "from __future__ import annotations"
    yield "import numpy as np"
    if compiled:
        yield "import math"
        yield "from numba import carray, cfunc, njit, types"
        yield "step = njit(error_model='numpy', forceinline=True)"
    else:
        yield "from sim.physics.engine import ieee_math as math"
        yield "from sim.physics.engine.compose import use_ieee_math"
        yield "step = lambda function: function"
    for effect in effects.values():
        for hook, act in effect.hooks.items():
            yield f"import {act.__module__}"
            makes = "step" if compiled else "use_ieee_math"
            yield f"{_format_alias(effect, hook)} = {makes}({act.__module__}.{act.__name__})"
    at = make_parameter_slices(effects)
    for hook in HOOKS:
        yield from _write_hook(hook, effects, at)
    yield from _write_memory(effects, at)
    for module in MODULES:
        yield from _write_module(module)
    yield from _write_entry(effects, compiled=compiled)


def _write_hook(hook: str, effects: Mapping[str, Effect], at: Mapping[str, slice]) -> Iterator[str]:
    """The lines of one function that combines a hook of all effects in use."""
    arguments, first, joins = HOOKS[hook]
    yield "@step"
    yield f"def {hook}({arguments}):"
    running = CHAINED.get(hook, "total")
    yield f"    {running} = {first}"
    order = list(effects)
    yield f"    if on[{len(order) + list(HOOKS).index(hook)}] == 0.0:"
    yield f"        return {running}"
    for name in sorted(effects, key=lambda name: effects[name].order):
        effect = effects[name]
        if hook in effect.hooks:
            answer = _make_call(effect, hook, at[name], order.index(name))
            yield f"    if on[{order.index(name)}] != 0.0:"
            yield f"        {running} = {joins.format(running, answer)}"
    yield f"    return {running}"


def _write_memory(effects: Mapping[str, Effect], at: Mapping[str, slice]) -> Iterator[str]:
    """The lines of the function that updates the memory of each effect in use."""
    yield "@step"
    yield "def update_memory(on, p, memory, dt, u, v, kv):"
    yield f"    if on[{len(effects) + len(HOOKS)}] == 0.0:"
    yield "        return"
    for place, (name, effect) in enumerate(effects.items()):
        if "update_memory" in effect.hooks:
            answer = _make_call(effect, "update_memory", at[name], place)
            yield f"    if on[{place}] != 0.0:"
            yield f"        memory[{place}] = {answer}"


def _write_entry(effects: Mapping[str, Effect], *, compiled: bool) -> Iterator[str]:
    """The lines of ``move``, the entry point: constant arrays become tuples for ``step_runs``."""
    names = list(inspect.signature(stepping.step_runs).parameters)
    sizes = {
        "c": CONSTANTS,
        "w": WIRES,
        "on": len(effects) + len(HOOKS) + 1,
        "p": sum(len(effect.parameters) for effect in effects.values()),
    }
    given = {
        name: _format_tuple(f"{name}[{place}]" for place in range(size))
        for name, size in sizes.items()
    }
    if compiled:  # as SIGNATURE in kernel.py: four lengths, then the arguments of `step_runs`
        shapes = {**SHAPES, "memory": f"({len(effects)},)"}
        given |= {name: f"carray({name}, {shape})" for name, shape in shapes.items()}
        pointers = ("types.int64" if name == "base_only" else "pointer" for name in names)
        yield "pointer = types.CPointer(types.float64)"
        lengths = ", ".join(["types.int64"] * 4)
        yield f"called = types.void({lengths}, {', '.join(pointers)})"
        yield "@cfunc(called, error_model='numpy', cache='__file__' in globals())"
        yield f"def move(count, n, rows, gains, {', '.join(names)}):"
        base = {
            **given,
            "w": _format_tuple(["0.0"] * WIRES),
            "on": _format_tuple(_write_delay_flags(effects)),
        }
        base["base_only"], given["base_only"] = "True", "False"
        yield "    if base_only != 0:  # LLVM removes the code that these constants exclude"
        yield f"        step_runs({', '.join(base.get(name, name) for name in names)})"
        yield "        return"
    else:
        given["on"] = "on.tolist()"  # plain Python is faster with floats than with an array
        yield f"def move({', '.join(names)}):"
    yield f"    step_runs({', '.join(given.get(name, name) for name in names)})"


def _format_tuple(items: Iterable[str]) -> str:
    return f"({', '.join(items)},)"


def _write_delay_flags(effects: Mapping[str, Effect]) -> Iterator[str]:
    """The flags ``on`` of a model without other effects than delays."""
    names = (*HOOKS, "update_memory")
    delays = [set(effect.hooks) <= DELAY_HOOKS for effect in effects.values()]
    delays += [name in DELAY_HOOKS for name in names]
    return (f"on[{place}]" if one else "0.0" for place, one in enumerate(delays))


def _make_call(effect: Effect, hook: str, at: slice, place: int) -> str:
    """The call of an effect's hook, with the arguments that it names."""
    given = {name: f"p[{at.start + n}]" for n, name in enumerate(effect.names)}
    given["memory"] = f"memory[{place}]"
    arguments = inspect.signature(effect.hooks[hook]).parameters
    return (
        f"{_format_alias(effect, hook)}({', '.join(given.get(name, name) for name in arguments)})"
    )


def _format_alias(effect: Effect, hook: str) -> str:
    return f"_{effect.name.replace('-', '_')}_{hook}"


def _write_module(module: ModuleType) -> Iterator[str]:
    """A module's text without its imports, each function decorated for compilation."""
    text = inspect.getsource(module)
    head = HEAD.match(text)
    for line in text[head.end() if head else 0 :].splitlines():
        if line.startswith("def "):
            yield "@step"
            yield "def " + line[4:]
        else:
            yield line
