"""Summary of the residual tests of the final model."""

from dataclasses import dataclass, field

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.reconcile.residual_tests.repeatability import RepeatedResidual, find_repeated_residual
from sim.reconcile.residual_tests.spectrum import SpectralPeak, find_spectral_peak
from sim.reconcile.residual_tests.whiteness import WorstWindow, find_worst_window
from sim.reconcile.thresholds import PERIODIC, REPEATED, UNLIKELY_WINDOW


@dataclass(frozen=True)
class ResidualSummary:
    """Results of the residual tests.

    Args:
        worst_window: the least likely window of innovations.
        repeated: the residual that runs share at the same positions or speeds.
        peak: the largest peak in the spectrum of the residual.
    """

    worst_window: WorstWindow = field(default_factory=WorstWindow)
    repeated: RepeatedResidual = field(default_factory=RepeatedResidual)
    peak: SpectralPeak = field(default_factory=SpectralPeak)

    @property
    def has_unlikely_window(self) -> bool:
        """Whether the whiteness test found an unlikely window of innovations."""
        return self.worst_window.size > UNLIKELY_WINDOW

    @property
    def is_periodic(self) -> bool:
        """Whether the residual is periodic in time."""
        return self.peak.size > PERIODIC

    @property
    def is_repeated(self) -> bool:
        """Whether runs have the same residuals at the same positions or speeds."""
        return self.repeated.size > REPEATED

    @property
    def largest_ratio(self) -> float:
        """[1] largest result of the residual tests over its threshold."""
        return max(
            self.worst_window.size / UNLIKELY_WINDOW,
            self.peak.size / PERIODIC,
            self.repeated.size / REPEATED,
        )

    @property
    def has_structure(self) -> bool:
        """Whether any of the residual tests found structure."""
        return self.largest_ratio > 1.0

    @classmethod
    def summarize(cls, problem: PredictionErrorProblem, point: Estimate) -> "ResidualSummary":
        """The residual tests of an estimate's innovations."""
        return cls(
            find_worst_window(problem, point),
            find_repeated_residual(problem, point),
            find_spectral_peak(problem, point),
        )
