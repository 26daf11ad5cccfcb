"""A learner's code is run apart: a process of its own that holds no key and returns only numbers.

    calls = [FunctionCall("fit", {"time": time, "voltage": voltage})]
    outcome = run_functions(Path("fit.py"), calls=calls)

The child (``sandbox_child.py``) confines itself before it reads the learner's file: no files but
Python's own, the data and an empty folder (``landlock.py``), no network, no processes,
nobody else's process (``seccomp.py``), so much time, memory and disk (``limits.py``). What it
says is judged outside (``result_parsing.py``), where nothing it made is ever imported or unpickled.
Where a system has no such confinement there are limits only, and ``find_isolation_level`` says so.

What has to run as a whole program, as a robot does, is confined in the same way by ``run_program``
(``sandbox_program.py`` outside, ``sandbox_program_child.py`` in the child); it leaves files for
others to judge.
"""

from grader.isolation.result_parsing import CallResult, format_one_line
from grader.isolation.sandbox_parent import (
    FunctionCall,
    Limits,
    SandboxOutcome,
    find_isolation_level,
    run_functions,
)
from grader.isolation.sandbox_program import run_program
from grader.isolation.scratch import scratch_folder

__all__ = [
    "CallResult",
    "FunctionCall",
    "Limits",
    "SandboxOutcome",
    "find_isolation_level",
    "format_one_line",
    "run_functions",
    "run_program",
    "scratch_folder",
]
