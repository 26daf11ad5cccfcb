"""A fit as a picture, as text on a terminal, as a page, and as code."""
