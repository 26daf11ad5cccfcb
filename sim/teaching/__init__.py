"""What only the lessons use: prediction widgets, the runway bench, cases that R2 hides."""
