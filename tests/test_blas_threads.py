"""Linear algebra runs on one thread, whichever of NumPy and ``sim`` is imported first."""

import os
import subprocess
import sys

import pytest

from sim.support.blas_threads import VARIABLES

COUNT = (
    "from threadpoolctl import threadpool_info\n"
    "found = [one['num_threads'] for one in threadpool_info() if one['user_api'] == 'blas']\n"
    "print(*found)\n"
)


def blas_threads(first, **environment):
    """How many threads each BLAS library of a new process has after some imports."""
    clean = {name: value for name, value in os.environ.items() if name not in VARIABLES}
    done = subprocess.run(
        [sys.executable, "-c", f"{first}\n{COUNT}"],
        env={**clean, **environment}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return [int(count) for count in done.stdout.split()]


@pytest.mark.parametrize("first", ["import sim, numpy", "import numpy, sim"])
def test_blas_uses_one_thread_whichever_is_imported_first(first):
    found = blas_threads(first)

    if not found:
        pytest.skip("this NumPy has no BLAS library that can be asked")
    assert set(found) == {1}


@pytest.mark.parametrize("first", ["import sim, numpy", "import numpy, sim"])
def test_thread_count_in_the_environment_is_kept(first):
    found = blas_threads(first, OPENBLAS_NUM_THREADS="2", MKL_NUM_THREADS="2")

    assert found == blas_threads("import numpy", OPENBLAS_NUM_THREADS="2", MKL_NUM_THREADS="2")
