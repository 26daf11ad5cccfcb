"""Friction that differs from run to run, as a random effect.

A gear warms up, a chain lies otherwise, a carpet has a seam: kS of a run is kS + δ, δ ~ N(0, τ²),
and what is believed of δ goes into the search as what is believed of starts does:

    Σ (δ/τ)² + Σ log(1 + τ² a)        a the square of how a run's innovations change with its δ

The second sum is Laplace's correction for integrating over δ. τ is fixed, not fitted: with a free τ
a constant load would be taken for friction that is larger in forward runs than in reverse ones.
"""

from collections.abc import Mapping

import numpy as np

from sim.core.log import Array
from sim.estimation.run_nuisance import RunNuisance

VARIES = 0.04  # [of kS] τ, measured on logs of one day: two to six hundredths
LEAST_KS = 0.05  # [V] of which it is a share where kS is less


def get_friction_sd(values: Mapping[str, float]) -> float:
    """[V] τ, the standard deviation of friction between runs."""
    return VARIES * max(values["kS"], LEAST_KS)


def compute_friction_prior(values: Mapping[str, float], nuisance: RunNuisance) -> float:
    """Prior cost of the runs' own frictions, as -2 log L."""
    return float(np.sum(np.square(nuisance.friction_offset / get_friction_sd(values))))


def compute_laplace_correction(sd: float, slopes: Array) -> float:
    """Correction of -2 log L for integrating over a parameter that each run has of its own.

    Args:
        sd: standard deviation of the parameter between runs.
        slopes: (2 n, runs) derivatives of the whitened innovations by each run's own.
    """
    return float(np.sum(np.log1p(sd**2 * np.sum(np.square(slopes), axis=0))))
