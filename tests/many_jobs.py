"""Jobs for the tests of executors; child processes import this module."""

import os
import time

from sim.support.work.child import ChildEnded, run_in_child

DIES, HANGS = 17, 18


def square(number: int) -> int:
    """The work of a job, which one number kills and another never ends."""
    if number == DIES:
        os._exit(3)
    if number == HANGS:
        time.sleep(3600)
    return number * number


def square_in_child(number: int) -> int | str:
    """The result, or what became of the child."""
    try:
        return run_in_child(square, number, seconds=5.0)
    except (ChildEnded, TimeoutError) as ended:
        return type(ended).__name__
