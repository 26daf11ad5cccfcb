"""``sysid fit --wpilog``: measured, simulated, residual and innovation as entries of one log."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from sim.cli.fit.layout import write_layout
from sim.core.log import Log, Run
from sim.core.units import Unit, find_unit
from sim.estimation.measurements import MIN_SAMPLES
from sim.fit import Fit
from sim.fit.innovations import RunInnovations, compute_innovations
from sim.fit.replay import RunReplay, replay_fit
from sim.inspect.detect_faults import inspect
from sim.inspect.fault import Damage
from sim.io.formats.wpilog.signals import SignalGroup, write_signals

TOP = "/sysid"  # path above all entries


def write_replay(found: Fit, parts: Mapping[str, Log], path: Path) -> None:
    """Write every run, measured and simulated, at the log's own times, and a layout to show it.

    Where there are several parts, the entries of each stand below its name:
    ``/sysid/left/measured/velocity``.

    Args:
        found: the fit.
        parts: the logs it was fitted to, by the name of each part.
        path: the file, ending in .wpilog.

    Raises:
        BadRequest: nothing can be simulated with these gains, or the file cannot be written.
    """
    unit = find_unit(found.log_units)
    tops = {name: f"{TOP}/{name}" if len(parts) > 1 else TOP for name in parts}
    groups = [
        group for name, log in parts.items() for group in _list_groups(found, log, tops[name], unit)
    ]
    names = {name for group in groups for name in group.signals}
    units = {
        name: unit.name if name.endswith("position") else f"{unit.name} per second"
        for name in names
        if not name.endswith("voltage")
    }
    write_signals(groups, path, units=units | {f"{TOP}/voltage": "volts"})
    write_layout(path, tuple(tops.values()))


def _list_groups(found: Fit, log: Log, top: str, unit: Unit) -> Iterator[SignalGroup]:
    """The entries of each run that is long enough to be simulated."""
    faults = inspect(log).faults
    runs = [(k, run) for k, run in enumerate(log.runs) if len(run) >= MIN_SAMPLES]
    for (k, run), replay in zip(runs, replay_fit(found, log), strict=False):
        yield _make_group(replay, run, [one for one in faults if one.where.run == k], top, unit)
    for innovations in compute_innovations(found, log):
        yield from _group_innovations(innovations, top, unit)


def _make_group(
    replay: RunReplay, run: Run, faults: list[Damage], top: str, unit: Unit
) -> SignalGroup:
    """The entries of one run: signals, the name of its test, and start and end of its faults."""
    signals = {
        f"{top}/voltage": replay.run.voltage,
        f"{top}/measured/position": replay.run.position / unit.si,
        f"{top}/measured/velocity": replay.run.velocity / unit.si,
        f"{top}/simulated/position": replay.position / unit.si,
        f"{top}/simulated/velocity": replay.velocity / unit.si,
        f"{top}/residual/position": replay.position_error / unit.si,
        f"{top}/residual/velocity": replay.velocity_error / unit.si,
    }
    time = replay.run.time
    after = float(time[-1] + np.median(np.diff(time)))
    marks = [(max(one.where.start, float(run.time[0])), one.fault) for one in faults]
    marks += [(one.where.end, "") for one in faults]
    texts = {f"{top}/test": [(float(time[0]), run.test), (after, "none")]}
    return SignalGroup(time, signals, texts | ({f"{top}/fault": sorted(marks)} if marks else {}))


def _group_innovations(one: RunInnovations, top: str, unit: Unit) -> Iterator[SignalGroup]:
    """The innovations of one run; positions and velocities can be measured at different times."""
    for name, time, values in (
        ("position", one.position_time, one.position),
        ("velocity", one.velocity_time, one.velocity),
    ):
        if time.size:
            yield SignalGroup(time, {f"{top}/innovation/{name}": values / unit.si})
