"""Exact solution of two inertias joined by a spring (modal step).

    d' = v - w        own·v' = b - kV·v - push        other·w' = r + push        y' = w
    push = d·stiff + (v - w)·damp

is linear, so while b and r [V] stay the same its exact solution is a table of numbers that depends
on the step alone: four rows (d, v, w, and how far the load goes) of what d, v, w, b and r do. It is
made of the series of the exponential for a short moment, doubled until it spans the step (Moler and
Van Loan 2003, method 3), and kept for the next step that is as long.

``ways`` holds what was made for a motor and its load, twice: for a load that moves, and for one
that stands. Each has the terms of the series, and a table for a step, for half of it, for half of
that and so on: where something happens in a step, its parts are tried.
"""

import math

from sim.core.log import Array

KNOWN, STIFF, DAMP, SMALL = range(4)  # places in ``ways``: for which kA [V·s²/unit], what joins
# them, and a small step [s]; then come the two sets
SETS = 4
HEAVY, RATE = 0, 1  # places in a set: the inertia it was made for, and its fastest rate [1/s]
LEVELS = 10  # tables: of a step, of half of it, ...
ROW = 5  # numbers
TABLE = 4 * ROW
FIRST = 2  # table in a set: the step [s] of which it is a part, then its numbers
TERMS = 12  # of the series beyond the first: what is left out is a part in 10¹¹
POWERS = FIRST + LEVELS * (1 + TABLE)  # the terms
SET = POWERS + (TERMS + 1) * TABLE
MOVES, STANDS = SETS, SETS + SET  # where the sets begin
WAYS = SETS + 2 * SET  # numbers in all
MOST = 60  # doublings, of a rate that has no end
SHORT = 0.7  # [1] of the fastest rate that the moment of the series lasts
SAME = 1e-9  # [s] steps that differ by less are one


def prepare_series(
    ways: Array, at: int, kv: float, own: float, other: float, stiff: float, damp: float
) -> None:
    """Make the terms of a set, if they are not there: row by row, each of the one before."""
    if ways[at + HEAVY] == own + other:
        return
    ways[at + HEAVY] = own + other
    ways[at + RATE] = max(
        (damp + kv) / own, damp / other, math.sqrt(stiff * (own + other) / (own * other))
    )
    for level in range(LEVELS):
        ways[at + FIRST + level * (1 + TABLE)] = -1.0
    for row in range(4):
        d = v = w = b = r = 0.0
        if row == 0:
            d = 1.0
        elif row == 1:
            v = 1.0
        elif row == 2:
            w = 1.0
        way = 1.0 if row == 3 else 0.0  # the load's way begins with w
        for term in range(TERMS + 1):
            to = at + POWERS + term * TABLE + row * ROW
            ways[to], ways[to + 1], ways[to + 2], ways[to + 3], ways[to + 4] = d, v, w, b, r
            part = 1.0 / (term + 1)
            apart = v / own - w / other  # what a push between the two does
            b, r = part * v / own, part * w / other
            d, v, w = (
                -part * stiff * apart,
                part * (d - damp * apart - kv * v / own),
                part * (way - d + damp * apart),
            )
            way = 0.0


def make_table(ways: Array, at: int, dt: float, level: int) -> int:
    """Index of the transition table of one part of a time step, computed if it is missing.

    The series converges for short times only, so a long part is halved and then doubled again.
    """
    step = at + FIRST + level * (1 + TABLE)
    if abs(ways[step] - dt) < SAME:
        return step + 1
    moment, doublings = dt / (1 << level), 0
    while moment * ways[at + RATE] > SHORT and doublings < MOST:
        moment *= 0.5
        doublings += 1
    sum_series(ways, at + POWERS, moment, step + 1)
    for _ in range(doublings):
        make_doubled_table(ways, step + 1, step + 1)
    ways[step] = dt
    return step + 1


def make_table_from_half(ways: Array, at: int, dt: float, level: int) -> int:
    """Index of the transition table of one part of a time step, from that of half the part."""
    step = at + FIRST + level * (1 + TABLE)
    if abs(ways[step] - dt) < SAME:
        return step + 1
    make_doubled_table(ways, make_table(ways, at, dt, level + 1), step + 1)
    ways[step] = dt
    return step + 1


def sum_series(ways: Array, powers: int, moment: float, to: int) -> None:
    """Compute the transition table of a short time from the terms of its power series."""
    last = powers + TERMS * TABLE
    for i in range(TABLE):
        ways[to + i] = ways[last + i]
    for term in range(TERMS):
        here = last - (term + 1) * TABLE
        for i in range(TABLE):
            ways[to + i] = ways[to + i] * moment + ways[here + i]


def make_doubled_table(ways: Array, at: int, to: int) -> None:
    """Make the table of twice the time of a table; ``to`` may be ``at``."""
    d0, v0, w0, b0, r0 = ways[at], ways[at + 1], ways[at + 2], ways[at + 3], ways[at + 4]
    d1, v1, w1, b1, r1 = ways[at + 5], ways[at + 6], ways[at + 7], ways[at + 8], ways[at + 9]
    d2, v2, w2, b2, r2 = ways[at + 10], ways[at + 11], ways[at + 12], ways[at + 13], ways[at + 14]
    for row in range(4):
        here, there = at + row * ROW, to + row * ROW
        d, v, w, b, r = ways[here], ways[here + 1], ways[here + 2], ways[here + 3], ways[here + 4]
        on = 1.0 if row == 3 else 0.0  # a way adds up
        ways[there] = d * d0 + v * d1 + w * d2 + on * d
        ways[there + 1] = d * v0 + v * v1 + w * v2 + on * v
        ways[there + 2] = d * w0 + v * w1 + w * w2 + on * w
        ways[there + 3] = d * b0 + v * b1 + w * b2 + b + on * b
        ways[there + 4] = d * r0 + v * r1 + w * r2 + r + on * r


def apply_row(ways: Array, at: int, d: float, v: float, w: float, b: float, r: float) -> float:
    """The product of row ``at`` of the transition table with five numbers.

    They are the distance and the two velocities of the bodies, and the two voltages.
    """
    return float(
        ways[at] * d + ways[at + 1] * v + ways[at + 2] * w + ways[at + 3] * b + ways[at + 4] * r
    )
