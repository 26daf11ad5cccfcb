"""Simulate a model under a log's recorded voltage, from each run's start."""

from sim.core.log import Log
from sim.physics.effects import EFFECTS
from sim.physics.engine import ORDER, State, Track, simulate_run
from sim.physics.model import Model
from sim.physics.voltage_residual import list_run_start_times


def replay_log(model: Model, log: Log, *, step: float | None = None) -> tuple[Track, ...]:
    """Simulate a model under a log's voltages, open loop.

    Args:
        model: the model.
        log: any runs. Each starts at the position and velocity of its first sample; the memory of
            effects, like the heat of a motor, is kept from run to run.
        step: [s] longest integration step; None chooses.

    Returns:
        One track for each run.

    Examples:
        >>> from sim.core.log import Run
        >>> run = Run("dynamic-forward", [0.0, 1.0, 2.0], [4.2] * 3, [0.0] * 3, [0.0] * 3)
        >>> (track,) = replay_log(Model("simple", {"kS": 0.2, "kV": 2.0, "kA": 0.1}), Log((run,)))
        >>> track.velocity.round(3)
        array([0., 2., 2.])
    """
    state, tracks = State(), []
    for run, clock in zip(log.runs, list_run_start_times(log).tolist(), strict=True):
        cool_down(state, model, clock - state.clock)
        state.clock = clock
        state.body[:] = State.cold_at(float(run.position[0]), float(run.velocity[0])).body
        tracks.append(
            simulate_run(
                model,
                time=run.time,
                voltage=run.voltage,
                slide=run.voltage_slide,
                state=state,
                step=step,
            )
        )
    return tuple(tracks)


def cool_down(state: State, model: Model, pause: float) -> None:
    """Let time pass without voltage or motion, so that the motor cools.

    Args:
        state: the state; its memory is updated, its clock is not.
        model: the model whose effects have memory.
        pause: [s] length of the pause; nothing happens if it is not positive.
    """
    if pause <= 0.0:
        return
    for part in model.parts:
        update = EFFECTS[part.effect].hooks.get("update_memory")
        if update is not None:
            place = ORDER[part.effect]
            values = {
                "memory": float(state.memory[place]), "dt": pause, "u": 0.0, "v": 0.0,
                "kv": model.gains["kV"], **part.parameters,
            }  # fmt: skip
            names = update.__code__.co_varnames[: update.__code__.co_argcount]
            state.memory[place] = update(**{name: values[name] for name in names})
