"""Shared by all fits: measurements and their noise, initial guess, Kalman filter, likelihood."""
