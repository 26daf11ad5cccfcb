"""Exact solution of two inertias joined by a spring (modal step).

    d' = v - w        own·v' = b - kV·v - push        other·w' = r + push        y' = w
    push = d·stiff + (v - w)·damp

is linear, so for constant b and r [V] the state after a step is a (4, 5) transition table times
(d, v, w, b, r): its rows give d, v, w, and the way of the load. The table depends on the length of
the step alone. It is the power series of the matrix exponential for a short time, doubled until it
spans the step (Moler and Van Loan 2003, method 3), and is cached for the next step of that length.

``tables`` is the cache for a motor and its load, in two sets: for a load that moves, and for one
that stands. Each set has the terms of the series, and the tables of a step, of half of it, of a
quarter and so on, for steps that are halved.
"""

import math

from sim.core.log import Array

KNOWN, STIFF, DAMP, SMALL = range(4)  # places in ``tables``: the kA [V·s²/unit] it is for, the
# joint's stiffness and damping, and the shortest part of a step [s]; then come the two sets
SETS = 4
HEAVY, RATE = 0, 1  # places in a set: the inertia it was made for, and its fastest rate [1/s]
LEVELS = 10  # tables of a set: of a step, of half of it, ...
ROW = 5  # numbers in a row of a table
TABLE = 4 * ROW
FIRST = 2  # place of the first table in a set: the whole step [s], then the table's numbers
TERMS = 12  # terms of the series beyond the first: the truncation error is a part in 10¹¹
POWERS = FIRST + LEVELS * (1 + TABLE)  # place of the series' terms in a set
SET = POWERS + (TERMS + 1) * TABLE
MOVES, STANDS = SETS, SETS + SET  # places of the two sets
TABLES_SIZE = SETS + 2 * SET  # length of ``tables``
MOST = 60  # doublings at most, also for an infinite rate
SHORT = 0.7  # [1] fastest rate times the time of the series: there it converges fast
SAME_STEP = 1e-12  # [s] steps that differ by less share a table


def prepare_series(
    tables: Array, at: int, kv: float, own: float, other: float, stiff: float, damp: float
) -> None:
    """Compute the series' terms of the set at ``at``, unless they are for the same inertias."""
    if tables[at + HEAVY] == own + other:
        return
    tables[at + HEAVY] = own + other
    tables[at + RATE] = max(
        (damp + kv) / own, damp / other, math.sqrt(stiff * (own + other) / (own * other))
    )
    for level in range(LEVELS):
        tables[at + FIRST + level * (1 + TABLE)] = -1.0
    for row in range(4):
        d = v = w = b = r = 0.0
        if row == 0:
            d = 1.0
        elif row == 1:
            v = 1.0
        elif row == 2:
            w = 1.0
        way = 1.0 if row == 3 else 0.0  # the derivative of the load's way is w
        for term in range(TERMS + 1):
            to = at + POWERS + term * TABLE + row * ROW
            tables[to], tables[to + 1], tables[to + 2] = d, v, w
            tables[to + 3], tables[to + 4] = b, r
            part = 1.0 / (term + 1)
            apart = v / own - w / other  # acceleration of d by a force between the two
            b, r = part * v / own, part * w / other
            d, v, w = (
                -part * stiff * apart,
                part * (d - damp * apart - kv * v / own),
                part * (way - d + damp * apart),
            )
            way = 0.0


def make_table(tables: Array, at: int, dt: float, level: int) -> int:
    """Index of the transition table of one part of a time step, computed if it is missing.

    The series converges for short times only, so a long part is halved and then doubled again.
    """
    step = at + FIRST + level * (1 + TABLE)
    if abs(tables[step] - dt) < SAME_STEP:
        return step + 1
    span, doublings = dt / (1 << level), 0
    while span * tables[at + RATE] > SHORT and doublings < MOST:
        span *= 0.5
        doublings += 1
    sum_series(tables, at + POWERS, span, step + 1)
    for _ in range(doublings):
        make_doubled_table(tables, step + 1, step + 1)
    tables[step] = dt
    return step + 1


def make_table_from_half(tables: Array, at: int, dt: float, level: int) -> int:
    """Index of the transition table of one part of a time step, from that of half the part."""
    step = at + FIRST + level * (1 + TABLE)
    if abs(tables[step] - dt) < SAME_STEP:
        return step + 1
    make_doubled_table(tables, make_table(tables, at, dt, level + 1), step + 1)
    tables[step] = dt
    return step + 1


def sum_series(tables: Array, powers: int, span: float, to: int) -> None:
    """Compute the transition table of a short time from the terms of its power series."""
    last = powers + TERMS * TABLE
    for i in range(TABLE):
        tables[to + i] = tables[last + i]
    for term in range(TERMS):
        here = last - (term + 1) * TABLE
        for i in range(TABLE):
            tables[to + i] = tables[to + i] * span + tables[here + i]


def make_doubled_table(tables: Array, at: int, to: int) -> None:
    """Compute the table of a step twice as long, by applying the step of a table twice.

    Args:
        tables: all tables, one after another.
        at: index of the first number of the given table.
        to: the same of the result; it may be ``at``.
    """
    d0, v0, w0, b0, r0 = tables[at], tables[at + 1], tables[at + 2], tables[at + 3], tables[at + 4]
    d1, v1, w1 = tables[at + 5], tables[at + 6], tables[at + 7]
    b1, r1 = tables[at + 8], tables[at + 9]
    d2, v2, w2 = tables[at + 10], tables[at + 11], tables[at + 12]
    b2, r2 = tables[at + 13], tables[at + 14]
    for row in range(4):
        here, there = at + row * ROW, to + row * ROW
        d, v, w = tables[here], tables[here + 1], tables[here + 2]
        b, r = tables[here + 3], tables[here + 4]
        on = 1.0 if row == 3 else 0.0  # the ways of both halves add up
        tables[there] = d * d0 + v * d1 + w * d2 + on * d
        tables[there + 1] = d * v0 + v * v1 + w * v2 + on * v
        tables[there + 2] = d * w0 + v * w1 + w * w2 + on * w
        tables[there + 3] = d * b0 + v * b1 + w * b2 + b + on * b
        tables[there + 4] = d * r0 + v * r1 + w * r2 + r + on * r


def apply_row(tables: Array, at: int, d: float, v: float, w: float, b: float, r: float) -> float:
    """The product of row ``at`` of the transition table with five numbers.

    They are the deflection [unit], the velocities of motor and load [unit/s], and b and r [V].
    """
    return float(
        tables[at] * d
        + tables[at + 1] * v
        + tables[at + 2] * w
        + tables[at + 3] * b
        + tables[at + 4] * r
    )
