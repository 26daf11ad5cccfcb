"""Tools of the lessons only: predictions, checked formulas, a runway, and R² cases."""
