"""A grade in words: on the terminal and as a page."""
