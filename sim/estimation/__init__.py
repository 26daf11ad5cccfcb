"""What every fit needs: measurements, their noise, a first guess, and the Kalman filter."""
