"""Tests of the final model's residuals."""
