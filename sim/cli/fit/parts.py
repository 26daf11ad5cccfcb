"""Alike parts of a robot that files hold: sides, modules, repetitions; each is fitted, then pooled.

Files that hold one test each are joined. Files that hold whole recordings are parts of their own,
as every motor is.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from sim.core.doubt import Doubt
from sim.core.errors import Refusal

if TYPE_CHECKING:
    from sim.core.log import Log
    from sim.fit import Fit

Parts = Mapping[str, "Log"]  # name -> its log

SIDE, MOTOR, FILE = "side", "motor", "file"
SIDES = ("left", "right")
SURELY = 3.0  # [standard errors] beyond which a difference is no accident of noise
SHOWN = 4  # [parts] whose gains a sentence lists; of more, the lowest and the highest


def list_parts(logs: Sequence[tuple[Path, Parts]]) -> Parts:
    """The parts of a robot that some files hold, in the order of the files.

    Args:
        logs: each file, and the logs of its motors by name.
    """
    if len(logs) == 1:
        return logs[0][1]
    if all(log.has_ramps_and_steps for _, motors in logs for log in motors.values()):
        stems = [path.stem for path, _ in logs]
        unique = len(set(stems)) == len(stems)
        return {
            f"{path.stem if unique else path} {name}".strip(): log
            for path, motors in logs
            for name, log in motors.items()
        }
    joined: dict[str, Log] = {}
    for _, motors in logs:
        for name, log in motors.items():
            joined[name] = _joined(joined[name], log) if name in joined else log
    return joined


def join_parts(parts: Parts) -> "Log":
    """All runs of all parts as one log for display; what several parts say is said once."""
    first, *others = parts.values()
    for log in others:
        first = _joined(first, log)
    return first


def _joined(first: "Log", other: "Log") -> "Log":
    """The runs of two logs; what is said of both, but for the name of the file, is said once."""
    said = {(one.code, one.message.replace(first.source, "")) for one in first.doubts}
    new = tuple(
        one for one in other.doubts if (one.code, one.message.replace(other.source, "")) not in said
    )
    return first.join(replace(other, doubts=new))


@dataclass(frozen=True)
class PooledParts:
    """The pooled fit of several parts, and the fit of each.

    Args:
        found: the pooled fit, where the parts differ among its doubts.
        fits: the name of each part -> its own fit.
        notes: sentences about parts that agree.
    """

    found: "Fit"
    fits: "Mapping[str, Fit]"
    notes: tuple[str, ...] = ()

    def to_json(self) -> dict[str, dict[str, object]]:
        """Name of each part -> its gains and errors in the unit of the log; empty for one part."""
        if len(self.fits) == 1:
            return {}
        units = self.found.log_units
        alike = {name: one.in_units(units) for name, one in self.fits.items()}
        return {
            name: {"gains": dict(one.gains), "errors": dict(one.errors)}
            for name, one in alike.items()
        }


def fit_parts(parts: Parts, find: Callable[["Log"], "Fit"], *, files: int = 1) -> PooledParts:
    """Fit every mechanism or side of a robot, compare the fits and pool them.

    Args:
        parts: at least one.
        find: fits one.
        files: how many files they come from.

    Raises:
        Refusal: none of them can be fitted; the reason of the first.
    """
    from sim.fit.physics import compare_parts  # noqa: PLC0415 - --help must not wait for it
    from sim.fit.pooled import pool_fits  # noqa: PLC0415 - the same

    fits: dict[str, Fit] = {}
    refused: dict[str, Refusal] = {}
    for name, log in parts.items():
        try:
            fits[name] = find(log)
        except Refusal as refusal:
            refused[name] = refusal
    if not fits:
        name = next(iter(refused))
        raise _explained(refused[name], parts[name])
    found = pool_fits(fits)
    if len(parts) == 1:
        return PooledParts(found, fits)
    kind = _kind(parts, files)
    left_out = tuple(
        Doubt("part-left-out", f"{kind} {name!r} cannot be fitted and was left out: {said.what}.")
        for name, said in refused.items()
    )
    if len(fits) == 1:
        return PooledParts(replace(found, doubts=(*found.doubts, *left_out)), fits)
    differ = compare_parts(fits, kind)
    found = replace(found, doubts=(*found.doubts, *differ, *left_out))
    return PooledParts(found, fits, () if differ else (_agree(fits, kind),))


def _kind(parts: Parts, files: int) -> str:
    """What the parts are: two sides, several motors, or several files."""
    if set(map(str.lower, parts)) == set(SIDES):
        return SIDE
    return FILE if files > 1 and len(parts) >= files else MOTOR


def _explained(refusal: Refusal, log: "Log") -> Refusal:
    """The refusal of a log, with the advice about its units or velocity if they are doubted."""
    for doubt in log.doubts:
        if doubt.code in {"velocity-scale", "contradicting-units"}:
            advice = doubt.message.removeprefix(f"{log.source}: ")
            return refusal.__class__(
                refusal.what, where=refusal.where, advice=f"{advice[:1].upper()}{advice[1:]}"
            )
    return refusal


def _agree(fits: Mapping[str, "Fit"], kind: str) -> str:
    """The sentence that parts agree, with the gains of each."""
    units = next(iter(fits.values())).log_units
    alike = {name: one.in_units(units) for name, one in fits.items()}
    if len(alike) > SHOWN:
        order = sorted(alike, key=lambda name: alike[name].gains["kV"])
        alike = {name: alike[name] for name in (order[0], order[-1])}
    gains = [
        f"{gain} {' and '.join(f'{one.gains[gain]:{digits}}' for one in alike.values())}"
        for gain, digits in (("kV", ".4g"), ("kA", ".3g"))
    ]
    values = [one.gains["kV"] for one in fits.values()]
    apart = (max(values) - min(values)) / abs(sum(values) / len(values))
    unsure = SURELY * max(one.errors["kV"] / abs(one.gains["kV"]) for one in fits.values())
    agree = "agree within their errors" if apart <= unsure else f"agree within {apart:.1%}"
    names = "Left and right" if kind == SIDE else f"All {len(fits)} {kind}s"
    some = f" ({' and '.join(alike)}:" if kind != SIDE else ":"
    end = ")." if kind != SIDE else "."
    return (
        f"{names}, each fitted alone, {agree}{some} {', '.join(gains)}{end} "
        "The gains are their weighted mean."
    )
