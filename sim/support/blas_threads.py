"""One thread for linear algebra: with small matrices, several threads are slower than one.

Measured in a notebook: a fit of 4 x 500 samples takes 3 times as long with a thread for each core.
"""

import os
import sys

VARIABLES = (
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "OMP_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)


def use_one_blas_thread() -> None:
    """Let NumPy's linear algebra use one thread, unless the environment says how many.

    The libraries read the environment once, when they are loaded. If NumPy was imported before, as
    in many notebooks, the number of threads is set in the library itself.
    """
    if any(name in os.environ for name in VARIABLES):
        return
    os.environ.update(dict.fromkeys(VARIABLES, "1"))
    if "numpy" in sys.modules:
        from threadpoolctl import threadpool_limits  # noqa: PLC0415 - only if NumPy was imported before

        threadpool_limits(limits=1, user_api="blas")
