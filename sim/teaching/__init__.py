"""What only the lessons use: predictions, the runway, and cases that R² hides."""
