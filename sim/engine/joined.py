"""Motor and load joined by a spring: where they are after a step, however fast they swing.

    d' = v - w        own·v' = b - kV·v - push        other·w' = r + push        y' = w
    push = d·stiff + (v - w)·damp

is linear, so while b and r [V] stay the same its exact solution is a table of numbers that depends
on the step alone. It is made of the series of the exponential for a short moment, doubled until it
spans the step (Moler and Van Loan 2003, method 3), and kept for the next step that is as long.

``ways`` holds the step [s] and the inertia [V·s²/unit] it was made for, then the tables of half the
step and of the whole: four rows (d, v, w, and how far the load goes) of what d, v, w, b and r do.
"""

import math

from sim.log import Array  # composed: end

STEP, HEAVY, HALF = 0, 1, 2  # places in ``ways``
ROW = 5  # numbers
TABLE = 4 * ROW
WHOLE = HALF + TABLE
WAYS = WHOLE + TABLE  # numbers in all
SHORT = 0.25  # [1] of the fastest rate that the moment of the series lasts
TERMS = 8  # of it: what is left out is a part in 10¹¹
SAME = 1e-9  # [s] steps that differ by less are one


def tabled(
    ways: Array, dt: float, kv: float, own: float, other: float, stiff: float, damp: float
) -> None:
    """Make the tables of a step, if they are not there."""
    if abs(ways[STEP] - dt) < SAME and ways[HEAVY] == own + other:
        return
    rate = max((damp + kv) / own, damp / other, math.sqrt(stiff * (own + other) / (own * other)))
    doublings = 0
    moment = 0.5 * dt
    while moment * rate > SHORT:
        moment *= 0.5
        doublings += 1
    series(ways, moment, kv, own, other, stiff, damp)
    for _ in range(doublings):
        double_table(ways, HALF, HALF)
    double_table(ways, HALF, WHOLE)
    ways[STEP], ways[HEAVY] = dt, own + other


def series(
    ways: Array, moment: float, kv: float, own: float, other: float, stiff: float, damp: float
) -> None:
    """The table of a moment, at the place of the half step: row by row, term by term."""
    for row in range(4):
        d = v = w = b = r = 0.0
        if row == 0:
            d = 1.0
        elif row == 1:
            v = 1.0
        elif row == 2:
            w = 1.0
        at = HALF + row * ROW
        way = 1.0 if row == 3 else 0.0  # the load's way begins with w
        ways[at], ways[at + 1], ways[at + 2], ways[at + 3], ways[at + 4] = d, v, w, b, r
        for term in range(1, TERMS + 1):
            part = moment / term
            apart = v / own - w / other  # what a push between the two does
            b, r = part * v / own, part * w / other
            d, v, w = (
                -part * stiff * apart,
                part * (d - damp * apart - kv * v / own),
                part * (way - d + damp * apart),
            )
            way = 0.0
            ways[at] += d
            ways[at + 1] += v
            ways[at + 2] += w
            ways[at + 3] += b
            ways[at + 4] += r


def double_table(ways: Array, at: int, to: int) -> None:
    """The table of twice the time, which may take the place of the one it is made of."""
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


def becomes(ways: Array, at: int, d: float, v: float, w: float, b: float, r: float) -> float:
    """What a row of a table makes of a motion and of what pushes it."""
    return float(
        ways[at] * d + ways[at + 1] * v + ways[at + 2] * w + ways[at + 3] * b + ways[at + 4] * r
    )
