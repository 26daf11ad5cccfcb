"""Tools of the lessons only: answers, checked formulas, a runway, and R² cases."""
