"""Equal parts of a robot, as sides and modules: each is fitted, then the fits are pooled."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from sim.cli.log_reader import Parts
from sim.core.doubt import Doubt
from sim.core.errors import Refusal
from sim.core.log import Log
from sim.fit import Fit
from sim.fit.physics import compare_parts
from sim.fit.pooled import pool_fits
from sim.support.printable import format_with_error, join_names

SIDE, MOTOR, FILE = "side", "motor", "file"
SIDES = ("left", "right")
SIGNIFICANT = 3.0  # [standard errors] smaller differences can be noise
MOST_LISTED = 4  # [parts] in a sentence; of more parts, it lists the lowest and the highest


@dataclass(frozen=True)
class PooledParts:
    """The pooled fit of several parts, and the fit of each.

    Args:
        found: the pooled fit; if the parts differ, one of its doubts says so.
        fits: the name of each part -> its own fit.
        notes: sentences about parts that agree.
    """

    found: Fit
    fits: Mapping[str, Fit]
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


def fit_parts(parts: Parts, find: Callable[[Log], Fit], *, files: int = 1) -> PooledParts:
    """Fit every mechanism or side of a robot, compare the fits and pool them.

    Args:
        parts: the logs by the name of each part; at least one.
        find: fits one log.
        files: number of files that the parts come from.

    Raises:
        Refusal: no part can be fitted; it gives the reason for the first.
    """
    fits: dict[str, Fit] = {}
    refused: dict[str, Refusal] = {}
    for name, log in parts.items():
        try:
            fits[name] = find(log)
        except Refusal as refusal:
            refused[name] = refusal
    if not fits:
        name = next(iter(refused))
        raise _add_unit_advice(refused[name], parts[name])
    found = pool_fits(fits)
    if len(parts) == 1:
        return PooledParts(found, fits)
    kind = _name_kind(parts, files)
    left_out = tuple(
        Doubt("part-left-out", f"{kind} {name!r} cannot be fitted and was left out: {said.what}.")
        for name, said in refused.items()
    )
    if len(fits) == 1:
        return PooledParts(replace(found, doubts=(*found.doubts, *left_out)), fits)
    differ = compare_parts(fits, kind)
    found = replace(found, doubts=(*found.doubts, *differ, *left_out))
    return PooledParts(found, fits, () if differ else (_describe_agreement(fits, kind),))


def _name_kind(parts: Parts, files: int) -> str:
    """The word for the parts: side, motor or file."""
    if set(map(str.lower, parts)) == set(SIDES):
        return SIDE
    return FILE if files > 1 and len(parts) >= files else MOTOR


def _add_unit_advice(refusal: Refusal, log: Log) -> Refusal:
    """The refusal; if the log has a doubt about its units or velocity, with that advice."""
    for doubt in log.doubts:
        if doubt.code in {"unit-error", "contradicting-units"}:
            said = doubt.message.removeprefix(f"{log.source}: ")
            said = f"{said[:1].upper()}{said[1:]}"
            advice = said if doubt.action is None else doubt.action.add_before(said)
            return refusal.__class__(refusal.what, where=refusal.where, advice=advice)
    return refusal


def _describe_agreement(fits: Mapping[str, Fit], kind: str) -> str:
    """The sentence that parts agree, with the gains of each."""
    units = next(iter(fits.values())).log_units
    alike = {name: one.in_units(units) for name, one in fits.items()}
    if len(alike) > MOST_LISTED:
        order = sorted(alike, key=lambda name: alike[name].gains["kV"])
        alike = {name: alike[name] for name in (order[0], order[-1])}
    gains = []
    for gain in ("kV", "kA"):
        known = [format_with_error(one.gains[gain], one.errors[gain]) for one in alike.values()]
        gains.append(f"{gain} {join_names(known)}")
    values = [one.gains["kV"] for one in fits.values()]
    apart = (max(values) - min(values)) / abs(sum(values) / len(values))
    tolerance = SIGNIFICANT * max(one.errors["kV"] / abs(one.gains["kV"]) for one in fits.values())
    agree = "agree within their errors" if apart <= tolerance else f"agree within {apart:.1%}"
    names = "Left and right" if kind == SIDE else f"All {len(fits)} {kind}s"
    some = f" ({' and '.join(alike)}:" if kind != SIDE else ":"
    end = ")." if kind != SIDE else "."
    return (
        f"{names}, each fitted alone, {agree}{some} {', '.join(gains)}{end} "
        "The gains are their weighted mean."
    )
