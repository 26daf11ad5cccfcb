"""Compares applied with requested voltages, and logged with true values."""

import math
import statistics
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from grader.robotcode.bench.facts import Driven, Sent, Signal
from grader.robotcode.library.base import Unknown

if TYPE_CHECKING:
    from grader.robotcode.bench.routine_run import Row

CLOSE = 1e-3  # [V] what two voltages may differ in that are the same
ALIKE, MOSTLY = 0.1, 0.9  # [V], [share of the loops] a steady voltage: the battery may sag once
JUMP = 0.5  # [share of its range] by which a position changes where its sensor begins anew
ENDS = 2  # loops in which a program may settle
ROUNDING = 1e-9  # [share of a signal's range] two errors that differ by less are equal
TRUE = 2e-3  # [share of a signal's range] that a logged value may be off
HICCUP = 0.995  # [share of a voltage] below which a motor was limited


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def compare_motor(name: str, rows: Sequence["Row"], sent: tuple[Sent, ...]) -> Driven:
    """The commands of a motor in a test, compared with the test's voltage."""
    unknown = next(
        (r.applied[name].unknown_text for r in rows if isinstance(r.applied[name], Unknown)), ""
    )
    if unknown or not rows:
        return Driven(loops=len(rows), unknown=unknown, sent=sent)
    got = [float(row.applied[name]) for row in rows]
    asked = [max(-row.battery, min(row.asked, row.battery)) for row in rows]
    limits = [row.limits.get(name, 1.0) for row in rows]
    off = [k for k in range(len(rows)) if abs(got[k] - asked[k] * limits[k]) > CLOSE]
    late = [k for k in range(1, len(rows)) if abs(got[k] - asked[k - 1] * limits[k]) > CLOSE]
    at = (0.0, 0.0, 0.0)
    if off:  # where it differs most tells most
        worst = max(off, key=lambda k: abs(got[k] - asked[k]))
        at = (rows[worst].time, asked[worst], got[worst])
    free = [(g, a) for g, a, limit in zip(got, asked, limits, strict=True) if limit == 1.0]
    large = [g / a for g, a in free if abs(a) > 0.5]  # noqa: PLR2004 - [V]
    ratio = large[-1] if large and max(large) - min(large) < 0.02 else None  # noqa: PLR2004 - as PWM's steps
    usual = statistics.median(got)
    steady = sum(abs(g - usual) < ALIKE for g in got) > MOSTLY * len(got)
    return Driven(
        len(rows), len(off), at, ratio, steady,
        late=len(off) > ENDS and not late,
        never=all(abs(g) < CLOSE for g in got),
        flipped=any(name in row.flipped for row in rows),
        sent=sent,
        cut=_find_cut(name, rows, off, got),
    )  # fmt: skip


def _find_cut(name: str, rows: Sequence["Row"], off: list[int], got: list[float]) -> float | None:
    """The position beyond which a motor got no voltage; None if there is none."""
    if not off or len(off) <= ENDS or name not in rows[off[0]].truth:
        return None
    tail = off == list(range(off[0], len(rows))) and all(abs(got[k]) < CLOSE for k in off)
    return rows[off[0]].truth[name][1] if tail else None


def compare_signal(name: str, signal: str, rows: Sequence["Row"]) -> Signal:
    """One signal of the log, held against everything that it could be."""
    found = [
        (k, [e for e in row.entries if str(e.motor) == name and e.signal == signal])
        for k, row in enumerate(rows)
    ]
    listed = [(k, entries) for k, entries in found if entries]
    last = listed[-1][1][-1]
    made: dict[str, Any] = {
        "loops": len(listed),
        "line": int(last.line),
        "unit": last.unit,
        "family": last.family,
        "twice": any(len(entries) > 1 for _, entries in listed),
    }
    pairs = [(k, entries[-1].value) for k, entries in listed]
    unknown = next((v.unknown_text for _, v in pairs if isinstance(v, Unknown)), "")
    if unknown:
        return Signal(unknown=unknown, **made)
    if not all(_is_number(v) for _, v in pairs):
        return Signal(**made)
    values = [float(v) for _, v in pairs]
    turned = {motor for row in rows for motor, true in row.truth.items() if abs(true[2]) > TRUE}
    made["values"] = (values[0], values[-1])
    made["still"] = max(values) - min(values) <= 1e-9 * max(1.0, abs(values[0]))  # rounding
    at_rest = not any(values) and turned < rows[0].truth.keys()  # right of a motor that rests
    made["idle"] = not turned or at_rest
    if signal == "voltage":
        return _compare_voltage([(k, float(v)) for k, v in pairs], rows, made)
    return _compare_motion([(k, float(v)) for k, v in pairs], rows, made, signal)


def _compare_voltage(
    pairs: list[tuple[int, float]], rows: Sequence["Row"], made: dict[str, Any]
) -> Signal:
    battery = all(abs(v - rows[k].battery) < 2 * CLOSE for k, v in pairs)
    asked = all(abs(v - rows[k].asked) < CLOSE for k, v in pairs)
    limited = any(min(rows[k].limits.values(), default=1.0) < HICCUP for k, _ in pairs)
    exact: list[str] = []
    near: dict[str, tuple[float, bool]] = {}  # motor -> factor, and whether only the sign is lost
    for motor in rows[0].truth:
        for lag in (0, 1):
            paired = _pair_with_truth(pairs, rows, motor, 0, lag)
            truth = [(t, v) for t, v in paired if _is_number(t)]
            if not truth or all(abs(t) < CLOSE for t, _ in truth):
                continue
            large = [v / t for t, v in truth if abs(t) > 0.5]  # noqa: PLR2004 - [V]
            if max(abs(t - v) for t, v in truth) < CLOSE:
                exact.append(motor)
                break
            if large and max(large) - min(large) < 0.01 * abs(large[0]):  # of a share
                near.setdefault(motor, (large[-1], False))
            elif max(abs(abs(t) - v) for t, v in truth) < CLOSE:
                near.setdefault(motor, (1.0, True))
    made |= {"asked": asked and limited and not exact, "battery": battery}
    owners = tuple(exact or near)
    if not owners:
        return Signal(**made)
    factor, absolute = (1.0, False) if exact else near[owners[0]]
    return Signal(
        follows=f"voltage {owners[0]}", owners=owners, scale=factor, absolute=absolute, **made
    )


def _compare_motion(
    pairs: list[tuple[int, float]], rows: Sequence["Row"], made: dict[str, Any], signal: str
) -> Signal:
    if signal == "position":
        pairs = _unwrap_position(pairs)
    best: tuple[float, str, float, float, bool] = (TRUE, "", 0.0, 0.0, False)
    errors: dict[str, float] = {}  # of a line through the truth of a motor, the least
    for part in (2, 1) if signal == "velocity" else (1, 2):
        for motor in rows[0].truth:
            name = f"{('', 'position', 'velocity')[part]} {motor}"
            for lag in (0, 1):
                truth = _pair_with_truth(pairs, rows, motor, part, lag)
                error, slope, offset = _fit_line(truth)
                errors[name] = min(error, errors.get(name, error))
                if error < best[0] * 0.99 - ROUNDING:  # else a rise fits its own shift as exactly
                    best = (error, name, slope, offset, False)
                error, slope, offset = _fit_line([(abs(t), v) for t, v in truth])
                if slope and error < best[0] * 0.5 and min(t for t, _ in truth) < 0:
                    best = (error, name, slope, offset, True)
        if best[1]:
            break
    _, follows, slope, offset, absolute = best
    if not follows or made["still"]:
        return Signal(**made)
    nearest = best[0] * 1.01  # a follower turns as its leader does
    alike = [name for name, error in errors.items() if name == follows or error <= nearest]
    owners = tuple(name.partition(" ")[2] for name in alike)
    return Signal(
        follows=follows, owners=owners, scale=slope, offset=offset, absolute=absolute, **made
    )


def _pair_with_truth(
    pairs: list[tuple[int, float]], rows: Sequence["Row"], motor: str, part: int, lag: int
) -> list[tuple[Any, float]]:
    """Pairs of logged and true values of a motor, from the same loop or the one before."""
    return [
        (rows[k - lag].truth[motor][part], v) for k, v in pairs if k >= lag and rows[k - lag].truth
    ]


def _unwrap_position(pairs: list[tuple[int, float]]) -> list[tuple[int, float]]:
    """A position without the jumps of an absolute sensor, which begins anew each rotation."""
    span = max(v for _, v in pairs) - min(v for _, v in pairs)
    added, before, step = 0.0, pairs[0][1], 0.0
    found = [pairs[0]]
    for k, value in pairs[1:]:
        change = value - before
        if abs(change) > JUMP * span and abs(step) < JUMP * span and change * step < 0:
            added -= change - step
        else:
            step = change
        before = value
        found.append((k, value + added))
    return found


def _fit_line(pairs: Sequence[tuple[float, float]]) -> tuple[float, float, float]:
    """The worst residual over the range of ``y``, slope and intercept of the best line."""
    count = len(pairs)
    if count < 3:  # noqa: PLR2004 - two points are always on a line
        return math.inf, 0.0, 0.0
    mean_x = sum(x for x, _ in pairs) / count
    mean_y = sum(y for _, y in pairs) / count
    square = sum((x - mean_x) ** 2 for x, _ in pairs)
    span = max(y for _, y in pairs) - min(y for _, y in pairs)
    if square <= 0.0 or span <= 0.0:
        return math.inf, 0.0, 0.0
    slope = sum((x - mean_x) * (y - mean_y) for x, y in pairs) / square
    offset = mean_y - slope * mean_x
    worst = max(abs(y - slope * x - offset) for x, y in pairs)
    return worst / span, slope, offset
