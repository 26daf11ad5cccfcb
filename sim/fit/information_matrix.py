"""Fisher information of a log about each gain, before anything is fitted.

Each row is one equation, V = kS·sgn(v) + kV·v + kA·a (+ kG·…), and each gain has a regressor, its
column. With X the columns and σ the noise of a row in volts, XᵀX/σ² is the Fisher information, and
the diagonal of its inverse holds the squares of the standard errors. If a column is a combination
of the others, there is no inverse: that gain is not identifiable, however many rows there are.

Use simulated rows without noise: noise in an acceleration would count as excitation.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.errors import BadRequest, refuse_unknown
from sim.core.log import Array
from sim.core.vocabulary import TYPES
from sim.fit.sysid_rows import Rows

LEAST_EIGENVALUE = 1e-12  # [share of the largest] a smaller one is rounding
LEAST_WEIGHT = 1e-5  # [1] of a gain in an unknown combination; with less, the gain is known


@dataclass(frozen=True, eq=False)
class InformationMatrix:
    """Fisher information about the gains.

    Args:
        names: names of the gains.
        information: (gains, gains) XᵀX/σ² [1/unit² of the gains].
    """

    names: tuple[str, ...]
    information: Array

    @property
    def errors(self) -> dict[str, float]:
        """Standard error of each gain; infinite where the rows do not determine it."""
        size = np.sqrt(np.diag(self.information))
        scale = np.where(size > 0.0, size, 1.0)
        values, vectors = np.linalg.eigh(self.information / np.outer(scale, scale))
        known = values > LEAST_EIGENVALUE * max(float(values[-1]), 1e-300)
        squares = (vectors[:, known] ** 2 / values[known]).sum(axis=1)
        unknown = (np.abs(vectors[:, ~known]) > LEAST_WEIGHT).any(axis=1)
        return {
            name: math.inf if lost else math.sqrt(float(square)) / float(one)
            for name, lost, square, one in zip(self.names, unknown, squares, scale, strict=True)
        }


def compute_information(rows: Mapping[str, Rows], *, type: str, noise: float) -> InformationMatrix:  # noqa: A002 - the field's word
    """Information of rows about kS, kV, kA, and about kG where there is gravity.

    Args:
        rows: test -> its rows, as from ``sim.fit.sysid_rows``; any tests, at least one.
        type: ``simple``, ``elevator`` or ``arm``.
        noise: [V] standard deviation of a row: kA times that of its acceleration.

    Raises:
        BadRequest: no rows, an unknown type, or a noise that is not above zero.

    Examples:
        >>> from sim.fit.sysid_rows import Rows
        >>> one = np.ones(3)
        >>> rows = Rows(one, one, one, one, np.arange(3.0), np.array([2.0, 0.0, 1.0]))
        >>> found = compute_information({"dynamic-forward": rows}, type="simple", noise=0.1)
        >>> found.information.shape
        (3, 3)
    """
    refuse_unknown("type", type, TYPES)
    if not (math.isfinite(noise) and noise > 0.0):
        raise BadRequest(f"the noise must be above 0, not {noise:g} V", advice="Give its size.")
    if not any(len(part) for part in rows.values()):
        raise BadRequest("there are no rows", advice="Give at least one test that moves.")
    parts = [_list_regressors(part, type=type) for part in rows.values()]
    columns = np.concatenate(parts, axis=1)
    names = ("kS", "kV", "kA") if type == "simple" else ("kS", "kV", "kA", "kG")
    return InformationMatrix(names, columns @ columns.T / noise**2)


def _list_regressors(rows: Rows, *, type: str) -> Array:  # noqa: A002 - the field's word
    """(gains, n) the regressor of each gain."""
    columns = [np.sign(rows.velocity), rows.velocity, rows.acceleration]
    if type == "elevator":
        columns.append(np.ones(len(rows)))
    elif type == "arm":
        columns.append(np.cos(rows.position))
    return np.asarray(np.stack(columns))
