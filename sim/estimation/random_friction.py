"""Friction that differs from run to run, as a random effect.

A gear warms up, a chain lies differently, a carpet has a seam: the friction of a run is kS + δ with
δ ~ N(0, τ²). This prior adds to -2 log L

    Σ (δ/τ)² + Σ log(1 + τ² a)        a = |∂ (whitened innovations of a run)/∂δ|²

The second sum is Laplace's correction for integrating over δ. τ is fixed, not fitted: with a free τ
a constant load would be absorbed as larger friction of the forward runs.
"""

from collections.abc import Mapping

import numpy as np

from sim.core.log import Array

VARIES = 0.04  # [of kS] τ; measured on logs of one day, it is 0.02 to 0.06
LEAST_KS = 0.05  # [V] a smaller kS has the priors of friction of this one


def get_friction_sd(values: Mapping[str, float]) -> float:
    """[V] τ, the standard deviation of friction between runs."""
    return VARIES * max(values["kS"], LEAST_KS)


def compute_laplace_correction(sd: float, slopes: Array) -> float:
    """Correction of -2 log L for integrating over a parameter that differs from run to run.

    Args:
        sd: standard deviation of the parameter between runs.
        slopes: (2 n, runs) derivatives of the whitened innovations by each run's value.
    """
    return float(np.sum(np.log1p(sd**2 * np.sum(np.square(slopes), axis=0))))
